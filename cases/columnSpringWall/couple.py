#!/usr/bin/python3
"""Couples column and wall in many ways, each run in a folder variants/<name> of its own with its wall.csv:

    couple.py            all runs of README.md; the case must be seeded, the utilities on PATH (Allrun sees to both)

A run that breaks off is a result too: what wallMaster said is in its log.wallMaster.
"""

import shutil
import subprocess
import sys
from pathlib import Path

WINDOWS = (0.0005, 0.001, 0.002, 0.004, 0.008, 0.016, 0.032)  # [s]; the first, implicit, is what the others are measured against
MASSES = (20000, 10000, 5000, 2500, 1200, 600, 300, 150, 75)  # [kg/m]
SCHEMES = ("implicit", "explicit")
LINKS = ("inProcess", "socket", "fmu", "precice")
WAIT = 60  # [s] for a program that should be done long ago


def program(name):
    """Path of a program, None if there is none."""
    return shutil.which(name)


def copy(case, name):
    """variants/<name>: the seeded case without results."""
    folder = Path(case) / "variants" / name
    shutil.rmtree(folder, ignore_errors=True)
    for part in ("constant", "system", "geometry", "0"):
        shutil.copytree(Path(case) / part, folder / part)
    shutil.copy(Path(case) / "precice-config.xml", folder)
    return folder


def call(folder, *arguments):
    """Runs a program in a folder, what it says in its log; the exit code."""
    with open(folder / f"log.{arguments[0]}", "a") as log:
        return subprocess.run(arguments, cwd=folder, stdout=log, stderr=subprocess.STDOUT, timeout=WAIT).returncode


def start(folder, *arguments):
    with open(folder / f"log.{arguments[0]}", "a") as log:
        return subprocess.Popen(arguments, cwd=folder, stdout=log, stderr=subprocess.STDOUT)


def in_process(case, name, *options):
    folder = copy(case, name)
    return call(folder, "wallMaster", "-case", ".", "-output", "wall.csv", *map(str, options))


def by_socket(case, name, *options):
    folder = copy(case, name)
    server = start(folder, "soilServer", ".", "soil")
    code = call(folder, "wallMaster", "-socket", "soil", "-output", "wall.csv", *map(str, options))
    return server.wait(WAIT) or code


def by_fmu(case, name, *options):
    folder = copy(case, name)
    if call(folder, "exportFMU", "-output", "column.fmu") != 0:
        return 1
    shutil.unpack_archive(folder / "column.fmu", folder / "fmu", "zip")
    return call(folder, "wallMaster", "-fmu", "fmu", "-output", "wall.csv", *map(str, options))


def by_precice(case, name, scheme, mass=20000, stiffness=5e5):
    """Two processes, coupled by precice-config.xml: the file says implicit; explicit is made from it."""
    folder = copy(case, name)
    config = folder / "precice-config.xml"
    if scheme == "explicit":
        text = config.read_text().replace("serial-implicit", "serial-explicit")
        begin, end = text.index("    <max-iterations"), text.index("    <exchange")
        text = text[:begin] + text[end:]
        begin, end = text.index("    <relative-convergence"), text.index("  </coupling-scheme")
        config.write_text(text[:begin] + text[end:])
    wall = start(folder, "wallForPrecice", config.name, str(mass), "0", str(stiffness), "wall.csv")
    code = call(folder, "mpmCouple")
    return wall.wait(WAIT) or code


def main():
    case = Path(__file__).resolve().parent
    if not (case / "0").is_dir():
        sys.exit("couple.py: the case has no state: run Allrun, or seedParticles")
    failed = []
    for scheme in SCHEMES:
        for link, way in zip(LINKS, (in_process, by_socket, by_fmu)):
            if way(case, f"{link}-{scheme}", "-coupling", scheme) != 0:
                failed.append(f"{link}-{scheme}")
        if program("wallForPrecice") and by_precice(case, f"precice-{scheme}", scheme) != 0:
            failed.append(f"precice-{scheme}")
        for window in WINDOWS:
            if in_process(case, f"window-{scheme}-{window}", "-coupling", scheme, "-window", window, "-end", 0.96) != 0:
                failed.append(f"window-{scheme}-{window}")
        for mass in MASSES:
            in_process(case, f"mass-{scheme}-{mass}", "-coupling", scheme, "-mass", mass)
    if failed:
        sys.exit("couple.py: these runs failed: " + ", ".join(failed))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""How well `mpmSolve -dry-run` knows what a run will cost: predicted over real, scene by scene.

    predictionCheck.py                   all scenes, about a minute and a half alone on a machine
    predictionCheck.py column3D drySand  those; -list names them
    predictionCheck.py -repeat 3         three runs a scene, each between two predictions; medians

Scenes are copies of shipped ones without splitting. Seconds are those of the processor, of all that mpmSolve does: on a
busy machine the clock on the wall says more about the neighbours; its ratio is shown beside. Memory is the largest
resident set. The last column counts steps that were predicted and taken (exact with a fixed step). The exit code is 1 if
a ratio of processor seconds is off by more than 25 %. MPM_BUILD_DIR names the build (default: build/).
"""

import argparse
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"
HARD = PROJECT / "tests" / "stability"
MOST = 0.25  # allowed difference
UNITS = {"B": 1, "kB": 1e3, "MB": 1e6, "GB": 1e9}
GRID, SCHEMES, CONTROL = "system/gridDict", "system/mpmSchemes", "system/controlDict"


def column(factor, *changes):
    """The column with cells of 4/(15 factor) m and a time step to match."""
    return COLUMN, [(GRID, "cellSize", repr(4 / (15 * factor))), (CONTROL, "deltaT", repr(1e-3 / factor)), *changes]


SCENES = {
    "column": column(2),
    "columnFine": column(3),
    "columnCpGIMP": column(2, (SCHEMES, "shape", "cpGIMP")),
    "columnAdaptive": column(2, (CONTROL, "adjustTimeStep", "yes")),
    "column3D": (HARD / "threadsAndRestart", [(GRID, "cellSize", "0.125"), (CONTROL, "deltaT", "2e-3")]),
    "footing": (HARD / "undrainedFooting", [(GRID, "cellSize", "0.0625"), (CONTROL, "deltaT", "1.5e-4")]),
    "elasticStrip": (HARD / "incompressibleStrip", [(CONTROL, "endTime", "4")]),
    "elasticBars": (HARD / "stiffnessRatio", []),
}


def drop(text, word):
    """The text without the dictionary of that name."""
    return re.sub(rf"(?ms)^{word}\s*\{{.*?^\}}\n?", "", text)


def change(case, file, word, value):
    path = case / file
    text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", lambda m: f"{m[1]}{value};", path.read_text(), count=1)
    if count != 1:
        sys.exit(f"predictionCheck: {path} has no {word}")
    path.write_text(text)


def make(folder, name):
    source, changes = SCENES[name]
    case = folder / name
    for part in ("geometry", "constant", "system"):
        shutil.copytree(source / part, case / part)
    for file, word in ((SCHEMES, "splitting"), (CONTROL, "recordStrain")):
        (case / file).write_text(drop((case / file).read_text(), word))
    for what, *rest in changes:
        change(case, what, *rest)
    run(case, "seedParticles")
    return case


def run(case, *command):
    """What it prints, and its processor and wall seconds and peak bytes."""
    log = case / f"log.{command[0]}"
    with open(log, "w") as out:
        begin = time.perf_counter()
        child = subprocess.Popen([str(BINARIES / command[0]), *command[1:]], cwd=case, stdout=out, stderr=out,
                                 stdin=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        wall = time.perf_counter() - begin
    if child.returncode != 0:
        sys.exit(f"predictionCheck: {' '.join(command)} failed in {case}:\n{log.read_text()}")
    return log.read_text(), usage.ru_utime + usage.ru_stime, wall, 1024 * usage.ru_maxrss


def seconds(text):
    parts = {"d": 86400, "h": 3600, "min": 60, "s": 1}
    return sum(float(number) * parts[unit] for number, unit in re.findall(r"([\d.]+) (d|h|min|s)\b", text))


def predict(case):
    text = run(case, "mpmSolve", "-dry-run", "-overwrite")[0]
    wall, cpu = re.search(r"predicted +(.*?) \((.*?) of processor time\)", text).groups()
    number, unit = re.search(r"memory +([\d.]+) (\w+) at most", text).groups()
    steps = re.search(r"\n  steps +(?:about )?(\d+)", text)[1]
    return {"cpu": seconds(cpu), "wall": seconds(wall), "memory": float(number) * UNITS[unit], "steps": int(steps)}


def measure(case):
    text, cpu, wall, memory = run(case, "mpmSolve", "-overwrite")
    found = re.search(r"Done: (\d+) steps", text)
    particles = int(re.search(r"particles +(\d+)", text)[1])
    return {"cpu": cpu, "wall": wall, "memory": memory, "steps": int(found[1]), "particles": particles}


def rewind(case):
    """Back to the seeded state, so that a dry run sees what the run saw."""
    for path in case.glob("*/state.h5"):
        if path.parent.name != "0":
            shutil.rmtree(path.parent)
    shutil.rmtree(case / "postProcessing", ignore_errors=True)


def check(case, repeat):
    predicted, real = [predict(case)], []
    for _ in range(repeat):
        real.append(measure(case))
        rewind(case)
        predicted.append(predict(case))
    def middle(rows, key):
        return statistics.median(row[key] for row in rows)
    return {key: (middle(predicted, key), middle(real, key)) for key in ("cpu", "wall", "memory", "steps")}, \
        real[0]["particles"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("-repeat", type=int, default=1)
    parser.add_argument("-list", action="store_true")
    options = parser.parse_args()
    if options.list:
        print(*SCENES, sep="\n")
        return 0
    unknown = set(options.scenes) - set(SCENES)
    if unknown:
        sys.exit(f"predictionCheck: found {' '.join(sorted(unknown))}, allowed {', '.join(SCENES)}")
    print(f"{'scene':<16}{'particles':>10}{'predicted':>11}{'real':>9}{'ratio':>8}{'wall':>7}{'memory':>8}{'steps':>16}")
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for name in options.scenes or SCENES:
            case = make(Path(folder), name)
            found, particles = check(case, options.repeat)
            ratio = {key: a / b for key, (a, b) in found.items()}
            ratios.append(ratio["cpu"])
            steps = "{:.0f} of {:.0f}".format(*found["steps"])
            print(f"{name:<16}{particles:>10}{found['cpu'][0]:>9.2f} s{found['cpu'][1]:>7.2f} s{ratio['cpu']:>8.2f}"
                  f"{ratio['wall']:>7.2f}{ratio['memory']:>8.2f}{steps:>16}", flush=True)
            shutil.rmtree(case)
    worst = max(ratios, key=lambda ratio: abs(ratio - 1))
    print(f"\npredicted over real, processor seconds: median {statistics.median(ratios):.2f}, "
          f"worst {worst:.2f}; allowed {1 - MOST:g} to {1 + MOST:g}. Load: {' '.join(map(str, os.getloadavg()))}")
    return int(abs(worst - 1) > MOST)


if __name__ == "__main__":
    sys.exit(main())

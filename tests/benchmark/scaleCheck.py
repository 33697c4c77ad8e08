#!/usr/bin/env python3
"""How the cost of every utility grows with the number of particles: one table, also as CSV.

    scaleCheck.py [PARTICLES...] [-steps N] [-threads N] [-shape NAME] [-repeat N] [-folder DIR] [-csv FILE] [-keep]

Copies of cases/collapsingSoilColumn on finer and finer grids (1,800 k^2 particles, time step in proportion to the cell)
go through the utilities; default 7200 115200 1036800 particles. Times are wall microseconds per particle (the medians
of -repeat runs), memory is the largest resident set in bytes per particle.

    seed     seedParticles -dry-run: geometry to particles
    write    what seedParticles takes beyond that: 0/state.h5, checked, with the arrays for ParaView, on the disk
    read     splitParticles -dry-run with a threshold that nothing reaches: state.h5 read and checked, one look for splits
    smooth   smoothStress: read twice, nodal and smoothed stress, overburden, derived fields written
    step     mpmSolve: nanoseconds of one step, all passes, without history and output
    50 steps the same times fifty, the yardstick for the others
    output   share of a run that writes a state every 100 steps: the wait for a state, from the mean of five, against
             100 steps. The disk takes a state while steps go on; only the last one is waited for

MPM_BUILD_DIR names the build (default: build/). With several people on a machine compare ratios, not seconds.
"""

import argparse
import csv
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
PASSES = ("weights", "toGrid", "nodal", "toParticles", "law", "sort", "split")
STATES = 5  # written in a run
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"


def change(case, file, word, value):
    path = case / file
    text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", lambda m: f"{m[1]}{value};", path.read_text(), count=1)
    if count != 1:
        sys.exit(f"scaleCheck: {path} has no {word}")
    path.write_text(text)


def run(case, *command):
    """Wall seconds and peak resident bytes of a command."""
    with open(case / f"log.{command[0]}", "w") as log:
        begin = time.perf_counter()
        child = subprocess.Popen([str(BINARIES / command[0]), *command[1:]], cwd=case, stdout=log, stderr=log,
                                 stdin=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.perf_counter() - begin
    if child.returncode != 0:
        sys.exit(f"scaleCheck: {' '.join(command)} failed in {case}:\n" + (case / f"log.{command[0]}").read_text())
    return seconds, 1024 * usage.ru_maxrss


def median(case, repeat, *command):
    runs = [run(case, *command) for _ in range(repeat)]
    return statistics.median(seconds for seconds, _ in runs), max(memory for _, memory in runs)


def make(folder, factor, steps, shape):
    """The column with cells of 4/(15 factor) m, a time step to match, and a run of so many steps."""
    case = folder / f"column{factor}"
    shutil.rmtree(case, ignore_errors=True)
    case.mkdir(parents=True)
    for part in ("geometry", "constant", "system"):
        shutil.copytree(COLUMN / part, case / part)
    step = 1e-3 / factor
    change(case, "system/gridDict", "cellSize", repr(4 / (15 * factor)))
    change(case, "system/mpmSchemes", "shape", shape)
    change(case, "system/mpmSchemes", "maxGeneration", "4")
    change(case, "system/splitParticlesDict", "threshold", "100")
    change(case, "system/controlDict", "startFrom", "firstTime")
    change(case, "system/controlDict", "deltaT", repr(step))
    change(case, "system/controlDict", "endTime", repr(step * steps))
    change(case, "system/controlDict", "writeControl", "timeStep")
    change(case, "system/controlDict", "writeInterval", str(steps // STATES))
    change(case, "system/controlDict", "purgeWrite", "1")
    change(case, "system/controlDict", "historyInterval", str(max(1, steps // 10)))
    control = case / "system/controlDict"
    control.write_text(re.sub(r"(?ms)^recordStrain.*?^\}\n", "", control.read_text()))
    return case


def profile(case):
    with open(case / "postProcessing" / "profile.csv", newline="") as file:
        return {row["pass"]: row for row in csv.DictReader(file)}


def measure(folder, particles, options):
    factor = max(1, round((particles / 1800) ** 0.5))
    count = 1800 * factor * factor
    steps = options.steps
    case = make(folder, factor, steps, options.shape)
    seed, seedMemory = median(case, options.repeat, "seedParticles", "-dry-run", "-overwrite")
    both, writeMemory = median(case, options.repeat, "seedParticles", "-overwrite")
    read, readMemory = median(case, options.repeat, "splitParticles", "-dry-run", "-time", "0")
    solve = ("mpmSolve", "-overwrite", "-threads", str(options.threads), "-profile")
    solveMemory = median(case, options.repeat, *solve)[1]
    passes = profile(case)
    step = sum(float(passes[name]["nsPerParticleStep"]) for name in PASSES)
    output = 1e9 * float(passes["output"]["seconds"]) / STATES / count  # ns a particle and state
    smooth, smoothMemory = median(case, options.repeat, "smoothStress", "-time", "0")
    if not options.keep:
        shutil.rmtree(case)
    per = 1e6 / count
    return {"particles": count, "seed": seed * per, "write": (both - seed) * per, "read": read * per,
            "smooth": smooth * per, "step": step, "50 steps": 50e-3 * step, "output": 100 * output / (output + 100 * step),
            "seedMemory": max(seedMemory, writeMemory) / count, "readMemory": readMemory / count,
            "smoothMemory": smoothMemory / count, "solveMemory": solveMemory / count}


HEADS = {"particles": "particles", "seed": "seed [us]", "write": "write [us]", "read": "read [us]", "smooth": "smooth [us]",
         "step": "step [ns]", "50 steps": "50 steps [us]", "output": "output [%]", "seedMemory": "seed [B]",
         "readMemory": "read [B]", "smoothMemory": "smooth [B]", "solveMemory": "solve [B]"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("particles", nargs="*", type=int, default=[7200, 115200, 1036800])
    parser.add_argument("-steps", type=int, default=100)
    parser.add_argument("-threads", type=int, default=1)
    parser.add_argument("-shape", default="uGIMP")
    parser.add_argument("-repeat", type=int, default=1)
    parser.add_argument("-folder", type=Path, help="where the cases are made (default: a temporary folder)")
    parser.add_argument("-csv", type=Path)
    parser.add_argument("-keep", action="store_true", help="leave the cases")
    options = parser.parse_args()
    rows = []
    print("| " + " | ".join(HEADS.values()) + " |\n" + "|" + " --- |" * len(HEADS), flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        for particles in options.particles:
            row = measure(options.folder or Path(temporary), particles, options)
            rows.append(row)
            print("| " + " | ".join(f"{row[key]:.0f}" if key == "particles" or key.endswith("Memory") else
                                    f"{row[key]:.1f}" if key in ("step", "output") else f"{row[key]:.2f}"
                                    for key in HEADS) + " |", flush=True)
    if options.csv:
        with open(options.csv, "w", newline="") as file:
            writer = csv.DictWriter(file, list(HEADS))
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()

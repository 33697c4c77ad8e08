"""What is absent costs nothing: instructions of a step of an elastic scene without gravity, counted by callgrind.

    instructions.py     MPM_BUILD_DIR names the build (default: build/)

countOrdinary steps it as mpmSolve does, with all effects linked; countBare holds the code of that scene alone
(bareScene.hpp). The difference of two run lengths leaves start-up out. Lengths differ by 80 steps, after which sorts
(every 20 steps) and samples of time (every 16) come round, so both have the same mixture of steps.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
PROGRAMS = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "tests"
MATERIAL = "law linearElastic; E 1e6; nu 0.3;\n"
SHORT, LONG = 20, 100
ALLOWED = 0.005


def instructions(program, steps, folder):
    out = folder / f"{program}.{steps}"
    run = subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", PROGRAMS / program, str(steps),
                          folder / "material"],
                         env={**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"},
                         capture_output=True, text=True, timeout=600)
    if run.returncode != 0:
        sys.exit(f"{program} {steps}: exit {run.returncode}\n{run.stdout}{run.stderr}")
    return int(re.search(r"(?m)^(?:summary|totals): (\d+)", out.read_text()).group(1))


def per_step(program, folder):
    return (instructions(program, LONG, folder) - instructions(program, SHORT, folder)) / (LONG - SHORT)


def main():
    if not shutil.which("valgrind"):
        sys.exit("valgrind is not installed; on Debian: apt-get install valgrind (etc/bootstrap --tests does it)")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "material").write_text(MATERIAL)
        bare, ordinary = (per_step(program, folder) for program in ("countBare", "countOrdinary"))
    more = ordinary / bare - 1
    print(f"instructions a step: {ordinary:.0f} with everything linked, {bare:.0f} with the scene alone: {100 * more:+.3f} %")
    if not abs(more) <= ALLOWED:
        sys.exit(f"found {100 * more:+.3f} %, allowed: within {100 * ALLOWED:g} %; callgrind_annotate says where")


main()

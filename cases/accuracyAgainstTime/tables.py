"""From postProcessing/accuracyCost.csv of the scenes to tables in README.md and figures beside it; called by Allrun.

A table stands between `<!-- table SCENE MEASURE -->` and `<!-- end -->`: for each error the cheapest run that is at most as
wrong. Figures are copied to SCENE-MEASURE.png.
"""

import csv
import math
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
HEADS = ["error below", "cheapest run", "cell size [m]", "Courant", "processor time", "particles", "steps", "its error"]
MARK = re.compile(r"<!-- table (\w+) (\w+) -->\n.*?<!-- end -->", re.S)


def read(scene, measure):
    """The runs with an error, without the one that is the reference."""
    with open(HERE / scene / "postProcessing" / "accuracyCost.csv", newline="") as file:
        return [line for line in csv.DictReader(file)
                if line["errorMeasure"] == measure and line["error"] and line["referenceRow"] != line["row"]]


def shown(seconds):
    return f"{seconds * 1e3:.3g} ms" if seconds < 1 else f"{seconds:.3g} s"


def bounds(lines):
    """1, 0.3, 0.1 ... from the largest error down to the smallest."""
    errors = [float(line["error"]) for line in lines]
    decades = range(math.ceil(math.log10(max(errors))), math.floor(math.log10(min(errors))) - 1, -1)
    found = [digit * 10.0**decade for decade in decades for digit in (3, 1)]
    return [bound for bound in found if min(errors) <= bound <= 3 * max(errors)]


def rows(lines):
    out = []
    for bound in bounds(lines):
        best = min((line for line in lines if float(line["error"]) <= bound), key=lambda line: float(line["cpuSeconds"]))
        cells = [best["method"], f"{float(best['cellSize']):.3g}", f"{float(best['courant']):.2g}",
                 shown(float(best["cpuSeconds"])), best["particles"], best["steps"], f"{float(best['error']):.2g}"]
        if out and out[-1][1:] == cells:
            out[-1][0] = f"{bound:.0e}"
        else:
            out.append([f"{bound:.0e}"] + cells)
    return out


def table(scene, measure):
    lines = read(scene, measure)
    text = ["| " + " | ".join(HEADS) + " |", "| " + " | ".join(["---"] * len(HEADS)) + " |"]
    text += ["| " + " | ".join(row) + " |" for row in rows(lines)]
    unsure = [float(line["referenceError"]) for line in lines if line["referenceError"] and float(line["referenceError"]) > 0]
    if unsure:
        text += ["", f"The reference itself is wrong by about {unsure[0]:.1g}: errors below twice that say nothing."]
    return "\n".join(text)


def main():
    readme = HERE / "README.md"
    text = readme.read_text()
    for scene, measure in MARK.findall(text):
        if not (HERE / scene / "postProcessing" / "accuracyCost.csv").is_file():
            sys.exit(f"{scene} was not run")
        new = f"<!-- table {scene} {measure} -->\n{table(scene, measure)}\n<!-- end -->"
        text = re.sub(rf"<!-- table {scene} {measure} -->\n.*?<!-- end -->", lambda _, new=new: new, text, flags=re.S)
        shutil.copy(HERE / scene / "postProcessing" / "figures" / f"accuracyCost-{measure}.png", HERE / f"{scene}-{measure}.png")
    readme.write_text(text)
    print("wrote README.md and its figures")


if __name__ == "__main__":
    sys.exit(main())

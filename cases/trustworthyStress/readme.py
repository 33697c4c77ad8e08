#!/usr/bin/python3
"""Writes the generated parts of README.md from runs.csv and tradeOff.csv.

    readme.py             writes them
    readme.py -check      exit code 1 if README.md is not what it would write, or the rows are not those of rows.py

A part stands between `<!-- NAME -->` and `<!-- end -->`; NAME is answer, goals or tradeOff.
"""

import csv
import re
import sys
from pathlib import Path

from rows import ROWS, TIMES

HERE = Path(__file__).resolve().parent
MARK = re.compile(r"<!-- (\w+) -->\n.*?<!-- end -->", re.S)
HEADS = ["row", "N at 0.5 / 1 / 1.5 / 2.5 s", "floor of N", "N inside", "corr.", "error against h/2 [kPa]", "volume [%]",
         "taken [%]", "transfers [%]", "toe, crest [m]", "kinetic peak [kJ/m]", "cost"]
RULE = {False: "no", True: "yes"}


def number(text):
    try:
        return float(text)
    except ValueError:
        return text if text else float("nan")


def read(name, key):
    with open(HERE / name, newline="") as file:
        return {row[key]: {word: number(value) for word, value in row.items()} for row in csv.DictReader(file)}


def short(value, digits=2):
    """So many significant digits, without an exponent above 1."""
    return f"{value:.0f}" if abs(value) >= 10 ** (digits - 1) else f"{value:.{digits}g}"


def at_times(row, word, digits=2, scale=1):
    return " / ".join(short(row[f"{word}{time:g}"] * scale, digits) for time in TIMES)


def percent(value, digits=2):
    """A share in per cent; what is nothing is written so."""
    return "0" if abs(value) < 5e-6 else f"{100 * value:.{digits}g}"


def table(heads, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [heads, ["---"] * len(heads), *rows])


def trade_off_row(row):
    if row["outcome"] != "end":
        return [row["label"], row["outcome"].replace("|", "\\|")] + ["-"] * (len(HEADS) - 2)
    known = row.get("plainFineError2.5") == row.get("plainFineError2.5")
    return [row["label"], at_times(row, "noise"), at_times(row, "floor"), at_times(row, "inside"), f"{row['correlation']:.3f}",
            at_times(row, "plainFineError", 2, 1e-3) if known else "-", percent(row["volumeError"]),
            percent(row["energyLoss"]), percent(row["transferLoss"]), f"{row['toe']:.2f}, {row['crest']:.2f}",
            f"{row['kineticPeak'] / 1e3:.0f}", f"{row['cost']:.2f}"]


def trade_off(_, rows):
    return table(HEADS, [trade_off_row(row) for row in rows.values()])


def worst(row, word):
    return max(row[f"{word}{time:g}"] for time in TIMES)


def bounds(row, base, times=1):
    """Goal, bound, plain, with the remedy, reached, as lists of text; all bounds are `times` those of h = 4/15 m."""
    noise, loose = 0.03 * times, 1 - 0.02 * times
    return [("largest N at 0.5, 1, 1.5, 2.5 s", f"<= {noise:g}", f"{worst(base, 'noise'):.2g}",
             f"{worst(row, 'noise'):.3g}", worst(row, "noise") <= noise),
            ("the same of particles inside", f"<= {noise:g}", f"{worst(base, 'inside'):.2g}", f"{worst(row, 'inside'):.3g}",
             worst(row, "inside") <= noise),
            ("correlation with overburden, 2.5 s", f">= {loose:g}", f"{base['correlation']:.2g}",
             f"{row['correlation']:.3f}", row["correlation"] >= loose),
            ("taken by remedies [% of released energy]", f"<= {0.5 * times:g}", percent(base["remedyLoss"]),
             percent(row["remedyLoss"], 3), row["remedyLoss"] <= 0.005 * times),
            ("volume error [%]", f"<= {0.1 * times:g}", percent(base["volumeError"], 3), percent(row["volumeError"]),
             abs(row["volumeError"]) <= 0.001 * times),
            ("time of a step, over that of plain", f"<= {1 + 0.1 * times:g}", "1", f"{row['cost']:.2f}",
             row["cost"] <= 1 + 0.1 * times)]


def failed(row, scene):
    return [(scene, "runs to its end", "", row["outcome"], False)]


def scene_bounds(rows, name, scene, times):
    row, base = rows["automatic" + name], rows["plain" + name]
    if row["outcome"] != "end":
        return failed(row, scene)
    return [(f"{scene}: {goal}", *rest) for goal, *rest in bounds(row, base, times)]


def motion_bounds(runs):
    """What the remedy changes, against what half the cells change in the plain scheme."""
    plain, cured, fine = (runs[name] for name in ("plain", "cured", "plainFine"))
    halving, changed = abs(plain["toe"] - fine["toe"]), abs(plain["toe"] - cured["toe"])
    energy = plain["kineticFrom_plainFine"], cured["kineticFrom_plain"]
    ratio = max(cured[f"plainFineError{t:g}"] / plain[f"plainFineError{t:g}"] for t in TIMES)
    other = max(cured[f"curedFineError{t:g}"] / plain[f"curedFineError{t:g}"] for t in TIMES)
    return [("toe: moved by the remedy, against moved by half the cells [m]", f"<= {halving:.2f}", "", f"{changed:.2f}",
             changed <= halving),
            ("kinetic energy at any time, likewise [% of peak]", f"<= {percent(energy[0])}", "", percent(energy[1]),
             energy[1] <= energy[0]),
            ("kinetic energy off plain at h/2 at any time [% of peak]", f"<= {percent(energy[0])}", percent(energy[0]),
             percent(cured["kineticFrom_plainFine"]), cured["kineticFrom_plainFine"] <= energy[0]),
            ("error of raw stress against plain at h/2, over that of plain, largest of the times", "<= 0.5", "1",
             f"{ratio:.2f}", ratio <= 0.5),
            ("the same against automatic at h/2", "<= 0.5", "1", f"{other:.2f}", other <= 0.5),
            (f"kinetic energy at {cured['endTime']:g} s over its peak", "< 1e-6", f"{plain['kineticAtEnd']:.1e}",
             f"{cured['kineticAtEnd']:.1e}", cured["kineticAtEnd"] < 1e-6)]


def rest_bounds(rows):
    row = rows["automaticPic3"]
    return [(f"the same with picRate 3, at {row['endTime']:g} s", "< 1e-6", "", f"{row['kineticAtEnd']:.1e}", row["kineticAtEnd"] < 1e-6)]


def goals(runs, rows):
    found = bounds(rows["automatic"], rows["plain"]) if rows["automatic"]["outcome"] == "end" else failed(rows["automatic"], "")
    found += motion_bounds(runs) + rest_bounds(rows)
    found += scene_bounds(rows, "Coarse", "h = 0.4 m", 2) + scene_bounds(rows, "Dilatant", "psi = 10°", 2)
    found += scene_bounds(rows, "Whole", "no splitting", 2)[:2]
    lines = [[goal, bound, plain, cured, RULE[bool(reached)]] for goal, bound, plain, cured, reached in found]
    return table(["goal", "bound", "plain", "automatic", "reached"], lines)


def answer(runs, rows):
    plain, cured, row = runs["plain"], runs["cured"], rows["automatic"]
    least = min(row[f"floor{t:g}"] for t in TIMES), max(row[f"floor{t:g}"] for t in TIMES)
    lines = [
        ("noise N of particle stresses at 0.5 / 1 / 1.5 / 2.5 s", at_times(plain, "noise", 3), at_times(cured, "noise")),
        ("the same of particles inside (all nodes in soil)", at_times(plain, "inside", 3), at_times(cured, "inside")),
        ("raw vertical stress off that of plain with half the cells [kPa], RMS",
         *(at_times(run, "plainFineError", 2, 1e-3) for run in (plain, cured))),
        ("the same of the smoothed stress", *(at_times(run, "plainFineErrorSmoothed", 2, 1e-3) for run in (plain, cured))),
        ("raw vertical stress off that of automatic with half the cells [kPa]",
         *(at_times(run, "curedFineError", 2, 1e-3) for run in (plain, cured))),
        ("the same of the smoothed stress", *(at_times(run, "curedFineErrorSmoothed", 2, 1e-3) for run in (plain, cured))),
        ("correlation of raw vertical stress with the weight above, 2.5 s",
         *(f"{run['correlation']:.3f}" for run in (plain, cured))),
        ("the same of the smoothed stress", *(f"{run['correlationSmoothed']:.3f}" for run in (plain, cured))),
        ("the same, smoothed, with half the cells", *(f"{runs[n]['correlationSmoothed']:.3f}" for n in ("plainFine", "curedFine"))),
        ("volume that came from nowhere [%]", percent(plain["volumeError"], 3), percent(cured["volumeError"])),
        ("energy the remedy took [% of what gravity released], sum of absolute values", percent(plain["remedyLoss"]), percent(row["remedyLoss"])),
        ("of it relaxation / averaging / its viscosity", "",
         " / ".join(percent(row[word]) for word in ("relaxationLoss", "averagingLoss", "viscosityLoss"))),
        ("time of a step", "1", f"{row['cost']:.2f}"),
        ("kinetic energy off that with half the cells (plain), at most [% of peak]",
         *(percent(run["kineticFrom_plainFine"]) for run in (plain, cured))),
        ("toe, crest at the end [m]", *(f"{run['toe']:.2f}, {run['crest']:.2f}" for run in (plain, cured))),
        ("the same with half the cells [m]", *(f"{runs[n]['toe']:.2f}, {runs[n]['crest']:.2f}" for n in ("plainFine", "curedFine"))),
        ("peak of the kinetic energy [kJ/m] at [s]",
         *(f"{run['kineticPeak'] / 1e3:.0f} at {run['kineticPeakTime']:.2f}" for run in (plain, cured))),
    ]
    text = table(["", "plain", "`stressTreatment automatic;`"], [list(line) for line in lines])
    return text + (f"\n\nN has a floor: smoothing bends any field that is not linear, and at free faces linear ones too. Of the cured "
                   f"field, filtered so that nothing a cell cannot carry is left, N would still be {least[0]:.2g} to {least[1]:.2g}.")


PARTS = {"answer": answer, "goals": goals, "tradeOff": trade_off}


def written(text):
    runs, rows = read("runs.csv", "run"), read("tradeOff.csv", "row")
    if list(rows) != [row.name for row in ROWS]:
        sys.exit("tradeOff.csv has other rows than rows.py: run Allrun")
    if sorted(MARK.findall(text)) != sorted(PARTS):
        sys.exit(f"README.md must have one place for each of {', '.join(PARTS)}")
    return MARK.sub(lambda found: f"<!-- {found[1]} -->\n{PARTS[found[1]](runs, rows)}\n<!-- end -->", text)


def main(arguments):
    readme = HERE / "README.md"
    text = readme.read_text()
    new = written(text)
    if arguments == ["-check"]:
        sys.exit("README.md is not what readme.py writes: run it" if new != text else 0)
    if arguments:
        sys.exit(__doc__.strip())
    readme.write_text(new)
    print("wrote README.md")


if __name__ == "__main__":
    main(sys.argv[1:])

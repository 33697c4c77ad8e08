#!/usr/bin/python3
"""Runs what the trade-off is made of, in copies of this case, and writes its numbers.

    tradeOff.py -cases            makes the folders plain, cured, plainFine, curedFine, unless they are there
    tradeOff.py -runs             runs.csv: what these four left
    tradeOff.py [-repeat N]       tradeOff.csv: all rows of rows.py, one after the other by one thread, in tradeOff/<row>/;
                                  N times over (default 3), so that prices are medians of runs that lie far apart
"""

import csv
import sys

import numpy as np

from measure import HERE, complaint, cost, make_case, measure, must, run, table
from rows import MAIN, ROWS, TIMES

REFERENCES = ("plainFine", "curedFine")


def write(name, rows):
    """One column for each number any row has, in the order they appear."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(HERE / name, "w", newline="") as file:
        out = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        out.writeheader()
        for row in rows:
            out.writerow({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()})
    print(f"wrote {name}")


def make_main_cases():
    for name, changes in MAIN.items():
        if not (HERE / name).is_dir():
            make_case(HERE / name, changes)


def largest_difference(history, other):
    """Of two histories of kinetic energy, over the peak of the second."""
    end = min(history[-1]["time"], other[-1]["time"])
    time = np.linspace(0, end, 2501)
    one, two = (np.interp(time, [row["time"] for row in h], [row["kineticEnergy"] for row in h]) for h in (history, other))
    return float(np.abs(one - two).max() / two.max())


def main_runs():
    history = {name: table(HERE / name / "postProcessing/history.csv") for name in MAIN}
    rows = []
    for name in ("plainFine", "curedFine", "plain", "cured"):  # the errors need the smoothed stresses of the finer ones
        row = {"run": name} | measure(HERE / name, () if name in REFERENCES else REFERENCES)
        rows.append(row | {f"kineticFrom_{other}": largest_difference(history[name], history[other]) for other in MAIN})
    write("runs.csv", rows)


def solve(row):
    """Price of one run in ns per particle and step, or nothing where it was refused or stopped."""
    case = HERE / "tradeOff" / row.name
    make_case(case, row.changes)
    must(case, "seedParticles")
    return cost(case) if run(case, "mpmSolve", "-threads", "1") == 0 else None


def numbers(row, prices):
    case = HERE / "tradeOff" / row.name
    start = {"row": row.name, "label": row.label, "group": row.group, "outcome": "end"}
    if prices[row.name][0] is None:
        return start | {"outcome": complaint(case)}
    out = start | measure(case, REFERENCES if row.reference else ())
    ratios = [mine / base for mine, base in zip(prices[row.name], prices[row.baseline])]
    return out | {"cost": float(np.median(ratios)), "nsPerParticleStep": float(np.median(prices[row.name]))}


def trade_off(repeat):
    prices = {row.name: [] for row in ROWS}
    for turn in range(repeat):
        for row in ROWS:
            prices[row.name].append(solve(row))
            print(f"{turn + 1}/{repeat} {row.label}: {prices[row.name][-1] or complaint(HERE / 'tradeOff' / row.name)}",
                  flush=True)
    rows = [numbers(row, prices) for row in ROWS]
    write("tradeOff.csv", with_losses(rows))


def with_losses(rows):
    """The energy a remedy takes and the largest noise, of rows that came to their end."""
    found = {row["row"]: row for row in rows}
    for row, described in zip(rows, ROWS):
        base = found[described.baseline]
        if row["outcome"] == "end":
            filtered = max(0.0, row["transferLoss"] - base["transferLoss"]) if described.filters else 0.0
            row["energyLoss"] = row["remedyLoss"] + filtered
            row["noise"] = max(row[f"noise{time:g}"] for time in TIMES)
    return rows


def main(arguments):
    if arguments == ["-cases"]:
        make_main_cases()
    elif arguments == ["-runs"]:
        main_runs()
    elif not arguments or (len(arguments) == 2 and arguments[0] == "-repeat" and arguments[1].isdigit()):
        trade_off(max(1, int(arguments[1])) if arguments else 3)
    else:
        sys.exit(__doc__.strip())


if __name__ == "__main__":
    main(sys.argv[1:])

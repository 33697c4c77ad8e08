"""The tables a run leaves in postProcessing/, and a report of checks on them."""

import csv
from pathlib import Path

import numpy as np

COLUMNS = (
    "time,dt,particles,mass,volume,apexVolume,momentumX,momentumY,momentumZ,wallImpulseX,wallImpulseY,wallImpulseZ,"
    "kineticEnergy,strainEnergy,plasticDissipation,frictionDissipation,splitMergeLoss,transferLoss,gravityWork,residual,"
    "apexReturns,maxYieldViolation,minX,maxX,minY,maxY,minZ,maxZ"
).split(",")


class Table:
    """A CSV file by columns: table["kineticEnergy"] is an array over the rows."""

    def __init__(self, case, name="history.csv"):
        with open(Path(case) / "postProcessing" / name, newline="") as file:
            rows = list(csv.reader(file))
        self.header = rows[0]
        self.rows = np.array([[float(value) for value in row] for row in rows[1:]])

    def __getitem__(self, column):
        return self.rows[:, self.header.index(column)]

    def last(self, column):
        return self[column][-1]

    def at(self, column, time):
        return float(np.interp(time, self["time"], self[column]))


def recomputed_residual(history, budget):
    """The energy that came in, less what the body holds more than at the start, less what was taken from it. Impacts on
    walls, what finite steps make of a rate law, and the staggering of velocities have no column in the history."""
    held = history["kineticEnergy"] + history["strainEnergy"]
    taken = sum(history[name] for name in
                ("plasticDissipation", "frictionDissipation", "splitMergeLoss", "transferLoss"))
    came = history["gravityWork"] + budget["finiteStrainWork"] + budget["staggering"]
    return came - (held - held[0]) - taken - budget["wallLoss"]


class Report:
    """Collects checks, prints each with its number, and says at the end whether all held."""

    def __init__(self):
        self.failed = 0

    def check(self, what, value, low, high):
        good = bool(low <= value <= high)
        self.failed += not good
        print(f"{'ok    ' if good else 'FAILED'} {what}: {value:.6g} in [{low:g}, {high:g}]")

    def equal(self, what, value, expected):
        good = value == expected
        self.failed += not good
        print(f"{'ok    ' if good else 'FAILED'} {what}" + ("" if good else f": {value} is not {expected}"))

    def exit_code(self):
        print("all checks hold" if not self.failed else f"{self.failed} checks FAILED")
        return 1 if self.failed else 0

"""postProcessing/history.csv of a run: its columns, and what must hold in every run."""

import csv
from pathlib import Path

import numpy as np

COLUMNS = (
    "time,dt,particles,mass,volume,apexVolume,momentumX,momentumY,momentumZ,wallImpulseX,wallImpulseY,wallImpulseZ,"
    "kineticEnergy,strainEnergy,plasticDissipation,frictionDissipation,splitMergeLoss,transferLoss,gravityWork,residual,"
    "apexReturns,maxYieldViolation,minX,maxX,minY,maxY,minZ,maxZ"
).split(",")


class History:
    """Columns by name: history["kineticEnergy"] is an array over the rows."""

    def __init__(self, case):
        self.path = Path(case) / "postProcessing" / "history.csv"
        with open(self.path, newline="") as file:
            rows = list(csv.reader(file))
        self.header = rows[0]
        self.table = np.array([[float(value) for value in row] for row in rows[1:]])

    def __getitem__(self, column):
        return self.table[:, self.header.index(column)]

    def last(self, column):
        return self[column][-1]

    def at(self, column, time):
        return float(np.interp(time, self["time"], self[column]))


def energy_mismatch(history):
    """What the other columns say the residual is: energy in the body and energy taken from it, less what came in."""
    held = history["kineticEnergy"] + history["strainEnergy"]
    taken = sum(history[name] for name in
                ("plasticDissipation", "frictionDissipation", "splitMergeLoss", "transferLoss"))
    return held - held[0] + taken - history["gravityWork"]


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

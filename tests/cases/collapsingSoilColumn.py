"""What the collapsing soil column must show: collapsingSoilColumn.py CASE scheme | heap | full

    books    any stable scheme on any grid: it runs to the end, keeps its books, stays symmetric and comes to rest
    heap     also the numbers of the scene at h = 4/15 m: kinetic energy, toes, crest, particles
    full     also what Allrun leaves: smoothed stress, the refined case, figures
"""

import sys
from pathlib import Path

import h5py
import numpy as np
from history import COLUMNS, Report, Table, recomputed_residual

MASS = 4.0 * 8.0 * 1000.0
GRAVITY = 9.8


def books(report, history, budget):
    """Conservation, in every row."""
    time = history["time"]
    report.equal("columns of history.csv", history.header, COLUMNS)
    report.check("end time", time[-1], 2.5 * (1 - 1e-12), 2.5 * (1 + 1e-12))
    report.check("all numbers finite", float(np.isfinite(history.rows).all()), 1, 1)
    report.check("largest relative error of mass", np.abs(history["mass"] / MASS - 1).max(), 0, 1e-12)

    weight = MASS * GRAVITY * time
    scale = weight[-1]
    error = history["momentumY"] - (history["wallImpulseY"] - weight)
    report.check("vertical momentum less impulses, of the weight's impulse", np.abs(error).max() / scale, 0, 1e-11)
    error = history["momentumX"] - history["wallImpulseX"]
    report.check("horizontal momentum less impulses, of the weight's impulse", np.abs(error).max() / scale, 0, 1e-11)
    report.check("largest yield violation", history["maxYieldViolation"].max(), -1, 1e-9)

    work = history.last("gravityWork")
    report.check("gravity work [J]", work, 1e5, 1.2544e6)
    report.check("largest |residual| of the final gravity work", np.abs(history["residual"]).max() / work, 0, 0.01)
    difference = np.abs(recomputed_residual(history, budget) - history["residual"]).max()
    report.check("residual against the other columns, of the gravity work", difference / work, 0, 1e-9)
    for name in ("plasticDissipation", "frictionDissipation"):
        report.check(f"final {name} [J]", history.last(name), 1, work)
    without = recomputed_residual(history, budget) + history["frictionDissipation"]
    report.check("|residual| without friction work over |residual|",
                 abs(without[-1] / history.last("residual")), 2, np.inf)


def rest_and_symmetry(report, history):
    kinetic, particles = history["kineticEnergy"], history["particles"]
    report.check("final kinetic energy of the peak", kinetic[-1] / kinetic.max(), 0, 0.01)
    report.check("lowest particle centre [m]", history["minY"].min(), 0, 0.2)
    report.equal("particles at the start", int(particles[0]), 1800)
    report.equal("every split adds three", int((particles[-1] - 1800) % 3), 0)
    whole = particles == 1800
    asymmetry = np.abs(history["minX"] + history["maxX"] - 4)[whole].max()
    report.check(f"asymmetry of the toes before the first split, t < {history['time'][whole][-1]:.3f} s [m]",
                 asymmetry, 0, 1e-9)


def heap(report, history):
    time, kinetic = history["time"], history["kineticEnergy"]
    report.check("peak kinetic energy [J]", kinetic.max(), 165e3, 195e3)
    report.check("time of the peak [s]", time[kinetic.argmax()], 0.75, 0.9)
    report.check("left toe [m]", history.last("minX"), -6.8, -5.8)
    report.check("right toe [m]", history.last("maxX"), 9.8, 10.8)
    report.check("crest [m]", history.last("maxY"), 3.6, 4.3)
    report.check("particles at the end", history.last("particles"), 8000, 11000)


def stress_field(case, time):
    """Raw and smoothed sigma_yy of a stored time, and the particles' masses."""
    with h5py.File(Path(case) / time / "state.h5") as file:
        smoothed = file["derived/smoothedStress"]
        yy = [str(name) for name in np.atleast_1d(smoothed.attrs["components"]).astype(str)].index("yy")
        return file["particles/stress"][:, 1], smoothed[:, yy], file["particles/mass"][:]


def what_allrun_leaves(report, case):
    for time in ("0.5", "1", "1.5", "2.5"):
        raw, smooth, mass = stress_field(case, time)
        report.check(f"mass-weighted mean of smoothed over raw sigma_yy at {time} s", (mass @ smooth) / (mass @ raw),
                     1 - 1e-10, 1 + 1e-10)
    noise = np.sqrt(((raw - smooth) ** 2).mean() / (smooth**2).mean())
    report.check("RMS(raw - smoothed)/RMS(smoothed) sigma_yy at the end", noise, 0.8, np.inf)

    refined = Table(case / "refined")
    coarse = Table(case)
    report.check("refined: particles over those of the coarse run at 1 s",
                 refined["particles"][0] / coarse.at("particles", 1.0), 1.1, 4)
    report.check("refined: first row [s]", refined["time"][0], 1, 1.0011)
    report.check("refined: end [s]", refined.last("time"), 2.5 * (1 - 1e-12), 2.5 * (1 + 1e-12))
    report.check("refined: largest relative error of mass", np.abs(refined["mass"] / MASS - 1).max(), 0, 1e-12)
    for side in ("minX", "maxX", "maxY"):
        report.check(f"refined: {side} against the coarse run [m]", refined.last(side) - coarse.last(side), -1, 1)
    for suffix, magic in ((".png", b"\x89PNG"), (".svg", b"<?xml")):
        figures = list((case / "postProcessing").rglob("*" + suffix))
        report.check(f"figures {suffix}", len(figures), 2, 100)
        report.equal(f"figures {suffix} are what they say",
                     [figure.name for figure in figures if not figure.read_bytes().startswith(magic)], [])


def main():
    case, kind = Path(sys.argv[1]), sys.argv[2]
    report, history = Report(), Table(case)
    books(report, history, Table(case, "energyBudget.csv"))
    rest_and_symmetry(report, history)
    if kind in ("heap", "full"):
        heap(report, history)
    if kind == "full":
        what_allrun_leaves(report, case)
    return report.exit_code()


if __name__ == "__main__":
    sys.exit(main())

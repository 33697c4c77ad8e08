#!/usr/bin/python3
"""Measures the wall that is pushed into sand, draws figures and writes the table of README.md (etc/sceneReport.py has the
options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

SOIL, SCHEMES = "constant/materialProperties", "system/mpmSchemes"
PHI, DENSITY, G = math.radians(30), 1600, 9.81
HEIGHT, SPEED, RAMP = 1.0, 0.02, 0.2  # [m], [m/s], [s]
K_P = math.tan(math.pi / 4 + PHI / 2) ** 2
RANKINE = 0.5 * K_P * DENSITY * G * HEIGHT**2  # [N/m]
K_0 = 0.5
PLATEAU = 0.005, 0.018  # of the wall's path, where the mean force is taken [m]
RUNS = {"psi 30°": ".", "psi 30°, h/2": "fine", "psi 0": "psi0", "psi 0, plain": "psi0plain"}


def folder(case, name):
    return case if RUNS[name] == "." else case / "variants" / RUNS[name]


def make_variants(case):
    step, h = report.entry(case, "system/controlDict", "deltaT"), report.entry(case, "system/gridDict", "cellSize")
    report.variant(case, "fine", {("system/gridDict", "cellSize"): repr(h / 2), ("system/controlDict", "deltaT"): repr(step / 2),
                                  ("system/controlDict", "endTime"): "1"})
    report.variant(case, "psi0", {(SOIL, "dilationAngle"): 0})
    report.variant(case, "psi0plain", {(SOIL, "dilationAngle"): 0, (SCHEMES, "stressTreatment"): "none"})


def path(t):
    """Of the wall [m]."""
    return np.where(t < RAMP, 0.5 * SPEED * t**2 / RAMP, SPEED * (t - RAMP / 2))


def force(run, rows=25):
    """Path of the wall and the force on it [N/m]: work it did over path, `rows` rows of the history at a time."""
    budget = report.series(run, "energyBudget")
    s, work = path(budget["time"][::rows]), budget["motionWork"][::rows]
    return 0.5 * (s[1:] + s[:-1]), np.diff(work) / np.diff(s)


def plateau(run):
    budget = report.series(run, "energyBudget")
    return float(np.diff(np.interp(PLATEAU, path(budget["time"]), budget["motionWork"]))[0] / (PLATEAU[1] - PLATEAU[0]))


def uplift(run):
    """x of the highest particles at the start [m] and how much they have risen [m]."""
    first, last = report.state(run, 0).by_id("x"), report.state(run).by_id("x")
    top = np.flatnonzero(first[:, 1] > first[:, 1].max() - 1e-6)
    top = top[np.argsort(first[top, 0])]
    return first[top, 0], (last - first)[top, 1]


def wedge(run):
    """Angle of the failure plane to the horizontal [deg]: from the wall's foot to where the uplift has fallen to half of
    what it is over the wedge (x = 0.3 to 0.6 m)."""
    x, u = uplift(run)
    half = 0.5 * u[(x > 0.3) & (x < 0.6)].mean()
    k = np.flatnonzero(u > half)[-1]
    edge = x[k] + (x[k + 1] - x[k]) * (u[k] - half) / (u[k] - u[k + 1])
    return math.degrees(math.atan(HEIGHT / (edge - float(path(np.array(report.state(run).time))))))


def measure(case, names=tuple(RUNS)):
    numbers = report.Numbers()
    for name in names:
        run = folder(case, name)
        associated = "30" in name
        numbers.add(f"force at 5 to 18 mm over Rankine's, {name}", plateau(run) / RANKINE, "", "1",
                    f"K_p = 3: {RANKINE / 1e3:.2f} kN/m" if associated else "without dilation at most that", 0.95 if associated else 0.85,
                    1.05, ".3f")
    for name in names:
        associated = "30" in name
        numbers.add(f"angle of the wedge, {name}", wedge(folder(case, name)), "deg", "30" if associated else "30 to 45",
                    "45 - phi/2" if associated else "45 - phi/2 (Rankine) to 45 - psi/2 (Roscoe)", 26 if associated else 27,
                    34 if associated else 48, ".1f")
    start = force(folder(case, names[0]), 1)[1]
    rest = 0.5 * K_0 * DENSITY * G * HEIGHT**2
    numbers.add("force at the start over that at rest", start[0] / rest, "", "1", "K0 = 0.5", 0.9, 1.15, ".3f")
    budget = report.series(folder(case, names[0]), "energyBudget")
    numbers.add("energy residual, of the wall's work", abs(budget["residual"]).max() / budget["motionWork"].max(), "", "round-off", "",
                0, 1e-9, ".0e")
    for name in names:
        budget = report.series(folder(case, name), "energyBudget")
        numbers.add(f"stress relaxation took of the wall's work, {name}", budget["relaxationLoss"][-1] / budget["motionWork"][-1], form=".1%")
    return numbers


def draw(case):
    sketch(case)
    plt = report.plotter()
    figure, panels = plt.subplots(3, 1, figsize=(7, 7), layout="constrained")
    for axes, name, angle in zip(panels, ("psi 30°, h/2", "psi 0"), (30, 45)):
        s = report.state(folder(case, name))
        domains = report.paint(axes, s, report.shear_strain(s), (0, 0.06), "magma_r")
        edge = float(path(np.array(s.time)))
        for direction, style in ((30, "-"), (45, "--")):
            axes.plot([edge, edge + HEIGHT / math.tan(math.radians(direction))], [0, HEIGHT], style, color="tab:cyan", linewidth=1,
                      label=f"{direction}°")
        report.wall(axes, (edge, edge), (0, 1.15), -0.08)
        report.frame(axes, (-0.1, 3), (-0.05, 1.15), f"{name}: the wall has gone {1e3 * edge:.0f} mm")
        axes.legend(loc="lower right")
    report.bar(figure, domains, panels[:2], "shear strain [-]")
    for name in RUNS:
        s, f = force(folder(case, name))
        panels[2].plot(1e3 * s, f / RANKINE, linewidth=1, label=name)
    panels[2].axhline(1, color="black", linewidth=0.8, linestyle=":", label="Rankine, K_p = 3")
    panels[2].axhline(K_0 / K_P, color="0.5", linewidth=0.8, linestyle=":", label="at rest, K0 = 0.5")
    panels[2].set(xlabel="path of the wall [mm]", ylabel="force/Rankine's", ylim=(0, 1.3), xlim=(0, 28))
    panels[2].legend(ncols=2)
    report.save(figure, case / "wall.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-0.6, 3.2), (-0.35, 1.45))
    axes.fill([0, 3, 3, 0], [0, 0, 1, 1], color="#d9c9a3")
    report.wall(axes, (0, 0), (0, 1.2), -0.1)
    report.wall(axes, (0, 3), (0, 0), 0.1)
    report.wall(axes, (3, 3), (0, 1.2), 0.1)
    report.arrow(axes, (-0.55, 0.5), (-0.12, 0.5), "20 mm/s", (0, 0.12))
    axes.plot([0, 1.73], [0, 1], "k--", linewidth=1)
    axes.text(0.55, 0.12, "45° - phi/2 = 30°")
    axes.text(0.45, 0.65, "wedge", ha="center")
    axes.text(1.85, 0.45, "sand: phi 30°, c = 0\n1600 kg/m³", ha="center")
    axes.text(1.5, -0.2, "friction, mu = tan phi", ha="center")
    axes.text(-0.15, 1.3, "smooth wall")
    report.arrow(axes, (2.85, 0), (2.85, 1), "H = 1 m", (-0.25, 0), both=True)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

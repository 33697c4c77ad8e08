#!/usr/bin/python3
"""Measures the footing, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

COHESION, HALF = 10e3, 1.0  # [Pa], [m]
PRANDTL = 2 + math.pi
SPEED, RAMP = 0.05, 0.2  # [m/s], [s]
WINDOW = 0.008, 0.014  # of the footing's path, where the mean force is taken [m]
RUNS = {"h 125 mm": "h125", "h 62.5 mm": ".", "h 31.25 mm": "h31.25", "h 62.5 mm, plain": "plain", "h 62.5 mm, automatic": "automatic"}
CELLS = {"h 125 mm": 2, "h 62.5 mm": 1, "h 31.25 mm": 0.5}


def folder(case, name):
    return case if RUNS[name] == "." else case / "variants" / RUNS[name]


def make_variants(case):
    step, h = report.entry(case, "system/controlDict", "deltaT"), report.entry(case, "system/gridDict", "cellSize")
    for name, size in CELLS.items():
        if size != 1:
            report.variant(case, RUNS[name], {("system/gridDict", "cellSize"): repr(size * h),
                                              ("system/controlDict", "deltaT"): repr(size * step)})
    for word in ("none", "automatic"):
        run = folder(case, "h 62.5 mm, " + ("plain" if word == "none" else word))
        schemes = report.variant(case, run.name, {}) / "system/mpmSchemes"
        text = schemes.read_text()
        schemes.write_text(text[:text.rindex("stressTreatment")] + f"stressTreatment {word};\n")


def path(t):
    """Of the footing, downwards [m]."""
    return np.where(t < RAMP, 0.5 * SPEED * t**2 / RAMP, SPEED * (t - RAMP / 2))


def pressure(run):
    """Path [m] and the footing's mean pressure over the cohesion, at the rows of postProcessing/footing.csv."""
    rows = report.series(run, "footing")
    return path(rows["time"]), rows["forceY"] / (COHESION * HALF)


def bearing(run):
    """Work of the footing over its path in the window, over c B/2."""
    budget = report.series(run, "energyBudget")
    work = np.interp(WINDOW, path(budget["time"]), budget["motionWork"])
    return float((work[1] - work[0]) / (WINDOW[1] - WINDOW[0]) / (COHESION * HALF))


def heave(run):
    """x and rise of the surface beside the footing."""
    first, last = report.state(run, 0).by_id("x"), report.state(run).by_id("x")
    top = np.flatnonzero((first[:, 1] > first[:, 1].max() - 1e-6) & (first[:, 0] > 1.1 * HALF))
    top = top[np.argsort(first[top, 0])]
    return first[top, 0], (last - first)[top, 1]


def edge(run):
    """Where the rise of the surface falls to half of its mean between x = 1.3 and 2.2 m: the end of the mechanism."""
    x, rise = heave(run)
    half = 0.5 * rise[(x > 1.3) & (x < 2.2)].mean()
    k = np.flatnonzero(rise > half)[-1]
    return x[k] + (x[k + 1] - x[k]) * (rise[k] - half) / (rise[k] - rise[k + 1])


def measure(case, names=tuple(RUNS)):
    numbers, found = report.Numbers(), {name: bearing(folder(case, name)) for name in names}
    for name in names:
        plain, cells = name.endswith("plain"), name in CELLS
        band = {"h 125 mm": 0.12, "h 62.5 mm": 0.07, "h 31.25 mm": 0.05}.get(name, 0.1)
        numbers.add(f"N_c, {name}", found[name], "", "above 5.14" if plain else "5.14", "locks" if plain else "Prandtl: 2 + pi" if cells
                    else "relaxation takes some", PRANDTL * (1 if plain else 1 - band), PRANDTL * (1.25 if plain else 1 + band), ".2f")
    if set(CELLS) <= set(names):
        fine, middle = found["h 31.25 mm"], found["h 62.5 mm"]
        numbers.add("N_c extrapolated to h = 0 (first order)", 2 * fine - middle, "", "5.14", "Prandtl: 2 + pi", 0.97 * PRANDTL,
                    1.03 * PRANDTL, ".2f")
    name = "h 31.25 mm" if "h 31.25 mm" in names else names[0]
    numbers.add(f"the surface rises up to x, {name}", edge(folder(case, name)), "m", "2 to 3",
                "Hill's mechanism ends at B, Prandtl's at 1.5 B; the load is the same", 1.8, 3.3, ".2f")
    x, rise = heave(folder(case, name))
    pushed = float(path(np.array(report.state(folder(case, name)).time))) * HALF
    numbers.add(f"area that rises over that pushed down, {name}", np.interp(np.arange(1.15, 3.9, 0.01), x, rise).sum() * 0.01 / pushed, "",
                "1", "undrained; less what the elastic clay gives way", 0.6, 1.1, ".2f")
    budgets = [report.series(folder(case, name), "energyBudget") for name in names]
    numbers.add("energy residual, of the footing's work (worst)", max(abs(b["residual"]).max() / b["motionWork"].max() for b in budgets),
                "", "round-off", "", 0, 1e-9, ".0e")
    return numbers


def draw(case):
    sketch(case)
    plt, run = report.plotter(), folder(case, "h 31.25 mm")
    first, last = report.state(run, 0.4), report.state(run)
    figure, panels = plt.subplots(3, 1, figsize=(7, 8.6), layout="constrained", gridspec_kw={"height_ratios": [1.2, 1.2, 1]})
    move = last.by_id("x") - first.by_id("x")
    order = np.argsort(np.argsort(last["id"]))
    size = np.linalg.norm(move, axis=1)[order] / (SPEED * (last.time - first.time))
    domains = report.paint(panels[0], last, size, (0, 1.2), "viridis")
    report.bar(figure, domains, panels[0], "speed/footing's")
    x, v = last.by_id("x"), move
    some = np.flatnonzero(np.all(np.floor(report.state(run, 0).by_id("x") / 0.015625).astype(int) % 8 == 0, axis=1))
    panels[0].quiver(*x[some].T, *v[some].T, color="white", scale=0.35, width=0.0022)
    shear = report.paint(panels[1], last, report.shear_strain(last), (0, 0.06), "magma_r")
    report.bar(figure, shear, panels[1], "shear strain [-]")
    down = float(path(np.array(last.time)))
    for axes, title in zip(panels, ("motion from 0.4 to 0.7 s", "shear strain at 0.7 s, and Prandtl's mechanism")):
        axes.fill([0, 1, 1, 0], [2 - down, 2 - down, 2.3, 2.3], color="0.5")
        report.frame(axes, (0, 3.6), (0.3, 2.3), title)
    mechanism(panels[1])
    for name in RUNS:
        panels[2].plot(*(a * b for a, b in zip(pressure(folder(case, name)), (1e3, 1))), linewidth=1, label=name)
    panels[2].axhline(PRANDTL, color="black", linestyle=":", linewidth=0.8, label="2 + pi")
    panels[2].set(xlabel="path of the footing [mm]", ylabel="pressure/c", xlim=(0, 30), ylim=(0, 7))
    panels[2].legend(ncols=2)
    report.save(figure, case / "footing.png", 130)


def mechanism(axes):
    """Prandtl's: a wedge under the footing, a fan, a wedge that goes up; B/2 = 1 m, surface y = 2 m."""
    axes.plot([0, 1], [1, 2], "-", color="tab:cyan", linewidth=0.9)
    angle = np.radians(np.linspace(225, 315, 50))
    axes.plot(1 + math.sqrt(2) * np.cos(angle), 2 + math.sqrt(2) * np.sin(angle), color="tab:cyan", linewidth=0.9)
    axes.plot([2, 1], [1, 2], color="tab:cyan", linewidth=0.9)
    axes.plot([2, 3], [1, 2], color="tab:cyan", linewidth=0.9)


def sketch(case):
    figure, axes = report.sketch_axes((-0.5, 4.5), (-0.45, 2.95))
    axes.fill([0, 4, 4, 0], [0, 0, 2, 2], color="#c9b7a0")
    axes.fill([0, 1, 1, 0], [2, 2, 2.5, 2.5], color="0.5")
    report.wall(axes, (0, 4), (0, 0), 0.12)
    mechanism(axes)
    axes.plot([0, 0], [0, 2.8], "k-.", linewidth=0.7)
    report.arrow(axes, (0.5, 2.9), (0.5, 2.55), "50 mm/s", (0.5, 0))
    axes.text(0.5, 2.25, "rigid, rough", ha="center", va="center")
    report.arrow(axes, (0, 1.9), (1, 1.9), "B/2 = 1 m", (0, -0.12), both=True)
    axes.text(3.3, 0.6, "clay: c = 10 kPa\nE = 2000 c", ha="center")
    report.arrow(axes, (4.15, 0), (4.15, 2), "2 m", (0.2, 0), both=True)
    report.arrow(axes, (0, -0.25), (4, -0.25), "4 m", (0, -0.12), both=True)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

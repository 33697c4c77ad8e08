#!/usr/bin/python3
"""Measures the granular columns, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

R, DENSITY = 0.1, 1600  # [m], [kg/m^3]
RATIOS = (0.5, 1, 2.5, 5)  # H/R; the folder itself has 1
END = {0.5: 0.6, 1: 0.6, 2.5: 1, 5: 1.4}  # [s] six fall times sqrt(H/g) and more
LINEAR, ROOT = (0.5, 1), (2.5, 5)


def folder(case, a):
    return case if a == 1 else case / "variants" / f"a{a:g}"


def make_variants(case):
    for a in RATIOS:
        if a != 1:
            report.variant(case, f"a{a:g}", {("geometry/column.geo", "height"): f"{a * R:g}",
                                             ("system/controlDict", "endTime"): f"{END[a]:g}"})


def lube(a):
    return 1.24 * a if a < 1.7 else 1.6 * math.sqrt(a)


def lajeunesse(a):
    return a if a < 3 else math.sqrt(3 * a)


def lube_height(a):
    return a if a < 1 else 0.88 * a ** (1 / 6)


def profile(run, time=np.inf):
    edges = np.arange(0, 0.7 + 1e-9, 0.1 * R)
    return edges, report.heap_profile(report.state(run, time), DENSITY, edges, radial=True)


def run_out(run, least=0.02):
    """(front - R)/R; the front is where `least` R is left: 2 mm, a grain or two."""
    return report.front(*profile(run), least * R) / R - 1


def height(run):
    """Of the heap over R, on the axis: the mean over its innermost quarter of the radius."""
    return profile(run)[1][:3].mean() / R


def exponent(values, pair):
    return math.log(values[pair[1]] / values[pair[0]]) / math.log(pair[1] / pair[0])


def measure(case, ratios=RATIOS):
    numbers = report.Numbers()
    outs = {a: run_out(folder(case, a)) for a in ratios}
    for a in ratios:
        laws = lube(a), lajeunesse(a)
        numbers.add(f"run-out over R, a = {a:g}", outs[a], form=".2f", expected=f"{laws[0]:.2f} (Lube), {laws[1]:.2f} (Lajeunesse)",
                    source="prefactors depend on grains and base", least=0.7 * min(laws), most=1.3 * max(laws))
    for name, pair, value in (("a < 1.7", LINEAR, 1), ("a > 1.7", ROOT, 0.5)):
        if set(pair) <= set(ratios):
            numbers.add(f"exponent of the run-out, {name} (a = {pair[0]:g} and {pair[1]:g})", exponent(outs, pair), form=".2f",
                        expected=f"{value:g}", source="both", least=value - 0.25, most=value + 0.25)
    for a in ratios:
        top = lube_height(a)
        numbers.add(f"height on the axis over R, a = {a:g}", height(folder(case, a)), form=".2f", expected=f"{top:.2f}",
                    source="Lube: a; 0.88 a^(1/6)", least=0.7 * top, most=1.3 * top)
    for a in ratios:
        s = report.state(folder(case, a))
        numbers.add(f"volume at the end over that of the start, a = {a:g}", s["volume"].sum() * DENSITY / s["mass"].sum(), form=".3f",
                    expected="1", source="psi = 0", least=0.98, most=1.12)
    rest = [report.series(folder(case, a))["kineticEnergy"] for a in ratios]
    numbers.add("kinetic energy at the end, of its peak (worst)", max(k[-1] / k.max() for k in rest), form=".1e",
                expected="at rest", least=0, most=0.02)
    loss = [report.series(folder(case, a)) for a in ratios]
    numbers.add("energy residual, of the work of gravity (worst)", max(abs(k["residual"]).max() / k["gravityWork"].max() for k in loss),
                form=".0e", expected="round-off", least=0, most=1e-9)
    s = report.state(folder(case, ratios[-1]))
    x = s["x"]
    twist = (s["mass"] * (x[:, 0] ** 2 - x[:, 1] ** 2)).sum() / (s["mass"] * (x[:, 0] ** 2 + x[:, 1] ** 2)).sum()
    numbers.add(f"inertia about x and y, difference over sum, a = {ratios[-1]:g}", abs(twist), form=".1e",
                expected="0: the grid has its axes, the heap has none", least=0, most=0.01)
    return numbers


def draw(case):
    sketch(case)
    plt = report.plotter()
    figure = plt.figure(figsize=(8, 6.2), layout="constrained")
    grid = figure.add_gridspec(2, 3, height_ratios=[1.5, 1])
    run = folder(case, 2.5)
    for column, time in enumerate((0, 0.25, 1)):
        s = report.state(run, time)
        axes = figure.add_subplot(grid[0, column], projection="3d")
        speed = np.linalg.norm(s["v"], axis=1)
        points = axes.scatter(*s["x"].T, c=speed, s=2.5, cmap="viridis", vmin=0, vmax=1.2, rasterized=True, linewidths=0)
        axes.set(xlim=(0, 0.4), ylim=(0, 0.4), zlim=(0, 0.26), title=f"a = 2.5, t = {s.time:.2g} s")
        axes.set_box_aspect((0.4, 0.4, 0.26))
        axes.view_init(22, 35)
        axes.tick_params(labelsize=5, pad=-3)
    report.bar(figure, points, figure.axes, "speed [m/s]", shrink=0.6)
    axes = figure.add_subplot(grid[1, :2])
    for a in RATIOS:
        edges, top = profile(folder(case, a))
        axes.plot(0.5 * (edges[1:] + edges[:-1]) / R, top / R, label=f"a = {a:g}")
    axes.set(xlabel="r/R", ylabel="height/R", xlim=(0, 5), ylim=(0, 1.6), title="heaps at rest")
    axes.legend()
    axes = figure.add_subplot(grid[1, 2])
    a = np.geomspace(0.4, 7, 50)
    axes.loglog(a, [lube(k) for k in a], label="Lube 2004")
    axes.loglog(a, [lajeunesse(k) for k in a], label="Lajeunesse 2005")
    axes.loglog(RATIOS, [run_out(folder(case, k)) for k in RATIOS], "ko", label="here")
    axes.set(xlabel="a = H/R", ylabel="run-out/R")
    axes.legend()
    report.save(figure, case / "columns.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-1.5, 3.7), (-0.55, 1.75))
    for y in (0, 1.2):
        angle = np.linspace(0, 2 * np.pi, 100)
        hidden = (angle > 0) & (angle < np.pi)
        axes.plot(np.cos(angle[hidden]), y + 0.25 * np.sin(angle[hidden]), "k:" if y == 0 else "k-", linewidth=0.8)
        axes.plot(np.cos(angle[~hidden]), y + 0.25 * np.sin(angle[~hidden]), "k-", linewidth=0.8)
    axes.plot([-1, -1], [0, 1.2], "k-", [1, 1], [0, 1.2], "k-", linewidth=0.8)
    axes.fill([0, 1, 1, 0], [0, 0, 1.2, 1.2], color="#d9c9a3", alpha=0.7)
    axes.fill([0, -0.35, -0.35, 0], [0, -0.235, 0.965, 1.2], color="#d9c9a3", alpha=0.9)
    axes.plot([0, 0], [0, 1.35], "k-.", linewidth=0.6)
    axes.text(0.5, 0.6, "y = 0: roller", ha="center")
    axes.text(-0.18, 0.35, "x = 0: roller", ha="center", rotation=90)
    axes.plot([-1.5, 3.7], [-0.3, -0.3], color="0.6", linewidth=0)
    axes.text(2.3, -0.15, "base: friction, mu 0.6", ha="center")
    axes.plot([0, 0.6, 1.6, 2.9], [0.75, 0.62, 0.25, 0], ":", color="0.3")
    report.arrow(axes, (0, 1.45), (1, 1.45), "R = 0.1 m", (0, 0.12), both=True)
    report.arrow(axes, (1.15, 0), (1.15, 1.2), "H = a R", (0.35, 0.3), both=True)
    report.arrow(axes, (1, 0), (2.9, 0), "run-out", (0.25, 0.12), both=True)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

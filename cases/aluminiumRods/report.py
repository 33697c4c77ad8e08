#!/usr/bin/python3
"""Measures the pile of rods, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

GRID, CONTROL, SOIL = "system/gridDict", "system/controlDict", "constant/materialProperties"
H, FINE, SAND = 0.005, 0.0025, 31  # [m], [m], [deg]
CELLS = {"h 10 mm": 2 * H, "h 5 mm": H, "h 2.5 mm": FINE}
L0, H0, DENSITY = 0.2, 0.1, 2650
A = H0 / L0
LUBE, LAJEUNESSE = 1.2 * A, A  # run-out over L0 of a < 2.3 and a < 3


def folders(case):
    return {name: case if name == "h 5 mm" else case / "variants" / name.replace(" ", "") for name in (*CELLS, "sand")}


def changes(h):
    return {(GRID, "cellSize"): repr(h), (CONTROL, "deltaT"): repr(h / 50)}


def make_variants(case):
    for name, h in CELLS.items():
        if h != H:
            report.variant(case, name.replace(" ", ""), changes(h))
    sand = {(SOIL, "frictionAngle"): SAND, (SOIL, "K0"): repr(round(1 - np.sin(np.radians(SAND)), 3))}
    report.variant(case, "sand", sand)


def profile(run, time=np.inf, bin=0.01):
    edges = np.arange(0, 0.6 + 1e-9, bin)
    return edges, report.heap_profile(report.state(run, time), DENSITY, edges)


def run_out(run, share=0.1):
    """(front - L0)/L0; the front is where the heap is `share` of its first height: 10 mm, the coarsest cell."""
    return report.front(*profile(run), share * H0) / L0 - 1


def measure(case):
    numbers, runs = report.Numbers(), folders(case)
    outs = {name: run_out(run) for name, run in runs.items()}
    for name in CELLS:
        numbers.add(f"run-out over L0, {name}", outs[name], form=".3f",
                    expected=f"{LUBE:g} (Lube), {LAJEUNESSE:g} (Lajeunesse) for sand of about 30°",
                    source="1.2 a and a; order of magnitude, phi is 19.8°", least=0.5 * LAJEUNESSE, most=2 * LUBE)
    for name, run in runs.items():
        numbers.add(f"the same to where 2 mm are left, {name}", run_out(run, 0.02), form=".3f")
    numbers.add("run-out over L0 with phi = 31°, h 5 mm", outs["sand"], form=".3f", expected=f"{LAJEUNESSE:g} to {LUBE:g}",
                source="the same laws, for what they were measured with", least=0.7 * LAJEUNESSE, most=1.3 * LUBE)
    _, middle, fine = (outs[name] for name in CELLS)
    numbers.add("change of the run-out from 5 to 2.5 mm", abs(fine / middle - 1), least=0, most=0.05, form=".1%")
    shapes = [profile(runs[name])[1] for name in CELLS]
    change = [np.abs(a - b).sum() / b.sum() for a, b in zip(shapes, shapes[1:])]
    numbers.add("area between the profiles of 10 and 5 mm", change[0], form=".1%")
    numbers.add("area between the profiles of 5 and 2.5 mm", change[1], expected="less than that of 10 and 5 mm",
                least=0, most=change[0], form=".1%")
    edges, height = profile(runs["h 5 mm"])
    slope = np.degrees(np.arctan(np.polyfit(0.5 * (edges[8:29] + edges[9:30]), height[8:29], 1)[0]))
    numbers.add("mean slope of the heap, x = 0.08 to 0.30 m", -slope, "deg", expected="below phi = 19.8", least=5, most=19.8)
    numbers.add("highest point at the wall over H0", height[0] / H0, expected="1: a < 1.15 keeps its height (Lube)",
                source="h = a; rods slip down the smooth wall", least=0.85, most=1.02)
    history = report.series(runs["h 5 mm"])
    numbers.add("kinetic energy at the end, of its peak", history["kineticEnergy"][-1] / history["kineticEnergy"].max(),
                expected="at rest", least=0, most=0.02, form=".1e")
    numbers.add("energy residual, of the work of gravity", abs(history["residual"]).max() / history["gravityWork"].max(),
                expected="round-off", least=0, most=1e-9, form=".0e")
    return numbers


def draw(case):
    sketch(case)
    plt, run = report.plotter(), case
    figure, panels = plt.subplots(3, 1, figsize=(7, 6.2), sharex=True, layout="constrained")
    for axes, time in zip(panels, (0.1, 0.3, 0.7)):
        s = report.state(run, time)
        domains = report.paint(axes, s, report.shear_strain(s), (0, 1.5), "magma_r")
        report.frame(axes, (0, 0.48), (0, 0.11), f"t = {s.time:g} s, {len(s['id'])} particles")
        axes.set_ylabel("y [m]")
    report.bar(figure, domains, panels, "shear strain [-]")
    panels[-1].set_xlabel("x [m]")
    report.save(figure, case / "collapse.png", 130)
    figure, axes = plt.subplots(figsize=(7, 2.8), layout="constrained")
    for name, folder in folders(case).items():
        edges, height = profile(folder)
        axes.plot(0.5 * (edges[1:] + edges[:-1]), height, "--" if name == "sand" else "-", linewidth=1.2,
                  label="phi 31°, h 5 mm" if name == "sand" else f"phi 19.8°, {name}")
    for law, value, colour in (("Lube 2005", LUBE, "tab:red"), ("Lajeunesse 2005", LAJEUNESSE, "tab:pink")):
        axes.axvline(L0 * (1 + value), color=colour, linestyle=":", label=f"front after {law} (sand)")
    axes.set(xlabel="x [m]", ylabel="height [m]", xlim=(0, 0.48), ylim=(0, 0.11))
    axes.legend()
    report.save(figure, case / "profiles.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-0.05, 0.45), (-0.045, 0.14))
    axes.fill([0, L0, L0, 0], [0, 0, H0, H0], color="#d9c9a3")
    axes.text(0.1, 0.05, "rods\nphi 19.8°, c = 0", ha="center", va="center")
    report.wall(axes, (0, 0), (0.13, 0), 0.012)
    report.wall(axes, (0, 0.44), (0, 0), 0.012)
    axes.plot([L0, L0], [0, 0.125], "--", color="tab:red")
    report.arrow(axes, (L0, 0.11), (L0, 0.135), colour="tab:red")
    axes.text(0.21, 0.125, "gate, gone at t = 0", color="tab:red", va="center")
    axes.plot([0, 0.05, 0.38], [0.09, 0.083, 0], ":", color="0.3")
    report.arrow(axes, (0, -0.025), (L0, -0.025), "L0 = 0.2 m", (0, -0.012), both=True)
    report.arrow(axes, (L0, -0.025), (0.38, -0.025), "run-out", (0, -0.012), both=True)
    report.arrow(axes, (-0.02, 0), (-0.02, H0), "H =\n0.1 m", (-0.018, 0), both=True)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

#!/usr/bin/python3
"""Measures the slope, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

G, DENSITY = 9.81, 1800
C, PHI, SLOPE, HEIGHT = 8e3, math.radians(25), math.radians(45), 6.0  # [Pa], [rad], [rad], [m]
GAMMA = DENSITY * G
BOUNDARIES, SOIL, GRID, CONTROL = ("constant/boundaryConditions", "constant/materialProperties", "system/gridDict",
                                   "system/controlDict")
RATE = 0.05  # [1/s] of the push, over g
AT_REST = 2.5  # [s] weight is there, the shaking is not
V, W, T0, TAU = 0.55, 7.85, 7, 1.6  # constant/boundaryConditions
PUSH = f"""/* libmpm: a push of the whole body */
FoamFile {{ version 2.0; format ascii; class dictionary; object bodyForce; }}
value       ("{RATE * G:g}*max(t - 2, 0)" 0 0);     // [m/s^2]
"""
RUNS = {"h 0.5 m": ".", "h 0.25 m": "fine", "weak": "weak", "softening": "softening", "push": "push"}


def folder(case, name):
    return case if RUNS[name] == "." else case / "variants" / RUNS[name]


def make_variants(case):
    h, step = report.entry(case, GRID, "cellSize"), report.entry(case, CONTROL, "deltaT")
    report.variant(case, "fine", {(GRID, "cellSize"): repr(h / 2), (CONTROL, "deltaT"): repr(step)})
    report.variant(case, "weak", {(BOUNDARIES, "V"): "0.1"})
    push = report.variant(case, "push", {(BOUNDARIES, "V"): "0", (CONTROL, "endTime"): "7", (CONTROL, "writeInterval"): "0.1"})
    (push / "constant/bodyForce").write_text(PUSH)
    soil = report.variant(case, "softening", {}) / SOIL
    soft = "softening { over 0.1; cohesion 0.5e3; frictionAngle 18; dilationAngle 0; referenceLength 0.5; }\n\n    initialStress"
    soil.write_text(soil.read_text().replace("initialStress", soft))


# The earthquake, and a block that slides under it -----------------------------------------------------------------------

def quake(speed=V):
    """Times, velocity, displacement and acceleration of the rock, as the dictionary has them."""
    t = np.arange(0, 12, 1e-3)
    v = speed * np.exp(-(((t - T0) / TAU) ** 2)) * (np.sin(W * (t - T0)) + 0.5 * np.sin(0.62 * W * (t - T0) + 1))
    return t, v, np.cumsum(v) * 1e-3, np.gradient(v, t)


def newmark(yields, speed=V, plane=math.radians(27.5)):
    """Path [m] of a block on a plane that yields at the acceleration `yields` g (N. M. Newmark 1965), down the plane alone:
    s'' = g (k - k_y) cos(plane - phi)/cos phi while it slides; rock that accelerates away from the valley throws the block."""
    t, _, _, a = quake(speed)
    path = rate = 0.0
    for k in -a / G:
        rate = max(0.0, rate + G * (k - yields) * math.cos(plane - PHI) / math.cos(PHI) * 1e-3)
        path += rate * 1e-3
    return path


def wedge_yield():
    """Yield acceleration over g and factor of safety at rest of plane wedges through the toe (Culmann): upper bounds."""
    th = np.radians(np.arange(15, 44, 0.1))
    weight = 0.5 * GAMMA * HEIGHT**2 * (1 / np.tan(th) - 1 / math.tan(SLOPE))
    hold = C * HEIGHT / np.sin(th) + weight * np.cos(th) * math.tan(PHI)
    safety = (hold / (weight * np.sin(th))).min()
    return ((hold - weight * np.sin(th)) / (weight * (np.cos(th) + np.sin(th) * math.tan(PHI)))).min(), safety


def spiral_yield():
    """The same acceleration of logarithmic spirals through the toe (W. F. Chen 1975): moments of weight and inertia about
    the pole against the work of cohesion; an upper bound for associated flow, and closer."""
    best, tangent = math.inf, math.tan(PHI)
    toe = np.array([0.0, 0.0])
    for start in np.radians(np.arange(20, 80, 2)):
        for end in np.radians(np.arange(60, 130, 2)):
            if end - start < 0.2:
                continue
            th = np.linspace(start, end, 60)
            r = np.exp((th - start) * tangent)  # over r0; angle from the horizontal, downwards, towards the valley is 180 deg
            x, y = -r * np.cos(th), -r * np.sin(th)
            if y[0] - y[-1] <= 1e-3:
                continue
            scale = HEIGHT / (y[0] - y[-1])  # crest level at the start, toe at the end
            x, y, r0 = x * scale, y * scale, scale
            pole = toe - np.array([x[-1], y[-1]])
            px, py = x + pole[0], y + pole[1]
            crest = -HEIGHT / math.tan(SLOPE)
            if px[0] >= crest:
                continue
            px, py = np.append(px, [crest]), np.append(py, [HEIGHT])
            cross = px * np.roll(py, -1) - np.roll(px, -1) * py
            area = cross.sum() / 2
            if area <= 0.1:
                continue
            mass = np.array([((px + np.roll(px, -1)) * cross).sum(), ((py + np.roll(py, -1)) * cross).sum()]) / (6 * area)
            arm = mass - pole
            cohesion = C * r0**2 * (math.exp(2 * (end - start) * tangent) - 1) / (2 * tangent)
            weight = GAMMA * area
            if -arm[1] > 0:
                best = min(best, (cohesion + weight * arm[0]) / (weight * -arm[1]))
    return best


# What a run did ---------------------------------------------------------------------------------------------------------

def slip(run):
    """Times and the motion of the face (a metre deep, 1 to 5 m above the toe) along x against the ground far behind, since
    weight is there [m]."""
    first = report.state(run, AT_REST).by_id("x")
    start = report.state(run, 0).by_id("x")
    face = (start[:, 1] > 3) & (start[:, 1] < 7) & (start[:, 0] > 21 - start[:, 1])
    far = start[:, 0] < 6
    rows = []
    for s in report.states(run):
        move = s.by_id("x")[:, 0] - first[:, 0]
        rows.append((s.time, move[face].mean() - move[far].mean()))
    return np.array(rows).T


def push_yield(run, least=0.005):
    """Push over g at which the face has slipped `least` [m]."""
    t, d = slip(run)
    k = RATE * np.clip(t - 2, 0, None)
    j = np.flatnonzero(d > least)[0]
    return float(k[j - 1] + (k[j] - k[j - 1]) * (least - d[j - 1]) / (d[j] - d[j - 1]))


def measure(case, names=tuple(RUNS)):
    numbers = report.Numbers()
    culmann, safety = wedge_yield()
    spiral = spiral_yield()
    infinite = C / (GAMMA * HEIGHT * math.sin(SLOPE) * math.cos(SLOPE)) + math.tan(PHI) / math.tan(SLOPE)
    numbers.add("factor of safety at rest, infinite slope 6 m thick", infinite, form=".2f",
                source="c/(gamma z sin b cos b) + tan phi/tan b: ends of the slope left out")
    numbers.add("factor of safety at rest, Culmann's wedge", safety, form=".2f", source="plane through the toe")
    first, rest = report.state(folder(case, names[0]), 0).by_id("x"), report.state(folder(case, names[0]), AT_REST).by_id("x")
    numbers.add("largest displacement as weight comes", 1e3 * np.linalg.norm(rest - first, axis=1).max(), "mm", "a few: it stands",
                "gamma H²/(2 M) = 4 mm", 0.5, 15, ".1f")
    numbers.add("yield acceleration over g, Culmann's wedge", culmann, form=".3f", source="upper bound")
    numbers.add("yield acceleration over g, logarithmic spiral", spiral, form=".3f", source="upper bound for psi = phi")
    k_y = spiral
    if "push" in names:
        k_y = numbers.add("yield acceleration over g, measured by a slow push", push_yield(folder(case, "push")), "",
                          "below the bounds (psi = 0)", "", 0.5 * spiral, 1.05 * spiral, ".3f")
    peak = abs(quake()[3]).max() / G
    numbers.add("largest acceleration of the rock over g", peak, form=".2f", source="constant/boundaryConditions")
    for name in ("h 0.5 m", "h 0.25 m"):
        if name in names:
            estimate = newmark(k_y)
            numbers.add(f"the face slips for good, {name}", slip(folder(case, name))[1][-1], "m", f"{estimate:.2f}",
                        "Newmark's block with the measured yield acceleration; within a factor of two", estimate / 2, 2 * estimate, ".3f")
    if "weak" in names:
        numbers.add("the same under 0.1 g", 1e3 * slip(folder(case, "weak"))[1][-1], "mm", "0: below the yield acceleration",
                    "Newmark", -5, 5, ".2f")
    if "softening" in names:
        numbers.add("the same with soil that softens", slip(folder(case, "softening"))[1][-1], "m",
                    f"run-out: at rest {residual_safety():.2f} of what it needs", "Culmann's wedge with residual strength",
                    3 * newmark(k_y), math.inf, ".2f")
    budget = report.series(folder(case, names[0]), "energyBudget")
    supplied = abs(budget["motionWork"][-1]) + abs(budget["gravityWork"]).max()
    numbers.add("energy residual, of the work of rock and gravity", abs(budget["residual"]).max() / supplied, "", "round-off", "", 0,
                1e-9, ".0e")
    return numbers


def residual_safety():
    """Factor of safety at rest with the strength softening ends at."""
    th = np.radians(np.arange(15, 44, 0.1))
    weight = 0.5 * GAMMA * HEIGHT**2 * (1 / np.tan(th) - 1 / math.tan(SLOPE))
    return ((0.5e3 * HEIGHT / np.sin(th) + weight * np.cos(th) * math.tan(math.radians(18))) / (weight * np.sin(th))).min()


def draw(case):
    sketch(case)
    plt = report.plotter()
    figure, panels = plt.subplots(3, 1, figsize=(7.5, 8), layout="constrained")
    for axes, name, limit in ((panels[0], "h 0.25 m", 0.3), (panels[1], "softening", 1.5)):
        s = report.state(folder(case, name))
        domains = report.paint(axes, s, report.shear_strain(s), (0, limit), "magma_r")
        axes.plot([14, 20], [8, 2], color="tab:cyan", linewidth=0.8)
        report.wall(axes, (0, 28), (0, 0), 0.4)
        report.frame(axes, (5, 28), (-0.4, 8.6), f"{name}: shear strain at {s.time:g} s; the line is the slope it was")
        report.bar(figure, domains, axes, "shear strain [-]")
    t, v, d, a = quake()
    panels[2].plot(t, a / G, color="0.7", linewidth=0.8, label="acceleration of the rock over g")
    for name in ("h 0.5 m", "h 0.25 m", "weak"):
        panels[2].plot(*slip(folder(case, name)), "o-", markersize=2.5, linewidth=1, label=f"slip of the face [m], {name}")
    k_y = push_yield(folder(case, "push"))
    panels[2].axhline(newmark(k_y), color="black", linestyle=":", linewidth=0.9, label=f"Newmark with k_y = {k_y:.2f} [m]")
    panels[2].set(xlabel="time [s]", ylim=(-0.65, 0.85), xlim=(2, 12))
    panels[2].legend(ncols=2)
    report.save(figure, case / "slope.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-2.5, 31), (-2.6, 10.2), 6.5)
    axes.fill([0, 28, 28, 20, 14, 0], [0, 0, 2, 2, 8, 8], color="#c9b7a0")
    report.wall(axes, (0, 28), (0, 0), 0.7)
    report.wall(axes, (0, 0), (0, 8), -0.6)
    report.wall(axes, (28, 28), (0, 2), 0.6)
    t = np.linspace(0, 1, 200)
    axes.plot(8 + 12 * t, -1.9 + 0.5 * np.exp(-((t - 0.5) / 0.22) ** 2) * np.sin(50 * t), color="tab:red", linewidth=1)
    report.arrow(axes, (6.8, -1.9), (4.3, -1.9), colour="tab:red")
    report.arrow(axes, (4.3, -1.9), (6.8, -1.9), colour="tab:red")
    axes.text(24, -1.9, "rock, shaken", color="tab:red", ha="center", va="center")
    axes.text(6, 4.5, "soil: phi 25°, c 8 kPa\nE 100 MPa, 1800 kg/m³", ha="center")
    axes.text(17.6, 2.5, "45°")
    axes.plot([11, 20], [8, 2], "k--", linewidth=0.9)
    report.arrow(axes, (22, 2), (22, 8), "6 m", (0.8, 0), both=True)
    axes.text(-0.2, 8.6, "sides go with the rock, let shear waves out", ha="left")
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

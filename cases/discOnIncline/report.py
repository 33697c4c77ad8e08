#!/usr/bin/python3
"""Measures the disc on its plane, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

R = 0.5
EASE = 0.3  # [s] over which gravity comes in eased runs
# name: angle [deg], mu, g [m/s^2], refinement, eased; the folder itself is the first
RUNS = {"60°, mu 0.3": (60, 0.3, 10, 1, False), "60°, mu 0.3, h/2": (60, 0.3, 10, 2, False), "45°, mu 0.3": (45, 0.3, 9.8, 1, False),
        "30°, mu 0.6": (30, 0.6, 9.8, 1, False), "30°, mu 0.6, eased": (30, 0.6, 9.8, 1, True),
        "30°, mu 0.6, eased, h/2": (30, 0.6, 9.8, 2, True)}
OWN = "60°, mu 0.3"


def folder(case, name):
    angle, mu, _, fine, eased = RUNS[name]
    return case if name == OWN else case / "variants" / f"{angle}deg-mu{mu:g}{'-eased' if eased else ''}{'-fine' if fine > 1 else ''}"


def make_variants(case):
    step, h = report.entry(case, "system/controlDict", "deltaT"), report.entry(case, "system/gridDict", "cellSize")
    for name, (angle, mu, g, fine, eased) in RUNS.items():
        if name != OWN:
            sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
            run = report.variant(case, folder(case, name).name, {
                ("constant/g", "value"): f"({g * sine!r} {-g * cosine!r} 0)", ("constant/contactProperties", "mu"): mu,
                ("system/gridDict", "cellSize"): repr(h / fine), ("system/controlDict", "deltaT"): repr(step / fine),
                ("system/controlDict", "endTime"): 0.65 if eased else 0.5})
            if eased:
                with open(run / "constant/g", "a") as file:
                    file.write(f"\nramp {{ duration {EASE:g}; shape smooth; }}\n")


def fallen(t, eased):
    """Path over the acceleration: t²/2, or what gravity that comes as s²(3 - 2s), s = t/EASE, makes of it."""
    s = np.minimum(t / EASE, 1)
    late = np.maximum(t - EASE, 0)
    return EASE**2 * (s**4 / 4 - s**5 / 10) + EASE / 2 * late + late**2 / 2 if eased else t**2 / 2

def closed_form(angle, mu, g):
    """Does it roll; acceleration of the centre [m/s^2]; of the angle [1/s^2]."""
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    if math.tan(math.radians(angle)) <= 3 * mu:
        return True, 2 / 3 * g * sine, 2 / 3 * g * sine / R
    return False, g * (sine - mu * cosine), 2 * mu * g * cosine / R


def motion(run):
    """Time, path along the plane [m] and angle turned, clockwise, at the stored times."""
    first = report.state(run, 0)
    disc = first.by_id("material") == first.materials.index("disc")
    start = report.centre(first, first.of("disc"))
    rows = [(s.time, report.centre(s, s.of("disc"))[0] - start[0], -report.turned(first, s, disc)) for s in report.states(run)]
    return np.array(rows).T


def measure(case, names=tuple(RUNS)):
    numbers = report.Numbers()
    for name in names:
        angle, mu, g, fine, eased = RUNS[name]
        path_band, angle_band = (0.05 if eased else 0.02) / fine, (0.08 if eased else 0.15) / fine
        rolls, a, alpha = closed_form(angle, mu, g)
        t, path, turned = (column[-1] for column in motion(folder(case, name)))
        exact = a * float(fallen(t, eased))
        numbers.add(f"path in {t:g} s, {name}", path, "m", f"{exact:.6f}" if not eased else f"{exact:.4f}", "2/3 g sin th: rolls" if rolls else "g (sin th - mu cos th): slips",
                    (1 - path_band) * exact, (1 + path_band) * exact, ".4f")
        exact = alpha * float(fallen(t, eased))
        numbers.add(f"angle turned, {name}", turned, "", f"{exact:.4f}", "a/R" if rolls else "2 mu g cos th/R",
                    (1 - angle_band) * exact, (1 + angle_band) * exact, ".4f")
        if rolls:
            numbers.add(f"path over angle, {name}", path / turned, "m", f"{R:g}", "rolls on its radius", (1 - angle_band) * R,
                        (1 + angle_band) * R, ".4f")
    history = report.series(folder(case, names[0]))
    budget = report.series(folder(case, names[0]), "energyBudget")
    numbers.add("energy residual, of the work of gravity", abs(history["residual"]).max() / history["gravityWork"].max(), "",
                "round-off", "", 0, 1e-9, ".0e")
    angle, mu, g, *_ = RUNS[names[0]]
    rolls, a, alpha = closed_form(angle, mu, g)
    if not rolls:
        t = history["time"][-1]
        mass = 1000 * math.pi * R**2
        exact = mu * mass * g * math.cos(math.radians(angle)) * (a - alpha * R) * t * t / 2
        numbers.add(f"heat of friction, {names[0]}", budget["contactFriction"][-1], "J/m", f"{exact:.0f}", "mu N times the slip",
                    0.9 * exact, 1.1 * exact, ".0f")
    return numbers


def draw(case):
    sketch(case)
    plt = report.plotter()
    figure, panels = plt.subplots(2, 2, figsize=(9, 5), layout="constrained", gridspec_kw={"width_ratios": [1.6, 1]})
    for row, name in zip(panels, ("60°, mu 0.3, h/2", "30°, mu 0.6, eased, h/2")):
        run, axes = folder(case, name), row[0]
        angle, mu, g, _, eased = RUNS[name]
        rolls, a, alpha = closed_form(angle, mu, g)
        first = report.state(run, 0)
        mark = np.abs((first["x"] - report.centre(first, first.of("disc")))).min(axis=1) < 0.03
        marked = first["id"][mark & first.of("disc")]
        for time in (0, 0.3, 1):
            s = report.state(run, time)
            report.paint(axes, s, "#d9c9a3", part=s.of("disc"))
            report.paint(axes, s, "0.7", part=s.of("plane"))
            report.paint(axes, s, "#7a4a2b", part=np.isin(s["id"], marked))
        report.frame(axes, (0, 2.4), (-0.25, 1.05), f"{name}: t = 0, 0.3, {0.65 if eased else 0.5:g} s; g points {angle}° off the plane's normal")
        t, path, turned = motion(run)
        row[1].plot(t, path, "o", color="tab:blue", markersize=3, label="path [m]")
        row[1].plot(t, a * fallen(t, eased), "-", color="tab:blue", linewidth=0.8)
        row[1].plot(t, turned, "s", color="tab:red", markersize=3, label="angle [rad]")
        row[1].plot(t, alpha * fallen(t, eased), "-", color="tab:red", linewidth=0.8, label="closed forms")
        row[1].set(xlabel="time [s]", title="rolls" if rolls else "slips")
        row[1].legend()
    report.save(figure, case / "disc.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-0.2, 3.2), (-0.1, 2.6), 4.2)
    turn = math.radians(-35)
    along, normal = np.array([math.cos(turn), math.sin(turn)]), np.array([-math.sin(turn), math.cos(turn)])
    origin = np.array([0.3, 1.9])
    slab = np.array([origin, origin + 3 * along, origin + 3 * along - 0.25 * normal, origin - 0.25 * normal])
    axes.fill(*slab.T, color="0.7")
    middle = origin + 0.75 * along + R * normal
    angle = np.linspace(0, 2 * np.pi, 100)
    axes.fill(middle[0] + R * np.cos(angle), middle[1] + R * np.sin(angle), color="#d9c9a3")
    report.arrow(axes, middle, middle + np.array([0, -0.42]), "g", (0.08, 0))
    report.arrow(axes, middle, middle + R * normal, "R", (0.08, 0))
    report.arrow(axes, middle + R * normal + 0.1 * along, middle + R * normal + 0.9 * along, "s", (0, 0.1))
    bottom = origin + 3 * along
    axes.plot([bottom[0] - 0.9, bottom[0]], [bottom[1]] * 2, "k:", linewidth=0.8)
    axes.text(bottom[0] - 0.6, bottom[1] + 0.1, "th")
    axes.text(1.75, 1.45, "disc: K 7, G 1.5 MPa", ha="left")
    axes.text(0.15, 0.75, "plane: ten times\nas stiff, mu", ha="left")
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

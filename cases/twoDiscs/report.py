#!/usr/bin/python3
"""Measures the discs, draws figures and writes the table of README.md (etc/sceneReport.py has the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

GRID, CONTROL, CONTACT = "system/gridDict", "system/controlDict", "constant/contactProperties"
R, V, DENSITY = 0.2, 0.1, 1000  # [m], each component [m/s], [kg/m^3]
START = DENSITY * math.pi * R**2 * 2 * V**2  # kinetic energy of both [J/m]
TOUCH = (0.6 * math.sqrt(2) - 2 * R) / (2 * V * math.sqrt(2))  # gap over closing speed [s]
LEAST = {"h 50 mm": 0.93, "h 25 mm": 0.96, "h 12.5 mm": 0.98}  # of the energy; README.md says what takes the rest
CELLS = {"h 50 mm": 0.05, "h 25 mm": 0.025, "h 12.5 mm": 0.0125}


def folder(case, name):
    return case if name == "h 25 mm" else case / "variants" / name.replace(" ", "")


def make_variants(case):
    for name, h in CELLS.items():
        if name != "h 25 mm":
            report.variant(case, name.replace(" ", ""), {(GRID, "cellSize"): repr(h), (CONTROL, "deltaT"): repr(h / 5)})
    report.variant(case, "oneField", {(CONTACT, None): None})


def relative(s):
    """Speed at which the discs part, along the line they came on [m/s]."""
    return float((report.centre(s, s.of("upper"), "v") - report.centre(s, s.of("lower"), "v")) @ np.ones(2) / math.sqrt(2))


def motion(run):
    """What a run says of the collision."""
    first, last, history = report.state(run, 0), report.state(run), report.series(run)
    energy = history["kineticEnergy"] + history["strainEnergy"]
    momentum = (last["mass"][:, None] * last["v"]).sum(axis=0)
    x, order = last.by_id("x"), lambda y: np.lexsort(np.round(y, 9).T)
    here, there = order(first.by_id("x")), order(1 - first.by_id("x"))
    mirror = np.abs(x[here] - (1 - x[there])).max()
    return {"touch": history["time"][np.argmax(history["strainEnergy"] > 1e-4 * START)],
            "start": history["kineticEnergy"][0], "least": history["kineticEnergy"].min() / START,
            "momentum": np.abs(momentum).max() / (last["mass"].sum() / 2 * V), "mirror": mirror / R,
            "kept": energy[-1] / START, "most": energy.max() / START,
            "restitution": relative(last) / -relative(first), "before": np.abs(energy[history["time"] < 1] / START - 1).max()}


def measure(case, names=tuple(CELLS), field="oneField"):
    numbers = report.Numbers()
    found = {name: motion(folder(case, name)) for name in (*names, *([field] if field else []))}
    best = found[names[-1]]
    h = CELLS[names[-1]]
    numbers.add("kinetic energy at the start", best["start"], "J/m", "2.513", "rho pi R² v²", 0.99 * START, 1.01 * START, ".3f")
    for name in names:
        numbers.add(f"they touch at, {name}", found[name]["touch"], "s", "1.586", "gap 0.449 m over 0.283 m/s",
                    TOUCH - 0.6 * CELLS[name] / (2 * V), TOUCH + 1.2 * CELLS[name] / (2 * V), ".3f")
    if field:
        numbers.add("they touch at, h 25 mm, one field for both", found[field]["touch"], "s", "up to two cells early",
                    "the grid of 1994", TOUCH - 2 * 0.025 / (V * math.sqrt(2)), TOUCH, ".3f")
    numbers.add("momentum, of that of one disc (worst)", max(f["momentum"] for f in found.values()), "", "0", "", 0, 1e-12, ".0e")
    numbers.add("distance from the mirrored body over R (worst)", max(f["mirror"] for f in found.values()), "", "0",
                "the scene is its own mirror image; normals of contact may not", 0, 0.02, ".0e")
    numbers.add("change of energy before they meet (worst)", max(f["before"] for f in found.values()), "", "0", "", 0, 1e-3, ".0e")
    for name, f in found.items():
        numbers.add(f"kinetic + strain energy at 4 s, {name}", f["kept"], "", "1", "elastic bodies", LEAST.get(name, 0.99), 1.005, ".4f")
    if len(names) > 1:
        lost = [1 - found[name]["kept"] for name in names]
        numbers.add("energy lost over that with 2h (worst)", max(b / a for a, b in zip(lost, lost[1:])), "", "falls with h", "", 0, 0.8, ".2f")
    loss = report.series(folder(case, names[-1]), "energyBudget")["contactLoss"][-1]
    numbers.add(f"of it impacts of nodes in contact (contactLoss), {names[-1]}", loss / START / (1 - best["kept"]), form=".2f")
    numbers.add("least kinetic energy, at the height of the collision", best["least"], "", "near 0",
                "symmetry: all mass stops; waves do not", 0, 0.1, ".3f")
    for name, f in found.items():
        numbers.add(f"restitution, {name}", f["restitution"], "", "below 1: vibration is left", "", 0.8, 0.99, ".3f")
    if len(names) > 2:
        change = [abs(found[a]["restitution"] - found[b]["restitution"]) for a, b in zip(names, names[1:])]
        numbers.add("change of the restitution by the last halving of h", change[-1], "", "small", "", 0, 0.02, ".3f")
    return numbers


def draw(case):
    sketch(case)
    plt, run = report.plotter(), folder(case, "h 12.5 mm")
    figure, panels = plt.subplots(1, 4, figsize=(10, 2.9), sharey=True, layout="constrained")
    for axes, time in zip(panels, (1, 1.9, 2.3, 3.5)):
        s = report.state(run, time)
        domains = report.paint(axes, s, np.linalg.norm(s["v"], axis=1), (0, 0.2))
        report.frame(axes, (-0.05, 1.05), (-0.05, 1.05), f"t = {s.time:g} s")
    report.bar(figure, domains, panels, "speed [m/s]")
    report.save(figure, case / "discs.png", 130)
    figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
    for name, style in (("h 12.5 mm", "-"), ("oneField", "--")):
        history = report.series(folder(case, name))
        label = "one field for both, h 25 mm" if name == "oneField" else f"contact, {name}"
        for column, colour in (("kineticEnergy", "tab:blue"), ("strainEnergy", "tab:red"), (None, "black")):
            energy = history[column] if column else history["kineticEnergy"] + history["strainEnergy"]
            axes.plot(history["time"], energy, style, color=colour, linewidth=1.1,
                      label=f"{({'kineticEnergy': 'kinetic', 'strainEnergy': 'strain'}.get(column, 'sum'))}: {label}")
    axes.axvline(TOUCH, color="0.5", linestyle=":", label="rigid outlines touch")
    axes.set(xlabel="time [s]", ylabel="energy [J/m]", xlim=(0, 4))
    axes.legend()
    report.save(figure, case / "energies.png", 130)


def sketch(case):
    figure, axes = report.sketch_axes((-0.1, 1.35), (-0.1, 1.1), 3.6)
    angle = np.linspace(0, 2 * np.pi, 100)
    for x in (0.2, 0.8):
        axes.fill(x + R * np.cos(angle), x + R * np.sin(angle), color="#d9c9a3")
    report.arrow(axes, (0.2, 0.2), (0.36, 0.36), "v", (0.03, -0.06))
    report.arrow(axes, (0.8, 0.8), (0.64, 0.64), "v", (-0.03, 0.06))
    report.arrow(axes, (0.2, 0.2), (0.2 - R, 0.2), "R = 0.2 m", (0, 0.05))
    axes.plot([0.2, 0.8], [0.2, 0.8], "k.")
    axes.text(0.2, -0.06, "(0.2, 0.2)", ha="center")
    axes.text(0.8, 1.04, "(0.8, 0.8)", ha="center")
    axes.text(0.72, 0.2, "v = (0.1, 0.1) m/s\nand (-0.1, -0.1) m/s\nno gravity, no walls", ha="left", va="center")
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw, make_variants)

#!/usr/bin/python3
"""Measures the column against the wall on a spring, draws figures and writes the table of README.md (etc/sceneReport.py has
the options)."""

import math
import os
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(os.environ.get("MPM_PROJECT_DIR") or Path(__file__).resolve().parents[2])
sys.path.insert(0, str(PROJECT / "etc"))
import sceneReport as report  # noqa: E402

from couple import LINKS, MASSES, SCHEMES, WINDOWS  # noqa: E402

HEIGHT, WIDTH, DENSITY, G = 8.0, 4.0, 1000, 9.8
E, NU, PHI, COHESION = 20e6, 0.42, math.radians(42), 1e3
MASS, WINDOW = 20000, 0.01  # of wall and coupling where nothing else is said [kg/m], [s]
IMPEDANCE = math.sqrt(DENSITY * E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))) * HEIGHT  # rho c H of the elastic column [N s/m^2]
LIGHT = 300  # [kg/m]
REST = 0.5 * NU / (1 - NU) * DENSITY * G * HEIGHT**2  # [N/m]
FIT = slice(1, 5)  # windows the order is fitted to: 1 to 8 ms
EARLY = 0.128  # [s] until then the order is measured


def folder(case, name):
    return Path(case) / "variants" / name


def wall(case, name):
    """Columns of wall.csv, a row a window."""
    return np.atleast_1d(np.genfromtxt(folder(case, name) / "wall.csv", delimiter=",", names=True))


def log(case, name):
    return (folder(case, name) / "log.wallMaster").read_text().strip()


def broke_off(case, name):
    return "error" in log(case, name)


def same_bytes(case, one, other):
    return (folder(case, one) / "wall.csv").read_bytes() == (folder(case, other) / "wall.csv").read_bytes()


def apart(case, one, other, end=math.inf):
    """Largest distance between two walls at times both have [m]."""
    a, b = wall(case, one), wall(case, other)
    nearest = np.abs(a["time"][:, None] - b["time"][None, :]).argmin(axis=1)
    both = (np.abs(a["time"] - b["time"][nearest]) < 1e-9) & (a["time"] < end + 1e-9)
    return float(np.abs(a["x"] - b["x"][nearest])[both].max())


def errors(case, scheme, end=EARLY):
    """Against implicit coupling with windows of one step [m], for the other windows."""
    return np.array([apart(case, f"window-{scheme}-{w}", f"window-implicit-{WINDOWS[0]}", end) for w in WINDOWS[1:]])


def order(case, scheme):
    fit = slice(FIT.start - 1, FIT.stop - 1)
    return float(np.polyfit(np.log(WINDOWS[1:][fit]), np.log(errors(case, scheme)[fit]), 1)[0])


def mean_slip(rows):
    """Work the wall got and did not take from the soil, of all that went through [J/m]."""
    return abs(rows["soilWork"][-1] + rows["wallWork"][-1]) / abs(rows["wallWork"][-1])


def agreement(case, numbers):
    for scheme in SCHEMES:
        for link in LINKS[1:3]:
            numbers.add(f"{link} beside inProcess, {scheme}: bytes that differ", 0 if same_bytes(case, f"{link}-{scheme}", f"inProcess-{scheme}")
                        else 1, "", "0", "the same operations", 0, 0, "d")
        if folder(case, f"precice-{scheme}").is_dir():
            exact = scheme == "explicit"
            numbers.add(f"preCICE beside inProcess, {scheme}: largest difference of x", apart(case, f"precice-{scheme}", f"inProcess-{scheme}"),
                        "m", "0", "the same operations" if exact else "force converged to 1e-6", 0, 0 if exact else 1e-6, ".0e")


def balances(case, numbers):
    rows = {scheme: wall(case, f"inProcess-{scheme}") for scheme in SCHEMES}
    for scheme, most in zip(SCHEMES, (1e-12, 0.05)):
        impulse = abs(rows[scheme]["soilImpulse"][-1] - rows[scheme]["wallImpulse"][-1]) / rows[scheme]["soilImpulse"][-1]
        numbers.add(f"impulse lost between soil and wall, {scheme}", impulse, "", "0" if most < 1e-3 else "F dt", "", 0, most, ".1e")
    for scheme, most in zip(SCHEMES, (1e-7, 0.1)):
        numbers.add(f"work lost between soil and wall, {scheme}", mean_slip(rows[scheme]), "", "0" if most < 1e-3 else "first order", "", 0,
                    most, ".1e")
    last = rows["implicit"][-1]
    numbers.add("books of the wall: energies - work, of the work",
                abs(last["kineticEnergy"] + last["springEnergy"] + last["heat"] - last["wallWork"]) / last["wallWork"], "", "0",
                "tolerance of CVODE", 0, 1e-8, ".0e")
    budget = report.series(folder(case, "inProcess-implicit"), "energyBudget")
    numbers.add("books of the soil: residual, of the work of gravity", abs(budget["residual"]).max() / budget["gravityWork"].max(), "",
                "round-off", "", 0, 1e-9, ".0e")
    numbers.add("motionWork of the soil's budget + work on the wall, of that work",
                abs(budget["motionWork"][-1] + last["wallWork"]) / last["wallWork"], "", "0", "", 0, 1e-7, ".0e")


def measure(case):
    numbers = report.Numbers()
    rows = wall(case, "inProcess-implicit")
    numbers.add("the wall goes back by at most", rows["x"].max(), "m", "", "", 0.1, 0.2, ".4f")
    numbers.add("largest force over the thrust at rest", rows["force"].max() / REST, "", "below 1", f"K0 = nu/(1 - nu): {REST / 1e3:.0f} kN/m", 0.4, 1,
                ".2f")
    agreement(case, numbers)
    for scheme, least, most in (("implicit", 1.6, 2.4), ("explicit", 0.85, 1.35)):
        numbers.add(f"order in the window, {scheme}", order(case, scheme), "", "2" if scheme == "implicit" else "1",
                    f"x until {EARLY} s, windows of {1e3 * WINDOWS[FIT][0]:g} to {1e3 * WINDOWS[FIT][-1]:g} ms", least, most, ".2f")
    numbers.add("error of windows of 8 ms, implicit", 1e3 * errors(case, "implicit")[3], "mm", form=".3f")
    numbers.add("error of windows of 8 ms, explicit", 1e3 * errors(case, "explicit")[3], "mm", form=".3f")
    balances(case, numbers)
    for mass in MASSES:
        implicit, explicit = f"mass-implicit-{mass}", f"mass-explicit-{mass}"
        numbers.add(f"wall of {mass} kg/m, iterations a window, implicit", wall(case, implicit)["iterations"].mean(), "", "", "", 1, 10, ".1f")
        if broke_off(case, explicit):
            numbers.add(f"wall of {mass} kg/m, explicit: breaks off at", wall(case, explicit)["time"][-1], "s", form=".2f")
        else:
            numbers.add(f"wall of {mass} kg/m, explicit beside implicit", apart(case, explicit, implicit), "m", form=".4f")
    numbers.add("heaviest wall that breaks off explicitly", max((m for m in MASSES if broke_off(case, f"mass-explicit-{m}")), default=0), "kg/m",
                f"below {WINDOW * IMPEDANCE / 2:.0f}", "window rho c H/2", 75, WINDOW * IMPEDANCE / 2, "d")
    return numbers


def draw_soil(case):
    plt = report.plotter()
    figure, panels = plt.subplots(1, 3, figsize=(10, 3.3), layout="constrained")
    run = folder(case, "inProcess-implicit")
    rows = wall(case, "inProcess-implicit")
    for axes, time in zip(panels, (0, 0.5, 1)):
        s = report.state(run, time)
        domains = report.paint(axes, s, report.shear_strain(s), (0, 1), "magma_r")
        x = 4.1 + float(np.interp(s.time, rows["time"], rows["x"])) if s.time else 4.1
        axes.fill([x, x + 1, x + 1, x], [0.2, 0.2, 8.2, 8.2], color="0.6")
        axes.axhline(0, color="black", linewidth=1.2)
        report.frame(axes, (-3, 6), (-0.4, 8.6), f"{s.time:g} s: wall at {1e3 * (x - 4.1):.0f} mm")
    report.bar(figure, domains, panels, "shear strain [-]")
    report.save(figure, case / "soil.png", 120)


def draw_motion(axes, below, case):
    for scheme, colour in zip(SCHEMES, ("tab:blue", "tab:red")):
        rows = wall(case, f"inProcess-{scheme}")
        axes.plot(rows["time"], 1e3 * rows["x"], color=colour, label=f"{scheme}, 10 ms")
        below.plot(rows["time"], rows["force"] / 1e3, color=colour, linewidth=0.9)
    finest = wall(case, f"window-implicit-{WINDOWS[0]}")
    axes.plot(finest["time"], 1e3 * finest["x"], "k--", linewidth=0.8, label="window of one step")
    axes.set(ylabel="x of the wall [mm]", title=f"wall of {MASS / 1e3:g} t/m on 500 kN/m per m")
    axes.legend()
    below.axhline(REST / 1e3, color="0.5", linestyle=":", linewidth=0.8)
    below.text(0.99, REST / 1e3 - 14, "thrust at rest", ha="right", color="0.4", fontsize=7)
    below.set(xlabel="time [s]", ylabel="force of the soil [kN/m]")


def draw_orders(axes, case):
    for scheme, colour, slope in zip(SCHEMES, ("tab:blue", "tab:red"), (2, 1)):
        e = errors(case, scheme)
        axes.loglog(1e3 * np.array(WINDOWS[1:]), 1e3 * e, "o-", color=colour, label=f"{scheme}: order {order(case, scheme):.2f}")
        guide = np.array(WINDOWS[1:6])
        axes.loglog(1e3 * guide, 1.5e3 * e[0] * (guide / guide[0]) ** slope, "--", color=colour, linewidth=0.6)
    axes.set(xlabel="window [ms]", ylabel=f"error of x until {EARLY} s [mm]", title="convergence with the window (dashed: orders 1, 2)")
    axes.legend()


def draw_light(axes, below, case):
    for scheme, colour in zip(SCHEMES, ("tab:blue", "tab:red")):
        rows = wall(case, f"mass-{scheme}-{LIGHT}")
        axes.plot(rows["time"], 1e3 * rows["x"], color=colour, label=scheme)
        if broke_off(case, f"mass-{scheme}-{LIGHT}"):
            axes.plot(rows["time"][-1], 1e3 * np.clip(rows["x"][-1], -0.05, 0.345), "x", color=colour)
    axes.set(xlabel="time [s]", ylabel="x of the wall [mm]", title=f"light wall, {LIGHT} kg/m, window 10 ms", ylim=(-50, 350))
    axes.legend()
    whole = [m for m in MASSES if not broke_off(case, f"mass-explicit-{m}")]
    gone = [m for m in MASSES if m not in whole]
    below.loglog(whole, [1e3 * apart(case, f"mass-explicit-{m}", f"mass-implicit-{m}") for m in whole], "o-", color="tab:red",
                 label="explicit - implicit")
    below.loglog(gone, [2e3] * len(gone), "x", color="tab:red", label="explicit breaks off")
    below.axvline(WINDOW * IMPEDANCE / 2, color="0.5", linestyle=":", linewidth=0.8)
    below.text(WINDOW * IMPEDANCE / 2 * 0.9, 100, "window rho c H/2", rotation=90, ha="right", va="bottom", color="0.4", fontsize=7)
    below.set(xlabel="mass of the wall [kg/m]", ylabel="largest difference of x [mm]", ylim=(1, 4e3))
    below.legend(loc="lower left")


def draw(case):
    sketch(case)
    draw_soil(case)
    plt = report.plotter()
    figure, panels = plt.subplots(2, 3, figsize=(12, 6), layout="constrained")
    draw_motion(panels[0, 0], panels[1, 0], case)
    draw_orders(panels[0, 1], case)
    draw_balance(panels[1, 1], case)
    draw_light(panels[0, 2], panels[1, 2], case)
    report.save(figure, case / "coupling.png", 120)


def draw_balance(axes, case):
    for scheme, colour in zip(SCHEMES, ("tab:blue", "tab:red")):
        rows = wall(case, f"inProcess-{scheme}")
        scale = abs(rows["wallWork"][-1])
        axes.semilogy(rows["time"], np.abs(rows["soilWork"] + rows["wallWork"]) / scale, color=colour, label=f"work, {scheme}")
        lost = np.abs(rows["soilImpulse"] - rows["wallImpulse"]) / rows["soilImpulse"][-1]
        if lost.max() > 0:
            axes.semilogy(rows["time"], lost, "--", color=colour, label=f"impulse, {scheme}")
    axes.set(xlabel="time [s]", ylabel="of what went through", title="lost between soil and wall (impulse, implicit: nothing)")
    axes.legend()


def sketch(case):
    figure, axes = report.sketch_axes((-1.5, 9), (-0.9, 8.9), 4.6)
    axes.fill([0, WIDTH, WIDTH, 0], [0, 0, HEIGHT, HEIGHT], color="#d9c9a3")
    axes.text(WIDTH / 2, HEIGHT / 2, "soil\nMohr-Coulomb\nE 20 MPa, nu 0.42\nphi 42°, c 1 kPa", ha="center", va="center")
    axes.fill([4.1, 5.1, 5.1, 4.1], [0.2, 0.2, 8.2, 8.2], color="0.7")
    axes.text(4.6, 4.2, "m", ha="center")
    spring = np.linspace(5.1, 7.6, 23)
    axes.plot(spring, 4.2 + np.where(np.arange(23) % 2, 0.25, -0.25) * (np.arange(23) > 3) * (np.arange(23) < 19), "k", linewidth=1)
    axes.text(6.3, 4.7, "k", ha="center")
    report.wall(axes, (7.6, 7.6), (3, 5.4), 0.4)
    report.wall(axes, (-1.5, 8.5), (0, 0), 0.4)
    report.arrow(axes, (4.6, 8.45), (5.8, 8.45), "x", (0.75, 0))
    report.arrow(axes, (0, -0.65), (WIDTH, -0.65), "4 m", (0, -0.15), both=True)
    report.arrow(axes, (-0.5, 0), (-0.5, HEIGHT), "8 m", (-0.5, 0), both=True)
    report.save(figure, case / "sketch.svg")


if __name__ == "__main__":
    report.main(measure, draw)

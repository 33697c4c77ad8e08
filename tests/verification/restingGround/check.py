"""A footing pushed slowly into a large ground at rest, most of which sleeps until the load comes to it.
Measured: the footing's load at the end against that of a run in which everything that moves at all takes part, and the share of
particle steps slept through. The long version: what following in sleep saves of the processor time of a larger, slower push, up to
where the clay yields, and what it costs of the load.
Pass: the load is off by less than 1 % at a tolerance of 1e-5, by less than 0.2 % at 3e-6 and by less than 1.5 % where what sleeps
follows; the energy budget closes; no particle that sleeps rigidly moves. Long: 5 times less processor time, the load within 1 % over
the last two thirds of the path and within 4 % of its end everywhere."""
import re

import numpy as np
from verification import LONG, Number, Verification

case = Verification(__file__, __doc__)
MODULUS = 20e6 * (1 - 0.45) / (1 + 0.45) / (1 - 2 * 0.45)


def loaded(name, tolerance, follow="no", *changes):
    """The run, time, load and the share of steps slept through."""
    run = case.solve(name, ("system/mpmSchemes", "rest", f"{{ tolerance {tolerance}; follow {follow}; }}"), *changes)
    load, budget, last = run.series("footing"), run.series("energyBudget"), run.state()
    steps = last.attributes["step"] * len(last["mass"])
    residual = np.abs(budget["residual"]).max() / np.abs(budget["motionWork"]).max()
    case.check(f"energy residual ({name})", residual, "<=", 1e-9)
    if follow == "no":
        asleep = last["quietLooks"] == 6
        case.check(f"speed of what sleeps ({name})", np.abs(last["velocity"][asleep]).max(initial=0), "==", 0, "m/s")
    return run, load["time"], load["forceY"], float(last.ledger["restingSteps"]) / steps


def compare():
    _, time, force, share = loaded("plain", 1e-300)
    plain = force[time > 3.8].mean()
    rows = [["nothing that moves sleeps", "0", f"{plain / 1e3:.1f}", "-", Number(share, ".2f", 0, 0.02)]]
    for name, tolerance, follow, most in (("loose", 1e-5, "no", 0.01), ("strict", 3e-6, "no", 0.002), ("follow", 1e-5, "yes", 0.015)):
        _, time, force, share = loaded(name, tolerance, follow)
        load = force[time > 3.8].mean()
        error = load / plain - 1
        case.check(f"load over that of the plain run, - 1 ({name})", abs(error), "<=", most)
        case.check(f"share of steps slept through ({name})", share, ">=", 0.1)
        rows.append([f"{tolerance:g}" + (", follows" if follow == "yes" else ""), f"{tolerance * MODULUS:.0f}", f"{load / 1e3:.1f}",
                     Number(100 * error, ".2f", 0, 0.05), Number(share, ".2f", 0, 0.02)])
    case.table("", ["tolerance", "stress that may be out of balance [Pa]", "load [kN/m]", "error [%]", "slept through"], rows)


def processor_seconds(run):
    return float(re.search(r"(?m)^ +processor +([0-9.]+)", run.log).group(1))


def larger(run):
    """80 m x 40 m, 0.3 mm/s, 30 mm."""
    for file, old, new in (("geometry/clay.geo", "width = 40", "width = 80"), ("geometry/clay.geo", "depth = 20", "depth = 40"),
                           ("constant/rigidBodies", "speed 0.003", "speed 0.0003")):
        path = run.folder / file
        path.write_text(path.read_text().replace(old, new))
    run.set("constant/rigidBodies", "points", "((-0.5 40) (2 40) (2 41.2) (-0.5 41.2))")
    run.set("system/gridDict", "max", "(82 42 0)")
    for word, value in (("endTime", 100), ("writeInterval", 100), ("historyInterval", 100)):
        run.set("system/controlDict", word, value)


def save():
    runs = {}
    for name, tolerance, follow in (("plainLong", 1e-300, "no"), ("followLong", TOLERANCE, "yes")):
        run, time, force, share = loaded(name, tolerance, follow, larger)
        work = np.concatenate([[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))])
        ends = np.linspace(0, 99, 34)  # means over 3 s, so that the steps of the load as cells are passed do not count
        runs[name] = processor_seconds(run), np.diff(np.interp(ends, time, work)) / 3, share, run
    (before, plain, _, _), (after, load, share, run) = runs.values()
    told = re.search(r"at most ([0-9.e+-]+) Pa out of balance", run.log)
    case.check("stress out of balance told by the run", float(told.group(1)), "<=", TOLERANCE * MODULUS, "Pa")
    print(f"      slept through {share:.3f}; processor time {before:.1f} s and {after:.1f} s")
    case.check("largest error of the load beyond a third of the path", np.abs(load / plain - 1)[11:].max(), "<=", 0.01)
    case.check("largest error over the load at the end", np.abs(load - plain).max() / plain[-1], "<=", 0.04)
    case.check("times less processor time", before / after, ">=", 5)


TOLERANCE = 3e-5
if LONG:
    save()
else:
    compare()
case.finish()

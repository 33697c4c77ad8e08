"""A footing pushed slowly into a large ground at rest, most of which sleeps until the load comes to it.
Measured: the footing's load at the end against that of a run in which everything that moves at all takes part, and the share of
particle steps slept through.
Pass: the load is off by less than 1 % at a tolerance of 1e-5 and by less than 0.2 % at 3e-6; the energy budget closes; no particle
that sleeps moves. The time this saves is a matter of the ground's size: the table has the shares."""
import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
MODULUS = 20e6 * (1 - 0.45) / (1 + 0.45) / (1 - 2 * 0.45)


def loaded(name, tolerance):
    run = case.solve(name, ("system/mpmSchemes", "rest", f"{{ tolerance {tolerance}; }}"))
    load, budget, last = run.series("footing"), run.series("energyBudget"), run.state()
    steps = last.attributes["step"] * len(last["mass"])
    residual = np.abs(budget["residual"]).max() / np.abs(budget["motionWork"]).max()
    case.check(f"energy residual ({name})", residual, "<=", 1e-9)
    asleep = last["quietLooks"] == 6
    case.check(f"speed of what sleeps ({name})", np.abs(last["velocity"][asleep]).max(initial=0), "==", 0, "m/s")
    return load["forceY"][load["time"] > 3.8].mean(), float(last.ledger["restingSteps"]) / steps


plain, share = loaded("plain", 1e-300)
rows = [["nothing that moves sleeps", "0", f"{plain / 1e3:.1f}", "-", Number(share, ".2f", 0, 0.02)]]
for name, tolerance, most in (("loose", 1e-5, 0.01), ("strict", 3e-6, 0.002)):
    load, share = loaded(name, tolerance)
    error = load / plain - 1
    case.check(f"load over that of the plain run, - 1 ({tolerance:g})", abs(error), "<=", most)
    case.check(f"share of steps slept through ({tolerance:g})", share, ">=", 0.1)
    rows.append([f"{tolerance:g}", f"{tolerance * MODULUS:.0f}", f"{load / 1e3:.1f}", Number(100 * error, ".2f", 0, 0.05),
                 Number(share, ".2f", 0, 0.02)])
case.table("", ["tolerance", "stress that may be out of balance [Pa]", "load [kN/m]", "error [%]", "slept through"], rows)
case.finish()

"""A strip load on undrained clay (friction angle 0).
Hard: the surface of the law has no apex and k - 1 = 0 wherever a formula divides by it; plastic flow keeps the
volume, which fully integrated cells resist (locking): they carry loads the soil cannot.
Pass: the load is raised in steps; the footing of width B stands at 5.0 c (sinks less than 0.1 % of B in the last
0.2 s) and goes on sinking at 5.6 c (more than 0.3 % of B in the last 0.2 s), so that N_c lies in [5.0, 5.6] (exact:
pi + 2); no return to an apex."""
import numpy as np
from hardCase import HardCase, record, schemes

case = HardCase(__file__, __doc__)
c, B = 10e3, 2.0


def settlement(run, time):
    first, state = run.state(0), run.state(time)
    x = first.by_id("position")
    under = (x[:, 0] < B / 2) & (x[:, 1] > x[:, 1].max() - 1e-6)
    return (x - state.by_id("position"))[under, 1].mean()


for shape, update in (("uGIMP", "MUSL"), ("linear", "MUSL"), ("quadraticBSpline", "USL")):
    run = case.seed(shape + update, *schemes(shape, update))
    tag, sunk = f"({run.folder.name})", {}
    for load, until in ((4.6, 0.2), (5.0, 0.4), (5.0, 0.6), (5.6, 0.8), (5.6, 1.0)):
        run.set("constant/boundaryConditions", "value", repr(load * c))
        run.set("system/controlDict", "endTime", repr(until))
        run.utility("mpmSolve")
        if run.exit != 0:
            print(run.log)
        case.check(f"exit code up to {until:g} s {tag}", run.exit, "==", 0)
        sunk[load] = settlement(run, -1) - settlement(run, -2)
    case.common(run)
    case.check(f"sinking at 5.0 c over B {tag}", sunk[5.0] / B, "<=", 0.001)
    case.check(f"sinking at 5.6 c over B {tag}", sunk[5.6] / B, ">=", 0.003)
    record(case, f"settlement over B at 1 s {tag}", settlement(run, -1) / B)
    case.check(f"apex returns {tag}", run.series()["apexReturns"][-1], "==", 0)
case.finish()

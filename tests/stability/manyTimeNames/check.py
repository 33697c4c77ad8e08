"""A hundred and twenty states with folder names of one digit (--long: three thousand).
Hard: timePrecision says fewer digits than the times need; a name used twice would overwrite a state.
Pass: as many folders as states, in order, every name within a thousandth of the interval; the run goes on from the true last one."""
import numpy as np
from hardCase import LONG, HardCase

case = HardCase(__file__, __doc__)
count = 3000 if LONG else 120
run = case.solve("many", ("system/controlDict", "endTime", f"{count * 1e-4:g}"))
case.common(run)
names = run.times()
case.check("folders", len(names), "==", count + 1)
times = np.array([run.state(name).time for name in names])
case.check("times out of order", int((np.diff(times) <= 0).sum()), "==", 0)
steps = np.array([int(run.state(name).attributes["step"]) for name in names[:: count // 20]])
case.check("steps that are not where their name says", int((steps != np.arange(0, count + 1, count // 20)).sum()), "==", 0)
case.check("largest |name - time| over the interval", np.abs(np.array([float(n) for n in names]) - times).max() / 1e-4, "<=", 1e-3)
run.set("system/controlDict", "endTime", f"{count * 1e-4 + 2e-4:g}")
run.utility("mpmSolve")
case.check("exit code of going on", run.exit, "==", 0)
case.check("folders after two more steps", len(run.times()), "==", count + 3)
case.check("steps of the last state", int(run.state().attributes["step"]), "==", count + 2)
case.finish()

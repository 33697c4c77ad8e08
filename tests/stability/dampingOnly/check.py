"""No gravity, viscous damping alone.
Hard: damping must neither wake what rests nor strain what moves, and its decay must not depend on the time step.
Pass: what rests stays bitwise; momentum and each velocity decay as exp(-t/tau) to round-off; no stress; energy lost is the damping's."""
import math

import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
tau, v0 = 0.2, np.array([1.5, 0.5])
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    for dt in ("1e-3", "2e-3") if shape == "uGIMP" else ("1e-3",):
        run = case.solve(f"{shape}-{dt}", ("system/mpmSchemes", "shape", shape), ("system/controlDict", "deltaT", dt))
        case.common(run)
        first, last = run.state(0), run.state()
        rests = first.by_id("material") == list(first.attributes["materials"]).index(b"resting")
        tag = f" ({run.folder.name})"
        changed = sum(int((first.by_id(n)[rests] != last.by_id(n)[rests]).sum())
                      for n in ("position", "velocity", "stress", "deformationGradient"))
        case.check("numbers at rest that changed" + tag, changed, "==", 0)
        worst = 0
        for name in run.times():
            state = run.state(name)
            left = v0 * math.exp(-state.time / tau)
            worst = max(worst, np.abs(state.by_id("velocity")[~rests] / left - 1).max())
        case.check("largest |v/(v_0 exp(-t/tau)) - 1|" + tag, worst, "<=", 1e-11)
        case.check("stress over E" + tag, np.abs(last["stress"]).max() / 20e6, "<=", 1e-12)
        history, budget = run.series(), run.series("energyBudget")
        momentum = history["momentumX"] / history["momentumX"][0] / np.exp(-history["time"] / tau) - 1
        case.check("largest |p/(p_0 exp(-t/tau)) - 1|" + tag, np.abs(momentum).max(), "<=", 1e-12)
        lost = budget["dampingDissipation"] + budget["kineticChange"]
        case.check("energy lost beside damping" + tag, np.abs(lost).max() / history["kineticEnergy"][0], "<=", 1e-12)
case.finish()

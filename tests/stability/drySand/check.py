"""A column of dry sand (cohesion 0) collapses on a rough base.
Hard: at the free surface stress is zero, the apex of the yield surface; grains there hardly have neighbours, light
nodes take large accelerations, and particles shoot out of the heap. Loosened sand is lighter: elastic waves in it are
faster.
Pass: a particle without pressure has stress zero in every bit, no principal stress is tensile beyond round-off, and
at no stored time is a particle faster than a free fall from the top, sqrt(2 g H)."""
import numpy as np
from hardCase import HardCase, pressure, schemes

case = HardCase(__file__, __doc__)
g, height = 9.81, 2
for shape, update, adjust in (("uGIMP", "MUSL", "no"), ("cpGIMP", "MUSL", "no"), ("quadraticBSpline", "USL", "yes"),
                              ("linear", "MUSL", "yes"), ("uGIMP", "USF", "yes")):
    run = case.solve(shape + update, *schemes(shape, update),
                     ("system/controlDict", "adjustTimeStep", adjust))
    tag = f"({run.folder.name})"
    case.common(run)
    apex, not_zero, tension, fastest = 0, 0, 0, 0
    for name in run.times()[1:]:
        state = run.state(name)
        stress, p = state["stress"], pressure(state["stress"])
        free = p <= 0
        apex += int(free.sum())
        not_zero += np.count_nonzero(stress[free])
        radius = np.hypot(0.5 * (stress[:, 0] - stress[:, 1]), stress[:, 3])
        largest = np.maximum(0.5 * (stress[:, 0] + stress[:, 1]) + radius, stress[:, 2])
        tension = max(tension, (largest / (np.abs(stress).max(axis=1) + 1e-300)).max())
        fastest = max(fastest, np.linalg.norm(state["velocity"], axis=1).max())
    case.check(f"particles without pressure, over all times {tag}", apex, ">", 0)
    case.check(f"stress components of theirs that are not zero {tag}", not_zero, "==", 0)
    case.check(f"tension over the largest stress component {tag}", tension, "<=", 1e-9)
    case.check(f"largest speed over sqrt(2 g H) {tag}", fastest / np.sqrt(2 * g * height), "<=", 1)
case.finish()

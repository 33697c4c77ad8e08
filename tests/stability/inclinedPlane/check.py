"""A block and a disc on an inclined plane, without friction, with some, and with a coefficient of a million.
Hard: friction is decided anew at every node and step; a coefficient of a million must hold without pushing back, and none must leave no trace.
Pass: block and disc slip, stick or roll as the closed forms say, within 2 % of the path; without friction the acceleration is exact; sticking sand does not slip by 1e-12 m; friction never does work on the body, in any step."""
import math

import numpy as np
from hardCase import HardCase

# angle [deg], mu, g [m/s^2], block's acceleration, disc's acceleration [m/s^2]. Block: 0 if tan(angle) <= mu, else
# g (sin - mu cos). Disc: rolls with (2/3) g sin if tan(angle) <= 3 mu, else slips as the block does.
TABLE = ((20, 0, 9.8, 3.351797, 3.351797), (30, 0.2, 9.8, 3.202590, 3.266667), (60, 0.3, 10, 7.160254, 7.160254),
         (20, 1.0, 9.8, 0, 2.234531), (30, 1e6, 9.8, 0, 3.266667))
RADIUS = 0.5


def scene(case, body, angle, mu, g, *changes):
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    run = case.seed(f"{body}-{angle}-{mu:g}{'-linear' if changes else ''}", ("constant/boundaryConditions", "mu", mu),
                    ("constant/g", "value", f"({g * sine!r} {-g * cosine!r} 0)"),
                    ("system/seedParticlesDict", "geometry", f'"geometry/{body}.geo"'), *changes)
    return run, 2000 * g * cosine


def motion(state):
    """Centre of mass, its velocity, angular velocity about it."""
    m, x, v = state["mass"][:, None], state["position"], state["velocity"]
    centre, mean = (m * x).sum(axis=0) / m.sum(), (m * v).sum(axis=0) / m.sum()
    r, w = x - centre, v - mean
    return centre, mean, (m[:, 0] * (r[:, 0] * w[:, 1] - r[:, 1] * w[:, 0])).sum() / (m[:, 0] * (r * r).sum(axis=1)).sum()


def common(run, mu):
    case.common(run)
    history = run.series()
    work = history["frictionDissipation"]
    case.check(f"least friction work of a step over the largest of all ({run.folder.name})",
               np.diff(work).min() / max(work.max(), np.abs(history["gravityWork"]).max()), ">=", 0)
    if mu == 0:
        case.check(f"friction work without friction ({run.folder.name})", np.abs(work).max(), "==", 0)
    first, last = run.state(0), run.state()
    return motion(first), motion(last), last.time


case = HardCase(__file__, __doc__)
for angle, mu, g, block, disc in TABLE:
    free = 0.5 * g * math.sin(math.radians(angle)) * 0.25

    run, weight = scene(case, "block", angle, mu, g)
    run.edit(lambda p: p["stress"].__setitem__((slice(None), 1), -weight * (0.5 - p["position"][:, 1])))
    case.require(run.utility("mpmSolve"))
    (x0, _, _), (x1, v1, _), t = common(run, mu)
    case.check(f"error of the block's path over that without friction ({angle} deg, mu {mu:g})",
               abs(x1[0] - x0[0] - 0.5 * block * t * t) / free, "<=", 0.02)

    run, _ = scene(case, "disc", angle, mu, g)
    case.require(run.utility("mpmSolve"))
    (x0, _, _), (x1, v1, spin), t = common(run, mu)
    case.check(f"error of the disc's path ({angle} deg, mu {mu:g})",
               abs(x1[0] - x0[0] - 0.5 * disc * t * t) / (0.5 * disc * t * t), "<=", 0.02)
    rolls = math.tan(math.radians(angle)) <= 3 * mu
    expected = 2 * g * math.sin(math.radians(angle)) / (3 * RADIUS) if rolls else 2 * mu * g * math.cos(math.radians(angle)) / RADIUS
    case.check(f"error of the disc's spin over that of rolling ({angle} deg, mu {mu:g})",
               abs(-spin - expected * t) / (2 * g * math.sin(math.radians(angle)) / (3 * RADIUS) * t), "<=", 0.02)
    if mu == 0:
        for body in ("block", "disc"):
            state = case.folder / f"{body}-{angle}-0"
        case.check("error of the disc's velocity without friction", abs(v1[0] / (disc * t) - 1), "<=", 1e-6)

# What sticks: the lowest particles are put a trillionth of a metre above the plane, where hats give them the plane's own motion.
run, _ = scene(case, "block", 30, 1e6, 9.8, ("system/mpmSchemes", "shape", "linear"))
lowest = run.state(0).by_id("position")[:, 1] < 0.06
run.edit(lambda p: p["position"].__setitem__((p["position"][:, 1] < 0.06, 1), 2.0**-40))
case.require(run.utility("mpmSolve"))
common(run, 1e6)
start = run.state(0).by_id("position")
slip = max(np.abs(run.state(time).by_id("position")[lowest, 0] - start[lowest, 0]).max() for time in run.times())
case.check("slip of the particles on the plane with mu 1e6", slip, "<=", 1e-12, "m")
case.finish()

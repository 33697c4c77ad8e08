"""A block and a disc on an inclined plane: without friction, with some, and with a coefficient of a million.
Hard: friction is decided anew at every node and step; a coefficient of a million must hold without pushing back, none must leave no trace.
Pass: without friction velocities are exact to 1e-6; paths are those of the closed forms to 2 % of the free path for the block and 5 % for the disc, 16 cells across (contact is felt a fraction of a cell before, so the disc's centre lies higher, which the closed form is given); what sticks slips by less than 1e-12 m; the work of friction is never negative."""
import math

import numpy as np
from hardCase import HardCase

# Angle [deg], mu, g [m/s^2] and the block's acceleration: 0 if tan(angle) <= mu, else g (sin - mu cos); rows of the usual
# table (arithmetic), and a coefficient of a million.
TABLE = ((20, 0, 9.8, 3.351797), (30, 0.2, 9.8, 3.202590), (60, 0.3, 10, 7.160254), (20, 1.0, 9.8, 0), (20, 1e6, 9.8, 0))
RADIUS, BLOCK_HEIGHT, H = 0.5, 0.5, 0.0625


def scene(case, variant, body, angle, mu, g, *changes):
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    return case.seed(variant, ("constant/boundaryConditions", "mu", mu),
                     ("constant/g", "value", f"({g * sine!r} {-g * cosine!r} 0)"),
                     ("system/seedParticlesDict", "geometry", f'"geometry/{body}.geo"'), *changes)


def rest_on_plane(angle, g):
    """The vertical stress of a wide block at rest (nu = 0: no other)."""
    weight = 2000 * g * math.cos(math.radians(angle))
    return lambda p: p["stress"].__setitem__((slice(None), 1), -weight * (BLOCK_HEIGHT - p["position"][:, 1]))


def centre(state, field="position"):
    return (state["mass"][:, None] * state[field]).sum(axis=0) / state["mass"].sum()


def turned(first, last):
    """Angle by which a body has turned, clockwise, as best fit."""
    r0, r1 = first.by_id("position") - centre(first), last.by_id("position") - centre(last)
    return -math.atan2((r0[:, 0] * r1[:, 1] - r0[:, 1] * r1[:, 0]).sum(), (r0 * r1).sum())


def finish(case, run, mu):
    case.require(run.utility("mpmSolve"))
    case.common(run)
    history = run.series()
    tag = f" ({run.folder.name})"
    scale = 0.5 * run.state(0)["mass"].sum() * (9.8 * 0.5 * 0.5) ** 2  # energy of a slide without friction
    case.check("least work of friction over the energy of a free slide" + tag, history["frictionDissipation"].min() / scale, ">=", -1e-12)
    if mu == 0:
        case.check("friction without friction" + tag, np.abs(history["frictionDissipation"]).max(), "==", 0)
    return run.state(0), [run.state(time) for time in run.times()[1:]]


def block(case, angle, mu, g, acceleration):
    run = scene(case, f"block-{angle}-{mu:g}", "block", angle, mu, g).edit(rest_on_plane(angle, g))
    first, states = finish(case, run, mu)
    last, free = states[-1], 0.5 * g * math.sin(math.radians(angle)) * states[-1].time**2
    case.check(f"error of the block's path over the free path ({angle} deg, mu {mu:g})",
               abs(centre(last)[0] - centre(first)[0] - 0.5 * acceleration * last.time**2) / free, "<=", 0.02)


def disc(case, angle, mu, g):
    first, states = finish(case, scene(case, f"disc-{angle}-{mu:g}", "disc", angle, mu, g), mu)
    last, sine, cosine = states[-1], math.sin(math.radians(angle)), math.cos(math.radians(angle))
    lever, t = np.mean([centre(s)[1] for s in states]), states[-1].time
    rolls = math.tan(math.radians(angle)) <= mu * (1 + 2 * lever**2 / RADIUS**2)
    acceleration = g * sine / (1 + RADIUS**2 / (2 * lever**2)) if rolls else g * (sine - mu * cosine)
    spin = acceleration / lever if rolls else 2 * mu * g * cosine * lever / RADIUS**2
    tag = f" ({angle} deg, mu {mu:g}: {'rolls' if rolls else 'slips'})"
    case.check("height of the disc's centre over its radius, in cells" + tag, abs((lever - RADIUS) / H - 0.65), "<=", 0.35)
    case.check("error of the disc's path over the free path" + tag,
               abs(centre(last)[0] - centre(first)[0] - 0.5 * acceleration * t * t) / (0.5 * g * sine * t * t), "<=", 0.05)
    case.check("error of the angle the disc turns over that of rolling" + tag,
               abs(turned(first, last) - 0.5 * spin * t * t) / (g * sine * t * t / (3 * RADIUS)), "<=", 0.1)
    print("      turned", turned(first, last), "closed form", 0.5 * spin * t * t, "path", centre(last)[0] - centre(first)[0], 0.5 * acceleration * t * t)
    if mu == 0:
        case.check("error of the velocity without friction" + tag, abs(centre(last, "velocity")[0] / (acceleration * t) - 1), "<=", 1e-6)


def sticking(case):
    """The lowest particles are put a trillionth of a metre above the plane, where hats give them the plane's own motion."""
    low = 0.5 * H
    run = scene(case, "sticking", "block", 10, 1e6, 9.8, ("system/mpmSchemes", "shape", "linear")).edit(rest_on_plane(10, 9.8))
    lowest = run.state(0).by_id("position")[:, 1] < low
    run.edit(lambda p: p["position"].__setitem__((p["position"][:, 1] < low, 1), 2.0**-40))
    first, states = finish(case, run, 1e6)
    slip = max(np.abs(s.by_id("position") - first.by_id("position"))[lowest, 0].max() for s in states)
    case.check("slip of particles on the plane with mu 1e6", slip, "<=", 1e-12, "m")
    case.check("particles on the plane", lowest.sum(), ">", 50)


case = HardCase(__file__, __doc__)
for angle, mu, g, acceleration in TABLE:
    block(case, angle, mu, g, acceleration)
    disc(case, angle, mu, g)
sticking(case)
case.finish()

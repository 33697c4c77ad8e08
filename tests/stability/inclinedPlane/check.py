"""A block and a disc on an inclined plane: without friction, with some, and with a coefficient of a million.
Hard: friction is decided anew at every node and step; a coefficient of a million must hold without pushing back,
none must leave no trace.
Pass: without friction velocities are exact to 1e-6; the block's path is that of the closed form to 2 % of the free
path; the disc, 16 cells across, slips as the closed form says to 2 %, and rolls as it says with a radius known to a
cell and a resistance whose lever is below 3/4 of a cell and shrinks with it (the grid feels contact up to a cell
ahead); what sticks slips by less than 1e-12 m; the work of friction is never negative."""
import math

import numpy as np
from hardCase import HardCase

# Angle [deg], mu, g [m/s^2]. The block moves with 0 if tan(angle) <= mu, else g (sin - mu cos); a disc rolls with
# (2/3) g sin if tan(angle) <= 3 mu, else it slips as the block does and turns with 2 mu g cos/R.
BLOCK = ((20, 0, 9.8), (30, 0.2, 9.8), (60, 0.3, 10), (20, 1.0, 9.8), (20, 1e6, 9.8))
DISC = ((20, 0, 9.8), (45, 0.3, 9.8), (60, 0.3, 10), (30, 0.6, 9.8), (45, 1.0, 9.8), (30, 1e6, 9.8))
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
    case.nothing_gained(run)
    history = run.series()
    tag = f" ({run.folder.name})"
    scale = 0.5 * run.state(0)["mass"].sum() * (9.8 * 0.5 * 0.5) ** 2  # energy of a slide without friction
    case.check("least work of friction over the energy of a free slide" + tag,
               history["frictionDissipation"].min() / scale, ">=", -1e-12)
    if mu == 0:
        case.check("friction without friction" + tag, np.abs(history["frictionDissipation"]).max(), "==", 0)
    return run.state(0), [run.state(time) for time in run.times()[1:]]


def block(case, angle, mu, g):
    run = scene(case, f"block-{angle}-{mu:g}", "block", angle, mu, g).edit(rest_on_plane(angle, g))
    first, states = finish(case, run, mu)
    last, sine, cosine = states[-1], math.sin(math.radians(angle)), math.cos(math.radians(angle))
    acceleration = 0 if sine <= mu * cosine else g * (sine - mu * cosine)
    path, half = centre(last)[0] - centre(first)[0], 0.5 * last.time**2
    case.check(f"error of the block's path over the free path ({angle} deg, mu {mu:g})",
               abs(path - acceleration * half) / (g * sine * half), "<=", 0.02)


def disc(case, angle, mu, g, variant="", *changes):
    """Returns the lever e of the resistance to rolling [m]: how far ahead of the centre the plane must press to explain
    the motion. m a = m g sin - F, I alpha = F y - N e, with N = m g cos, I = m R^2/2, y the height of the centre, and
    alpha = a/y where it rolls, F = mu N where it slips."""
    run = scene(case, f"disc-{angle}-{mu:g}{variant}", "disc", angle, mu, g, *changes)
    first, states = finish(case, run, mu)
    last, sine, cosine = states[-1], math.sin(math.radians(angle)), math.cos(math.radians(angle))
    height, t = np.mean([centre(s)[1] for s in states]), states[-1].time
    inertia = 0.5 * RADIUS**2
    rolls = math.tan(math.radians(angle)) <= 3 * mu
    path, turn = centre(last)[0] - centre(first)[0], turned(first, last)
    tag = f" ({angle} deg, mu {mu:g}: {'rolls' if rolls else 'slips'}{variant.replace('-', ', ')})"
    if mu == 0:
        case.check("error of the velocity without friction" + tag,
                   abs(centre(last, "velocity")[0] / (g * sine * t) - 1), "<=", 1e-6)
        case.check("angle turned without friction" + tag, abs(turn), "<=", 1e-3)
    if not rolls:
        case.check("error of the slipping disc's path" + tag,
                   abs(path / (0.5 * g * (sine - mu * cosine) * t * t) - 1), "<=", 0.02)
        return height * mu - inertia * 2 * turn / (g * cosine * t * t)
    case.check("radius the disc rolls on less its centre's height, in cells" + tag, abs(path / turn - height) / H, "<=", 1)
    acceleration = 2 * path / (t * t)
    case.check("path of the rolling disc over that of the closed form" + tag,
               acceleration * (1 + inertia / height**2) / (g * sine), "<=", 1.01)
    return height * (sine - acceleration / g * (1 + inertia / height**2)) / cosine


def sticking(case):
    """The lowest particles are put a trillionth of a metre off the plane: hats give them the plane's own motion."""
    low = 0.5 * H
    run = scene(case, "sticking", "block", 10, 1e6, 9.8, ("system/mpmSchemes", "shape", "linear")).edit(rest_on_plane(10, 9.8))
    lowest = run.state(0).by_id("position")[:, 1] < low
    run.edit(lambda p: p["position"].__setitem__((p["position"][:, 1] < low, 1), 2.0**-40))
    first, states = finish(case, run, 1e6)
    slip = max(np.abs(s.by_id("position") - first.by_id("position"))[lowest, 0].max() for s in states)
    case.check("slip of particles on the plane with mu 1e6", slip, "<=", 1e-12, "m")
    case.check("particles on the plane", lowest.sum(), ">", 50)


case = HardCase(__file__, __doc__)
sticking(case)
for angle, mu, g in BLOCK:
    block(case, angle, mu, g)
levers = {}
for angle, mu, g in DISC:
    levers[angle, mu] = disc(case, angle, mu, g)
    case.check(f"lever of the resistance to rolling over a cell ({angle} deg, mu {mu:g})",
               abs(levers[angle, mu]) / H, "<=", 0.75)
fine = disc(case, 30, 1e6, 9.8, "-fine", ("system/gridDict", "cellSize", H / 2),
            ("geometry/disc.geo", "gap", f"= {0.65 * H / 2}"), ("system/controlDict", "deltaT", 2.5e-4))
case.check("lever of the resistance with cells half as wide over that before", fine / levers[30, 1e6], "<=", 0.7)
case.finish()

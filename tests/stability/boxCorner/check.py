"""A column of sand that collapses between two walls and fills the corners of a box.
Hard: two walls act on the node in the corner at once, each with friction; the pile is symmetric, and neither walls
nor sums may prefer a side.
Pass: sand that lies exactly on a wall never moves along its normal into it, no particle is ever outside, and the
pile stays its own mirror image to 1e-12 (walls of finite extent, and with them a re-entrant step, do not exist)."""
import numpy as np
from hardCase import HardCase

HALF = 1.0  # the box is x in [-1, 1], y >= 0


NEAR = 2.0**-40  # [m], a trillionth


def onto_the_walls(p):
    """Moves the outermost particles of a filled box to a trillionth of a metre off its walls: with hats they follow the
    wall's own nodes."""
    x = p["position"]
    x[:, 0] = np.where(np.abs(x[:, 0]) > HALF - 0.06, np.copysign(HALF - NEAR, x[:, 0]), x[:, 0])
    x[:, 1] = np.where(x[:, 1] < 0.06, NEAR, x[:, 1])


def outside(states):
    """Deepest place beyond a wall."""
    return max(max(np.abs(s["position"][:, 0]).max() - HALF, -s["position"][:, 1].min()) for s in states)


def asymmetry(state, first):
    """Difference of the left half from the mirror image of the right one, by places at the start."""
    start = first.by_id("position")
    right = np.lexsort((start[:, 0].round(9), start[:, 1].round(9)))
    left = np.lexsort((-start[:, 0].round(9), start[:, 1].round(9)))
    mirror = np.array([-1.0, 1.0])
    return {name: np.abs(state.by_id(name)[right] - state.by_id(name)[left] * mirror).max()
            / np.abs(state[name]).max() for name in ("position", "velocity")}


case = HardCase(__file__, __doc__)
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    run = case.solve(f"pile-{shape}", ("system/mpmSchemes", "shape", shape))
    case.common(run)
    case.nothing_gained(run)
    states = [run.state(time) for time in run.times()]
    reach = max(np.abs(s["position"][:, 0]).max() for s in states)
    case.check(f"the sand reaches the walls: nearest ({shape})", HALF - reach, "<", 0.125, "m")
    case.check(f"deepest place beyond a wall ({shape})", outside(states), "<=", 0, "m")
    for name, value in asymmetry(states[-1], states[0]).items():
        case.check(f"difference of {name} from the mirror image ({shape})", value, "<=", 1e-12)
    case.check(f"momentum to the side over m sqrt(2 g H) ({shape})",
               np.abs(run.series()["momentumX"]).max() / (states[0]["mass"].sum() * np.sqrt(2 * 8 * 2)), "<=", 1e-12)

geometry = "geometry/pile.geo"
for name, kind in (("holds", "roller"), ("pushes", "friction")):
    run = case.copy(f"filled-{name}", ("system/mpmSchemes", "shape", "linear"), (geometry, "width", "= 2"))
    if kind == "roller":
        walls = run.folder / "constant/boundaryConditions"
        walls.write_text(walls.read_text().replace("friction", "roller").replace("    mu              0.5;\n", ""))
    run.utility("seedParticles").edit(onto_the_walls).utility("mpmSolve")
    case.require(run)
    case.common(run)
    case.nothing_gained(run)
    first, states = run.state(0), [run.state(time) for time in run.times()]
    start = first.by_id("position")
    at_side, at_base = np.abs(start[:, 0]) == HALF - NEAR, start[:, 1] == NEAR
    case.check(f"particles on walls (filled, {name})", (at_side | at_base).sum(), ">", 40)
    places = [s.by_id("position") for s in states]
    into = max(max((np.abs(x[at_side, 0]) - HALF).max(), -x[at_base, 1].min()) for x in places)
    case.check(f"displacement into a wall of sand that lies on it (filled, {name})", into, "<=", 0, "m")
    if kind == "roller":
        away = max(max((HALF - np.abs(x[at_side, 0])).max(), x[at_base, 1].max()) for x in places)
        case.check(f"displacement off the wall that holds it (filled, {name})", away, "<=", 1e-11, "m")
case.finish()

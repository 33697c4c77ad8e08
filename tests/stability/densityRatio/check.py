"""Two blocks that meet, one 10,000 times as dense as the other, through the common velocity field of the grid.
Hard: where both share a node the light one has next to no say in its velocity; forces that are small for one are
huge for the other.
Pass: the momentum of both together is kept to round-off, the common energy budget holds, and neither block's face is
ever more than half a cell inside the other's."""
from hardCase import HardCase

H = 0.25
HITS = {"heavyHitsLight": ("(1 0 0)", "(0 0 0)"), "lightHitsHeavy": ("(0 0 0)", "(-1 0 0)")}


def faces(state):
    """Right face of the heavy block, left face of the light one: outermost centres and half the deformed edges."""
    reach = 0.5 * state["length0"][:, 0] * state["deformationGradient"][:, 0, 0]
    x, material = state["position"][:, 0], state["material"]
    return (x + reach)[material == 0].max(), (x - reach)[material == 1].min()


def velocity(state, material):
    here = state["material"] == material
    return (state["mass"] * state["velocity"][:, 0])[here].sum() / state["mass"][here].sum()


case = HardCase(__file__, __doc__)
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    for name, (heavy, light) in HITS.items():
        run = case.copy(f"{name}-{shape}", ("system/mpmSchemes", "shape", shape))
        text = run.folder / "constant/materialProperties"
        text.write_text(text.read_text().replace("HEAVY", heavy).replace("LIGHT", light))
        case.require(run.utility("seedParticles").utility("mpmSolve"))
        case.common(run)
        case.nothing_gained(run)
        states = [run.state(time) for time in run.times()]
        depth = [heavy_face - light_face for heavy_face, light_face in map(faces, states)]
        case.check(f"contact was made: gap closed ({run.folder.name})", -max(depth), "<", 2 * H, "m")
        case.check(f"penetration over h ({run.folder.name})", max(depth) / H, "<=", 0.5)
        gained = abs(velocity(states[-1], 1) - velocity(states[0], 1))
        case.check(f"the light block was hit: its change of velocity ({run.folder.name})", gained, ">", 0.5, "m/s")
        case.check(f"the same over what an elastic hit can give ({run.folder.name})", gained / 2, "<=", 1 + 1e-3)
case.finish()

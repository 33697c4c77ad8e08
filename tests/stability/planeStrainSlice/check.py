"""The same collapse in plane strain and in 3D, one cell thick between rollers.
Hard: in 3D every node lies on a wall or behind one; the out-of-plane stress is carried by hand in one and computed
in the other.
Pass: position, velocity, stress and energies per metre agree to 1e-10 of their largest values, for every shape and
stress update; nothing moves out of the plane."""
import numpy as np
from hardCase import HardCase

THICKNESS = 0.25
ROLLERS = """
front { type roller; plane { normal (0 0 1); position 0.25; } }
back { type roller; plane { normal (0 0 -1); position 0; } }
"""


def in_plane_order(first):
    """Ids sorted by the place they had at the start."""
    x = first.by_id("position")
    return np.lexsort((x[:, 0].round(9), x[:, 1].round(9)))


case = HardCase(__file__, __doc__)
for shape, update in (("linear", "MUSL"), ("uGIMP", "MUSL"), ("uGIMP", "USF"), ("uGIMP", "USL"), ("cpGIMP", "MUSL"),
                      ("quadraticBSpline", "MUSL")):
    name = f"{shape}-{update}"
    schemes = (("system/mpmSchemes", "shape", shape), ("system/mpmSchemes", "stressUpdate", update))
    plane = case.copy(f"plane-{name}", *schemes, ("system/seedParticlesDict", "geometry", '"geometry/heap.geo"'))
    slab = case.copy(f"slice-{name}", *schemes, ("system/seedParticlesDict", "geometry", '"geometry/slice.geo"'),
                     ("system/gridDict", "dimension", 3), ("system/gridDict", "max", "(4 3 0.25)"))
    walls = slab.folder / "constant/boundaryConditions"
    walls.write_text(walls.read_text() + ROLLERS)
    for run in (plane, slab):
        case.require(run.utility("seedParticles").utility("mpmSolve"))
    case.common(slab)
    case.nothing_gained(slab)
    two, three = plane.state(), slab.state()
    order2, order3 = in_plane_order(plane.state(0)), in_plane_order(slab.state(0))
    case.check(f"particles in the slice over those in the plane ({name})", len(order3) / len(order2), "==", 2)
    case.check(f"plastic work over the work of gravity ({name})",
               two.ledger["plasticDissipation"] / two.ledger["gravityWork"], ">", 0.05)
    for field, components in (("position", (0, 1)), ("velocity", (0, 1)), ("stress", (0, 1, 2, 3))):
        here = three.by_id(field)[order3][:, components].reshape(len(order2), 2, len(components))
        there = two.by_id(field)[order2][:, components]
        case.check(f"difference of {field} ({name})",
                   np.abs(here - there[:, None, :]).max() / np.abs(there).max(), "<=", 1e-10)
    largest = np.abs(two["velocity"]).max()
    case.check(f"velocity out of the plane over the largest ({name})",
               np.abs(three["velocity"][:, 2]).max() / largest, "<=", 1e-10)
    for term in ("plasticDissipation", "frictionDissipation", "gravityWork", "kineticEnergy"):
        case.check(f"difference of {term} a metre ({name})",
                   abs(three.ledger[term] / THICKNESS / two.ledger[term] - 1), "<=", 1e-10)
case.finish()

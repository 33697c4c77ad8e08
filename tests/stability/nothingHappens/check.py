"""Sand without cohesion, without gravity, at rest.
Hard: stress zero lies on the apex of the yield surface; any 0/0 or round-off there starts motion out of nothing.
Pass: after 200 steps stress, velocity and energies are zero in every bit, and no bit of a position or volume has
changed."""
import numpy as np
from hardCase import HardCase, schemes

case = HardCase(__file__, __doc__)
VARIANTS = [(2, shape, update) for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline")
            for update in ("USF", "USL", "MUSL")] + [(3, "uGIMP", "MUSL"), (3, "quadraticBSpline", "USF")]
for dimension, shape, update in VARIANTS:
    changes = [*schemes(shape, update),
               ("system/gridDict", "dimension", dimension)]
    if dimension == 3:
        changes += [("system/gridDict", "max", "(5 5 5)"), ("system/seedParticlesDict", "geometry", '"geometry/solid.geo"')]
    run = case.solve(f"{shape}{update}{dimension}D", *changes)
    tag = f"({run.folder.name})"
    case.common(run)
    first, last = run.state(0), run.state()
    moved = sum(np.count_nonzero(last.by_id(n) != first.by_id(n)) for n in ("position", "volume", "deformationGradient"))
    case.check(f"numbers that changed {tag}", moved, "==", 0)
    case.check(f"stresses and velocities other than zero {tag}",
               np.count_nonzero(last["stress"]) + np.count_nonzero(last["velocity"]), "==", 0)
    history = run.series()
    energies = ("kineticEnergy", "strainEnergy", "plasticDissipation", "frictionDissipation", "transferLoss", "residual")
    case.check(f"largest energy {tag}", max(np.abs(history[n]).max() for n in energies), "==", 0, "J")
    case.check(f"steps {tag}", int(last.attributes["step"]), "==", 200)
case.finish()

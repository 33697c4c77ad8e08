"""A heavy slab slides on a layer of sand that dilates at its full friction angle (associated flow).
Hard: large shear with dilation opens volume without end: the layer doubles its thickness, its density falls and its
waves get faster, so that a step which was safe is not any more.
Pass: the layer grows by tan(psi) times its shear, within 5 %; the slab rises by tan(psi) times its slide, within 5
%, and no higher than its energy allows; c_p dt/h stays below 1.1 maxCo with the wave speed of the loosest sand."""
import numpy as np
from hardCase import HardCase, schemes, set_fields

case = HardCase(__file__, __doc__)
tangent, h, c_p, max_co = np.tan(np.pi / 6), 0.25, np.sqrt(20e6 * 0.7 / 1.3 / 0.4 / 1600), 0.5
v0 = 5.0


def sliding(x):
    """As dense sand moves: linear over the layer, upwards by tan(psi) of sideways."""
    profile = v0 * np.minimum(x[:, 1], 1)
    return np.stack([profile, tangent * profile], axis=1)


for shape, update in (("uGIMP", "MUSL"), ("quadraticBSpline", "USL"), ("cpGIMP", "MUSL")):
    run = case.seed(shape + update, *schemes(shape, update))
    set_fields(run, velocity=sliding)
    run.utility("mpmSolve")
    tag = f"({run.folder.name})"
    case.check(f"exit code {tag}", run.exit, "==", 0)
    case.common(run)
    first = run.state(0)
    x = first.by_id("position")
    middle = np.abs(x[:, 0] - 18) < 3
    soil, slab = middle & (x[:, 1] < 1), middle & (x[:, 1] > 1)
    worst = 0
    for name in run.times()[1:]:
        state = run.state(name)
        F, J = state.by_id("deformationGradient"), state.by_id("volume") / state.by_id("volume0")
        moved = (state.by_id("position") - x)[slab].mean(axis=0)
        shear, growth = F[soil][:, 0, 1].mean(), J[soil].mean() - 1
        worst = max(worst, state.attributes["deltaT"] * (c_p * np.sqrt(J[x[:, 1] < 1].max())) / h)
    case.check(f"shear of the layer {tag}", shear, ">=", 1)
    case.check(f"error of growth over tan(psi) shear {tag}", abs(growth / shear / tangent - 1), "<=", 0.05)
    case.check(f"error of rise over tan(psi) slide {tag}", abs(moved[1] / moved[0] / tangent - 1), "<=", 0.05)
    case.check(f"rise over the height its energy allows {tag}", moved[1] / (v0**2 * (1 + tangent**2) / 20), "<=", 1)
    case.check(f"largest c_p dt/h, loosest sand, over maxCo {tag}", worst / max_co, "<=", 1.1)
case.finish()

"""Simple shear up to gamma = 8, far beyond where stress rates differ.
Hard: the frame of the principal strains turns by more than a quarter turn; rates that look alike at 10 % shear part
company there, and a wrong rotation shows. The layer is driven by its own inertia: velocity a y, stresses too small to
change it.
Pass: stress of the middle is that of Jaumann's rate (the rate the solver states), s_xy = G sin gamma and s_xx =
-s_yy = G (1 - cos gamma), within 1 % of G at gamma 1 ... 8; volume stays within 1e-6."""
import numpy as np
from hardCase import HardCase, schemes, set_fields

case = HardCase(__file__, __doc__)
G = 10.0
for shape, update in (("linear", "MUSL"), ("uGIMP", "USL"), ("uGIMP", "USF"), ("cpGIMP", "MUSL"),
                      ("quadraticBSpline", "MUSL")):
    # Stretched domains carry what happens at the surfaces two cells further in: a thicker layer for them.
    half = 7 if shape == "cpGIMP" else 4
    run = case.seed(shape + update, ("geometry/layer.geo", "half", f"= {half}"), *schemes(shape, update))
    set_fields(run, velocity=lambda x: np.stack([x[:, 1] - 4, 0 * x[:, 1]], axis=1))
    run.utility("mpmSolve")
    case.check(f"exit code ({run.folder.name})", run.exit, "==", 0)
    case.common(run)
    start = run.state(0).by_id("position")
    middle = (abs(start[:, 0] - 40) < 6) & (abs(start[:, 1] - 4) < 0.5)
    worst, drift = 0, 0
    for name in run.times()[1:]:
        state = run.state(name)
        gamma, stress = state.time, state.by_id("stress")[middle] / G
        exact = np.array([1 - np.cos(gamma), np.cos(gamma) - 1, 0, np.sin(gamma)])
        worst = max(worst, np.abs(stress - exact).max())
        F = state.by_id("deformationGradient")[middle]
        drift = max(drift, np.abs(np.linalg.det(F) - 1).max())
    case.check(f"error of stress over G ({run.folder.name})", worst, "<=", 0.01)
    case.check(f"change of volume ({run.folder.name})", drift, "<=", 1e-6)
case.finish()

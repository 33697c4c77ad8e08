"""One particle in free fall.
Hard: a lone particle must not feel its own image on the grid, whatever its place in the cell.
Pass: x and v are the sums of the scheme, v_n = n g dt and x_n = x_0 + g dt^2 n (n + 1)/2, to round-off; stress stays 0."""
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    run = case.solve(shape, ("system/mpmSchemes", "shape", shape))
    case.common(run)
    first, last = run.state(0), run.state()
    n, dt, g = int(last.attributes["step"]), 1e-3, np.array([0.3, -9.8])
    case.check(f"particles ({shape})", len(last["mass"]), "==", 1)
    case.check(f"error of v ({shape})", np.abs(last["velocity"][0] - n * dt * g).max() / (n * dt * 9.8), "<=", 1e-12)
    fallen = g * dt**2 * n * (n + 1) / 2
    case.check(f"error of x ({shape})", np.abs(last["position"][0] - first["position"][0] - fallen).max(), "<=", 1e-12, "m")
    case.check(f"stress over E ({shape})", np.abs(last["stress"]).max() / 20e6, "<=", 1e-12)
case.finish()

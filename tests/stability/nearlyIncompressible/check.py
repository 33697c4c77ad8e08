"""Undrained soil as a nearly incompressible solid (Poisson's ratio 0.499) in an oedometer under sudden self weight.
Hard: the bulk modulus is 500 times the shear modulus, so that small errors of volume become large errors of pressure,
which often alternate from cell to cell (checkerboard); and the step must shrink with the P-wave speed.
Pass: at t = 2 H/c_p the pressure is 2 rho g (H - y) K/M within 5 % of its value at the base for every particle, no
checkerboard above 1 % of it; the step the solver allows falls as 1/sqrt(M) from nu 0.3 to 0.4999."""
import numpy as np
from hardCase import HardCase, checkerboard, log_number, pressure, schemes

case = HardCase(__file__, __doc__)
E, rho, g, H, h = 20e6, 1000, 1, 10, 0.25
for nu, shape, update in ((0.499, "linear", "MUSL"), (0.499, "uGIMP", "MUSL"), (0.499, "cpGIMP", "USL"),
                          (0.499, "quadraticBSpline", "USF"), (0.3, "uGIMP", "MUSL"), (0.4999, "uGIMP", "MUSL")):
    M, K = E * (1 - nu) / (1 + nu) / (1 - 2 * nu), E / 3 / (1 - 2 * nu)
    time = 2 * H * np.sqrt(rho / M)
    run = case.solve(f"{shape}{update}{nu}", *schemes(shape, update),
                     ("constant/materialProperties", "nu", nu), ("system/controlDict", "endTime", repr(time)),
                     ("system/controlDict", "deltaT", repr(time / 250)), ("system/controlDict", "writeInterval", repr(time)))
    tag = f"({run.folder.name})"
    case.common(run)
    limit = log_number(run, r"stability\s+deltaT <= (\S+) s")
    bound = 0.36 if update == "USL" else 0.85 if shape == "linear" else 1.2
    expected = bound * h * np.sqrt(rho / M)
    case.check(f"error of the allowed step, {bound} h sqrt(rho/M) {tag}", abs(limit / expected - 1), "<=", 1e-3)
    first, last = run.state(0), run.state()
    x, p = first.by_id("position"), pressure(last.by_id("stress"))
    base = 2 * rho * g * H * K / M
    error = (p - base * (1 - x[:, 1] / H)) / base
    case.check(f"largest error of the pressure {tag}", np.abs(error).max(), "<=", 0.05)
    case.check(f"checkerboard of the pressure {tag}", checkerboard(x, error, h / 2), "<=", 0.01)
case.finish()

"""Sudden self weight of a column with Poisson's ratio 0 and -0.2.
Hard: laws that divide by nu, take nu/(1 - nu) for positive, or couple axes at nu = 0 show here; the motion has a
closed form.
Pass: at t = 2 H/c_p, when the top turns back, settlement and stress are twice the static ones, 2 rho g (H y -
y^2/2)/M and 2 rho g (H - y), within 1 % of their largest values (stress: RMS); lateral stress is nu/(1 - nu) of the
vertical one to 1e-9, and zero for nu = 0, with side walls and without."""
import numpy as np
from hardCase import HardCase, schemes

case = HardCase(__file__, __doc__)
E, rho, g, H, h = 20e6, 1000, 1, 10, 0.25
VARIANTS = ((0, True, "uGIMP", "MUSL"), (0, False, "uGIMP", "USL"), (0, False, "quadraticBSpline", "MUSL"),
            (0, False, "linear", "USF"), (-0.2, True, "linear", "MUSL"), (-0.2, True, "cpGIMP", "USL"))
for nu, walls, shape, update in VARIANTS:
    M = E * (1 - nu) / (1 + nu) / (1 - 2 * nu)
    time = 2 * H * np.sqrt(rho / M)
    run = case.copy(f"{shape}{update}{nu}{'walls' if walls else 'free'}", *schemes(shape, update), ("constant/materialProperties", "nu", nu),
                    ("system/controlDict", "endTime", repr(time)), ("system/controlDict", "deltaT", repr(time / 250)),
                    ("system/controlDict", "writeInterval", repr(time)))
    if not walls:
        file = run.folder / "constant/boundaryConditions"
        file.write_text(file.read_text().split("left")[0])
    run.utility("seedParticles").utility("mpmSolve")
    tag = f"({run.folder.name})"
    case.check(f"exit code {tag}", run.exit, "==", 0)
    case.common(run)
    first, last = run.state(0), run.state()
    Y, down = first.by_id("position")[:, 1], (first.by_id("position") - last.by_id("position"))[:, 1]
    exact = 2 * rho * g / M * (H * Y - Y**2 / 2)
    case.check(f"error of the settlement {tag}", np.abs(down - exact).max() / exact.max(), "<=", 0.01)
    stress = last.by_id("stress")
    base = 2 * rho * g * H
    error = np.sqrt(np.mean((stress[:, 1] + 2 * rho * g * (H - Y))**2))
    case.check(f"RMS error of the vertical stress {tag}", error / base, "<=", 0.01)
    lateral = np.abs(stress[:, [0, 2]] - nu / (1 - nu) * stress[:, 1:2]).max()
    case.check(f"lateral stress less nu/(1 - nu) of the vertical one {tag}", lateral / base, "<=", 1e-9)
    case.check(f"shear stress {tag}", np.abs(stress[:, 3]).max() / base, "<=", 1e-9)
case.finish()

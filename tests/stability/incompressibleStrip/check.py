"""A nearly incompressible block (Poisson's ratio 0.499) pressed between two strips.
Hard: cells with more particles than they have freedom to keep their volume lock, and the pressures of single
particles alternate from one to the next (checkerboard) by several times the load. In plane strain under given
tractions the true stresses in the plane do not depend on Poisson's ratio (Michell), which gives a reference: the same
block at 0.3.
Pass: smoothed stresses (smoothStress) of quadratic splines: pressure within 5 % of the load (RMS over the block,
and everywhere below the top quarter), checkerboard under 1 %. What particles show before smoothing, and GIMP, is
recorded: see a pressure at 0.499 only after smoothing, and use splines."""
import h5py
import numpy as np
from hardCase import HardCase, checkerboard, record

case = HardCase(__file__, __doc__)
E, rho, h, load = 10e6, 2000, 0.25, 1e3


def run_at(shape, nu):
    dt = 0.5 * h / np.sqrt(E * (1 - nu) / (1 + nu) / (1 - 2 * nu) / rho)
    run = case.solve(f"{shape}{nu}", ("system/mpmSchemes", "shape", shape), ("constant/materialProperties", "nu", nu),
                     ("system/controlDict", "deltaT", repr(dt)), ("system/controlDict", "endTime", repr(4000 * dt)),
                     ("system/controlDict", "writeInterval", repr(4000 * dt)))
    case.common(run)
    history = run.series()
    case.check(f"kinetic over strain energy at the end ({run.folder.name})",
               history["kineticEnergy"][-1] / history["strainEnergy"][-1], "<=", 1e-4)
    run.utility("smoothStress", "-latestTime")
    case.check(f"exit code of smoothStress ({run.folder.name})", run.exit, "==", 0)
    last = run.state()
    with h5py.File(last.path) as file:
        smoothed = file["derived/smoothedStress"][()][np.argsort(file["particles/id"][()])]
    return run.state(0).by_id("position"), last.by_id("stress"), smoothed


for shape in ("quadraticBSpline", "uGIMP"):
    reference, soft = run_at(shape, 0.3), run_at(shape, 0.499)
    x = reference[0]
    for what, k in (("raw", 1), ("smoothed", 2)):
        # p = -(1 + nu)(s_xx + s_yy)/3
        error = -(1 + 0.499) / 3 * (soft[k][:, 0] + soft[k][:, 1] - reference[k][:, 0] - reference[k][:, 1]) / load
        rms, below = np.sqrt((error**2).mean()), np.abs(error[x[:, 1] < 3]).max()
        alternating = checkerboard(x, error, h / 2)
        tag = f"({shape}, {what})"
        if shape == "quadraticBSpline" and what == "smoothed":
            case.check(f"RMS error of the pressure over the load {tag}", rms, "<=", 0.05)
            case.check(f"largest error below the top quarter {tag}", below, "<=", 0.05)
            case.check(f"checkerboard of the pressure {tag}", alternating, "<=", 0.01)
        else:
            record(case, f"RMS error of the pressure over the load {tag}", rms)
            record(case, f"largest error below the top quarter {tag}", below)
            record(case, f"checkerboard of the pressure {tag}", alternating)
case.finish()

"""Axial vibration of a bar with one end fixed, in its first and tenth mode.
Measured: velocity of the centre of mass, displacement of the particles, frequency and energy over two periods, against the cell
size.
Pass: displacement of the first mode converges with order 1.95 to 2.05 in splines, 1.8 in cpGIMP, 1.65 in uGIMP; frequency
right to 1.6/N^2 and energy kept within 0.2/N; linear MPM, whose particles cross cells at 40, diverges."""
import numpy as np
from verification import Verification, expressions, rms, schemes, worst_rms

case = Verification(__file__, __doc__)
L, C, V0 = 25.0, 10.0, 0.1


def wave(mode):
    k = (2 * mode - 1) * np.pi / 2 / L
    return k, k * C


def displacement(mode):
    k, omega = wave(mode)
    return lambda X, t: np.stack([V0 / omega * np.sin(omega * t) * np.sin(k * X[:, 0]), 0 * X[:, 0]], axis=1)


def frequency(time, v):
    """From the times at which a cosine passes zero: linear between steps."""
    i = np.nonzero(np.sign(v[:-1]) != np.sign(v[1:]))[0]
    passed = time[i] + (time[i + 1] - time[i]) * v[i] / (v[i] - v[i + 1])
    return np.pi / np.polyfit(np.arange(len(passed)), passed, 1)[0]


def errors(shape, update, mode):
    k, omega = wave(mode)
    period = 2 * np.pi / omega

    def of(N):
        h = L / N
        run = case.solve(f"{shape}-{update}-mode{mode}-N{N}", *schemes(shape, update), ("constant/materialProperties", "mode", mode),
                         ("geometry/bar.geo", "thickness", f"= {h!r}"), ("system/gridDict", "cellSize", repr(h)),
                         ("system/gridDict", "max", f"({L + h!r} $cellSize 0)"), ("system/controlDict", "deltaT", repr(0.2 * h / C)),
                         ("system/controlDict", "endTime", repr(2 * period)), ("system/controlDict", "writeInterval", repr(period / 40)))
        history = run.series()
        time, v = history["time"], history["momentumX"] / history["mass"]
        mean = V0 / (k * L) * np.cos(omega * (time - 0.5 * history["dt"]))  # velocities live half a step before positions
        energy = history["kineticEnergy"] + history["strainEnergy"]
        return {"displacement": worst_rms(run, displacement(mode)) / (V0 / omega), "mean velocity": rms((v - mean)[1:]) / (V0 / (k * L)),
                "frequency": abs(frequency(time[1:], v[1:]) / omega - 1), "energy": np.abs(energy[1:] / energy[1] - 1).max()}
    return of


speed = expressions(case.scene / "constant/materialProperties", "initialVelocity")
X = np.linspace(0, L, 50)
difference = speed(X=X)[:, :1] - displacement(1)(X[:, None], 1e-8)[:, :1] / 1e-8
case.check("initial velocity against the solution", np.abs(difference).max() / V0, "<=", 1e-10)
# variants, cells, bounds of the order of the displacement (None: diverges)
STUDIES = (("linear", "MUSL", (10, 20, 40), None), ("uGIMP", "MUSL", (10, 20, 40, 80), (1.65, 2.05)),
           ("cpGIMP", "USL", (10, 20, 40), (1.8, 2.05)), ("quadraticBSpline", "MUSL", (10, 20, 40), (1.95, 2.05)),
           ("cubicBSpline", "MUSL", (10, 20), (1.95, 2.05)))
for shape, update, cells, bounds in STUDIES:
    study = case.study(f"mode 1, {shape} {update}", "N", cells, errors(shape, update, 1), loose=bounds is None)
    if bounds is None:
        case.check("linear MPM diverges: displacement error at 40 cells over that at 20", study.errors["displacement"][-1] /
                   study.errors["displacement"][1], ">", 1)
        continue
    case.check_order(study, "displacement", *bounds)
    case.check(f"frequency at {cells[-1]} cells ({study.label})", study.errors["frequency"][-1], "<=", 1.6 / cells[-1]**2)
    case.check(f"largest change of energy at {cells[-1]} cells ({study.label})", study.errors["energy"][-1], "<=", 0.2 / cells[-1])
study = case.study("mode 10, uGIMP MUSL", "N", (40, 80), errors("uGIMP", "MUSL", 10))
case.check_order(study, "displacement", 1.65)
case.finish()

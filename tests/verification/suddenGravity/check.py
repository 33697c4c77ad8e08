"""An elastic bar on a fixed base under sudden gravity.
Measured: displacement, stress, the top's largest settlement and the period, against the cell size, in four shapes.
Pass: with 80 cells the top is at twice the static settlement at t = 2 H/c within 0.1 %, the period is 4 H/c within
0.05 %, displacement right to 0.2 % and stress to 0.5 %; displacement converges with order 1.6 or more where the start is staggered."""
import numpy as np
from verification import Verification, displacements, rms, schemes

case = Verification(__file__, __doc__)
E, RHO, G, H = 1e6, 1000.0, 0.01, 10.0
C = np.sqrt(E / RHO)
TOP = G * H**2 / (2 * C**2)  # static settlement of the top


def static(Y):
    """Odd about 0, even about H."""
    Y = (Y + 2 * H) % (4 * H) - 2 * H
    sign, Y = np.sign(Y), np.abs(Y)
    return sign * G / C**2 * (H * Y - Y**2 / 2)


def exact(Y, t):
    return -static(Y) + (static(Y - C * t) + static(Y + C * t)) / 2


def crossings(time, y, level):
    """Times at which a series passes a level, by a parabola's accuracy: linear between steps of a hundredth of a period."""
    d = y - level
    i = np.nonzero(np.sign(d[:-1]) != np.sign(d[1:]))[0]
    return time[i] + (time[i + 1] - time[i]) * d[i] / (d[i] - d[i + 1])


def errors(shape, update):
    def of(N):
        h = H / N
        run = case.solve(f"{shape}{update}{N}", *schemes(shape, update),
                         ("system/mpmSchemes", "staggeredStart", "no" if update == "USF" else "yes"), ("geometry/bar.geo", "width", f"= {h!r}"),
                         ("system/gridDict", "cellSize", repr(h)), ("system/controlDict", "deltaT", repr(0.25 * h / C)))
        X, states = displacements(run)
        Y = X[:, 1]
        worst = max(rms(u[:, 1] - exact(Y, t)) for t, u in states)
        history = run.series()
        time, top, Yt = history["time"], history["maxY"], Y.max()
        reached = np.interp(2 * H / C, time, top) - Yt
        passed = crossings(time[1:], top[1:] - Yt, -static(Yt))
        period = np.polyfit(np.arange(len(passed)), passed, 1)[0] * 2
        state = run.state("0.632456")
        stress = rms(state.by_id("stress")[:, 1] - 2 * RHO * G * (Y - H))
        return {"displacement": worst / (2 * TOP), "stress": stress / (2 * RHO * G * H),
                "top at 2 H/c": abs(reached / exact(Yt, 2 * H / C) - 1), "period": abs(period * C / (4 * H) - 1)}
    return of


for shape, update in (("linear", "USL"), ("uGIMP", "MUSL"), ("cpGIMP", "USF"), ("quadraticBSpline", "MUSL")):
    study = case.study(f"{shape} {update}", "N", (10, 20, 40, 80), errors(shape, update))
    for measure, bound in (("displacement", 1e-3), ("stress", 5e-3), ("top at 2 H/c", 1e-3), ("period", 5e-4)):
        case.check(f"{measure} ({study.label})", study.errors[measure][-1], "<=", bound)
    case.check(f"order of displacement, fit ({study.label})", study.fit("displacement"), ">=", 1.2 if update == "USF" else 1.6)
case.finish()

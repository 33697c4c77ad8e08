"""A block on an inclined plane, sticking or sliding.
Measured: the error of the path in half a second over the path without friction, for ten angles and coefficients, and
against the cell size for two of them.
Pass: what slides with tan(angle) at least 10 % beyond mu: 0.2 % with 16 cells a metre, 0.05 % with 32, order 1 of the
time step; what sticks, or stands at the limit, sticks with damping: 0.01 % with tan(angle) 4 % below mu, 2 % at the
limit itself; without damping, where the block's vibrations decide, 20 %. The work of friction is never negative."""
import functools
import math

import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
# Angle [deg], mu, g [m/s^2].
TABLE = ((30, 0.2, 9.8), (30, 0.6, 9.8), (45, 0.3, 9.8), (60, 0.3, 10), (60, 0.6, 10), (60, 0.4951, 10), (20, 0, 9.8),
         (45, 1.0, 9.8), (math.degrees(math.atan(0.5)), 0.5, 9.8), (31, 0.6, 9.8))
HEIGHT, RHO, REST, TIME, TAU = 0.25, 2000.0, 0.2, 0.5, 0.01


def acceleration(angle, mu, g):
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    return 0.0 if sine <= mu * cosine * (1 + 1e-12) else g * (sine - mu * cosine)


def centre(state):
    return (state["mass"][:, None] * state["position"]).sum(axis=0) / state["mass"].sum()


def steady(particles, normal, along):
    """The stress of a wide block that neither begins nor ends: pressed by its weight, held back at its base."""
    over = RHO * (HEIGHT - particles["position"][:, 1])
    particles["stress"][:, 1] = -normal * over
    particles["stress"][:, 3] = along * over


@functools.lru_cache(None)
def slide(angle, mu, g, n, damped=False):
    """Cells of 1/n m; returns the largest error of the path over that without friction, and the path in the end."""
    h, sine, cosine = 1 / n, math.sin(math.radians(angle)), math.cos(math.radians(angle))
    run = case.seed(f"{angle:.4g}-{mu:g}-{n}{'-damped' if damped else ''}", ("constant/boundaryConditions", "mu", mu),
                    ("constant/g", "value", f"({g * sine!r} {-g * cosine!r} 0)"), ("system/gridDict", "cellSize", h),
                    ("system/controlDict", "deltaT", repr(h / 250)))
    a = acceleration(angle, mu, g)
    run.edit(lambda p: steady(p, g * cosine, g * sine - a))
    case.require(run.utility("mpmSolve", threads=1))  # its edges come to rest: the vibrations are damped
    first = run.state()
    if not damped:
        run.set("system/mpmSchemes", "relaxationTime", 1e12)
    run.set("system/controlDict", "endTime", REST + TIME)
    case.require(run.utility("mpmSolve", threads=1))
    last = run.state()
    start = (first["mass"][:, None] * first["velocity"]).sum(axis=0)[0] / first["mass"].sum()
    time = last.time - first.time
    # Of a body with acceleration a, less that of its first velocity; with damping v' = a - v/tau, from the steady state.
    path = centre(last)[0] - centre(first)[0] - (0 if damped else start * time)
    half = TAU * time if damped else 0.5 * time**2
    free = 0.5 * RHO * HEIGHT * (g * sine * 0.5) ** 2
    case.check(f"least work of friction over the energy of a free slide ({run.folder.name})",
               run.series()["frictionDissipation"].min() / free, ">=", -1e-12)
    return abs(path - a * half) / (g * sine * half), path, a


rows = []
for angle, mu, g in TABLE:
    a, ratio = acceleration(angle, mu, g), math.tan(math.radians(angle)) / mu if mu else math.inf
    grips = ratio < 1.01  # sticks, or as good as: vibrations decide without damping (theory.md)
    error, path, _ = slide(angle, mu, g, 16)
    damped = slide(angle, mu, g, 16, True)[0] if grips else math.nan
    tag = f"({angle:.4g} deg, mu {mu:g})"
    case.check(f"error of the path over the free path, no damping {tag}", error, "<=", 0.2 if grips else 0.002)
    if grips:
        bound = 1e-4 if ratio < 0.99 else 0.02
        case.check(f"error of the path over the free path, with damping {tag}", damped, "<=", bound)
    rows.append([f"{angle:.4g}", f"{mu:g}", f"{g:g}", "slides" if a else "sticks", f"{a:.6f}", f"{a * TIME**2 / 2:.5f}",
                 Number(path, ".5f", 0.7 if grips else 0.01, 1e-3), Number(error, ".1e", 0.7, 1e-3),
                 Number(damped, ".1e", 0.7, 1e-3)])
for angle, mu, g in (TABLE[0], TABLE[3]):
    study = case.study(f"{angle:g} deg, mu {mu:g}", "N", (8, 16, 32), lambda n: {"path": slide(angle, mu, g, n)[0]})
    case.check(f"error of the path over the free path, 32 cells ({study.label})", study.errors["path"][-1], "<=", 5e-4)
    case.check_order(study, "path", 0.9, 1.1)
case.table("16 cells a metre:", ["angle [deg]", "mu", "g [m/s^2]", "block", "a [m/s^2]", "a t^2/2 [m]",
           "path in 0.5 s [m]", "error over the free path", "the same with damping"], rows)
case.finish()

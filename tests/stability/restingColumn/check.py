"""A soil column at rest between rollers, for 5,000 steps (100,000 in the long version).
Hard: any imbalance between the stress it starts with and the discrete forces sets it swinging for ever; any energy a
step makes from nothing multiplies round-off until the column jumps; and every swing that reaches the yield surface
leaves plastic strain.
Pass: kinetic energy below 1e-12 m g H and displacement below 1e-8 H at all times and no plastic work, for the K0
stress as seeded and, with splines (whose forces a linear stress does not balance at a free surface), for the nearest
stress in equilibrium; a column that is disturbed never swings harder than at first."""
import math

import numpy as np
from hardCase import LONG, HardCase

H, G, DT = 8.0, 9.8, 2e-3
STEPS = 100_000 if LONG else 5_000


def spline(y, h=0.8, levels=13):
    """Quadratic B-splines of the heights y at the levels 0, h, ..., folded at the base: values, slopes (points, levels)."""
    d = y[:, None] / h - np.arange(levels)
    a = np.abs(d)
    n = np.where(a <= 0.5, 0.75 - d * d, np.where(a <= 1.5, 0.5 * (1.5 - a) ** 2, 0))
    g = np.where(a <= 0.5, -2 * d, np.where(a <= 1.5, -np.sign(d) * (1.5 - a), 0)) / h
    low = y < 0.5 * h  # functions of the half cell on the base: hats
    n[low], g[low] = 0, 0
    n[low, 0], n[low, 1] = 1 - y[low] / h, y[low] / h
    g[low, 0], g[low, 1] = -1 / h, 1 / h
    return n, g


def balance(p):
    """Adds the smallest change of vertical stress, the same in a row, that makes every free level's force vanish."""
    y, row = np.unique(p["position"][:, 1].round(9), return_inverse=True)
    n, g = spline(y)
    mass, volume = np.bincount(row, p["mass"]), np.bincount(row, p["volume"])
    free = (n.sum(axis=0) > 0) & (np.arange(n.shape[1]) > 0)
    stress = np.bincount(row, p["stress"][:, 1]) / np.bincount(row)
    out_of_balance = (n.T @ mass * -G - g.T @ (volume * stress))[free]
    change = np.linalg.lstsq((g * volume[:, None]).T[free], out_of_balance, rcond=None)[0]
    p["stress"][:, 1] += change[row]
    return np.abs(change).max() / np.abs(stress).max()


def watch(run):
    case.require(run.utility("mpmSolve"))
    case.common(run)
    case.nothing_gained(run)
    first, last, history = run.state(0), run.state(), run.series()
    tag = f" ({run.folder.name})"
    case.check("steps" + tag, last.attributes["step"], "==", STEPS)
    weight = math.fsum(first["mass"]) * G * H
    case.check("largest kinetic energy over m g H" + tag, history["kineticEnergy"].max() / weight, "<", 1e-12)
    moved = np.abs(last.by_id("position") - first.by_id("position")).max()
    case.check("displacement over H" + tag, moved / H, "<", 1e-8)
    case.check("extents ever moved by, over H" + tag,
               max(np.ptp(history[name]) for name in ("minX", "maxX", "minY", "maxY")) / H, "<", 1e-8)
    case.check("plastic work over m g H" + tag, np.abs(history["plasticDissipation"]).max() / weight, "<=", 1e-16)
    case.check("returns to the apex" + tag, history["apexReturns"][-1], "==", 0)


def disturb(p):
    """Two per cent more vertical stress in the upper metre: makes any growth seen in a short run."""
    p["stress"][:, 1] *= np.where(p["position"][:, 1] > H - 1, 1.02, 1)


case = HardCase(__file__, __doc__)
times = [("system/controlDict", word, STEPS * DT) for word in ("endTime", "writeInterval")]
for shape in ("linear", "uGIMP", "cpGIMP"):
    for update in ("MUSL",) if shape != "uGIMP" else ("MUSL", "USF"):
        watch(case.seed(f"{shape}-{update}", ("system/mpmSchemes", "shape", shape),
                        ("system/mpmSchemes", "stressUpdate", update), *times))
run = case.seed("quadraticBSpline-balanced", ("system/mpmSchemes", "shape", "quadraticBSpline"), *times)
run.edit(lambda p: case.check("the nearest balanced stress differs from K0 by, at most", balance(p), "<", 0.05))
watch(run)
for update in ("MUSL", "USF", "USL"):
    run = case.seed(f"disturbed-{update}", ("system/mpmSchemes", "stressUpdate", update),
                    ("system/controlDict", "deltaT", DT if update != "USL" else DT / 2),
                    *[("system/controlDict", word, 5_000 * DT) for word in ("endTime", "writeInterval")]).edit(disturb)
    case.require(run.utility("mpmSolve"))
    case.common(run)
    case.nothing_gained(run)
    swing = run.series()["kineticEnergy"]
    case.check(f"largest kinetic energy of the last half over that of the first tenth ({run.folder.name})",
               swing[len(swing) // 2:].max() / swing[:len(swing) // 10].max(), "<=", 1)
case.finish()

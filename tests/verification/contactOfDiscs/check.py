"""Two elastic discs meet as bodies of their own, head on and off centre.
Measured: when they begin to feel each other, momentum and angular momentum, energy kept, share of the motion that is of the
discs as wholes, spin that friction gives.
Pass: no energy is lost until 0.1 s before the circles meet (1.586 s; two cells of a grid with one velocity are 0.7 s); momentum is kept to
round-off, angular momentum to 0.5 % of that of the glancing discs; the budget closes to 1e-10; where nothing rubs
less energy is lost than a third of h/R, and the spin stays below 2 %; discs that glance spin in the same sense, only with friction, and friction takes energy."""
import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
V, rows = 0.1, []


def spin(x, v, m):
    """Angular momentum about the origin."""
    return float((m * (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])).sum())


def collide(n, update, mu, aside=0.0):
    run = case.solve(f"{n}-{update}-{mu:g}-{aside:g}", ("system/gridDict", "cellSize", repr(1 / n)), ("system/gridDict", "max", "(1.4 1.4 0)"),
                     ("system/gridDict", "min", "(-0.4 -0.4 0)"),
                     ("system/controlDict", "deltaT", repr(0.2 / n)), ("system/mpmSchemes", "stressUpdate", update),
                     ("constant/contactProperties", "mu", mu), ("geometry/discs.geo", "aside", f"= {aside!r}"))
    first, last, history, budget = run.state(0), run.state(), run.series(), run.series("energyBudget")
    m, x, v = (last.by_id(name) for name in ("mass", "position", "velocity"))
    x0, v0 = first.by_id("position"), first.by_id("velocity")
    start, time = 0.5 * (m * (v0**2).sum(axis=1)).sum(), history["time"]
    kinetic = history["kineticEnergy"] / start
    kept = (kinetic + history["strainEnergy"] / start)[-1]
    parts = [last.by_id("material") == body for body in (0, 1)]
    whole = [(m[p, None] * v[p]).sum(axis=0) / m[p].sum() for p in parts]
    share = sum((w**2).sum() for w in whole) / (4 * V**2)
    spins = []
    for p, w in zip(parts, whole):
        centre = (m[p, None] * x[p]).sum(axis=0) / m[p].sum()
        spins.append(spin(x[p] - centre, v[p] - w, m[p]))
    felt = time[np.argmax(np.abs(kinetic - 1) > 1e-4)]
    scale = m.sum() * V * 0.2 * np.sqrt(2)
    turned = (spin(x, v, m) - spin(x0, v0, m)) / scale
    tag = f"({0.4 * n:g} cells, {update}, mu {mu:g}, {aside:g} m aside)"
    momentum = np.abs((m[:, None] * v).sum(axis=0)).max() / (m.sum() * V)
    case.check(f"momentum over that of one disc {tag}", momentum, "<=", 1e-13)
    case.check(f"change of angular momentum over m v R {tag}", abs(turned), "<=", 5e-3)
    case.check(f"residual of the budget over the energy {tag}", abs(budget["residual"][-1]) / start, "<=", 1e-10)
    friction = budget["contactFriction"] / start
    if aside == 0:
        case.check(f"time at which they feel each other {tag}", felt, ">=", 1.586 - 0.1)
    if mu == 0:
        case.check(f"energy taken by friction {tag}", abs(friction[-1]), "<=", 0)
        case.check(f"spin over m v R {tag}", abs(spins[0] + spins[1]) / scale, "<=", 0.02)
        if update == "MUSL":
            case.check(f"energy lost over the cell size over the radius {tag}", (1 - kept) * n * 0.2, "<=", 0.35)
    else:
        case.check(f"least growth of the energy taken by friction {tag}", np.diff(friction).min(), ">=", -1e-15)
        case.check(f"energy taken by friction {tag}", friction[-1], ">=", 1e-3)
        case.check(f"product of the spins over (m v R)^2 {tag}", spins[0] * spins[1] / scale**2, ">=", 1e-6)
    case.check(f"energy kept {tag}", kept, "<=", 1.002)
    rows.append([f"{0.4 * n:g}", update, f"{mu:g}", f"{aside:g}", Number(felt, ".2f", 0, 0.03), Number(kept, ".4f", 0, 0.003),
                 Number(share, ".3f", 0, 0.01), Number(friction[-1], ".4f", 0.05, 5e-4), Number((spins[0] + spins[1]) / scale, ".4f", 0.05, 2e-3),
                 Number(turned, ".1e", 1, 1e-3)])


for n in (20, 40):
    collide(n, "MUSL", 0)
collide(40, "USL", 0)
collide(40, "USF", 0)
for mu in (0, 0.2):
    collide(40, "MUSL", mu, 0.07)
case.table("", ["cells in the diameter", "update", "mu", "aside [m]", "felt at [s]", "energy kept", "share of motion as wholes", "friction",
                "spin over m v R", "change of angular momentum over m v R"], rows)
case.finish()

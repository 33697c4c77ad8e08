"""Two elastic discs that meet head on, bounce and part (Sulsky, Chen & Schreyer 1994).
Measured: momentum, symmetry, kinetic energy at the height of the collision and after it, and the energy that each scheme
keeps.
Pass: momentum stays zero to round-off and the motion symmetric about the centre; before they touch, kinetic energy stays
within 0.1 %; afterwards no scheme has more than 100.5 % of the energy, MUSL with uGIMP or cpGIMP keeps 99 %, USL comes
nearer with every halving of the cells, to 97 % with 32 cells in the diameter; the share that is motion of the discs as
wholes is between 0.8 and 0.92."""
import numpy as np
from verification import Number, Verification, schemes, set_fields

case = Verification(__file__, __doc__)
V = 0.1  # each component of the velocity [m/s]
rows = []


def collide(n, shape, update, transfer="FLIP"):
    """Cells of 1/n m."""
    run = case.seed(f"{shape}-{update}-{transfer.split(';')[0]}{transfer[-1]}-{n}", *schemes(shape, update),
                    ("system/mpmSchemes", "transfer", transfer), ("system/gridDict", "cellSize", repr(1 / n)),
                    ("system/controlDict", "deltaT", repr(0.2 / n)), ("system/controlDict", "historyInterval", n // 10))
    set_fields(run, velocity=lambda x: np.where(x[:, :1] < 0.5, V, -V) * np.ones((1, 2)))
    case.require(run.utility("mpmSolve", threads=1))
    first, last, history = run.state(0), run.state(), run.series()
    X, m, v = first.by_id("position"), first.by_id("mass"), last.by_id("velocity")
    left = X[:, 0] < 0.5
    start = 0.5 * m.sum() * 2 * V**2
    momentum = np.abs((m[:, None] * v).sum(axis=0)).max() / (m.sum() * V)
    # The particle at X has a partner at (1, 1) - X.
    here, there = np.lexsort(np.round(X, 9).T), np.lexsort(np.round(1 - X, 9).T)
    x = last.by_id("position")
    mirror = np.abs(x[here] - (1 - x[there])).max()
    kinetic, time = history["kineticEnergy"] / start, history["time"]
    kept = (kinetic + history["strainEnergy"] / start)[-1]
    whole = [(m[part, None] * v[part]).sum(axis=0) / m[part].sum() for part in (left, ~left)]
    share = sum((w**2).sum() for w in whole) / (4 * V**2)
    tag = f"({shape}, {update}, {transfer}, {0.4 * n:g} cells)"
    case.check(f"momentum over that of one disc {tag}", momentum, "<=", 1e-13)
    case.check(f"difference from the mirrored body over its diameter {tag}", mirror / 0.4, "<=", 1e-5)
    case.check(f"loss of kinetic energy until t = 1 s {tag}", abs(kinetic[time <= 1] - 1).max(), "<=", 1e-3)
    case.check(f"energy kept {tag}", kept, "<=", 1.005)
    case.check(f"share of the motion as wholes {tag}", abs(share - 0.86), "<=", 0.06)
    rows.append([shape, update, transfer.replace(";", ""), f"{0.4 * n:g}", Number(kinetic.min(), ".3f", 0, 0.005),
                 Number(kinetic[time > 3].mean(), ".3f", 0, 0.005), Number(share, ".3f", 0, 0.005), Number(kept, ".4f", 0, 0.002)])
    print("      " + ", ".join(str(cell) for cell in rows[-1]) + f"; momentum {momentum:.1e}, mirror {mirror:.1e}")
    return kept


kept = {}
for n in (20, 40, 80):
    for shape, update in (("uGIMP", "USL"), ("uGIMP", "MUSL"), ("cpGIMP", "MUSL")):
        kept[shape, update, n] = collide(n, shape, update)
for shape, update in (("uGIMP", "USF"), ("linear", "MUSL"), ("quadraticBSpline", "MUSL"), ("quadraticBSpline", "USL")):
    kept[shape, update, 40] = collide(40, shape, update)
for transfer in ("XPIC; order 2", "XPIC; order 5", "FMPM; order 5", "APIC", "TPIC"):
    kept[transfer] = collide(40, "uGIMP", "MUSL", transfer)
for shape in ("uGIMP", "cpGIMP"):
    case.check(f"energy kept, 32 cells ({shape}, MUSL)", kept[shape, "MUSL", 80], ">=", 0.99)
loss = [1 - kept["uGIMP", "USL", n] for n in (20, 40, 80)]
case.check("energy lost, 32 cells (uGIMP, USL)", loss[-1], "<=", 0.03)
case.check("largest ratio of losses, cells h/2 to h (uGIMP, USL)", max(loss[1] / loss[0], loss[2] / loss[1]), "<=", 0.8)
case.table("", ["shape", "update", "transfer", "cells in the diameter", "least kinetic energy", "kinetic energy after 3 s",
                "share of motion as wholes", "energy kept"], rows)
case.finish()

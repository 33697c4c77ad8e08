"""A column under its K0 stress between smooth walls, for 100,000 steps.
Measured: the largest velocity and displacement of a particle and how far any stress component drifts, in soil without
and with dilation and in elastic soil, with and without treatments of the stresses.
Pass: it stays at rest at round-off: velocities below 1e-9 m/s, displacements below 1e-9 H, stresses within 1e-9 of
rho g H, no plastic work and no energy from or to a treatment, with every treatment and law."""
import numpy as np
from verification import Number, Verification, treatment

NAMES = ("plain", "automatic")
COLUMNS = ((8.0, "soil"), (8.0, "dilatantSoil"), (7.6, "elastic"))  # 7.6 m: the surface halves a cell
STEPS, DT, H, SCALE = 100_000, 2e-3, 8.0, 1000 * 9.8 * 8.0

case = Verification(__file__, __doc__)


def rest(height, law, word):
    run = case.solve(f"{law}-{height:g}-{len(rows)}", ("geometry/column.geo", "height", f"= {height}"),
                     ("system/seedParticlesDict", "soil", f"{{ material {law}; }}"), treatment(word), exits=None)
    if case.require(run).exit != 0:
        rows.append([f"{height:g}", law, word, "stopped", "-", "-"])
        return
    first, last, history, budget = run.state(0), run.state(), run.series(), run.series("energyBudget")
    tag = f"({height:g} m, {law}, {word})"
    case.check(f"steps {tag}", last.attributes["step"], "==", STEPS)
    # Velocities of all rows, by their energy: no particle is faster than if it held all of it.
    speed = max(np.abs(last["velocity"]).max(), np.sqrt(2 * history["kineticEnergy"].max() / last["mass"].min()))
    moved = np.abs(last.by_id("position") - first.by_id("position")).max() / H
    drift = np.abs(last.by_id("stress") - first.by_id("stress")).max() / SCALE
    case.check(f"largest velocity {tag}", speed, "<", 1e-9, "m/s")
    case.check(f"displacement over H {tag}", moved, "<", 1e-9)
    case.check(f"drift of stress over rho g H {tag}", drift, "<", 1e-9)
    scale = SCALE * H * 0.8
    for name in ("plasticDissipation", "relaxationLoss", "averagingLoss", "viscosityLoss", "gapWork"):
        if name in budget.dtype.names:
            case.check(f"{name} over rho g H^2 {tag}", np.abs(budget[name]).max() / scale, "<=", 1e-14)
    rows.append([f"{height:g}", law, word, *[Number(value, ".0e", 10, floor=1e-10) for value in (speed, moved, drift)]])


rows = []
for height, law in COLUMNS:
    for word in NAMES:
        rest(height, law, word)
case.table("", ["height [m]", "law", "treatment", "largest velocity [m/s]", "displacement over H", "drift of stress over rho g H"], rows)
case.finish()

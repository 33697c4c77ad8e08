"""A smooth wall pushed into a block of soil under a surcharge, and one pulled away.
Measured: force of the soil on the wall over its height, and the mean horizontal stress, against Rankine's limits.
Pass: within 3 % of K_p q + 2 c sqrt(K_p) and of K_a q - 2 c sqrt(K_a) once the soil yields; the energy budget closes."""
import math

import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
PHI, C, Q, HEIGHT = math.radians(30), 5e3, 100e3, 1.0625
K_A = math.tan(math.pi / 4 - PHI / 2) ** 2
LIMIT = {"active": K_A * Q - 2 * C * math.sqrt(K_A), "passive": Q / K_A + 2 * C / math.sqrt(K_A)}
SPEED, END = {"active": -0.02, "passive": 0.05}, {"active": 0.6, "passive": 1.0}
rows = []
for kind, limit in LIMIT.items():
    run = case.solve(kind, ("constant/boundaryConditions", "velocity", f"table ((0 (0 0 0)) (0.1 ({SPEED[kind]} 0 0)))"),
                     ("system/controlDict", "endTime", END[kind]), ("system/controlDict", "writeInterval", END[kind]))
    wall, history, budget = run.series("face"), run.series(), run.series("energyBudget")
    late = wall["time"] > 0.8 * END[kind]
    state = run.state()
    # the soil rises beside a wall that pushes: its height now
    x, F = state["position"], state["deformationGradient"]
    top = x[x[:, 0] < 0.5, 1].max() + 0.03125
    pressure = -wall["forceX"][late].mean() / top
    stress = -(state["stress"][:, 0] * state["volume"]).sum() / state["volume"].sum()
    work = abs(budget["motionWork"]).max()
    case.check(f"force on the wall over Rankine's, - 1 ({kind})", abs(pressure / limit - 1), "<=", 0.03)
    case.check(f"mean horizontal stress over Rankine's, - 1 ({kind})", abs(stress / limit - 1), "<=", 0.03)
    case.check(f"energy residual ({kind})", np.abs(history["residual"]).max() / work, "<=", 1e-9)
    rows.append([kind, f"{limit / 1e3:.2f}", Number(pressure / limit, ".3f", 0, 0.005), Number(stress / limit, ".3f", 0, 0.005)])
case.table("", ["limit", "Rankine [kPa]", "force on the wall over it", "mean stress over it"], rows)
case.finish()

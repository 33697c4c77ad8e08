"""A pulse in an elastic strip with absorbing ends, of pressure and of shear waves.
Measured: energy left in the strip after both halves of the pulse have met an end, over the energy at the start; the same
with dashpots of twice the impedance.
Pass: less than 1 % of the energy comes back at normal incidence; a dashpot of twice the impedance sends back 1/9; the
energy budget closes to round-off."""
import numpy as np
from verification import Number, Verification

case = Verification(__file__, __doc__)
RHO, E, NU = 2000.0, 20e6, 0.3
C = {"pressure": np.sqrt(E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) / RHO), "shear": np.sqrt(E / (2 * (1 + NU)) / RHO)}
PULSE = '"1e-3*exp(-(X - 5)^2/(2*R^2))"'
rows = []


def left_over(kind, share):
    """Both halves of the pulse run 5 m to an end, what is reflected another 3 m."""
    velocity = f"({PULSE} 0 0)" if kind == "pressure" else f"(0 {PULSE} 0)"
    end = 8 / C[kind]
    run = case.seed(f"{kind}-{share:g}", ("constant/materialProperties", "initialVelocity", velocity),
                    ("system/controlDict", "endTime", repr(end)), ("system/controlDict", "writeInterval", repr(end)))
    run.set("constant/boundaryConditions", "share", share)
    case.require(run.utility("mpmSolve", threads=1))
    history, budget = run.series(), run.series("energyBudget")
    energy = history["kineticEnergy"] + history["strainEnergy"]
    case.check(f"energy residual ({kind}, {share:g})", np.abs(history["residual"]).max() / energy[0], "<=", 1e-11)
    return energy[-1] / energy[0], budget["absorbedEnergy"][-1] / energy[0]


for kind in C:
    left, absorbed = left_over(kind, 1)
    case.check(f"energy that comes back ({kind} waves)", left, "<=", 0.01)
    twice, _ = left_over(kind, 2)
    case.check(f"energy a dashpot of twice the impedance sends back, over 1/9, - 1 ({kind} waves)", abs(9 * twice - 1), "<=", 0.03)
    rows.append([kind, Number(left, ".1e", 0.1, 0, 1e-6), Number(absorbed, ".4f", 0, 1e-3), Number(twice, ".4f", 0, 2e-3)])
case.table("", ["waves", "energy left", "energy absorbed", "left with twice the impedance (1/9 = 0.1111)"], rows)
case.finish()

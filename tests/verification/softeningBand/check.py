"""A layer of clay slides over its base until strength, falling along the slip, has stopped it.
Measured: slip, dissipation, and the energy the fall of strength took, against the cell size, with the softening scaled
by the cell size and without (referenceLength = cellSize).
Pass: slip shears one row of cells; dissipation less residual strength times slip is that of the closed form within 12, 8
and 5 % for cells of 200, 100 and 50 mm, the slips of the last two agree within 8 %; without the scaling that energy halves with
the cell, and the slip of 50 mm is more than three times that of 200 mm. The energy budget closes to round-off."""
import numpy as np
from verification import Number, Verification, displacements

case = Verification(__file__, __doc__)
PEAK, RESIDUAL, OVER, LENGTH = 10e3, 2e3, 0.23094010767585033, 0.1  # [Pa], [-], [m]
KINETIC = 0.5 * 2000 * 2 * 0.2  # [J/m^2]
rows = []


def slide(h, reference):
    run = case.solve(f"{h}-{reference}", ("geometry/layer.geo", "width", f"= {h!r}"), ("system/gridDict", "cellSize", h),
                     ("system/controlDict", "deltaT", repr(h / 200)),
                     ("constant/materialProperties", "referenceLength", reference))
    X, states = displacements(run)
    Y = X[:, 1]
    top = Y > Y.max() - 1e-9
    slip = np.unwrap([0 * X[top, 0]] + [u[top, 0] for _, u in states], period=h, axis=0)[-1].mean()  # comes round
    last = run.state()
    history = run.series()
    dissipated = history["plasticDissipation"][-1] / h  # of a square metre
    excess = dissipated - RESIDUAL * slip
    triangle = 0.5 * (PEAK - RESIDUAL) * np.sqrt(3) * OVER * reference  # (c_p - c_r)/2 times the slip to the residual
    kappa = last.by_id("plasticStrain")
    in_band = kappa[Y < h].min() / kappa[Y > h].max()
    tag = f" ({h * 1e3:g} mm, referenceLength {reference * 1e3:g} mm)"
    print(f"      slip {slip:.4f} m, dissipation {dissipated:.1f} J/m^2, above the residual {excess:.1f}, closed form "
          f"{triangle:.1f}; kappa in the band over that outside {in_band:.1f}{tag}")
    case.check("kappa in the lowest row of cells over that above" + tag, in_band, ">=", 8)
    case.check("energy residual" + tag, np.abs(history["residual"]).max() / h / KINETIC, "<=", 1e-12)
    case.check("kinetic energy left" + tag, history["kineticEnergy"][-1] / h / KINETIC, "<=", 0.05)
    rows.append(["yes" if reference == LENGTH else "no", f"{h * 1e3:g}", f"{reference * 1e3:g}", Number(slip, ".4f"),
                 Number(dissipated, ".0f"), Number(excess, ".0f"), f"{triangle:.0f}"])
    return slip, excess / triangle, excess


scaled = {h: slide(h, LENGTH) for h in (0.2, 0.1, 0.05)}
plain = {h: slide(h, h) for h in (0.2, 0.05)}
for (h, (_, share, _)), bound in zip(scaled.items(), (0.12, 0.08, 0.05), strict=True):
    case.check(f"energy above the residual over the closed form, less 1 ({h * 1e3:g} mm)", abs(share - 1), "<=", bound)
case.check("slip with 50 mm over that with 100 mm", abs(scaled[0.05][0] / scaled[0.1][0] - 1), "<=", 0.08)
case.check("the same energy without scaling, 200 mm over 50 mm", plain[0.2][2] / plain[0.05][2], ">=", 3)
case.check("slip without scaling, 50 mm over 200 mm", plain[0.05][0] / plain[0.2][0], ">=", 3)
case.table("", ["scaled by the cell", "cell [mm]", "referenceLength [mm]", "slip [m]", "dissipation [J/m^2]",
                "less residual strength times slip [J/m^2]", "closed form [J/m^2]"], rows)
case.finish()

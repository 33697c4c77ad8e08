"""A plate thinner than a cell that falls through the grid while waves run along it.
Hard: its particles are flat, its nodes carry little mass, and each row of nodes hands over to the next as it falls.
Pass: mass exact; it falls as the sum of the scheme and its waves are those of a plate as thick as a cell, to round-off; the end swings to twice its static displacement at t = 2 L/c."""
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
g, length, c, dt, geometry = 9.8, 4.0, np.sqrt(4e6 / 1000), 1e-3, "geometry/plate.geo"
# bottom and thickness; cells are 0.5 m, so that some lie across a row of nodes
VARIANTS = {"asThickAsACell": ("5.0", "0.5"), "tenthInside": ("5.1", "0.05"), "tenthAcross": ("4.98", "0.05"),
            "tenthOnTop": ("5.0", "0.05"), "hundredth": ("5.24", "0.005"), "tenThousandth": ("5.24", "5e-5")}
axial = {}
for shape in ("uGIMP", "linear", "cpGIMP", "quadraticBSpline"):
    for name, (bottom, thickness) in VARIANTS.items():
        if shape not in ("uGIMP", "linear") and name != "hundredth" and name != "asThickAsACell":
            continue
        run = case.solve(f"{shape}-{name}", (geometry, "bottom", f"= {bottom}"), (geometry, "thickness", f"= {thickness}"),
                         ("system/mpmSchemes", "shape", shape))
        case.common(run)
        first, last = run.state(0), run.state()
        tag = f" ({run.folder.name})"
        mass = 1000 * length * float(thickness)
        roundOff = 4 * np.finfo(float).eps * (1 + float(bottom) / float(thickness))  # of the corners' coordinates
        case.check("mass over rho L d, - 1" + tag, abs(first["mass"].sum() / mass - 1), "<=", roundOff)
        n = int(last.attributes["step"])
        fallen = last.by_id("position")[:, 1] - first.by_id("position")[:, 1]
        case.check("error of the fall" + tag, np.abs(fallen + g * dt**2 * n * (n + 1) / 2).max(), "<=", 1e-11, "m")
        history = run.series()
        x0, x = first.by_id("position")[:, 0], last.by_id("position")[:, 0]
        column = dict(zip(x0.round(9), x - x0))
        reach = history["maxX"] - history["maxX"][0]
        axial.setdefault(shape, (column, reach))
        scale = np.abs(axial[shape][1]).max()
        worst = max(abs(column[x] - axial[shape][0][x]) for x in axial[shape][0])
        case.check("difference of the displacements to those of the thick plate over the largest" + tag, worst / scale, "<=", 1e-10)
        if name == "asThickAsACell":
            end = length - 0.125  # the last particles' place; static displacement g (L x - x^2/2)/c^2
            twice = 2 * g * (length * end - end**2 / 2) / c**2
            peak = np.argmax(reach[: int(4 * length / c / dt) + 1])
            case.check("largest displacement of the end over twice the static one, - 1" + tag, abs(reach[peak] / twice - 1), "<=", 0.03)
            case.check("time of it over 2 L/c, - 1" + tag, abs(history["time"][peak] / (2 * length / c) - 1), "<=", 0.03)
case.finish()

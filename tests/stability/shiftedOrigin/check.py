"""A block that slides and bounces, moved away from the origin by 64 cells and by a million.
Hard: a coordinate of a million cells leaves six digits fewer for the place within the cell.
Pass: moved by a power of two of cells, results differ by round-off of the positions alone; the difference of
positions, velocities and stresses never exceeds eps x/h a step, summed over the steps."""
import numpy as np
from hardCase import HardCase

H, WIDE = 0.25, 6.0
EPS = np.finfo(float).eps
case = HardCase(__file__, __doc__)
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    runs = {}
    for cells in (0, 64, 2**20, 10**6):
        origin = cells * H
        runs[cells] = case.solve(f"{shape}-{cells}", ("system/mpmSchemes", "shape", shape),
                                 ("geometry/block.geo", "x0", f"= {origin!r}"),
                                 ("system/gridDict", "min", f"({origin - 2!r} -0.5 0)"),
                                 ("system/gridDict", "max", f"({origin - 2 + WIDE!r} 4 0)"))
    case.common(runs[10**6])
    case.nothing_gained(runs[10**6])
    reference = runs[0].state()
    steps = int(reference.attributes["step"])
    for cells in (64, 2**20, 10**6):
        moved = runs[cells].state()
        bound = steps * EPS * (cells + WIDE / H)
        shift = np.array([cells * H, 0])
        far = np.abs(moved.by_id("position") - shift - reference.by_id("position")).max()
        differences = {"position over h": far / H}
        for field in ("velocity", "stress"):
            largest = np.abs(reference[field]).max()
            differences[field] = np.abs(moved.by_id(field) - reference.by_id(field)).max() / largest
        for field, value in differences.items():
            case.check(f"difference of {field} over eps x/h a step ({shape}, {cells} cells)", value / bound, "<=", 1)
case.finish()

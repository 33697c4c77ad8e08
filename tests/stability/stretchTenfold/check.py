"""A bar stretched to ten times its length.
Hard: once particles are further apart than a cell they no longer share nodes, and the body tears although the
material does not (numerical fracture).
Pass: with splitting no gap along the bar is wider than a cell and mass is exact; without splitting the gap is
there, and the summary of the run says so. (The stretch single particles know of is recorded: it scatters about
ten.)"""
import re
import numpy as np
from hardCase import HardCase, record, set_fields

case = HardCase(__file__, __doc__)
h = 0.5
for shape in ("uGIMP", "cpGIMP", "linear", "quadraticBSpline"):
    for splitting in (True, False):
        run = case.copy(shape + ("Split" if splitting else "Whole"), ("system/mpmSchemes", "shape", shape))
        if not splitting:
            schemes = run.folder / "system/mpmSchemes"
            schemes.write_text(schemes.read_text().split("splitting")[0])
        if shape == "linear":  # its limit falls fastest with speed
            run.set("system/controlDict", "deltaT", 0.004)
        run.utility("seedParticles")
        set_fields(run, velocity=lambda x: np.stack([x[:, 0], 0 * x[:, 0]], axis=1))
        run.utility("mpmSolve")
        tag = f"({run.folder.name})"
        case.check(f"exit code {tag}", run.exit, "==", 0)
        case.common(run)
        last = run.state()
        gap = np.diff(np.sort(last["position"][:, 0])).max() / h
        middle = np.abs(last["position"][:, 0]) < 20
        stretch = last["deformationGradient"][middle][:, 0, 0]
        case.check(f"length over length at the start {tag}", np.ptp(last["position"][:, 0]) / 7.75, ">=", 10)
        if splitting:
            case.check(f"widest gap in cells {tag}", gap, "<=", 1)
            record(case, f"least stretch the particles know of {tag}", stretch.min())
            record(case, f"largest stretch the particles know of {tag}", stretch.max())
        else:
            case.check(f"widest gap in cells {tag}", gap, ">", 1)
            record(case, f"largest stretch the particles know of {tag}", stretch.max())
            case.check(f"summary warns of numerical fracture {tag}", len(re.findall("(?i)note.*(cells|fracture)", run.log)),
                       ">=", 1)
case.finish()

"""A pressure on the end of a bar that flies through the grid.
Hard: the loaded surface moves through 20 cells, its nodes change, and it must stay on the material.
Pass: momentum m v + p A t to round-off; the load's work is p A times the surface's way; but for hat functions the end moves at p/(rho c) beside the flight until the wave is back, and the wave is within a cell of c t."""
import h5py
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
p, rho, E, v0, length, width = 1e3, 1000, 1e6, 12, 4, 0.125
c = np.sqrt(E / rho)
for shape in ("uGIMP", "cpGIMP", "quadraticBSpline", "linear"):
    run = case.solve(shape, ("system/mpmSchemes", "shape", shape))
    case.common(run)
    history, tag = run.series(), f" ({shape})"
    t = history["time"]
    momentum = rho * length * width * v0 - p * width * t
    case.check("largest error of the momentum over that of the load" + tag,
               np.abs(history["momentumY"] - momentum).max() / (p * width * t[-1]), "<=", 1e-12)
    case.check("momentum across over that of the load" + tag, np.abs(history["momentumX"]).max() / (p * width * t[-1]), "<=", 1e-12)
    way = []
    for name in run.times():
        with h5py.File(run.folder / name / "state.h5") as file:
            way.append(file["patches/top/centre"][0, 1])
    way, times = np.array(way) - way[0], np.array([run.state(n).time for n in run.times()])
    work = float(run.state().ledger["tractionWork"])
    case.check("work over p A times the surface's way, - 1" + tag, abs(work / (-p * width * way[-1]) - 1), "<=", 1e-3)
    # the end of a free bar, while the wave is not back
    beside = way - v0 * times + p / (rho * c) * times
    if shape == "linear":  # its stress jumps where particles change cells: what is exact is checked above
        continue
    case.check("error of the surface's place over p t/(rho c)" + tag, np.abs(beside).max() / (p / (rho * c) * times[-1]), "<=", 0.03)
    early = run.state("0.06")
    x0, stress, volume = run.state(0).by_id("position")[:, 1], early.by_id("stress")[:, 1], early.by_id("volume")
    carried = -(stress * volume).sum() / (p * width * c * 0.06)
    case.check("length under stress less c t, over the cell size" + tag, abs(carried - 1) * c * 0.06 / width, "<=", 1)
    front = 6 - x0[stress < -p / 2].min()
    case.check("distance of the front from c t over the cell size" + tag, abs(front - c * 0.06) / width, "<=", 1)
case.finish()

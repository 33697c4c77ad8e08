"""Two materials in one column, one a million times as stiff as the other.
Hard: waves are a thousand times faster in one; strains that the grid smears over the interface mean huge stresses there.
Pass: the limit of the time step is the stiffer one's; from no stress, damped to rest, every layer carries the weight above it within 1 %. With uGIMP under a stiff layer that settles the two cells beside the interface are left out."""
import re

import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
rho, gravity, height, h = 100, 10, 2, 0.25
for name, shape, soft, stiff in (("stiffOnSoft", "linear", "1e7", "1e13"), ("softOnStiff", "linear", "1e13", "1e7"),
                                 ("softOnStiffGIMP", "uGIMP", "1e13", "1e7"), ("stiffOnSoftGIMP", "uGIMP", "1e7", "1e13")):
    run = case.seed(name, ("system/mpmSchemes", "shape", shape))
    text = (run.folder / "constant/materialProperties").read_text()
    text = text.replace("1e13", "STIFF").replace("1e7", soft).replace("STIFF", stiff)
    (run.folder / "constant/materialProperties").write_text(text)
    run.utility("mpmSolve")
    case.check(f"exit code ({name})", run.exit, "==", 0)
    case.common(run)
    limit = float(re.search(r"deltaT <= (\S+) s", run.log)[1])
    courant = 0.85 if shape == "linear" else 1.2
    case.check(f"limit of the time step over that of the stiffer one, - 1 ({name})",
               abs(limit / (courant * h / np.sqrt(1e13 / rho)) - 1), "<=", 0.01)  # printed with four digits
    first, last = run.state(0), run.state()
    y, stress = first.by_id("position")[:, 1], last.by_id("stress")[:, 1]
    layer = np.floor(y / h).astype(int)
    layers = np.unique(layer)
    mean = np.array([stress[layer == k].mean() for k in layers])
    weight = rho * gravity * (height - (layers + 0.5) * h)
    # Once the interface has settled by u, domains of the stiff particles on it reach over it by u/h and see that much of the
    # soft cell's strain: E_stiff u/h times it is a hundred times the weight. The sum of the forces stays right.
    settles = name == "stiffOnSoftGIMP"
    clear = np.abs((layers + 0.5) * h - 1) > (h if settles else 0)
    case.check(f"layers ({name})", clear.sum(), "==", 6 if settles else 8)
    case.check(f"largest |sigma_yy of a layer/weight above - 1| ({name})", np.abs(mean / -weight - 1)[clear].max(), "<=", 0.01)
    if not settles:
        # inside a cell sigma_yy is constant: a particle a quarter cell from the middle differs by rho g h/4
        exact = -rho * gravity * (height - y)
        case.check(f"largest error of a particle over rho g h ({name})", np.abs(stress - exact).max() / (rho * gravity * h), "<=", 0.3)
    case.check(f"kinetic over strain energy at the end ({name})", run.series()["kineticEnergy"][-1] / run.series()["strainEnergy"][-1],
               "<=", 1e-6)
case.finish()

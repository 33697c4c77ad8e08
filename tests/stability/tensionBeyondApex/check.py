"""Soil without dilation pulled apart in all directions.
Hard: at dilation angle 0 the flow rule has no answer once the mean tension passes c cot(phi); a return map must
choose, keep to what it chose, and say how often it did.
Pass: the run ends in the steps it should take; the counter of apex returns is above 0, the mean tension stays at c
cot(phi) to 1e-9, and the volume dropped at the apex is the growth of the body's volume less the elastic part,
within 0.1 %; the energy residual is under 2 % of the plastic work."""
import math
import numpy as np
from hardCase import HardCase, pressure, schemes, set_fields

case = HardCase(__file__, __doc__)
K, apex = 20e6 / 3 / (1 - 2 * 0.42), 1e3 / math.tan(math.radians(42))
SOLID = [("system/gridDict", "dimension", 3), ("system/gridDict", "min", "(-5 -5 -5)"), ("system/gridDict", "max", "(5 5 5)"),
         ("system/seedParticlesDict", "geometry", '"geometry/solid.geo"')]
for dimension, shape, update in ((2, "linear", "USL"), (2, "uGIMP", "MUSL"), (2, "cpGIMP", "USF"),
                                 (2, "quadraticBSpline", "MUSL"), (3, "uGIMP", "MUSL")):
    run = case.seed(f"{shape}{update}{dimension}D", *schemes(shape, update), *(SOLID if dimension == 3 else []))
    set_fields(run, velocity=lambda x: x)
    run.utility("mpmSolve")
    tag = f"({run.folder.name})"
    case.check(f"exit code {tag}", run.exit, "==", 0)
    case.common(run)
    first, last, history = run.state(0), run.state(), run.series()
    case.check(f"steps {tag}", int(last.attributes["step"]), "==", 1000)
    case.check(f"apex returns {tag}", history["apexReturns"][-1], ">", 0)
    tension = -pressure(last["stress"])
    case.check(f"mean tension over c cot(phi) {tag}", tension.max() / apex, "<=", 1 + 1e-9)
    # Volume grows by J - 1 per particle; ln J = elastic p/K + dropped at the apex; the sum of V dlnJ is the growth.
    growth = last["volume"].sum() - first["volume"].sum()
    elastic = (last["volume"] * tension / K).sum()
    case.check(f"error of the dropped volume {tag}", abs(history["apexVolume"][-1] / (growth - elastic) - 1), "<=", 1e-3)
    # The common check compares the budget with a kinetic energy a million times the plastic work; here with the latter.
    dissipated = history["plasticDissipation"][-1]
    case.check(f"energy residual over plastic work {tag}", np.abs(history["residual"]).max() / dissipated, "<=", 0.02)
case.finish()

"""Undrained clay (friction angle 0) sheared under a mean tension of a million times its cohesion.
Hard: c cot(phi) is infinite, there is no apex to return to; a return map that divides by k - 1 or looks for an apex
breaks, and round-off of the mean stress must not eat the strength.
Pass: particles yield and none is sent to an apex; plastic flow leaves the mean stress alone: p = p0 - K ln J for
every particle to 1e-12 of p0."""
import numpy as np
from hardCase import HardCase, pressure, schemes, set_fields

case = HardCase(__file__, __doc__)
K = 20e9 / 3 / (1 - 2 * 0.3)


def shearWave(x):
    v = 0 * x
    v[:, 0], v[:, 1] = 0.05 * np.cos(np.pi * x[:, 1] / 4), 0.03 * np.cos(np.pi * x[:, 0] / 2)
    return v


for dimension, shape, update in ((2, "linear", "USL"), (2, "uGIMP", "MUSL"), (2, "cpGIMP", "USF"),
                                 (2, "quadraticBSpline", "MUSL"), (3, "uGIMP", "MUSL")):
    changes = [*schemes(shape, update),
               ("system/gridDict", "dimension", dimension)]
    if dimension == 3:
        changes += [("system/gridDict", "min", "(-1 -1 -1)"), ("system/gridDict", "max", "(5 5 3)"),
                    ("system/seedParticlesDict", "geometry", '"geometry/solid.geo"')]
    run = case.seed(f"{shape}{update}{dimension}D", *changes)
    tag = f"({run.folder.name})"
    if dimension == 3:
        walls = run.folder / "constant/boundaryConditions"
        walls.write_text(walls.read_text() + "\nback   { type roller; plane { normal (0 0 -1); position 0; } }"
                                             "\nfront  { type roller; plane { normal (0 0 1);  position 2; } }\n")
    set_fields(run, velocity=shearWave)
    run.utility("mpmSolve")
    case.check(f"exit code {tag}", run.exit, "==", 0)
    # The walls hold 1e9 Pa on faces of 4 m (4 x 2 m) for 0.012 s.
    case.common(run, impulse=1e9 * (4 if dimension == 2 else 8) * 0.012)
    history, last = run.series(), run.state()
    case.check(f"plastic work over the kinetic energy at the start {tag}",
               history["plasticDissipation"][-1] / history["kineticEnergy"][0], ">", 0.1)
    case.check(f"apex returns {tag}", history["apexReturns"][-1], "==", 0)
    J = np.linalg.det(last["deformationGradient"])
    change = pressure(last["stress"]) + 1e9 + K * np.log(J)
    case.check(f"error of the mean stress {tag}", np.abs(change).max() / 1e9, "<=", 1e-12)
    kinetic = history["kineticEnergy"]
    case.check(f"largest kinetic energy over that at the start {tag}", kinetic.max() / kinetic[0], "<=", 1.001)
case.finish()

"""A bar that flies against a wall at the speed of its own pressure wave, and at three times that.
Hard: material arrives faster than any wave can carry the news away; with fixed steps particles cross up to two cells
a step and the shock squeezes them to a few per cent of their volume.
Pass: no particle is turned inside out (det F > 0 in every state); with adjustTimeStep the run finishes within its
energy budget; with a fixed step it does the same, or is refused or stopped with an error that says why."""
import numpy as np
from hardCase import HardCase

WAVE = np.sqrt(1e7 * 0.75 / (1.25 * 0.5) / 1000)  # c_p of E 1e7, nu 0.25, density 1000 [m/s]
case = HardCase(__file__, __doc__)
for mach in (1, 3):
    for adjust in ("yes", "no"):
        for shape in ("uGIMP", "cpGIMP"):
            name = f"mach{mach}-{'adjusted' if adjust == 'yes' else 'fixed'}-{shape}"
            end = 6 / (mach * WAVE)  # the bar is 4 m long and 1 m away
            run = case.copy(name, ("constant/materialProperties", "initialVelocity", f"({-mach * WAVE} 0 0)"),
                            ("system/mpmSchemes", "shape", shape), ("system/controlDict", "adjustTimeStep", adjust),
                            ("system/controlDict", "endTime", end), ("system/controlDict", "writeInterval", end / 10),
                            ("system/controlDict", "deltaT", 0.5 * 0.25 / WAVE))
            run.utility("seedParticles").utility("mpmSolve")
            volumes = [np.linalg.det(run.state(time)["deformationGradient"]) for time in run.times()]
            case.check(f"smallest det F stored ({name})", min(v.min() for v in volumes), ">", 0)
            said = {1: "adjustTimeStep yes", 2: "come from nowhere"}.get(run.exit)
            if adjust == "no" and said:
                case.check(f"the solver {'refused' if run.exit == 1 else 'stopped'} and said why ({name})",
                           float("error:" in run.log and said in run.log), "==", 1)
                continue
            case.require(run)
            case.common(run)
            case.nothing_gained(run)
            case.check(f"det F squeezed to ({name})", min(v.min() for v in volumes), "<", 0.5)
case.finish()

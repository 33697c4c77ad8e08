"""Time steps of 0.9, 1, 1.1 and 2 times the stability limit.
Hard: an explicit step beyond its limit grows by a factor each step; soon after, every number is wrong or none is left.
Pass: up to the limit a quivering elastic block keeps its energy; beyond it the run is refused with the largest step that
is allowed; a run that is there all the same (a restart with the step it had) is stopped within 60 steps with exit code
2, or says so and goes on where the dictionary asks for that, and no stored state holds what has grown."""
import re

import h5py
import numpy as np
from hardCase import HardCase, schemes, set_fields

case = HardCase(__file__, __doc__)
CONTROL = "system/controlDict"


def quiver(x):
    return 0.01 * np.stack([np.sin(9 * x[:, 0] + 4 * x[:, 1]), np.cos(7 * x[:, 0] - 5 * x[:, 1])], axis=1)


for update in ("USL", "MUSL", "USF"):
    for shape in ("linear", "uGIMP", "quadraticBSpline"):
        run = case.seed(f"{shape}{update}", *schemes(shape, update))
        set_fields(run, velocity=quiver)
        run.utility("mpmSolve", "-dry-run")
        limit = float(re.search(r"stability +deltaT <= (\S+) s", run.log)[1])
        for share in (0.9, 1.0, 1.1, 2.0):
            name = f"{shape}{update}{share}"
            delta_t = share * limit * (1 - 1e-3)  # the limit is printed with four digits
            run = case.seed(name, *schemes(shape, update), (CONTROL, "deltaT", repr(delta_t)),
                            (CONTROL, "endTime", repr(400 * delta_t)), (CONTROL, "writeInterval", repr(100 * delta_t)))
            set_fields(run, velocity=quiver)
            run.utility("mpmSolve")
            if share <= 1:
                case.check(f"exit code ({name})", run.exit, "==", 0)
                case.common(run)
                case.check(f"kinetic over initial energy ({name})",
                           run.series()["kineticEnergy"].max() / run.series()["kineticEnergy"][0], "<=", 1.1)
            else:
                case.check(f"exit code, refused ({name})", run.exit, "==", 1)
                allowed = re.search(r"allowed: at most (\S+) s", run.log)
                case.check(f"allowed step over the limit ({name})", float(allowed[1]) / limit if allowed else 0.0, ">=", 0.999)

# A run that has this step already: what a restart of a run does whose limit has fallen meanwhile.
for action in ("stop", "warn"):
    run = case.seed(f"beyond-{action}", (CONTROL, "deltaT", "0.02"), (CONTROL, "endTime", "8"),
                    (CONTROL, "writeInterval", "0.2"))
    set_fields(run, velocity=quiver)
    with h5py.File(run.folder / "0" / "state.h5", "r+") as file:
        file.attrs["deltaT"], file.attrs["step"] = 0.02, np.int64(1)
        first = 0.5 * (file["particles/mass"][:][:, None] * file["particles/velocity"][:]**2).sum()
        for entry in ("kineticEnergy", "initialKineticEnergy"):
            file[f"ledger/{entry}"][...] = first
        file["ledger/initialMomentum"][:2] = (file["particles/mass"][:][:, None] * file["particles/velocity"][:]).sum(axis=0)
    with open(run.folder / CONTROL, "a") as text:
        text.write(f"monitor {{ action {action}; }}\n")
    run.utility("mpmSolve")
    found = re.search(r"step (\d+) at time \S+ s: .*come from nowhere", run.log)
    case.check(f"steps until it is found ({action})", int(found[1]) if found else 10**9, "<=", 60)
    case.check(f"exit code ({action})", run.exit, "==" if action == "stop" else "<=", 2)
    if action == "stop":
        last = run.state()
        stored = 0.5 * (last["mass"][:, None] * last["velocity"]**2).sum()
        case.check("kinetic energy of the last stored state over the first", stored / first, "<=", 1.3)
        case.check("the last stored time is named", f"the last stored time is {run.times()[-1]}" in run.log, "==", True)
case.finish()

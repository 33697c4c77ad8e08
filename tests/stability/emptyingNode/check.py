"""A vibrating bar whose last particles barely reach over the end of a cell.
Hard: the outermost nodes carry a hundred-thousandth of the mass of the others; a force divided by so little mass is a
huge acceleration, and explicit schemes lose stability at any step of practical size.
Pass: at c_p dt/h = 0.5 all shapes with MUSL and USF, and at 0.3 GIMP and splines with USL, vibrate for 5000 steps
without gaining energy; linear USL is refused before the first step by a message that names the limit, or stopped by
one that says why if the nodes empty on the way; with adjustTimeStep it takes the small steps it needs."""
import re
import numpy as np
from hardCase import HardCase, log_number, schemes, set_fields

case = HardCase(__file__, __doc__)
h, c_p = 0.5, np.sqrt(20e6 * 0.7 / 1.3 / 0.4 / 1000)
SHIFT = 0.25001 * h


def shifted(x):
    return x + [SHIFT, 0]


def vibration(x):
    """The first mode of the free bar, too small for particles to move out of their places (1e-7 h)."""
    return np.stack([1e-7 * c_p * np.cos(np.pi * (x[:, 0] - 2) / 8), 0 * x[:, 0]], axis=1)


def run_case(name, *changes, velocity=vibration, position=shifted, courant=0.5):
    run = case.seed(name, ("system/controlDict", "deltaT", repr(courant * h / c_p)), *changes)
    set_fields(run, velocity=velocity, position=position)
    return run.utility("mpmSolve")


def energy_growth(run):
    """Mean energy of the last ten periods over that of the first ten. (Single values swing by omega dt/2 = 5 % to either
    side and back, as the scheme keeps stress and velocity half a step apart.)"""
    history = run.series()
    energy, n = history["kineticEnergy"] + history["strainEnergy"], 64
    return energy[-n - 1:-1].mean() / energy[:n].mean()


for shape, update in (("linear", "MUSL"), ("linear", "USF"), ("uGIMP", "MUSL"), ("uGIMP", "USL"), ("uGIMP", "USF"),
                      ("cpGIMP", "USL"), ("quadraticBSpline", "USL"), ("quadraticBSpline", "MUSL")):
    courant = 0.3 if update == "USL" else 0.5
    end = repr(5000.1 * courant * h / c_p)
    run = run_case(shape + update, *schemes(shape, update), ("system/controlDict", "endTime", end),
                   ("system/controlDict", "writeInterval", end), courant=courant)
    tag = f"({run.folder.name})"
    case.check(f"exit code {tag}", run.exit, "==", 0)
    case.common(run)
    case.check(f"steps {tag}", int(run.state().attributes["step"]), ">=", 5000)
    case.check(f"energy at the end over that at the start {tag}", energy_growth(run), "<=", 1.001)

run = run_case("linearUSL", *schemes("linear", "USL"))
case.check("exit code (linearUSL)", run.exit, "==", 1)
case.check("times stored beside 0 (linearUSL)", len(run.times()) - 1, "==", 0)
named = len(re.findall(r"deltaT: found .* allowed: at most", run.log))
case.check("messages that name the limit (linearUSL)", named, "==", 1)
case.check("largest c_p deltaT/h it allows (linearUSL)", log_number(run, r"at most (\S+) s") * c_p / h, "<", 0.14)

# Adapted, it may go on, in the small steps it needs.
run = run_case("linearUSLadapted", *schemes("linear", "USL"), ("system/controlDict", "adjustTimeStep", "yes"),
               ("system/controlDict", "endTime", "1e-2"), ("system/controlDict", "writeInterval", "1e-2"))
case.check("exit code (linearUSLadapted)", run.exit, "==", 0)
case.common(run)
history = run.series()
energy = history["kineticEnergy"] + history["strainEnergy"]
case.check("largest energy over that at the start (linearUSLadapted)", energy.max() / energy[0], "<=", 1.02)

# Nodes empty on the way: the step is allowed at the start and is not later.
run = run_case("linearUSLmoving", *schemes("linear", "USL"), ("system/controlDict", "endTime", "2"),
               velocity=lambda x: vibration(x) + [0.5, 0], position=lambda x: x, courant=0.3)
case.check("exit code (linearUSLmoving)", run.exit, "==", 2)
why = re.findall(r"(?i)error:.*(nodal mass|stability limit|from nowhere)", run.log)
case.check("messages that say why (linearUSLmoving)", len(why), ">=", 1)
case.finish()

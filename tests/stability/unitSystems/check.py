"""A collapsing column in SI units, in mm, tonnes and seconds, and in units a million times as large or small.
Hard: any tolerance that is an absolute number shows as soon as metres become millimetres or nanometres.
Pass: after scaling back, positions, velocities, stresses and energies agree to 1e-9 of their largest values; where
all factors are powers of two, bit for bit; the particles split alike."""
import numpy as np
from hardCase import HardCase

SI = {"density": 1000.0, "E": 20e6, "cohesion": 1e3}
STEPS, DT, H, G = 300, 2e-3, 0.5, -9.8


def scaled(case, name, length, mass, time):
    """The scene with lengths, masses and times in other units: how many a metre, a kilogram and a second are."""
    stress = mass / (length * time**2)
    number = lambda value: repr(float(value))
    triple = lambda *values: "(" + " ".join(number(v) for v in values) + ")"
    return case.solve(name, ("system/seedParticlesDict", "scale", number(length)),
                      ("system/gridDict", "min", triple(-6 * length, -1 * length, 0)),
                      ("system/gridDict", "max", triple(8 * length, 6 * length, 0)),
                      ("system/gridDict", "cellSize", number(H * length)),
                      ("constant/g", "value", triple(0, G * length / time**2, 0)),
                      ("constant/materialProperties", "density", number(SI["density"] * mass / length**3)),
                      ("constant/materialProperties", "E", number(SI["E"] * stress)),
                      ("constant/materialProperties", "cohesion", number(SI["cohesion"] * stress)),
                      ("system/controlDict", "deltaT", number(DT * time)),
                      ("system/controlDict", "endTime", number(STEPS * DT * time)))


case = HardCase(__file__, __doc__)
plain = scaled(case, "SI", 1, 1, 1)
case.common(plain)
case.nothing_gained(plain)
reference, history = plain.state(), plain.series()
case.check("splits on the way", reference.ledger["splits"], ">", 10)
units = {"mm-t-s": (1e3, 1e-3, 1), "lengths-1e6": (1e6, 1, 1), "lengths-1e-6": (1e-6, 1, 1), "times-1e6": (1, 1, 1e6),
         "times-1e-6": (1, 1, 1e-6), "masses-1e6": (1, 1e6, 1), "micro-all": (1e-6, 1e-6, 1e-6),
         "twos-up": (2.0**20, 2.0**10, 2.0**7), "twos-down": (2.0**-20, 2.0**-13, 2.0**-10)}
for name, (length, mass, time) in units.items():
    run = scaled(case, name, length, mass, time)
    case.common(run)
    case.nothing_gained(run)
    state = run.state()
    per_metre = mass / length  # masses of particles are per metre of thickness, and that metre scales too
    factors = {"position": length, "velocity": length / time, "stress": mass / (length * time**2),
               "deformationGradient": 1, "mass": per_metre}
    same = np.array_equal(state.by_id("generation"), reference.by_id("generation"))
    if not case.check(f"splits alike ({name})", float(same), "==", 1):
        continue
    for field, factor in factors.items():
        here, expected = state.by_id(field) / factor, reference.by_id(field)
        if name.startswith("twos"):
            case.check(f"values of {field} that differ in any bit ({name})", int((here != expected).sum()), "==", 0)
        else:
            difference = np.abs(here - expected).max() / np.abs(expected).max()
            case.check(f"difference of {field} ({name})", difference, "<=", 1e-9)
    energy = per_metre * (length / time) ** 2
    rows = run.series()
    for column in ("kineticEnergy", "plasticDissipation", "frictionDissipation", "gravityWork", "transferLoss"):
        scale = np.abs(history[column]).max()
        case.check(f"difference of {column} ({name})", np.abs(rows[column] / energy - history[column]).max() / scale,
                   "<=", 0 if name.startswith("twos") else 1e-9)
case.finish()

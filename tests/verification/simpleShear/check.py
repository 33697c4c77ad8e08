"""Simple shear up to gamma = 8 in the stress rate of linearElastic (Jaumann's) and in the hyperelastic laws.
Measured: the largest error of the stress over G at gamma = 1, 2, ... 8 in the middle of an endless layer, against the time step.
Pass: linearElastic follows Jaumann's closed form with second order in the step (cpGIMP, whose sheared domains carry what happens
at the surfaces to the middle, within 0.2 %); hencky, smallStrain and neoHookean, functions of F
alone, are exact to 1e-9."""
import numpy as np
from verification import Number, Verification, schemes

case = Verification(__file__, __doc__)
G, LAMBDA = 10.0, 26 * 0.3 / 1.3 / 0.4


def jaumann(g):
    """Rate equation d sigma/dg = G (...) with spin 1/2: the stress oscillates with the period 2 pi of gamma."""
    return G * (1 - np.cos(g)), G * (np.cos(g) - 1), 0.0, G * np.sin(g)


def spectral(g, principal):
    """Stress of the principal stretches of V: l = g/2 + sqrt(1 + g^2/4) along the angle theta, tan 2 theta = 2/g, and 1/l."""
    l = g / 2 + np.sqrt(1 + g**2 / 4)
    first, second, out = principal(l, 1 / l)
    mean, half = (first + second) / 2, (first - second) / 2
    cos, sin = g / np.sqrt(4 + g**2), 2 / np.sqrt(4 + g**2)
    return mean + half * cos, mean - half * cos, out, half * sin


def small_strain(a, b):
    trace = LAMBDA * (a + b - 2)
    return a * (trace + 2 * G * (a - 1)), b * (trace + 2 * G * (b - 1)), trace


EXACT = {"linearElastic": jaumann, "neoHookean": lambda g: (G * g**2, 0.0, 0.0, G * g),
         "hencky": lambda g: spectral(g, lambda a, b: (2 * G * np.log(a), 2 * G * np.log(b), 0.0)),
         "smallStrain": lambda g: spectral(g, small_strain)}


def errors(law, shape, update):
    def of(dt):
        run = case.solve(f"{law}-{shape}-{update}-dt{dt:g}", *schemes(shape, update), ("constant/materialProperties", "law", law),
                         ("system/controlDict", "deltaT", dt))
        start = run.state(0).by_id("position")
        middle = np.abs(start[:, 1] - 6) < 1
        worst = 0
        for name in run.times()[1:]:
            state = run.state(name)
            worst = max(worst, np.abs(state.by_id("stress")[middle] - np.array(EXACT[law](state.time))).max() / G)
        return {"stress over G": worst}
    return of


STEPS = (0.04, 0.02, 0.01)
for shape, update in (("uGIMP", "MUSL"), ("cpGIMP", "MUSL"), ("quadraticBSpline", "MUSL")):
    study = case.study(f"linearElastic, {shape} {update}", "dt", STEPS, errors("linearElastic", shape, update))
    if shape != "cpGIMP":
        case.check_order(study, "stress over G", 1.9, 2.1)
    case.check(f"error of stress over G at the smallest step ({study.label})", study.errors["stress over G"][-1], "<=",
               2e-3 if shape == "cpGIMP" else 2e-5)
rows = []
for law in ("neoHookean", "hencky", "smallStrain"):
    error = errors(law, "uGIMP", "MUSL")(0.04)["stress over G"]
    case.check(f"error of stress over G ({law})", error, "<=", 1e-9)
    rows.append([law, Number(error, floor=1e-9)])
case.table("Laws that are functions of F, dt = 0.04 s:", ["law", "stress over G"], rows)
case.finish()

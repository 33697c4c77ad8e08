"""A neo-Hookean ring that expands and contracts by a manufactured solution.
Measured: the largest RMS displacement error over one period against the cell size: curved free surfaces that cut cells.
Pass: it falls with order 1 (at least 0.95) in every shape (surfaces that cut cells cost the second order the shapes have within)."""
import numpy as np
from verification import Verification, body_force_of, expressions, neo_hookean, schemes, worst_rms

case = Verification(__file__, __doc__)
E, RHO, C, RI, RO = 1e7, 1000.0, 100.0, 0.4, 0.6
D = RO**2 * (RO - 3 * RI)
C3, C2, C1 = -2 / D, 3 * (RO + RI) / D, -6 * RI * RO / D


def displacement(A):
    def u(X, t):
        R = np.sqrt(X[:, 0]**2 + X[:, 1]**2)
        return (A * np.sin(C * np.pi * t) * (C3 * R**2 + C2 * R + C1))[:, None] * X
    return u


# The dictionary's body force and initial velocity against the mapping itself, by finite differences.
force, speed = expressions(case.scene / "constant/bodyForce"), expressions(case.scene / "constant/materialProperties", "initialVelocity")
random = np.random.default_rng(1)
R, angle = random.uniform(RI, RO, 200), random.uniform(0, np.pi / 2, 200)
X = np.stack([R * np.cos(angle), R * np.sin(angle)], axis=1)
AMPLITUDE = 0.02
u = displacement(np.longdouble(AMPLITUDE))
for t in (1e-3, 7e-3, 1.3e-2):
    b = force(X=X[:, 0], Y=X[:, 1], t=t)[:, :2]
    difference = b - body_force_of(u, neo_hookean(0, E / 2), RHO, X, t, 2e-3, 5e-5)
    case.check(f"body force at {t:g} s against finite differences of the mapping", np.abs(difference).max() / np.abs(b).max(), "<=", 1e-10)
difference = speed(X=X[:, 0], Y=X[:, 1])[:, :2] - u(X, 1e-9) / 1e-9
case.check("initial velocity against the mapping", np.abs(difference).max() / (AMPLITUDE * np.pi * C), "<=", 1e-10)
rate = lambda radius: C3 * 3 * radius**2 + 2 * C2 * radius + C1
case.check("radial strain at the free sides", max(abs(rate(RI)), abs(rate(RO))), "<=", 1e-12)


def errors(shape, A):
    def of(N):
        h = 0.2 / N
        changes = [("system/gridDict", "cellSize", repr(h)), ("system/controlDict", "deltaT", repr(0.2 * h / C))]
        run = case.copy(f"{shape}-A{A:g}-N{N}", ("system/mpmSchemes", "shape", shape), *changes)
        for file in ("constant/bodyForce", "constant/materialProperties"):
            run.set(file, "A", A)
        run.utility("seedParticles").utility("mpmSolve", threads=1)
        if run.exit != 0:
            return f"stopped with exit code {run.exit}: {run.log.strip().splitlines()[-1]}"
        return {"displacement over A": worst_rms(run, displacement(A)) / A}
    return of


for A, shape, cells in ((1e-4, "uGIMP", (4, 8)), (1e-4, "cubicBSpline", (4, 8)), (AMPLITUDE, "cpGIMP", (4, 8, 16)),
                        (AMPLITUDE, "uGIMP", (4, 8)), (AMPLITUDE, "quadraticBSpline", (4, 8)), (AMPLITUDE, "cubicBSpline", (4, 8))):
    study = case.study(f"A = {A:g}, {shape}", "N", cells, errors(shape, A))
    case.check_order(study, "displacement over A", 0.95)
case.finish()

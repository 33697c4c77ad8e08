"""An elastic layer on a rigid base that shakes harmonically.
Measured: the amplitude of the surface over that of the base, and its phase, once transients have died.
Pass: within 1 % of the closed form |1/cos(k H)|, below, at and above the first resonance; phase within 0.01; the energy
budget closes to round-off and the base's work is what damping takes."""
import numpy as np
from verification import Number, Verification, displacements

case = Verification(__file__, __doc__)
H, C, TAU, A = 10.0, np.sqrt(0.5e6 / 1000), 0.5, 1e-3
FIRST = np.pi * C / (2 * H)  # natural frequency of the undamped layer [rad/s]
rows = []


def shaken(ratio):
    w = ratio * FIRST
    end = 12.0
    run = case.solve(f"w{ratio:g}", ("constant/boundaryConditions", "w", repr(w)))
    X, states = displacements(run)
    top = X[:, 1] > X[:, 1].max() - 1e-6
    late = [(t, u[top, 0].mean()) for t, u in states if t > end - 2 * 2 * np.pi / w]
    t, u = np.array(late).T
    (s, c, _), *_ = np.linalg.lstsq(np.column_stack([np.sin(w * t), np.cos(w * t), np.ones_like(t)]), u, rcond=None)
    measured = (s + 1j * c) / A  # u = Im(measured A exp(i w t))
    k = np.sqrt((w**2 - 1j * w / TAU) / C**2 + 0j)
    y = X[top, 1].mean()
    exact = np.cos(k * (H - y)) / np.cos(k * H)
    budget, history = run.series("energyBudget"), run.series()
    case.check(f"energy residual ({ratio:g})", np.abs(history["residual"]).max() / budget["motionWork"][-1], "<=", 1e-11)
    return w, measured, exact


for ratio in (0.5, 1, 1.8):
    w, measured, exact = shaken(ratio)
    off = abs(measured) / abs(exact) - 1
    phase = np.angle(measured / exact)
    case.check(f"amplitude over the closed form, - 1 ({ratio:g})", abs(off), "<=", 0.01)
    case.check(f"phase from the closed form ({ratio:g})", abs(phase), "<=", 0.01, "rad")
    rows.append([f"{ratio:g}", Number(abs(exact), ".3f", 0.001), Number(abs(measured), ".3f", 0.005), Number(phase, ".4f", 0, 2e-3)])
case.table("", ["frequency over the first natural one", "amplification, closed form", "measured", "phase off [rad]"], rows)
case.finish()

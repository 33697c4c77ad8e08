"""A column 1000 cells high and one cell wide, dropped on its base while it swings.
Hard: every cell of a one cell wide domain touches both side walls, so any error of the walls, of nodes behind them
or of the tiles shows in every particle; material falls through 20 cells.
Pass: position, velocity and both stresses are those of an independent one-dimensional MPM to 1e-10 of their largest
values; nothing moves sideways."""
import numpy as np
from hardCase import HardCase

E, NU, DENSITY, G, DT, H = 1e7, 0.3, 2000.0, -9.8, 2e-3, 0.25
LAME, SHEAR = E * NU / ((1 + NU) * (1 - 2 * NU)), E / (2 * (1 + NU))


def one_dimensional(y, v, length, steps):
    """uGIMP, MUSL and FLIP in one dimension (confined compression), base at y = 0, per square metre of the base.
    Returns y, v and the stresses along and across."""
    nodes = 1050
    mass, volume = DENSITY * length, length.copy()
    along, across = np.zeros_like(y), np.zeros_like(y)
    half = 0.5 * length / H

    def weights():
        s = y / H + 1  # node k lies at (k - 1) H: one node behind the base
        first = np.floor(s - 0.5).astype(int)
        index = first[:, None] + np.arange(3)
        d = s[:, None] - index
        a, l = np.abs(d), half[:, None]
        inner, outer = 1 - (a * a + l * l) / (2 * l), (1 + l - a) ** 2 / (4 * l)
        n = np.where(a < l, inner, np.where(a < 1 - l, 1 - a, np.where(a < 1 + l, outer, 0)))
        slope = np.where(a < l, -a / l, np.where(a < 1 - l, -1, np.where(a < 1 + l, -(1 + l - a) / (2 * l), 0)))
        return index, n, slope * np.sign(d) / H

    def scatter(index, values):
        return np.bincount(index.ravel(), values.ravel(), nodes)

    def base(velocity):
        velocity[:2] = 0
        return velocity

    for _ in range(steps):
        index, n, slope = weights()
        m = scatter(index, mass[:, None] * n)
        held = np.where(m > 0, m, np.inf)
        before = scatter(index, (mass * v)[:, None] * n) / held
        force = scatter(index, -(volume * along)[:, None] * slope) / held + np.where(m > 0, G, 0)
        after = base(before + DT * force)
        v = v + (n * (after - before)[index]).sum(axis=1)
        again = base(scatter(index, (mass * v)[:, None] * n) / held)
        stretch = DT * (slope * again[index]).sum(axis=1)
        strain = stretch / (1 + stretch / 2)  # over the configuration of mid-step
        y = y + DT * (n * after[index]).sum(axis=1)
        volume = volume * np.exp(strain)
        along, across = along + (LAME + 2 * SHEAR) * strain, across + LAME * strain
    return y, v, along, across


def swing(run):
    """Adds a standing wave to the start velocities."""
    def edit(p):
        p["velocity"][:, 1] += 2 * np.sin(2 * np.pi * p["position"][:, 1] / 50)
    run.edit(edit)


case = HardCase(__file__, __doc__)
run = case.seed("column")
swing(run)
case.require(run.utility("mpmSolve"))
case.common(run)
case.nothing_gained(run)
first, last = run.state(0), run.state()
x0 = first.by_id("position")
y, v, along, across = one_dimensional(x0[:, 1], first.by_id("velocity")[:, 1], first.by_id("length0")[:, 1],
                                      int(last.attributes["step"]))
case.check("cells a particle falls through, at most", np.abs(y - x0[:, 1]).max() / H, ">", 10)
found = {"y": (last.by_id("position")[:, 1], y), "v": (last.by_id("velocity")[:, 1], v),
         "stress along": (last.by_id("stress")[:, 1], along), "stress across": (last.by_id("stress")[:, 0], across)}
for name, (here, expected) in found.items():
    case.check(f"difference of {name}", np.abs(here - expected).max() / np.abs(expected).max(), "<=", 1e-10)
case.check("velocity sideways over the largest", np.abs(last["velocity"][:, 0]).max() / np.abs(v).max(), "<=", 1e-10)
case.check("shear stress over the largest", np.abs(last["stress"][:, 3]).max() / np.abs(along).max(), "<=", 1e-10)
case.finish()

"""Particles exactly on nodes and edges of the grid.
Hard: a particle on the border of two cells may count twice, not at all, or always to one side.
Pass: in a linear velocity field F is exp(dt L), L over mid-step, to round-off wherever the lattice lies; a square under pressure bursts symmetrically, mirrored shifts give mirrored results, and a shift by a cell changes nothing, to round-off."""
import h5py
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
h, dt = 0.5, 1e-3
SHIFTS = (0, 0.25, 0.5, 0.75, 1)  # of a cell; seeds lie at quarters, so at 0.25 and 0.75 they are on nodes, at 0 their edges are


def shifted(name, shape, shift, *changes):
    run = case.seed(name, ("system/mpmSchemes", "shape", shape), *changes)
    with h5py.File(run.folder / "0" / "state.h5", "a") as file:
        file["particles/position"][...] += shift * h
    return run


# linear field: p = A x, no stress yet, so the field stays as it is for a step
A = np.array([[0.3, -0.7], [0.5, -0.2]])
dA = dt * A
G = dA @ np.linalg.inv(np.eye(2) + dA / 2)  # dt L over the configuration of mid-step
exponential = np.eye(2) + G + G @ G / 2 + G @ G @ G / 6 + G @ G @ G @ G / 24
for shape in ("linear", "uGIMP", "cpGIMP", "quadraticBSpline"):
    for shift in SHIFTS[:4]:
        run = shifted(f"field-{shape}-{shift}", shape, shift, ("system/controlDict", "endTime", "1e-3"), ("system/controlDict", "deltaT", "1e-3"),
                      ("system/controlDict", "writeInterval", "1e-3"), ("constant/materialProperties", "value", "(0 0 0 0 0 0)"))
        with h5py.File(run.folder / "0" / "state.h5", "a") as file:
            x = file["particles/position"][()]
            file["particles/velocity"][...] = x @ A.T
        run.utility("mpmSolve")
        state = run.state()
        inside = (np.abs(x - x.mean(axis=0)) < 0.8).all(axis=1)
        first = run.state(0)
        ids = first["id"][inside]
        F = state["deformationGradient"][np.isin(state["id"], ids)]
        case.check(f"particles inside ({shape}, shift {shift})", len(F), ">=", 36)
        case.check(f"largest error of F ({shape}, shift {shift})", np.abs(F - exponential).max(), "<=", 1e-14)

# bursting square
for shape in ("uGIMP", "quadraticBSpline"):
    result = {}
    for shift in SHIFTS:
        run = shifted(f"burst-{shape}-{shift}", shape, shift)
        run.utility("mpmSolve")
        case.check(f"exit code (burst {shape}, shift {shift})", run.exit, "==", 0)
        case.common(run)
        first, last = run.state(0), run.state()
        x0 = first.by_id("position")
        u, v = last.by_id("position") - x0, last.by_id("velocity")
        centre = x0.mean(axis=0)
        result[shift] = (np.round((x0 - centre) / (h / 4)).astype(int), u, v)

    def mirrored(a, b, axes, signs):
        """Largest difference of b to the mirror image of a, over the largest displacement and velocity."""
        place = {tuple(p): k for k, p in enumerate(result[b][0])}
        image = [place[tuple(p[axes] * signs)] for p in result[a][0]]
        return max(np.abs(result[a][k][:, axes] * signs - result[b][k][image]).max() / np.abs(result[a][k]).max() for k in (1, 2))

    for name, axes, signs in (("x", [0, 1], [-1, 1]), ("y", [0, 1], [1, -1]), ("x = y", [1, 0], [1, 1])):
        for a in (0, 0.5):
            case.check(f"asymmetry about {name} ({shape}, shift {a})", mirrored(a, a, axes, np.array(signs)), "<=", 1e-11)
    case.check(f"asymmetry about x = y ({shape}, shift 0.25)", mirrored(0.25, 0.25, [1, 0], np.array([1, 1])), "<=", 1e-11)
    case.check(f"shifts 0.25 and 0.75, difference of the mirror image ({shape})", mirrored(0.25, 0.75, [0, 1], np.array([-1, -1])), "<=", 1e-11)
    case.check(f"shifts 0 and 1, difference ({shape})", mirrored(0, 1, [0, 1], np.array([1, 1])), "<=", 1e-11)
    case.check(f"velocity reached ({shape})", np.abs(result[0][2]).max(), ">", 0.1, "m/s")
case.finish()

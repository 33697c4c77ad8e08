"""A slope that fails, its mirror image, the same with x and y exchanged, and with its particles in another order in the
file.
Hard: walls, tiles and sums have a left and a right and an x and a y; a plastic collapse multiplies any difference.
Pass: the mirror image stays one, and the exchanged scene the same, to 1e-12 of the largest values; the order in the
file changes no bit, by ids."""

import numpy as np
from hardCase import HardCase

TENSOR = {"mirror": np.array([[-1.0, 0], [0, 1]]), "exchange": np.array([[0, 1.0], [1, 0]])}
BASE = "constant/boundaryConditions"


def turned(q, s):
    """What the particles s become under the orthogonal map q."""
    stress = s["stress"].copy()
    full = np.zeros((len(stress), 2, 2))
    full[:, 0, 0], full[:, 1, 1] = stress[:, 0], stress[:, 1]
    full[:, 0, 1] = full[:, 1, 0] = stress[:, 3]
    full = q @ full @ q.T
    stress[:, 0], stress[:, 1], stress[:, 3] = full[:, 0, 0], full[:, 1, 1], full[:, 0, 1]
    return {"position": s["position"] @ q.T, "velocity": s["velocity"] @ q.T, "stress": stress,
            "deformationGradient": q @ s["deformationGradient"] @ q.T, "length0": s["length0"] @ np.abs(q.T)}


def map_particles(q):
    return lambda p: [p[name].__setitem__(..., value) for name, value in turned(q, p).items()]


case = HardCase(__file__, __doc__)
for shape in ("uGIMP", "linear", "cpGIMP", "quadraticBSpline"):
    change = ("system/mpmSchemes", "shape", shape)
    plain = case.solve(f"plain-{shape}", change)
    case.common(plain)
    case.nothing_gained(plain)
    last = plain.state()
    case.check(f"plastic work over the work of gravity ({shape})",
               last.ledger["plasticDissipation"] / last.ledger["gravityWork"], ">", 0.05)
    for name, q in TENSOR.items():
        run = case.seed(f"{name}-{shape}", change).edit(map_particles(q))
        if name == "exchange":
            run.set("constant/g", "value", "(-9.8 0 0)")
            run.set(BASE, "normal", "(-1 0 0)")
        case.require(run.utility("mpmSolve"))
        back = turned(q.T, run.state().particles)
        order, expected = np.argsort(run.state()["id"]), last.particles
        for field in ("position", "velocity", "stress"):
            there = expected[field][np.argsort(expected["id"])]
            case.check(f"difference of {field} ({name}, {shape})",
                       np.abs(back[field][order] - there).max() / np.abs(there).max(), "<=", 1e-12)
    run = case.seed(f"permuted-{shape}", change)
    run.edit(lambda p: [v.__setitem__(..., v[np.random.default_rng(7).permutation(len(v))]) for v in p.values()])
    case.require(run.utility("mpmSolve"))
    bits = [run.state().by_id(name).tobytes() == last.by_id(name).tobytes() for name in last.particles]
    case.check(f"fields that differ in any bit (permuted, {shape})", bits.count(False), "==", 0)
    texts = [(r.folder / "postProcessing/history.csv").read_text() for r in (run, plain)]
    case.check(f"histories alike (permuted, {shape})", float(texts[0] == texts[1]), "==", 1)
case.finish()

"""A block of soil in 3D that collapses along a rubbing wall and splits on the way, on one, two and four threads, and
stopped and continued half way.
Hard: sums over particles depend on their order, and a restart has to find the same order, the same tiles and the
children of a cascade that is under way.
Pass: every number of the last state that a restart reads, and every row of history.csv, is the same bit for bit."""
import h5py
import numpy as np
from hardCase import HardCase


def content(state):
    """Everything a restart reads, as bytes."""
    held = {}
    with h5py.File(state.path) as file:
        for name, value in file.attrs.items():
            held[f"/{name}"] = np.asarray(value).tobytes()
        for group in ("particles", "grid", "ledger"):
            for name, item in file[group].items():
                held[f"{group}/{name}"] = item[()].tobytes()
    return held


def history(run):
    return (run.folder / "postProcessing/history.csv").read_text().splitlines()


case = HardCase(__file__, __doc__)
whole = case.solve("oneThread", threads=1)
case.common(whole)
case.nothing_gained(whole)
last, expected, rows = whole.state(), content(whole.state()), history(whole)
case.check("splits on the way", last.ledger["splits"], ">", 100)
case.check("splits after the restart", last.ledger["splits"] - whole.state("0.4").ledger["splits"], ">", 10)
case.check("work of friction", last.ledger["frictionDissipation"] / last.ledger["gravityWork"], ">", 0.01)


def same(run):
    found = content(run.state())
    differing = sorted(name for name in expected.keys() | found.keys() if found.get(name) != expected.get(name))
    if differing:
        print("      differing:", *differing)
    case.check(f"fields that differ in any bit ({run.folder.name})", len(differing), "==", 0)
    case.check(f"rows of history that differ ({run.folder.name})",
               sum(a != b for a, b in zip(history(run), rows)) + abs(len(history(run)) - len(rows)), "==", 0)


for threads in (2, 4):
    same(case.solve(f"threads{threads}", threads=threads))
run = case.solve("restarted", ("system/controlDict", "endTime", "0.4"), threads=2)
run.set("system/controlDict", "endTime", "0.8")
same(case.require(run.utility("mpmSolve", threads=1)))
case.finish()

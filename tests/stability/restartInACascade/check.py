"""Restarts inside a cascade of splittings.
Hard: particles split every few steps, up to five times; order, ids and counts must follow from the state alone.
Pass: cut at any step, also with another number of threads, the run ends bitwise as the uninterrupted one, history included."""
import numpy as np
from hardCase import HardCase

case = HardCase(__file__, __doc__)
whole = case.solve("whole")
case.common(whole)
end = whole.state()
history = whole.series()
case.check("particles at the end over those at the start", history["particles"][-1] / history["particles"][0], ">", 2)
case.check("halvings of one particle", int(end["generation"].max()), ">=", 4)
grows = history["time"][1:][np.diff(history["particles"]) > 0]
case.check("steps at which particles split", len(grows), ">", 10)

# at, before and after a step that splits, where sorting is due and where not
first = int(round(grows[len(grows) // 3] / 1e-3))
for k, cuts in enumerate([(first - 1, first, first + 1), (137, 138, 200, 259), tuple(range(20, 400, 41))]):
    run = case.seed(f"cut{k}")
    for n, step in enumerate(cuts + (400,)):
        run.set("system/controlDict", "endTime", f"{step * 1e-3:.3f}")
        run.set("system/controlDict", "writeInterval", f"{step * 1e-3:.3f}")
        run.utility("mpmSolve", threads=1 + n % 2)
    state = run.state()
    case.check(f"exit code (cut {k})", run.exit, "==", 0)
    same = state["id"].shape == end["id"].shape
    differ = sum(int((state[n] != end[n]).sum()) for n in end.particles) if same else -1
    case.check(f"numbers that differ, cut at steps {', '.join(map(str, cuts[:4]))}", differ, "==", 0)
    case.check(f"entries of the ledger that differ (cut {k})",
               sum(int(np.any(state.ledger[n] != end.ledger[n])) for n in end.ledger), "==", 0)
    texts = [(r.folder / "postProcessing/history.csv").read_text() for r in (whole, run)]
    case.check(f"history is the same text (cut {k})", str(texts[0] == texts[1]), "==", "True")
case.finish()

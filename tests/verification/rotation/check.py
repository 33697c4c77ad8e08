"""A free disc that turns once.
Measured: radius, volume and stress against the time step; and the angle it reaches, which FLIP's transfers hold back.
Pass: the disc keeps its radius within 1e-4 in cpGIMP with USL, within 4e-4 in uGIMP with MUSL and USF, and its volume within 2e-4; RMS
stress stays below 1e-3 G (cpGIMP) and 6e-3 G (uGIMP, which keeps the vibrations a turning lattice excites)."""
import numpy as np
from verification import Verification, rms, schemes

case = Verification(__file__, __doc__)
G, TURN = 10e6, 2 * np.pi


def errors(shape, update):
    def of(steps):
        run = case.solve(f"{shape}-{update}-{steps}", *schemes(shape, update), ("system/controlDict", "deltaT", repr(TURN / steps)))
        first = run.state(0).by_id("position")
        out = {"radius": 0.0, "volume": 0.0, "stress over G": 0.0}
        angle = 0.0
        for name in run.times()[1:]:
            state = run.state(name)
            now = state.by_id("position")
            found = {"radius": abs(rms(now) / rms(first) - 1), "stress over G": rms(state["stress"]) / G,
                     "volume": abs(state["volume"].sum() / state["volume0"].sum() - 1)}
            out = {key: max(out[key], found[key]) for key in out}
            turned = np.arctan2((first[:, 0] * now[:, 1] - first[:, 1] * now[:, 0]).sum(), (first * now).sum()) % (2 * np.pi)
            angle = turned + 2 * np.pi * np.round((state.time - turned) / (2 * np.pi))
        return {**out, "angle": abs(angle / state.time - 1)}
    return of


for shape, update in (("uGIMP", "MUSL"), ("cpGIMP", "USL"), ("uGIMP", "USF")):
    study = case.study(f"{shape} {update}", "steps", (8000, 16000) if update != "USL" else (12000, 24000), errors(shape, update))
    follows = shape == "cpGIMP"
    for measure, bound in (("radius", 1e-4 if follows else 4e-4), ("volume", 2e-4), ("stress over G", 1e-3 if follows else 6e-3)):
        case.check(f"{measure} ({study.label})", max(study.errors[measure]), "<=", bound)
case.finish()

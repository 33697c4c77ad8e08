"""A stressed plate that turns once as a rigid body.
Measured: volume, stress and position over one turn, against the time step.
Pass: volume and the stress that turns with the body"""
import numpy as np
from verification import Verification, rms, schemes

case = Verification(__file__, __doc__)
S0 = np.array([[1, 0.7], [0.7, -2]])
TURN = 2 * np.pi


def errors(law, shape, update):
    def of(steps):
        run = case.solve(f"{law}-{shape}-{update}-{steps}", *schemes(shape, update), ("constant/materialProperties", "law", law),
                         ("system/controlDict", "deltaT", repr(TURN / steps)))
        first = run.state(0).by_id("position")
        out = {"volume": 0.0, "stress": 0.0, "position": 0.0}
        for name in run.times()[1:]:
            state = run.state(name)
            c, s = np.cos(state.time), np.sin(state.time)
            Q = np.array([[c, -s], [s, c]])
            turned = Q @ S0 @ Q.T
            exact = np.array([turned[0, 0], turned[1, 1], 0.5, turned[0, 1]])
            out["volume"] = max(out["volume"], np.abs(np.linalg.det(state["deformationGradient"]) - 1).max())
            out["stress"] = max(out["stress"], np.abs(state["stress"] - exact).max())
            out["position"] = max(out["position"], np.abs(state.by_id("position") - first @ Q.T).max())
        return out
    return of


for shape, update in (("uGIMP", "MUSL"), ("linear", "USL"), ("cpGIMP", "MUSL"), ("quadraticBSpline", "USF")):
    study = case.study(f"linearElastic, {shape} {update}", "steps", (100, 200, 400, 800), errors("linearElastic", shape, update))
case.finish()

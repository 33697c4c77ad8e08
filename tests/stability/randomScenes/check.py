"""Two hundred random scenes: one or two bodies, elastic or Mohr-Coulomb, stiff, soft, nearly incompressible or auxetic, at
rest or at up to twice their wave speed, every shape and stress update, 2D and 3D, walls of all kinds, with time steps of a
tenth to three times the printed stability limit.
Hard: nobody chose the combinations; most are what no test case would hold.
Pass: every scene either finishes with an energy residual below 2 % and finite numbers, or ends with a named error and exit
code 1 or 2; every scene with a time step up to 0.9 of the printed limit, and every one with adjustTimeStep, finishes; at
least 70 % of all finish."""
import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from hardCase import LONG, HardCase, Run
from scenes import RandomScene

case = HardCase(__file__, __doc__)
STEPS, CROSSINGS = 300, 60  # a run's length: the shorter of so many steps and a wave's way through so many cells
SCENES = range(2000) if LONG else range(200)


class Outcome:
    """verdict: finished, named (an error that says what and where), or wrong (anything else)."""

    def __init__(self, scene, verdict, residual=0.0, text=""):
        self.scene, self.verdict, self.residual, self.text = scene, verdict, residual, text
        self.must = scene.adjusts or scene.factor <= 0.9

    def __str__(self):
        steps = "adjusted steps" if self.scene.adjusts else f"{self.scene.factor:.2f} of the limit"
        return (f"{self.scene.seed:4d} {self.verdict:8} residual {self.residual:.1e}  {self.scene.describe()}, {steps}"
                f"{': ' + self.text[:200] if self.text else ''}")


def outcome(scene, run):
    if run.exit != 0:
        named = run.exit in (1, 2) and re.search(r"error: .*(deltaT|step \d+ at time)", run.log)
        return Outcome(scene, "named" if named else "wrong", text=run.log.strip().splitlines()[-1 if not named else 0])
    last, history = run.state(), run.series()
    finite = all(np.isfinite(last[name]).all() for name in last.particles)
    supplied = sum(abs(float(last.ledger[n])) for n in ("initialKineticEnergy", "initialStrainEnergy"))
    supplied += np.abs(history["gravityWork"]).max()
    residual = np.abs(history["residual"]).max() / supplied if supplied > 0 else 0.0
    return Outcome(scene, "finished" if finite and residual < 0.02 else "wrong", residual)


def solve(seed):
    scene = RandomScene(seed)
    run = Run(case.folder / str(seed))
    scene.write(run.folder, 1e-12, 1e-9, False)
    run.utility("seedParticles")
    run.utility("mpmSolve", "-dry-run", threads=1)
    limit = float(re.search(r"deltaT <= (\S+) s", run.log)[1])
    delta_t = scene.factor * limit
    scene.write(run.folder, delta_t, min(STEPS * delta_t, CROSSINGS * scene.h / scene.speed), scene.adjusts)
    return outcome(scene, run.utility("mpmSolve", threads=1))


with ThreadPoolExecutor(2) as pool:
    outcomes = list(pool.map(solve, SCENES))
for o in outcomes:
    if o.verdict == "wrong" or (o.must and o.verdict != "finished"):
        print(o)
case.check("scenes that end wrongly", sum(o.verdict == "wrong" for o in outcomes), "==", 0)
case.check("scenes within 0.9 of the limit, or adjusted", sum(o.must for o in outcomes), ">=", len(outcomes) / 2)
case.check("of these, not finished", sum(o.must and o.verdict != "finished" for o in outcomes), "==", 0)
case.check("share of scenes finished", sum(o.verdict == "finished" for o in outcomes) / len(outcomes), ">=", 0.7)
case.check("largest residual", max(o.residual for o in outcomes), "<", 0.02)
case.finish()

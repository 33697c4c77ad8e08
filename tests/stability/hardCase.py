"""What the check.py of a hard case is written with, on top of tests/support/sceneCase.py.

Its docstring says in three lines what the case is, why it is hard and when it passes:

    \"\"\"One particle in free fall.
    Hard: a lone particle must not feel its own image on the grid.
    Pass: x and v are those of the scheme, summed exactly.\"\"\"
    from hardCase import HardCase
    case = HardCase(__file__, __doc__)
    run = case.solve("plain")
    case.common(run)
    case.check("error of v", abs(v - expected), "<=", 1e-12, "m/s")
    case.finish()

tests/stability/check NAME runs one, below <build>/tests/stability/<name>/; cases/hardCases gathers the verdicts.
"""

import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from sceneCase import (BUILD, LONG, PROJECT, Run, SceneCase, State, checkerboard, log_number, pressure, record, schemes, set_fields,
                       treatment)


class HardCase(SceneCase):
    KIND = "stability"

    def __init__(self, script, text):
        super().__init__(script, text, "Hard", "whatIsHard")

    def nothing_gained(self, run, most=0.02):
        """The residual closes over what transfers between particles and grid make of nothing; this does not: their loss,
        with that of impacts on walls (each takes what the other gives back), may not become a gain of more than `most` of
        the energy that was there or supplied."""
        ledger, history = run.state(-1).ledger, run.series()
        supplied = sum(abs(float(ledger[n])) for n in ("initialKineticEnergy", "initialStrainEnergy", "tractionWork",
                                                      "motionSupply") if n in ledger)
        supplied += np.abs(history["gravityWork"]).max()
        if supplied > 0:
            budget = run.series("energyBudget")
            lost = budget["transferLoss"] + budget["wallLoss"]
            self.check(f"energy gained in transfer ({run.folder.name})", -lost.min() / supplied, "<=", most)

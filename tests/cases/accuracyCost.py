"""accuracyCost end to end on the self-weight column: the table, taking rows over, ending and going on, figures, advice.

    accuracyCost.py [AccuracyCost.test_name ...]     MPM_BUILD_DIR names the build (default: build/)
"""

import csv
import math
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
CASES = PROJECT / "cases" / "accuracyAgainstTime"
COLUMN = CASES / "selfWeightColumn"
AXES = ["cellSize", "particlesPerCell", "shape", "transfer", "order", "picRate", "stressUpdate", "staggeredStart",
        "timeIntegration", "splitting", "courant", "deltaT"]
COLUMNS = ["row", "method"] + AXES + [
    "status", "reason", "errorMeasure", "error", "errorScale", "against", "value", "reference", "referenceRow",
    "referenceError", "temporalError", "spatialError", "pareto", "cpuSeconds", "wallSeconds", "repeats", "threads",
    "sideBySide", "particles", "steps", "particleSteps", "cells", "nsPerParticleStep", "endTime", "machine", "version", "key"]
DICT = """
methods { uGIMP { shape uGIMP; } cpGIMP { shape cpGIMP; } }
axes { cellSize (5 2.5 3 1.25); courant (0.5 1); }
exact { constants { w 800; H 50; } stress (0 "-w*(H - Y)" 0 0); }
measures
{
    stress { field stress; component yy; against exact; scale 40e3; }
    top    { history maxY; against finest; scale 1; }
    force  { history wallImpulseY; take rate; window 1; against number; value 200e3; }
}
"""


class AccuracyCost(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "column"
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, self.case / part)
        control = self.case / "system" / "controlDict"
        control.write_text(re.sub("historyInterval +100", "historyInterval 10", control.read_text()))
        self.write(DICT)

    def write(self, text):
        (self.case / "system" / "accuracyCostDict").write_text(text)

    def run_utility(self, *options, code=0):
        run = subprocess.run([BINARIES / "accuracyCost", *options], cwd=self.case, text=True, capture_output=True,
                             stdin=subprocess.DEVNULL, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout[-3000:] + run.stderr)
        return run.stdout + run.stderr

    def table(self):
        with open(self.case / "postProcessing" / "accuracyCost.csv", newline="") as file:
            lines = list(csv.DictReader(file))
        self.assertEqual(list(lines[0]), COLUMNS)
        return lines

    def stamps(self):
        return {path.parent.name: path.stat().st_mtime_ns for path in self.case.glob("accuracyCost/*/result.csv")}

    def test_against_the_equations_before_time_is_cut_into_steps(self):
        """The manufactured bar: temporal errors of a symplectic step, of RK4 and of a transfer that has no limit."""
        self.case = self.case.parent / "bar"
        for part in ("geometry", "constant", "system"):
            shutil.copytree(CASES / "manufacturedBar" / part, self.case / part)
        for file, entry, value in (("system/mpmSchemes", "staggeredStart", "no"), ("system/controlDict", "endTime", "0.005"),
                                   ("system/controlDict", "writeInterval", "0.005")):
            path = self.case / file
            path.write_text(re.sub(rf"(?m)^({entry} +)[^;]*;", rf"\g<1>{value};", path.read_text()))
        self.write("""
            methods { USL { stressUpdate USL; } RK4 { timeIntegration RK4; } APIC { transfer APIC; } }
            axes { cellSize (0.03125); shape (cubicBSpline); courant (0.2 0.1 0.05); }
            measures { temporal { field position; against semiDiscrete; scale 1; } }""")
        self.run_utility("-noFigures")
        errors = {name: [float(line["error"]) for line in self.table() if line["method"] == name]
                  for name in ("USL", "RK4", "APIC")}
        # As in an independent 1D calculation of this bar (order 0.4 to 0.6 of USL while particles cross cells, 4 of RK4).
        self.assertGreater(errors["USL"][0] / errors["USL"][2], 2 ** (2 * 0.4))
        self.assertGreater(errors["RK4"][0] / errors["RK4"][1], 2 ** 3.3)
        self.assertLess(errors["RK4"][0], 1e-3 * errors["USL"][0])
        # What APIC takes out of the velocities it takes out once a step: smaller steps bring it no nearer.
        self.assertGreater(errors["APIC"][2], 0.8 * errors["APIC"][0])
        for line in self.table():
            self.assertLess(float(line["referenceError"]), 1e-9)
            self.assertEqual(line["temporalError"], line["error"])

    def test_the_table_the_figures_and_taking_rows_over(self):
        text = self.run_utility("-within", "0.02")
        lines = self.table()
        self.assertEqual(len(lines), 16 * 3)
        self.assertEqual([line["errorMeasure"] for line in lines[::16]], ["stress", "top", "force"])
        stress = {(line["shape"], float(line["cellSize"]), round(float(line["courant"]), 1)): line for line in lines[:16]}
        for (shape, h, courant), line in stress.items():
            if h == 3:
                self.assertEqual((line["status"], line["error"], line["cpuSeconds"]), ("refused", "", ""))
                self.assertIn("whole number of cells", line["reason"])
                continue
            self.assertEqual((line["status"], line["reason"]), ("done", ""))
            steps = int(line["steps"])
            self.assertEqual(int(line["particles"]), round(4 * 5 * 50 / h**2))
            self.assertAlmostEqual(float(line["particleSteps"]), steps * int(line["particles"]), delta=1)
            self.assertAlmostEqual(steps * float(line["deltaT"]), 6, delta=1e-9)
            self.assertAlmostEqual(float(line["courant"]), (1e6 / 80) ** 0.5 * float(line["deltaT"]) / h, delta=1e-12)
            self.assertAlmostEqual(float(line["nsPerParticleStep"]),
                                   1e9 * float(line["cpuSeconds"]) / float(line["particleSteps"]), delta=1e-6)
            self.assertGreater(float(line["cpuSeconds"]), 0)
            self.assertLess(float(line["cpuSeconds"]), 1.05 * float(line["wallSeconds"]) + 0.01)
            self.assertEqual(line["splitting"], "off")
        for shape in ("uGIMP", "cpGIMP"):  # first order, as tests/verification/selfWeightColumn.cpp finds it
            errors = [float(stress[shape, h, 0.5]["error"]) for h in (5, 2.5, 1.25)]
            self.assertLess(errors[1], 0.7 * errors[0])
            self.assertLess(errors[2], 0.7 * errors[1])
            # at rest the step has no say
            self.assertLess(float(stress[shape, 5, 1]["temporalError"]), 0.01 * errors[0])
            self.assertEqual(float(stress[shape, 5, 1]["spatialError"]), errors[0])
        best = [line for line in lines[:16] if line["pareto"] == "1"]
        self.assertTrue(best)
        for line in best:
            for other in stress.values():
                self.assertFalse(other["status"] == "done" and float(other["cpuSeconds"]) < float(line["cpuSeconds"])
                                 and float(other["error"]) < float(line["error"]))
        self.check_scalars(lines)
        self.check_advice(text, lines[:16])
        for measure in ("stress", "top", "force"):
            for suffix in ("png", "svg"):
                self.assertGreater((self.case / f"postProcessing/figures/accuracyCost-{measure}.{suffix}").stat().st_size, 10000)
        self.taking_over(lines)

    def check_scalars(self, lines):
        top = [line for line in lines if line["errorMeasure"] == "top" and line["status"] == "done"]
        names = {line["referenceRow"] for line in top}
        self.assertEqual(len(names), 1)
        reference = next(line for line in top if line["row"] in names)
        self.assertEqual(float(reference["cellSize"]), 1.25)
        self.assertEqual(reference["error"], reference["referenceError"])
        self.assertEqual(reference["pareto"], "0")
        for line in top:
            if line is not reference:
                self.assertAlmostEqual(float(line["error"]), abs(float(line["value"]) - float(reference["value"])), delta=1e-12)
        for line in lines[32:]:
            if line["status"] == "done":
                # The base carries the weight, 80 x 10 x 50 x 5 N/m, less what damping takes of a step's impulse
                # (nodal/damping.hpp): phi = (1 - exp(-dt/tau)) tau/dt
                ratio = float(line["deltaT"]) / 0.15
                self.assertAlmostEqual(float(line["value"]), 200e3 * -math.expm1(-ratio) / ratio, delta=200)
                self.assertAlmostEqual(float(line["error"]), abs(float(line["value"]) / 200e3 - 1), delta=1e-12)

    def check_advice(self, text, lines):
        advised = re.search(r"within 0\.02: (\w+), cells of ([\d.]+) m, Courant ([\d.]+) .*costs .* \(error (.*)\)", text)
        self.assertTrue(advised, text)
        fit = [line for line in lines if line["error"] and float(line["error"]) <= 0.02]
        cheapest = min(fit, key=lambda line: float(line["cpuSeconds"]))
        self.assertEqual((advised[1], float(advised[2])), (cheapest["shape"], float(cheapest["cellSize"])))
        self.assertAlmostEqual(float(advised[4]), float(cheapest["error"]), delta=1e-3 * float(advised[4]))

    def taking_over(self, lines):
        before = self.stamps()
        self.assertEqual(len(before), 12)
        self.write(DICT.replace("scale 1;", "scale 2;").replace("cellSize (5 2.5 3 1.25)", "cellSize (5 2.5 10)"))
        self.assertIn("8 of 12 rows are known, 4 refused", self.run_utility("-noFigures"))
        after = self.stamps()
        self.assertEqual({name: after[name] for name in before}, before, "measures and other rows cost nothing")
        with open(self.case / "system" / "controlDict", "a") as file:
            file.write("timePrecision 8;\n")
        self.run_utility("-noFigures")
        self.assertTrue(all(self.stamps()[name] != before[name] for name in before if "1.25" not in name))

    def test_a_killed_run_leaves_whole_rows_and_goes_on(self):
        self.write(DICT.replace("(5 2.5 3 1.25)", "(5 1.25)").replace("(0.5 1)", "(0.2 1)"))
        program = subprocess.Popen([BINARIES / "accuracyCost", "-noFigures"], cwd=self.case, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        while not self.stamps():
            time.sleep(0.01)
        program.send_signal(signal.SIGKILL)
        program.wait()
        time.sleep(0.5)  # its child ends its step and goes
        known = self.stamps()
        self.assertIn(len(known), range(1, 8))
        program = subprocess.Popen([BINARIES / "accuracyCost", "-noFigures"], cwd=self.case, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, text=True)
        while len(self.stamps()) < len(known) + 1:
            time.sleep(0.01)
        program.send_signal(signal.SIGTERM)
        message = program.communicate()[1]
        self.assertEqual(program.returncode, 143)
        self.assertIn("stopped by SIGTERM; run it again", message)
        text = self.run_utility("-noFigures", "-threads", "2")
        self.assertRegex(text, r"[1-7] of 8 rows are known")
        self.assertIn("2 rows run side by side", text)
        self.assertEqual({name: self.stamps()[name] for name in known}, known)
        self.assertTrue(all(line["status"] == "done" for line in self.table()))

    def test_rows_that_fail_say_why(self):
        walls = self.case / "constant" / "boundaryConditions"
        walls.write_text(walls.read_text().replace("base  { type fixed; }", ""))  # it falls out of the grid
        self.write("axes { stressUpdate (USL MUSL); courant (0.3 5); } measures { top { history maxY; against finest; } }")
        text = self.run_utility()
        self.assertIn("no row has an error", text)
        by_name = {line["row"]: line for line in self.table()}
        for update in ("USL", "MUSL"):
            self.assertEqual(by_name[f"{update}-courant_0.3"]["status"], "failed")
            self.assertRegex(by_name[f"{update}-courant_0.3"]["reason"], "mpmSolve: .*grid")
            self.assertEqual(by_name[f"{update}-courant_5"]["status"], "refused")
            self.assertRegex(by_name[f"{update}-courant_5"]["reason"], "deltaT: found .* allowed: at most")
        self.assertFalse((self.case / "postProcessing" / "figures").exists())

    def test_dry_run_writes_nothing(self):
        before = sorted(self.case.rglob("*"))
        text = self.run_utility("-dry-run")
        self.assertEqual(text.count("refused: "), 4)
        self.assertEqual(sorted(self.case.rglob("*")), before)


if __name__ == "__main__":
    unittest.main()

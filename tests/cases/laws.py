"""driveLaw and checkIntegration -law as a user types them.

    laws.py [Laws.test_name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import csv
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
VECTORS = PROJECT / "tests" / "support" / "mohrCoulombVectors.csv"
SOIL = "law mohrCoulomb; E 20e6; nu 0.42; cohesion 1e3; frictionAngle 42;\n"
COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Laws(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_utility(self, name, *options, code=0, cwd=None):
        run = subprocess.run([BINARIES / name, *options], cwd=cwd or self.folder, text=True, capture_output=True,
                             stdin=subprocess.DEVNULL, timeout=300, env={**os.environ, "MPM_PROJECT_DIR": str(PROJECT)})
        self.assertEqual(run.returncode, code, run.stdout[-2000:] + run.stderr)
        return run.stdout if code == 0 else run.stderr

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    # driveLaw

    def test_vectors_return(self):
        self.run_utility("driveLaw", "-trial", VECTORS, "-out", "out.csv")
        self.assertEqual(self.files(), ["out.csv"])
        given, returned = rows_of(VECTORS), rows_of(self.folder / "out.csv")
        self.assertEqual(len(given), 18)
        for a, b in zip(given, returned, strict=True):
            for column in ("name", "material", "basis", "tr_xx", "region"):
                self.assertEqual(a[column], b[column])
            size = max(abs(float(a["tr_1"])), abs(float(a["tr_3"])))
            for c in COMPONENTS:
                self.assertLessEqual(abs(float(a["ret_" + c]) - float(b["ret_" + c])), 1e-10 * size, a["name"])

    def test_bad_trial_rows_write_nothing(self):
        text = VECTORS.read_text()
        for old, new, says in (
            ("V03 paper edge l1 (triax compression),paper,20000000", "V03,paper,-1", "bad.csv:4: E_Pa: found '-1'"),
            ("V01 elastic inside,paper,20000000,0.42", "V01,paper,20000000,0.5", "bad.csv:2: nu: found '0.5'"),
            ("E_Pa", "E", "E_Pa"),
        ):
            self.assertEqual(text.count(old), 1)
            (self.folder / "bad.csv").write_text(text.replace(old, new))
            self.assertIn(says, self.run_utility("driveLaw", "-trial", "bad.csv", "-out", "out.csv", code=1))
            self.assertEqual(self.files(), ["bad.csv"])
        self.assertIn("nowhere", self.run_utility("driveLaw", "-trial", VECTORS, "-out", "nowhere/out.csv", code=1))
        self.assertIn("-out", self.run_utility("driveLaw", "-trial", VECTORS, code=1))

    def test_triaxial_strength_and_figure(self):
        (self.folder / "soil").write_text(SOIL + "test { confiningStress 50e3; steps 100; }\n")
        self.run_utility("driveLaw", "-law", "soil", "-path", "triaxial")
        self.assertEqual(self.files(), ["soil", "triaxialTest.csv", "triaxialTest.png", "triaxialTest.svg"])
        self.assertEqual((self.folder / "triaxialTest.png").read_bytes()[:4], b"\x89PNG")
        self.assertIn("<svg", (self.folder / "triaxialTest.svg").read_text())
        last = rows_of(self.folder / "triaxialTest.csv")[-1]
        passive = np.tan(np.radians(45 + 21)) ** 2
        self.assertAlmostEqual(-float(last["syy"]) / (passive * 50e3 + 2 * 1e3 * np.sqrt(passive)), 1, 9)
        self.assertAlmostEqual(float(last["sxx"]), -50e3, 6)

    def test_cones_clay_and_softening(self):
        (self.folder / "cone").write_text("law druckerPrager; E 20e6; nu 0.3; cohesion 1e3; frictionAngle 42; match compression;\n"
                                          "test { confiningStress 50e3; steps 100; }\n")
        self.run_utility("driveLaw", "-law", "cone", "-path", "triaxial", "-noPlot")
        passive = np.tan(np.radians(45 + 21)) ** 2
        last = rows_of(self.folder / "triaxialTest.csv")[-1]
        self.assertAlmostEqual(-float(last["syy"]) / (passive * 50e3 + 2 * 1e3 * np.sqrt(passive)), 1, 9)
        self.assertNotIn("plasticStrain", last)
        # clay in triaxial compression: q = 2 c(kappa), kappa the axial plastic strain
        (self.folder / "clay").write_text("law tresca; E 20e6; nu 0.45; cohesion 10e3;\n"
                                          "softening { over 0.04; cohesion 2e3; referenceLength 0.1; }\n"
                                          "test { confiningStress 50e3; steps 200; maxStrain 0.05; }\n")
        self.run_utility("driveLaw", "-law", "clay", "-path", "triaxial", "-noPlot")
        rows = rows_of(self.folder / "triaxialTest.csv")
        for row in rows[20:]:
            kappa, q = float(row["plasticStrain"]), float(row["deviatorStress"])
            self.assertAlmostEqual(q / (2 * (10e3 - 8e3 * min(kappa / 0.04, 1))), 1, 8)
            self.assertAlmostEqual(kappa, -float(row["eyy"]) - q / 20e6, 8)
        self.assertGreater(float(rows[-1]["plasticStrain"]), 0.04)

    def test_a_table_repeats_the_test_that_wrote_it(self):
        material = PROJECT / "cases" / "collapsingSoilColumn" / "constant" / "materialProperties"
        self.run_utility("driveLaw", "-law", material, "-path", "simpleShear", "-out", "shear.csv", "-noPlot")
        (self.folder / "soil").write_text(SOIL + "test { startStress (-72413.793103448276 -100e3 -72413.793103448276 0 0 0); }\n")
        self.run_utility("driveLaw", "-law", "soil", "-path", "shear.csv", "-out", "again.csv", "-noPlot")
        self.assertEqual(self.files(), ["again.csv", "shear.csv", "soil"])
        for a, b in zip(rows_of(self.folder / "shear.csv"), rows_of(self.folder / "again.csv"), strict=True):
            for c in COMPONENTS:
                self.assertAlmostEqual(float(a["s" + c]), float(b["s" + c]), delta=1e-6)

    def test_wrong_law_files(self):
        for text, path, says in (
            (SOIL.replace("cohesion", "cohesoin"), "triaxial", ("cohesion", "cohesoin", "line 1")),
            (SOIL.replace("0.42", "0.5"), "triaxial", ("soil:1", "nu", "0.5")),
            (SOIL + "test { confiningStress -1; }", "triaxial", ("soil:2", "confiningStress", ">= 0")),
            (SOIL + "test { confinigStress 1; }", "triaxial", ("soil:2", "confiningStress")),
            (SOIL, "triaxal", ("triaxal", "triaxial", "oedometer")),
            (SOIL, "none.csv", ("none.csv", "oedometer")),
        ):
            (self.folder / "soil").write_text(text)
            message = self.run_utility("driveLaw", "-law", "soil", "-path", path, code=1)
            for word in says:
                self.assertIn(word, message)
            self.assertEqual(self.files(), ["soil"])
        self.run_utility("driveLaw", "-path", "triaxial", code=1)
        self.run_utility("driveLaw", "-law", "soil", "-path", "triaxial", "-trial", "x", code=1)

    # checkIntegration

    def case_with(self, recorded):
        case = self.folder / "column"
        for part in ("constant", "system", "geometry"):
            shutil.copytree(PROJECT / "cases" / "collapsingSoilColumn" / part, case / part)
        if recorded is not None:
            (case / "postProcessing").mkdir()
            (case / "postProcessing" / "strainPaths.csv").write_text(recorded)
        return case

    def record(self):
        """A strain path with turning axes, its stresses elastic (far below yield): particle 7."""
        lines = ["particle,time," + ",".join("e" + c for c in COMPONENTS) + "," + ",".join("s" + c for c in COMPONENTS)]
        young, nu = 20e6, 0.42
        shear, lame = young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))
        for i in range(21):
            strain = np.array([-1e-3 * i / 20, -2e-3 * i / 20, 0, 2e-4 * np.sin(i / 10), 0, 0])
            stress = 2 * shear * strain + lame * strain[:3].sum() * np.array([1, 1, 1, 0, 0, 0]) + \
                np.array([-40e3, -50e3, -40e3, 0, 0, 0])
            lines.append(",".join(repr(float(x)) for x in (7, i * 1e-3, *strain, *stress)))
        return "\n".join(lines) + "\n"

    def test_order_of_the_return_map(self):
        case = self.case_with(self.record())
        text = self.run_utility("checkIntegration", "-law", cwd=case)
        for stress in ("xx -57701.2406", "xy 57442.3609", "xx -56655.7182", "yy -294857.3594"):
            self.assertIn(stress, text)
        rows = rows_of(case / "postProcessing" / "checkIntegrationLaw.csv")
        last = {row["path"]: row for row in rows}
        self.assertEqual(list(last), ["columnSoil", "columnSoilInSubsteps", "nonAssociated", "Tresca", "associated",
                                      "particle 7"])
        # the same path by spin: the same rows; in sub-steps one step is as good as its tolerance
        of = {(row["path"], row["method"], row["steps"]): row for row in rows}
        for steps in ("1", "64", "512"):
            plain, spun = (float(of[name, "returnMap", steps]["error"]) for name in ("columnSoil", "columnSoilInSubsteps"))
            self.assertAlmostEqual(plain, spun, delta=1e-9)
        self.assertGreater(float(of["columnSoilInSubsteps", "returnMap", "1"]["error"]), 0.3)
        for steps in ("1", "8", "64"):
            row = of["columnSoilInSubsteps", "substep", steps]
            self.assertLess(float(row["error"]), 1e-4)
            self.assertGreater(float(row["lawCalls"]), 1)
        for name in ("columnSoil", "nonAssociated", "Tresca", "associated"):
            self.assertEqual(last[name]["steps"], "512")
            self.assertAlmostEqual(float(last[name]["order"]), 1, delta=0.05)
            self.assertLess(float(last[name]["drift"]), 1e-9)
        # an elastic path leaves the return map without error, and the record agrees
        self.assertLess(float(last["particle 7"]["error"]), 1e-9)
        self.assertLess(float(last["particle 7"]["recordError"]), 1e-12)

    def test_what_cannot_be_checked_is_refused(self):
        case = self.case_with(None)
        dictionary = case / "system" / "checkIntegrationDict"
        whole = dictionary.read_text()
        self.assertIn("recordStrain", self.run_utility("checkIntegration", "-law", cwd=case, code=1))
        (case / "postProcessing").mkdir()
        record = case / "postProcessing" / "strainPaths.csv"
        record.write_text(self.record().replace("-0.0005,", "x,", 1))
        self.assertRegex(self.run_utility("checkIntegration", "-law", cwd=case, code=1), r"strainPaths\.csv:\d+: eyy: found 'x'")
        record.write_text(self.record())
        for old, new, says in (
            ("file         ", "particles (8);  file ", ("particles", "8", "7")),
            ("function cos; amplitude 1e-2;  angularFrequency 2.4", "function tan; amplitude 1", ("tan", "cos")),
            ("material        soil;", "material        clay;", ("clay", "soil")),
            ("steps           (1 2 4", "steps           (1 2 2", ("steps", "growing")),
            ("endTime     1;                              // [s]", "endTime 0;", ("endTime", "> 0")),
            ("startStress (-40e3 ", "startStress (400e3 ", ("columnSoil", "start stress")),
            ("subdivisions", "subdivision", ("subdivision", "subdivisions")),
        ):
            self.assertEqual(whole.count(old), 1, old)
            dictionary.write_text(whole.replace(old, new))
            message = self.run_utility("checkIntegration", "-law", cwd=case, code=1)
            for word in says:
                self.assertIn(word, message)
            self.assertEqual([path.name for path in (case / "postProcessing").iterdir()], ["strainPaths.csv"])
        dictionary.write_text(whole)
        self.assertIn("-law", self.run_utility("checkIntegration", cwd=case, code=1))


if __name__ == "__main__":
    unittest.main()

"""mpmSolve -effects: prices of effects in use and off, nothing written; the summary of a run says what effects did.

    effectsOption.py [Option.test_name ...]     MPM_BUILD_DIR names the build (default: build/)
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tests" / "cases"))
from wrongInput import snapshot  # noqa: E402

BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"


class Option(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "column"
        self.case.mkdir()
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, self.case / part)
        self.change("system/controlDict", "endTime", "0.05")
        self.run_utility("seedParticles")

    def change(self, file, word, value):
        path = self.case / file
        text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", path.read_text())
        self.assertEqual(count, 1, f"{word} in {file}")
        path.write_text(text)

    def run_utility(self, name, *options, code=0):
        run = subprocess.run([BINARIES / name, *options], cwd=self.case, stdin=subprocess.DEVNULL, capture_output=True,
                             text=True, timeout=300)
        self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return run.stdout if code == 0 else run.stderr

    def test_tables(self):
        before = snapshot(self.case)
        out = self.run_utility("mpmSolve", "-effects")
        self.assertEqual(before, snapshot(self.case), "nothing may be written")
        used, off = out.split("Available but off")
        used = used.split("Effects in use")[1]
        for name in ("mohrCoulomb", "friction", "gravity", "splitting"):
            row = re.search(rf"(?m)^  {name} .*$", used)
            self.assertTrue(row, f"{name} is in use:\n{out}")
            self.assertRegex(row.group(0), r"-?\d+\.\d +\d+\.\d +-?\d+\.\d +\d+$")
            self.assertNotRegex(off, rf"(?m)^  {name} ")
        for name, size in (("tensionGap", 8), ("APIC", 32), ("vonMises", 0), ("roller", 0)):
            self.assertRegex(off, rf"(?m)^  {name} .* {size}$")

    def test_page(self):
        out = self.run_utility("mpmSolve", "-effects", "-markdown")
        self.assertTrue(out.startswith("# Effects\n"))
        self.assertIn("\n## Prices\n", out)

    def test_summary(self):
        (self.case / "constant" / "boundaryConditions").write_text(
            "base { type friction; mu 0.6; plane { normal (0 -1 0); position 0; } }\n"
            "far { type friction; mu 0.6; plane { normal (1 0 0); position 16; } }\n")
        out = self.run_utility("mpmSolve")
        effects = out.split("\nEffects (")[1]
        self.assertRegex(effects, r"(?m)^  gravity +\S.* work [\d.]+ kJ/m")
        self.assertRegex(effects, r"(?m)^  mohrCoulomb +\S.* plastic work [\d.]+ kJ/m")
        self.assertRegex(effects, r"(?m)^  friction +\S.* took [\d.e-]+ kJ/m .* nodes a step")
        self.assertIn("splitting: 0 particles split in 50 steps", out)
        self.assertNotIn("friction: 0 contacts", out)

    def test_idle_friction(self):
        (self.case / "constant" / "boundaryConditions").write_text(
            "far { type friction; mu 0.6; plane { normal (1 0 0); position 16; } }\n")
        (self.case / "constant" / "g").write_text("value (0 1e-3 0);\n")
        out = self.run_utility("mpmSolve")
        self.assertIn("friction: 0 contacts in 50 steps", out)


if __name__ == "__main__":
    unittest.main()

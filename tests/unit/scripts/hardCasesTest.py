"""cases/hardCases: the table of what the hard cases measured, on small scripts made here that stand for them."""

import csv
import os
import re
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]
CASE = '''"""Title of {0}.
Hard: why | {0}.
Pass: when {0}."""
from hardCase import HardCase
case = HardCase(__file__, __doc__)
{1}
case.finish()
'''


class HardCases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.home = Path(folder.name)
        shutil.copytree(PROJECT / "cases" / "hardCases", self.home / "cases" / "hardCases",
                        ignore=shutil.ignore_patterns("postProcessing", "__pycache__"))
        self.scenes = self.home / "tests" / "stability"
        self.scenes.mkdir(parents=True)
        for name in ("check", "hardCase.py"):
            shutil.copy(PROJECT / "tests" / "stability" / name, self.scenes)
        (self.home / "tests" / "support").mkdir()
        shutil.copy(PROJECT / "tests" / "support" / "sceneCase.py", self.home / "tests" / "support")
        self.readme = self.home / "cases" / "hardCases" / "README.md"
        self.out = self.home / "cases" / "hardCases" / "postProcessing"

    def add(self, name, body):
        (self.scenes / name).mkdir()
        (self.scenes / name / "check.py").write_text(CASE.format(name, body))

    def call(self, *arguments):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("MPM_")}
        run = subprocess.run(["/usr/bin/python3", self.home / "cases" / "hardCases" / "hardCases.py", *arguments], text=True,
                             capture_output=True, env=environment)
        return run.returncode, run.stdout + run.stderr

    def rows(self):
        with open(self.out / "hardCases.csv") as file:
            self.assertEqual(file.readline(), "case,whatIsHard,criterion,measured,verdict\n")
            file.seek(0)
            return {row["case"]: row for row in csv.DictReader(file)}

    def test_rows_tell_the_worst_of_each_criterion_and_what_failed(self):
        self.add("good", 'case.check("error (a)", 1e-14, "<=", 1e-12, "m")\ncase.check("error (b)", 9e-13, "<=", 1e-12, "m")')
        self.add("bad", 'case.check("peak", 2.5, "<", 2)\ncase.check("change of mass (x)", float("nan"), "<=", 1e-14)')
        self.add("broken", "1 / 0")
        code, text = self.call()
        self.assertEqual(code, 1, text)
        self.assertIn("1 of 3 hard cases passed", text)
        self.assertRegex(text, r"\[3/3\] .* left")
        rows = self.rows()
        self.assertEqual(list(rows), ["bad", "broken", "good"])
        self.assertEqual(rows["good"], {"case": "good", "whatIsHard": "Title of good. why | good.", "criterion": "when good.",
                                        "measured": "error 9e-13 m (<= 1e-12)", "verdict": "passed"})
        self.assertEqual(rows["bad"]["verdict"], "FAILED")
        self.assertEqual(rows["bad"]["measured"], "peak 2.5 (< 2) FAILED; change of mass nan (<= 1e-14) FAILED")
        self.assertEqual(rows["broken"]["verdict"], "FAILED")
        self.assertIn("no verdict, exit code 1", rows["broken"]["measured"])
        self.assertIn("why \\| bad.", (self.out / "hardCases.md").read_text())

    def test_an_old_verdict_is_not_taken_for_a_new_one(self):
        self.add("once", 'case.check("one", 1, "==", 1)')
        self.assertEqual(self.call()[0], 0)
        (self.scenes / "once" / "check.py").write_text(CASE.format("once", "1 / 0").replace("case = ", "1 / 0\ncase = "))
        self.assertEqual(self.call()[0], 1)
        self.assertEqual(self.rows()["once"]["verdict"], "FAILED")

    def test_readme_lists_the_cases_there_are(self):
        self.add("first", 'case.check("one", 1, "==", 1)')
        code, text = self.call("--check")
        self.assertEqual(code, 1)
        self.assertIn("README.md lacks first", text)
        before = self.readme.read_text()
        code, text = self.call("--readme")
        self.assertEqual(code, 0, text)
        after = self.readme.read_text()
        self.assertEqual(self.call("--check"), (0, ""))
        self.assertIn("| first | Title of first. why \\| first. | when first. | one 1 (== 1) | passed |", after)
        parts = [re.split("<!-- .* -->", text) for text in (before, after)]
        self.assertEqual([parts[0][0], parts[0][2]], [parts[1][0], parts[1][2]])
        self.add("second", "")
        self.assertIn("lacks second", self.call("--check")[1])
        shutil.rmtree(self.scenes / "first")
        self.assertIn("lists first, which is not there", self.call("--check")[1])

    def test_an_installation_says_where_the_scenes_are(self):
        shutil.rmtree(self.scenes)
        code, text = self.call()
        self.assertEqual(code, 1)
        self.assertIn("source tree", text)
        self.assertFalse(self.out.exists())

    def test_a_wrong_word_is_refused(self):
        self.add("first", "")
        for word in ("frist", "-readme"):
            code, text = self.call(word)
            self.assertEqual(code, 1)
            self.assertIn(f"found '{word}'", text)
            self.assertIn("first", text)

    def test_scripts_are_executable(self):
        for name in ("Allrun", "Allclean"):
            self.assertTrue((PROJECT / "cases" / "hardCases" / name).stat().st_mode & stat.S_IXUSR, name)


if __name__ == "__main__":
    unittest.main()

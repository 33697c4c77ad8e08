"""cases/trustworthyStress without running it: its dictionaries are accepted, with the words of every row of the trade-off,
and README.md is what its script writes from the tables beside it.

    trustworthyStress.py [Test.name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import csv
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
CASE = PROJECT / "cases" / "trustworthyStress"
sys.dont_write_bytecode = True
sys.path.insert(0, str(CASE))
import measure  # noqa: E402
import readme  # noqa: E402
import rows  # noqa: E402

REFUSED = ("WDilatant",)    # averages all of the volume change of soil that dilates


def run(case, name, *options):
    return subprocess.run([BINARIES / name, *options], cwd=case, text=True, capture_output=True, stdin=subprocess.DEVNULL,
                          timeout=120)


class Dictionaries(unittest.TestCase):
    """Of two steps each: a dry run tries steps to say what a run will take."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)

    def dry_run(self, name, changes):
        case = self.folder / name
        measure.make_case(case, rows.merged(changes, {rows.CONTROL: {"endTime": "2e-3"}}))
        seeded = run(case, "seedParticles")
        self.assertEqual(seeded.returncode, 0, f"{name}: {seeded.stderr}")
        return run(case, "mpmSolve", "-dry-run")

    def test_every_row_is_accepted(self):
        for row in rows.ROWS:
            done = self.dry_run(row.name, row.changes)
            self.assertEqual(done.returncode, int(row.name in REFUSED), f"{row.name}: {done.stdout}{done.stderr}")

    def test_the_folder_itself_and_the_runs_of_the_figure(self):
        for name, changes in {"itself": {}, **rows.MAIN}.items():
            done = self.dry_run(name, changes)
            self.assertEqual(done.returncode, 0, f"{name}: {done.stdout}{done.stderr}")

    def test_changes_are_changes(self):
        for row in rows.ROWS:
            case = self.folder / ("changed-" + row.name)
            measure.make_case(case, row.changes)
            changed = [file for file in row.changes if (case / file).read_text() != (CASE / file).read_text()]
            expected = [file for file, words in row.changes.items() if words != {"stressTreatment": "automatic"}]
            self.assertEqual(changed, expected, row.name)

    def test_a_word_that_is_not_there(self):
        case = self.folder / "wrong"
        with self.assertRaises(SystemExit) as caught:
            measure.make_case(case, {rows.SCHEMES: {"stressTreatmnt": "none"}})
        self.assertIn("stressTreatmnt", str(caught.exception))


class Readme(unittest.TestCase):
    def test_its_tables_were_written_by_the_script(self):
        text = (CASE / "README.md").read_text()
        self.assertEqual(readme.written(text), text, "run cases/trustworthyStress/readme.py")

    def test_its_rows_are_those_there_are(self):
        part = (CASE / "README.md").read_text().split("<!-- tradeOff -->\n")[1].split("<!-- end -->")[0]
        labels = [line.split("|")[1].strip() for line in part.splitlines() if line.startswith("|")][2:]
        self.assertEqual(labels, [row.label for row in rows.ROWS])
        self.assertEqual(len({row.name for row in rows.ROWS}), len(rows.ROWS))
        for row in rows.ROWS:
            self.assertIn(row.baseline, [other.name for other in rows.ROWS])

    def test_a_number_that_was_changed_by_hand(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "cases" / "trustworthyStress"
            shutil.copytree(CASE, copy, ignore=shutil.ignore_patterns("plain*", "cured*", "tradeOff", "__pycache__"))
            check = ["/usr/bin/python3", "-B", copy / "readme.py", "-check"]
            self.assertEqual(subprocess.run(check, capture_output=True).returncode, 0)
            with open(copy / "tradeOff.csv", newline="") as file:
                lines = list(csv.DictReader(file))
            lines[0]["noise0.5"] = 7.77
            with open(copy / "tradeOff.csv", "w", newline="") as file:
                out = csv.DictWriter(file, lines[0])
                out.writeheader()
                out.writerows(lines)
            self.assertEqual(subprocess.run(check, capture_output=True).returncode, 1)

    def test_figures_and_scripts_are_there(self):
        text = (CASE / "README.md").read_text()
        for name in ("figure1.png", "cut.png", "motion.png", "tradeOff.png", "sketch.svg"):
            self.assertIn(f"({name})", text)
            self.assertTrue((CASE / name).is_file(), name)
        for name in ("Allrun", "Allclean", "tradeOff.py", "figures.py", "readme.py"):
            self.assertTrue(os.access(CASE / name, os.X_OK), name)


if __name__ == "__main__":
    unittest.main()

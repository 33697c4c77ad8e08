"""mpmSolve -profile: every second of a run has a row, and particle-steps are counted as they are.

    profile.py [Profile.test_name ...]     MPM_BUILD_DIR names the build (default: build/)

The collapsing column with early splitting, so that the number of particles grows on the way.
"""

import csv
import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"
PASSES = ["start", "weights", "toGrid", "nodal", "toParticles", "law", "sort", "split", "timeStep", "monitor",
          "history", "output", "other", "total", "processor"]


def change(case, file, word, value):
    path = case / file
    text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", path.read_text())
    assert count == 1, f"{word} in {file}"
    path.write_text(text)


class Profile(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.case = Path(folder.name)
        for part in ("geometry", "constant", "system"):
            shutil.copytree(COLUMN / part, cls.case / part)
        change(cls.case, "system/controlDict", "endTime", "0.5")
        change(cls.case, "system/controlDict", "historyInterval", "1")
        change(cls.case, "system/mpmSchemes", "threshold", "1.2")
        cls.run_utility("seedParticles")
        begin = time.perf_counter()
        cls.log = cls.run_utility("mpmSolve", "-profile")
        cls.wall = time.perf_counter() - begin
        with open(cls.case / "postProcessing" / "profile.csv", newline="") as file:
            cls.header, *cls.rows = csv.reader(file)
        cls.seconds = {row[0]: float(row[1]) for row in cls.rows}

    @classmethod
    def run_utility(cls, name, *options):
        return subprocess.run([BINARIES / name, *options], cwd=cls.case, check=True, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=600).stdout

    def test_columns_and_passes(self):
        self.assertEqual(self.header, ["pass", "seconds", "share", "nsPerParticleStep"])
        self.assertEqual([row[0] for row in self.rows], PASSES)

    def test_rows_add_up_to_the_wall_time(self):
        total = self.seconds["total"]
        self.assertAlmostEqual(sum(self.seconds[name] for name in PASSES[:-2]), total, delta=1e-9 * total)
        for name, seconds in self.seconds.items():
            # what no clock sees is measured as a difference
            self.assertGreaterEqual(seconds, -0.01 * total if name == "other" else 0, name)
        self.assertLess(total, self.wall)
        self.assertGreater(total, 0.5 * self.wall)
        for name in ("start", "toGrid", "nodal", "toParticles", "law", "sort", "split", "history", "output"):
            self.assertGreater(self.seconds[name], 0, name)
        passes = sum(self.seconds[name] for name in PASSES[1:8])
        self.assertGreater(passes, 0.5 * (total - self.seconds["history"]), "the steps are most of this run")

    def test_processor_time_of_the_steps(self):
        # one thread: what the passes took, but for waiting; nothing of reading the case and writing files
        steps = sum(self.seconds[name] for name in PASSES[1:10]) + self.seconds["other"]
        self.assertLess(self.seconds["processor"], 1.1 * steps + 0.02)
        self.assertGreater(self.seconds["processor"], 0.3 * steps)

    def test_shares(self):
        for row in self.rows:
            self.assertAlmostEqual(float(row[2]), float(row[1]) / self.seconds["total"], delta=1e-12)

    def test_every_particle_of_every_step_counts(self):
        with open(self.case / "postProcessing" / "history.csv", newline="") as file:
            particles = [float(row["particles"]) for row in csv.DictReader(file)]
        self.assertEqual(len(particles), 501)
        self.assertGreater(particles[-1], 1.2 * particles[0])
        particle_steps = sum(particles[1:])  # the first row is the start
        for name, seconds, _, nanoseconds in self.rows:
            self.assertAlmostEqual(float(nanoseconds), 1e9 * float(seconds) / particle_steps,
                                   delta=1e-9 * abs(float(nanoseconds)), msg=name)

    def test_the_summary_shows_the_same(self):
        table = self.log[self.log.index("\n  pass "):].splitlines()[2:]
        shown = {row.split()[0]: float(row.split()[1]) for row in table}
        for name, seconds in self.seconds.items():
            if seconds != 0:
                self.assertAlmostEqual(shown[name], seconds, delta=0.002 + 0.05 * seconds, msg=name)
        self.assertEqual([name for name in PASSES if name in shown], list(shown))

    def test_only_if_asked_for(self):
        (self.case / "postProcessing" / "profile.csv").rename(self.case / "kept.csv")
        self.run_utility("mpmSolve")  # nothing left to do, yet a run
        self.assertFalse((self.case / "postProcessing" / "profile.csv").exists())
        (self.case / "kept.csv").rename(self.case / "postProcessing" / "profile.csv")


if __name__ == "__main__":
    unittest.main()

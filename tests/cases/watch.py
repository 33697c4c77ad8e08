"""seedParticles -watch: a script in the place of a person who edits the geometry of a case while it is watched.

A changed geometry is seeded again; a mistake is told and leaves the state as it was, bit by bit; mended, it goes on; a
dictionary counts as well, a touch does not; Ctrl-C ends it with 130.
"""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import h5py

PROJECT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
CASE = BUILD / "tests" / "cases" / "watch"
PATIENCE = 60  # [s] for what takes a fraction of one


class Watch(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(CASE, ignore_errors=True)
        for part in ("geometry", "constant", "system"):
            shutil.copytree(PROJECT / "cases" / "collapsingSoilColumn" / part, CASE / part)
        self.log = CASE / "log.watch"
        self.process = None

    def tearDown(self):
        if self.process and self.process.poll() is None:
            self.process.kill()
            self.process.wait()

    def start(self, *options):
        with open(self.log, "w") as log:
            self.process = subprocess.Popen([BUILD / "bin" / "seedParticles", "-watch", *options], cwd=CASE, stdout=log,
                                            stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        return self.process

    def seen(self, times):
        """Until it watches for the so many-th time; what it said since the time before."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.process.poll() is None:
            rounds = self.log.read_text().split("watching geometry")
            if len(rounds) > times:
                return rounds[times - 1]
            time.sleep(0.02)
        self.fail(f"not seen:\n{self.log.read_text()}")

    def particles(self):
        with h5py.File(CASE / "0" / "state.h5") as file:
            return len(file["particles/mass"])

    def state(self):
        return hashlib.sha256((CASE / "0" / "state.h5").read_bytes()).hexdigest()

    def edit(self, file, old, new):
        path = CASE / file
        text = path.read_text()
        self.assertIn(old, text)
        path.with_suffix(".partial").write_text(text.replace(old, new))
        path.with_suffix(".partial").replace(path)  # as editors do

    def test_a_changed_geometry_is_seeded_again(self):
        self.start()
        self.seen(1)
        self.assertEqual(self.particles(), 1800)

        self.edit("geometry/column.geo", "height = 8;", "height = 4;")
        self.assertIn("changed: geometry/column.geo", self.seen(2))
        self.assertEqual(self.particles(), 900)
        kept = self.state()

        self.edit("geometry/column.geo", "height = 4;", "height = ;")
        said = self.seen(3)
        self.assertRegex(said, r"--> seedParticles: error: \S*column.geo:\d+: gmsh: ")
        self.assertIn("0/state.h5 is as it was", said)
        self.assertEqual(self.state(), kept)

        self.edit("geometry/column.geo", "height = ;", "height = 6;")
        self.assertIn("wrote 0/state.h5", self.seen(4))
        self.assertEqual(self.particles(), 1350)

        self.edit("system/seedParticlesDict", "particlesPerCell    2;", "particlesPerCell    1;")
        self.assertIn("changed: system/seedParticlesDict", self.seen(5))
        self.assertLess(self.particles(), 400)

        os.utime(CASE / "geometry" / "column.geo")
        time.sleep(1)
        self.assertEqual(self.log.read_text().count("watching geometry"), 5, "a touch is no change")
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(PATIENCE), 130)
        self.assertFalse((CASE / ".caseLock").exists())

    def test_a_broken_start_is_watched_too(self):
        self.edit("geometry/column.geo", "height = 8;", "height = ;")
        self.start()
        self.assertIn("error", self.seen(1))
        self.assertFalse((CASE / "0").exists())
        self.edit("geometry/column.geo", "height = ;", "height = 8;")
        self.seen(2)
        self.assertEqual(self.particles(), 1800)
        self.process.send_signal(signal.SIGTERM)
        self.assertEqual(self.process.wait(PATIENCE), 143)

    def test_an_old_state_is_replaced_only_when_told(self):
        subprocess.run([BUILD / "bin" / "seedParticles"], cwd=CASE, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(self.start().wait(PATIENCE), 1)
        self.assertIn("-overwrite", self.log.read_text())
        self.start("-overwrite")
        self.assertIn("wrote 0/state.h5", self.seen(1))
        self.process.send_signal(signal.SIGINT)
        self.assertEqual(self.process.wait(PATIENCE), 130)


if __name__ == "__main__":
    sys.dont_write_bytecode = True
    unittest.main(verbosity=2)

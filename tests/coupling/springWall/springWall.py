#!/usr/bin/python3
"""cases/columnSpringWall for a tenth of a second: the ways to couple it agree bit by bit, balances close, explicit coupling
fails with a light wall; and one side dies.

    springWall.py [precice]     precice: the tests with real preCICE, where libmpm was built with it
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[3]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
os.environ["PATH"] = f"{BUILD / 'bin'}:{os.environ['PATH']}"
os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(PROJECT / "cases" / "columnSpringWall"))
sys.path.insert(0, str(PROJECT / "etc"))
sys.dont_write_bytecode = True
import couple  # noqa: E402
import sceneReport  # noqa: E402

CASE = BUILD / "tests" / "coupling" / ("springWallPreciceCase" if "precice" in sys.argv else "springWallCase")
SHORT = ("-end", "0.1")


def setUpModule():
    shutil.rmtree(CASE, ignore_errors=True)
    CASE.mkdir(parents=True)
    for part in ("constant", "system", "geometry", "precice-config.xml"):
        source = PROJECT / "cases" / "columnSpringWall" / part
        (shutil.copytree if source.is_dir() else shutil.copy)(source, CASE / part)
    text = (CASE / "precice-config.xml").read_text()
    (CASE / "precice-config.xml").write_text(text.replace('max-time value="1"', 'max-time value="0.1"'))
    subprocess.run(["seedParticles"], cwd=CASE, check=True, stdout=subprocess.DEVNULL)


def rows(name):
    return np.genfromtxt(CASE / "variants" / name / "wall.csv", delimiter=",", names=True)


def bytes_of(name):
    return (CASE / "variants" / name / "wall.csv").read_bytes()


def said(name, program="wallMaster"):
    return (CASE / "variants" / name / f"log.{program}").read_text()


def times(folder):
    return sorted(float(p.parent.name) for p in folder.glob("*/state.h5"))


def until(condition):
    """Waits for what another process does; fails after 20 s."""
    for _ in range(1000):
        if condition():
            return
        time.sleep(0.02)
    raise AssertionError("nothing happened for 20 s")


def grown(file, lines):
    return file.is_file() and len(file.read_text().splitlines()) > lines


class Ways(unittest.TestCase):
    def test_three_ways_are_one(self):
        for scheme in couple.SCHEMES:
            for link, way in zip(couple.LINKS, (couple.in_process, couple.by_socket, couple.by_fmu)):
                self.assertEqual(way(CASE, f"{link}-{scheme}", "-coupling", scheme, *SHORT), 0)
            self.assertEqual(bytes_of(f"socket-{scheme}"), bytes_of(f"inProcess-{scheme}"))
            self.assertEqual(bytes_of(f"fmu-{scheme}"), bytes_of(f"inProcess-{scheme}"))
        self.assertNotEqual(bytes_of("inProcess-explicit"), bytes_of("inProcess-implicit"))

    def test_impulse_and_work_arrive(self):
        self.assertEqual(couple.in_process(CASE, "balance", *SHORT, "-damping", 1e5), 0)
        last = rows("balance")[-1]
        self.assertGreater(last["x"], 1e-3)
        self.assertEqual(last["soilImpulse"], last["wallImpulse"])
        self.assertLess(abs(last["soilWork"] + last["wallWork"]), 1e-7 * last["wallWork"])
        energy = last["kineticEnergy"] + last["springEnergy"] + last["heat"]
        self.assertLess(abs(energy - last["wallWork"]), 1e-8 * last["wallWork"])
        # what the soil wrote itself, window by window
        windows = sceneReport.series(CASE / "variants" / "balance", "wallWindows")
        self.assertAlmostEqual(windows["impulseX"].sum(), last["soilImpulse"], delta=1e-9 * last["soilImpulse"])
        budget = sceneReport.series(CASE / "variants" / "balance", "energyBudget")
        self.assertLess(abs(budget["residual"]).max(), 1e-9 * budget["gravityWork"].max())
        self.assertAlmostEqual(budget["motionWork"][-1], last["soilWork"], delta=1e-9 * last["wallWork"])

    def test_orders(self):
        end = ("-end", "0.096")
        couple.in_process(CASE, "exact", "-window", 0.0005, *end)
        exact = rows("exact")
        errors = {}
        for scheme in couple.SCHEMES:
            for window in (0.002, 0.004):
                couple.in_process(CASE, "window", "-coupling", scheme, "-window", window, *end)
                coarse = rows("window")
                errors[scheme, window] = abs(coarse["x"] - np.interp(coarse["time"], exact["time"], exact["x"])).max()
        self.assertGreater(errors["implicit", 0.004] / errors["implicit", 0.002], 2**1.5)
        self.assertLess(errors["explicit", 0.004] / errors["explicit", 0.002], 2**1.5)
        self.assertLess(errors["implicit", 0.004], 0.1 * errors["explicit", 0.004])

    def test_light_wall(self):
        self.assertEqual(couple.in_process(CASE, "light-explicit", "-coupling", "explicit", "-mass", 100, *SHORT), 2)
        self.assertRegex(said("light-explicit"), r"^--> wallMaster: error: at 0\.\d+ s: .*jump: wall: .*\n$")
        self.assertEqual(couple.in_process(CASE, "light-implicit", "-mass", 100, *SHORT), 0)
        self.assertLess(rows("light-implicit")["x"].max(), 0.1)

    def test_readme_is_what_was_measured(self):
        report = PROJECT / "cases" / "columnSpringWall" / "report.py"
        self.assertEqual(subprocess.run([report, "-check"]).returncode, 0)

    def test_the_soil_dies(self):
        folder = couple.copy(CASE, "noSoil")
        server = couple.start(folder, "soilServer", ".", "soil")
        master = couple.start(folder, "wallMaster", "-socket", "soil", "-end", "100", "-output", "wall.csv")
        until(lambda: grown(folder / "wall.csv", 1))
        server.kill()
        self.assertEqual(master.wait(20), 2)
        server.wait()
        self.assertRegex(said("noSoil"), r"^--> wallMaster: error: at .* s: the soil's process is gone\n$")

    def test_the_wall_dies(self):
        folder = couple.copy(CASE, "noWall")
        server = couple.start(folder, "soilServer", ".", "soil")
        master = couple.start(folder, "wallMaster", "-socket", "soil", "-end", "100", "-output", "wall.csv")
        until(lambda: grown(folder / "wall.csv", 1))
        master.kill()
        self.assertEqual(server.wait(20), 2)
        master.wait()
        self.assertRegex(said("noWall", "soilServer"), r"^--> soilServer: error: the wall went away; .*\n$")
        last = times(folder)[-1]
        self.assertGreater(last, 0)
        self.assertAlmostEqual(last / 0.01, round(last / 0.01), places=6)  # the end of a window


class MpmCouple(unittest.TestCase):
    def couple(self, folder, *options):
        return subprocess.run(["mpmCouple", *options], cwd=folder, capture_output=True, text=True, timeout=60)

    def test_dry_run_and_without_precice(self):
        folder = couple.copy(CASE, "dry")
        done = self.couple(folder, "-dry-run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Rigid wall on mesh SoilMesh: reads Displacement, Rotation; writes Force", done.stdout)
        if "built without preCICE" in self.couple(folder, "-help").stdout:
            done = self.couple(folder)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"^--> mpmCouple: error: built without preCICE: install preCICE 3 .*\n$")

    def test_wrong_words(self):
        folder = couple.copy(CASE, "wrong")
        path = folder / "system" / "couplingDict"
        path.write_text(path.read_text().replace("(Displacement Rotation)", "(Displacment)"))
        done = self.couple(folder, "-dry-run")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"system/couplingDict:\d+: .*did you mean 'Displacement'\?")


@unittest.skipUnless("precice" in sys.argv, "asked for by name")
class Precice(unittest.TestCase):
    def long(self, name):
        folder = couple.copy(CASE, name)
        path = folder / "precice-config.xml"
        path.write_text(path.read_text().replace('max-time value="0.1"', 'max-time value="1000"'))
        return folder

    def test_agrees_with_one_process(self):
        for scheme in couple.SCHEMES:
            self.assertEqual(couple.by_precice(CASE, f"precice-{scheme}", scheme), 0)
            couple.in_process(CASE, f"beside-{scheme}", "-coupling", scheme, *SHORT)
            ours, theirs = rows(f"beside-{scheme}"), rows(f"precice-{scheme}")
            self.assertEqual(len(ours), len(theirs))
            self.assertLessEqual(abs(ours["x"] - theirs["x"]).max(), 0 if scheme == "explicit" else 1e-7)

    def test_sub_cycling_within_windows(self):
        folder = couple.copy(CASE, "precice-sub")
        path = folder / "system" / "couplingDict"
        path.write_text(path.read_text().replace("participant     Soil;", "participant     Soil; maxStep 0.004;"))
        shutil.copytree(folder, CASE / "subCycled", dirs_exist_ok=True)
        wall = couple.start(folder, "wallForPrecice", "precice-config.xml", "2e4", "0", "5e5", "wall.csv")
        self.assertEqual(couple.call(folder, "mpmCouple"), 0)
        self.assertEqual(wall.wait(20), 0)
        windows = sceneReport.series(folder, "wallWindows")
        self.assertEqual(len(windows), 10)  # rows for accepted windows, not for steps or iterations
        couple.in_process(CASE, "beside", *SHORT)
        self.assertLess(abs(rows("beside")["x"] - rows("precice-sub")["x"]).max(), 0.1 * rows("beside")["x"].max())

    def breaks(self, folder, code):
        wall = couple.start(folder, "wallForPrecice", "precice-config.xml", "2e4", "0", "5e5", "wall.csv")
        with open(folder / "stderr", "w") as errors, open(folder / "log.mpmCouple", "w") as log:
            soil = subprocess.Popen(["mpmCouple"], cwd=folder, stdout=log, stderr=errors)
        until(lambda: grown(folder / "wall.csv", 3))
        code(wall, soil)
        wall.wait(20)
        status = soil.wait(20)
        text = (folder / "stderr").read_text()
        self.assertEqual(text.count("\n"), 1, text)
        said = re.search(r"the last accepted window is in ([\d.]+)/state.h5", text)
        self.assertEqual(float(said[1]), times(folder)[-1])
        self.assertAlmostEqual(sceneReport.series(folder, "wallWindows")["time"][-1], times(folder)[-1], places=9)
        return status, text

    def test_the_wall_dies(self):
        folder = self.long("dead")
        status, text = self.breaks(folder, lambda wall, soil: wall.kill())
        self.assertEqual(status, 2)
        self.assertTrue(text.startswith("--> mpmCouple: error: preCICE: "), text)
        before = times(folder)[-1]
        path = folder / "precice-config.xml"  # and goes on
        path.write_text(path.read_text().replace('max-time value="1000"', 'max-time value="0.02"'))
        shutil.rmtree(folder / "precice-run", ignore_errors=True)
        wall = couple.start(folder, "wallForPrecice", "precice-config.xml", "2e4", "0", "5e5", "again.csv")
        self.assertEqual(couple.call(folder, "mpmCouple"), 0)
        self.assertEqual(wall.wait(20), 0)
        self.assertAlmostEqual(times(folder)[-1], before + 0.02, places=6)

    def test_a_signal(self):
        status, text = self.breaks(self.long("signal"), lambda wall, soil: soil.send_signal(signal.SIGTERM))
        self.assertEqual(status, 128 + signal.SIGTERM)
        self.assertIn("stopped by SIGTERM", text)

    def test_a_signal_while_the_wall_sleeps(self):
        def sleep(wall, soil):
            wall.send_signal(signal.SIGSTOP)
            time.sleep(0.3)
            soil.send_signal(signal.SIGINT)
            soil.wait(20)
            wall.kill()

        status, text = self.breaks(self.long("asleep"), sleep)
        self.assertEqual(status, 128 + signal.SIGINT)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + (["Precice"] if "precice" in sys.argv else ["Ways", "MpmCouple"]))

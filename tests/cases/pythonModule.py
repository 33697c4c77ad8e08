"""import libmpm: the participant's verbs, arrays without copies, errors, states through pickle, threads, the example.

    pythonModule.py     MPM_BUILD_DIR names the build (default: build/)
"""

import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve()
sys.path.insert(0, str(BUILD / "python"))
import libmpm  # noqa: E402

WALL = np.array([(-1.2, 0.3), (-0.25, 0.3), (-0.25, 6.0), (-1.2, 6.0)])
SIDES = np.array([(0, 1), (1, 2), (2, 3), (3, 0)])
CENTRE = WALL.mean(axis=0)
WINDOW = 0.02


class Module(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.seeded = cls.folder / "seeded"
        shutil.copytree(PROJECT / "cases" / "collapsingSoilColumn", cls.seeded,
                        ignore=shutil.ignore_patterns("[0-9]*", "*.png", "postProcessing", "log.*"))
        control = cls.seeded / "system" / "controlDict"
        control.write_text(re.sub(r"(?ms)^recordStrain.*?^}", "", control.read_text()))  # for mpmSolve alone
        for file, word, value in (("gridDict", "cellSize", "0.4"), ("seedParticlesDict", "particlesPerCell", "3")):
            path = cls.seeded / "system" / file
            path.write_text(re.sub(rf"(?m)^({word}\s+)[^;]*", rf"\g<1>{value}", path.read_text()))
        subprocess.run([BUILD / "bin" / "seedParticles", "-case", cls.seeded], check=True, stdout=subprocess.DEVNULL)

    def case(self, name=""):
        return shutil.copytree(self.seeded, self.folder / (self.id() + name))

    def soil(self, **options):
        soil = libmpm.Participant(self.case(), **options)
        soil.add_coupling_surface("wall", WALL, SIDES, mu=0.3)
        soil.add_coupling_surface("probe", [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0)], [(0, 1), (1, 2)], kind="Monitor")
        soil.initialize()
        return soil

    def push(self, soil, way):
        soil.write_field("wall", "RigidPose", [CENTRE[0] + way, CENTRE[1], 0, 1, 0, 0, 0], WINDOW)
        self.assertTrue(soil.advance(WINDOW))

    def test_a_wall_is_pushed_against_the_soil(self):
        soil = self.soil()
        self.assertEqual((soil.dimension, soil.lifecycle, soil.surfaces), (2, "Initialized", ["wall", "probe"]))
        for i in range(10):
            self.push(soil, 0.02 * (i + 1))
            soil.accept_window()
        self.assertEqual(soil.lifecycle, "Stepping")
        self.assertAlmostEqual(soil.time, 0.2, delta=1e-12)
        force = soil.window_average("wall", "Force")
        self.assertLess(force[0], 0)
        sums = soil.resultants("wall")
        np.testing.assert_array_equal(sums.force, force)
        np.testing.assert_allclose(sums.impulse, force * WINDOW, rtol=1e-12)
        balance = soil.balance()
        self.assertEqual(balance.interface_work, soil.interface_work("wall") + soil.interface_work("probe"))
        self.assertLess(abs(balance.residual), 1e-9 * balance.gravity_work)
        self.assertAlmostEqual(balance.motion_work, balance.interface_work, delta=1e-9 * balance.gravity_work)
        stress = soil.read_field("probe", "Stress")
        self.assertEqual(stress.shape, (3, 6))
        vertical = stress[:, 1]  # 6 m below the top: -59 kPa before the column falls, less when it does
        self.assertTrue(((vertical > -59e3) & (vertical < -5e3)).all(), stress)
        soil.finalize()
        self.assertEqual(soil.lifecycle, "Finalized")

    def test_arrays_are_filled_where_they_lie(self):
        soil = self.soil()
        self.push(soil, 0.02)
        out = np.full((4, 3), np.nan)
        back = soil.read_field("wall", "Traction", out=out)
        self.assertTrue(np.shares_memory(back, out))
        np.testing.assert_array_equal(out, soil.read_field("wall", "Traction"))
        vertices = soil.vertices("wall")
        self.assertFalse(vertices.flags.owndata)
        del soil
        np.testing.assert_array_equal(vertices, np.column_stack([WALL, np.zeros(4)]))

    def test_arrays_that_do_not_fit_are_refused(self):
        soil = self.soil()
        self.push(soil, 0.02)
        for out in (np.zeros(3), np.zeros((4, 6))[:, ::2], np.zeros((3, 4)).T):
            with self.assertRaisesRegex(ValueError, "^out: "):
                soil.read_field("wall", "Traction", out=out)
        fixed = np.zeros((4, 3))
        fixed.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "^out: "):
            soil.read_field("wall", "Traction", out=fixed)
        for out in (np.zeros((4, 3), dtype=np.float32), [0.0] * 12):
            with self.assertRaisesRegex(TypeError, "^out: "):
                soil.read_field("wall", "Traction", out=out)
        for wrong in (np.zeros((4, 4)), np.zeros(8)):
            with self.assertRaisesRegex(ValueError, "vertices"):
                libmpm.Participant(self.seeded).add_coupling_surface("a", wrong, SIDES)

    def test_faults_have_names(self):
        soil = self.soil()
        pose = [CENTRE[0], CENTRE[1], 0, 1, 0, 0, 0]
        for fault, call in {
            "callOrder": soil.initialize,
            "unknownSurface": lambda: soil.write_field("wal", "RigidPose", pose),
            "unknownField": lambda: soil.write_field("wall", "Pose", pose),
            "wrongSize": lambda: soil.write_field("wall", "RigidPose", pose[:6]),
            "notFinite": lambda: soil.write_field("wall", "RigidPose", [np.nan] + pose[1:]),
            "badValue": lambda: soil.write_field("wall", "RigidPose", np.zeros(7)),
            "badWindow": lambda: soil.advance(0),
            "badState": lambda: soil.restore_state(pickle.loads(pickle.dumps(soil.save_state()).replace(b"soil", b"coal"))),
            "files": lambda: soil.export_surface("wall", self.folder / "none" / "wall.vtp"),
        }.items():
            with self.subTest(fault):
                with self.assertRaises(libmpm.CouplingError) as caught:
                    call()
                self.assertEqual(caught.exception.fault, fault)
                self.assertTrue(str(caught.exception).startswith(fault + ": "), caught.exception)

    def test_settings_stand_in_for_words_of_the_dictionaries(self):
        steps = []
        for stiffness in (np.float64(5e6), 20000000):
            soil = libmpm.Participant(self.case(f"{stiffness}"), settings={
                "constant/materialProperties": {"soil.E": stiffness},
                "system/controlDict": {"adjustTimeStep": True, "deltaT": 1}})
            soil.initialize()
            steps.append(soil.stable_time_step)
        self.assertAlmostEqual(steps[0] / steps[1], 2, delta=0.02)  # ~ 1/sqrt(E)
        soil = libmpm.Participant(self.case("aslant"), settings={"constant/g": {"value": (3.0, 0, 0)}})
        soil.initialize()
        soil.advance(WINDOW)
        self.assertAlmostEqual(soil.balance().momentum[0] / (32000 * 3 * WINDOW), 1, delta=0.05)  # 4 m x 8 m
        for words, error, text in (({"system/mpmSchemes": {"shape": "round"}}, libmpm.InputError, "round.*uGIMP"),
                                   ({"system/mpmSchemes": {"shape": object()}}, TypeError, "object"),
                                   ({"system/mpmSchemes": "shape"}, TypeError, "word")):
            with self.assertRaisesRegex(error, text):
                libmpm.Participant(self.seeded, settings=words)

    def test_a_pickled_state_goes_on_bitwise_in_another_process(self):
        soil = self.soil()
        self.push(soil, 0.02)
        held = self.folder / "held.pickle"
        held.write_bytes(pickle.dumps(soil.save_state()))
        self.push(soil, 0.04)
        again = shutil.copytree(self.seeded, self.folder / "again")
        code = f"""
import pickle, sys
sys.path.insert(0, {str(BUILD / 'python')!r}); sys.path.insert(0, {str(Path(__file__).parent)!r})
import libmpm, pythonModule as m
soil = libmpm.Participant({str(again)!r})
soil.add_coupling_surface("wall", m.WALL, m.SIDES, mu=0.3)
soil.add_coupling_surface("probe", [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0)], [(0, 1), (1, 2)], kind="Monitor")
soil.initialize()
soil.restore_state(pickle.load(open({str(held)!r}, "rb")))
soil.write_field("wall", "RigidPose", [m.CENTRE[0] + 0.04, m.CENTRE[1], 0, 1, 0, 0, 0], m.WINDOW)
soil.advance(m.WINDOW)
print(soil.time.hex(), soil.balance().kinetic_energy.hex(), soil.window_average("wall", "Force").tobytes().hex())
"""
        said = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, timeout=120)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertEqual(said.stdout.split(), [soil.time.hex(), soil.balance().kinetic_energy.hex(),
                                               soil.window_average("wall", "Force").tobytes().hex()])

    def test_python_runs_on_while_the_soil_steps(self):
        soil = self.soil()
        stepping = threading.Thread(target=lambda: soil.advance(0.3))
        counted = refused = 0
        stepping.start()
        while stepping.is_alive():
            counted += 1
            try:
                soil.time
            except RuntimeError as error:
                refused += "another thread" in str(error)
        stepping.join()
        self.assertGreater(counted, 20)
        self.assertGreater(refused, 10)
        self.assertAlmostEqual(soil.time, 0.3, delta=1e-12)

    def test_every_verb_is_explained(self):
        for name in dir(libmpm.Participant):
            if not name.startswith("_") and name not in ("dimension", "kind"):
                self.assertGreater(len(getattr(libmpm.Participant, name).__doc__ or ""), 2, name)

    def test_the_example_draws_its_picture(self):
        case = self.case()
        said = subprocess.run([PROJECT / "examples" / "python" / "pushedWall.py", case, "0.1"], text=True,
                              capture_output=True, timeout=120, env={**os.environ, "PYTHONPATH": str(BUILD / "python")})
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
        self.assertRegex(said.stdout, "5 windows, .*\nwork of the wall on the soil: [1-9]")
        self.assertGreater((case / "pushedWall.png").stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main()

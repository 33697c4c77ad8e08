"""One run, cut and threaded in every way: the states it ends with must be the same bit for bit.

    reproducibility.py [Reproducibility.test_name ...]     MPM_BUILD_DIR names the build (default: build/)

The scene is the collapsing column with an early, busy splitting, so that particle numbers change on the way.
"""

import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np
from columnCase import BINARIES, ColumnCase

END = "1"


def content(path):
    """Everything a restart reads, by name: bytes, so that -0.0 is not 0.0."""
    held = {}
    with h5py.File(path) as file:
        for name, value in file.attrs.items():
            held[f"/{name}"] = np.asarray(value).tobytes()
        for group in ("particles", "grid", "ledger", "patches"):
            if group in file:
                file[group].visititems(lambda name, item, group=group: held.update(
                    {f"{group}/{name}": item[()].tobytes()} if isinstance(item, h5py.Dataset) else {}))
    return held


class Reproducibility(ColumnCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.seed(endTime=("system/controlDict", END), threshold=("system/mpmSchemes", "1.3"))
        cls.whole = cls.fresh("whole")
        cls.run_utility(cls.whole, "mpmSolve")
        cls.expected = content(cls.whole / END / "state.h5")

    def assert_same(self, case):
        found = content(case / END / "state.h5")
        self.assertEqual([name for name in self.expected if found.get(name) != self.expected[name]], [])
        self.assertEqual(set(found), set(self.expected))

    def history(self, case):
        return (case / "postProcessing" / "history.csv").read_text().splitlines()

    def test_the_scene_splits_on_the_way(self):
        with h5py.File(self.whole / END / "state.h5") as file:
            self.assertGreater(len(file["particles/id"]), 2500)

    def test_threads(self):
        for threads in ("1", "2", "3"):
            case = self.fresh(f"threads{threads}")
            self.run_utility(case, "mpmSolve", "-threads", threads)
            self.assert_same(case)
            self.assertEqual(self.history(case), self.history(self.whole))

    def test_restart_after_an_earlier_end(self):
        case = self.fresh("extended")
        self.set(case, "system/controlDict", "endTime", "0.25")
        self.run_utility(case, "mpmSolve")
        self.assertFalse((case / END).exists())
        self.set(case, "system/controlDict", "endTime", END)
        self.run_utility(case, "mpmSolve")
        self.assert_same(case)
        self.assertEqual(self.history(case), self.history(self.whole))

    def test_restart_from_every_stored_time(self):
        for name in ("0.25", "0.5", "0.75"):
            with self.subTest(name):
                case = self.fresh(f"from{name}")
                shutil.rmtree(case / "0")
                shutil.copytree(self.whole / name, case / name)
                self.run_utility(case, "mpmSolve")
                self.assert_same(case)

    def test_any_order_of_particles_in_the_file(self):
        case = self.fresh("shuffled")
        shutil.copytree(self.whole / "0.5", case / "0.5")
        with h5py.File(case / "0.5" / "state.h5", "r+") as file:
            order = np.random.default_rng(1).permutation(len(file["particles/id"]))
            for item in file["particles"].values():
                item[...] = item[()][order]
        self.run_utility(case, "mpmSolve")
        self.assert_same(case)

    def stop_half_way(self, case, how):
        """Starts mpmSolve and sends it the signal as soon as a state was written; returns its exit code."""
        with subprocess.Popen([BINARIES / "mpmSolve"], cwd=case, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                              stdin=subprocess.DEVNULL) as run:
            while not (case / "0.25" / "state.h5").exists() and run.poll() is None:
                time.sleep(0.001)
            run.send_signal(how)
            return run.wait(timeout=60)

    def test_a_stopped_run_keeps_whole_states_and_goes_on(self):
        for how in (signal.SIGINT, signal.SIGKILL):
            with self.subTest(how.name):
                case = self.fresh(how.name)
                code = self.stop_half_way(case, how)
                self.assertNotEqual(code, 0)
                self.assertFalse((case / END / "state.h5").exists(), "stopped too late to test anything")
                for state in case.glob("[0-9]*/state.h5"):
                    self.assertTrue(content(state))
                self.run_utility(case, "mpmSolve")
                self.assert_same(case)
                self.assertEqual(self.history(case), self.history(self.whole))
                self.assertEqual({path.name for path in case.glob("[0-9]*/*")}, {"state.h5"})


if __name__ == "__main__":
    unittest.main()

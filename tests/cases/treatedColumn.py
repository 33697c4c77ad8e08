"""The collapsing column with stress treatments: cut and threaded in every way a run ends with the same bits, and a
treatment that is off leaves no trace.

    treatedColumn.py [Automatic.test_name ...]     MPM_BUILD_DIR names the build (default: build/)
"""

import shutil
import unittest

import h5py
import numpy as np
from columnCase import ColumnCase
from reproducibility import content

END = "0.3"
COLUMNS = {"tensionGap", "dilationRate", "viscousStress", "flowMemory"}


def particles_of(case):
    with h5py.File(case / END / "state.h5") as file:
        return set(file["particles"]), {name: item[()] for name, item in file["particles"].items()}, {
            name: item[()] for name, item in file["ledger"].items()}


class Column(ColumnCase):
    """The column for 0.3 s, with an early, busy splitting, of soil that opens soon."""

    @classmethod
    def seed_with(cls, words, *edits, **settings):
        cls.seed(endTime=("system/controlDict", END), writeInterval=("system/controlDict", "0.1"),
                 threshold=("system/mpmSchemes", "1.05"),
                 cohesion=("constant/materialProperties", "100"), **settings)
        path = cls.seeded / "system" / "mpmSchemes"
        text = path.read_text() + words + "\n"
        for old, new in edits:
            assert text.count(old) == 1, old
            text = text.replace(old, new)
        path.write_text(text)

    @classmethod
    def solve(cls, name, *options):
        case = cls.fresh(name)
        cls.run_utility(case, "mpmSolve", *options)
        return case


class Treated:
    """What every treatment must keep; HELD are the columns it has, LOST the entries of the ledger that it fills."""

    HELD, LOST = set(), set()

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.prepare()
        cls.whole = cls.solve("whole", "-threads", "1")
        cls.expected = content(cls.whole / END / "state.h5")

    def assert_same(self, case):
        found = content(case / END / "state.h5")
        self.assertEqual([name for name in self.expected if found.get(name) != self.expected[name]], [])
        self.assertEqual(set(found), set(self.expected))

    def test_something_happens(self):
        names, values, ledger = particles_of(self.whole)
        self.assertGreater(len(values["id"]), 1800, "no particle was split")
        self.assertEqual(names & COLUMNS, self.HELD)
        for name in self.HELD:
            self.assertGreater(np.count_nonzero(values[name]), 3, name)
        for name in ("relaxationLoss", "averagingLoss", "viscosityLoss", "gapWork"):
            (self.assertNotEqual if name in self.LOST else self.assertEqual)(ledger[name], 0, name)

    def test_threads(self):
        for threads in ("2", "3"):
            with self.subTest(threads):
                self.assert_same(self.solve(f"threads{threads}", "-threads", threads))

    def test_restart_from_every_stored_time(self):
        for name in ("0.1", "0.2"):
            with self.subTest(name):
                case = self.fresh(f"from{name}")
                shutil.rmtree(case / "0")
                shutil.copytree(self.whole / name, case / name)
                self.run_utility(case, "mpmSolve", "-threads", "1")
                self.assert_same(case)


class Automatic(Treated, Column):
    HELD, LOST = {"tensionGap", "viscousStress", "flowMemory"}, {"relaxationLoss", "averagingLoss", "viscosityLoss", "gapWork"}

    @classmethod
    def prepare(cls):
        cls.seed_with("stressTreatment automatic;")


class AutomaticDilating(Treated, Column):
    HELD, LOST = {"dilationRate", "viscousStress", "flowMemory"}, {"relaxationLoss", "averagingLoss", "viscosityLoss"}

    @classmethod
    def prepare(cls):
        cls.seed_with("stressTreatment automatic;", dilationAngle=("constant/materialProperties", "5"))


class Conjugate(Treated, Column):
    """Relaxation and a filter at intervals that fit no time of writing."""

    HELD, LOST = {"tensionGap", "flowMemory"}, {"relaxationLoss", "gapWork"}

    @classmethod
    def prepare(cls):
        cls.seed_with("""
            order 2; filterRate 5; filterInterval 7;
            stressTreatment
            {
                volumetricAveraging { region cell; conjugate yes; }
                stressRelaxation    { target smoothed; rate 50; interval 13; }
                tensionGap          yes;
            }""", ("transfer        FLIP;", "transfer XPIC;"), ("picRate         2; ", "//"))


class Off(Column):
    def test_none_is_no_word_at_all(self):
        self.seed_with("")
        plain = content(self.solve("plain", "-threads", "2") / END / "state.h5")
        case = self.fresh("none")
        path = case / "system" / "mpmSchemes"
        path.write_text(path.read_text() + "stressTreatment none;\n")
        self.run_utility(case, "mpmSolve", "-threads", "2")
        none = content(case / END / "state.h5")
        self.assertEqual({name for name in plain if plain[name] != none.get(name)}, set())
        self.assertEqual(set(none), set(plain))
        self.assertEqual(particles_of(case)[0] & COLUMNS, set())


if __name__ == "__main__":
    unittest.main()

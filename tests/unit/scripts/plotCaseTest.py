"""etc/plotCase on small cases made here: what it draws, what it says, what it refuses."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

PROJECT = Path(__file__).resolve().parents[3]
COLUMNS = ("time,particles,kineticEnergy,strainEnergy,plasticDissipation,frictionDissipation,splitMergeLoss,transferLoss,"
           "gravityWork,residual,minX,maxX,maxY").split(",")


def write_state(folder, time, dimension=2, smoothed=True):
    """Four particles in a row under pressures of 10, 20, 30, 40 kPa; smoothed: 25 kPa each."""
    folder.mkdir(parents=True)
    components = 4 if dimension == 2 else 6
    with h5py.File(folder / "state.h5", "w") as file:
        file.attrs["dimension"], file.attrs["time"] = dimension, time
        stress = np.zeros((4, components))
        stress[:, 1] = [-10e3, -20e3, -30e3, -40e3]
        file["particles/stress"] = stress
        file["particles/position"] = np.arange(4.0)[:, None] + np.zeros(dimension)
        file["particles/deformationGradient"] = np.tile(np.eye(dimension), (4, 1, 1))
        file["particles/length0"] = np.ones((4, dimension))
        file["particles/id"] = np.arange(4)
        if smoothed:
            file["derived/smoothedStress"] = np.full((4, components), -25e3)


def write_history(case):
    (case / "postProcessing").mkdir(parents=True)
    rows = [",".join(COLUMNS)] + [",".join([f"{0.5 * k}"] + ["1000"] * (len(COLUMNS) - 1)) for k in range(6)]
    (case / "postProcessing" / "history.csv").write_text("\n".join(rows) + "\n")


class PlotCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "small"
        for time in (0, 0.5, 1, 1.5, 2, 2.5):
            write_state(self.case / f"{time:g}", time)
        write_history(self.case)

    def plot(self, *options):
        run = subprocess.run([PROJECT / "etc" / "plotCase", "-case", self.case, *options], text=True, capture_output=True)
        return run.returncode, run.stdout, run.stderr

    def figures(self):
        folder = self.case / "postProcessing" / "figures"
        return sorted(path.name for path in folder.iterdir()) if folder.exists() else []

    def refused(self, *options, says):
        code, _, err = self.plot(*options)
        self.assertEqual(code, 1, err)
        for text in says:
            self.assertIn(text, err)
        self.assertEqual(self.figures(), [])

    def test_draws_the_four_times_in_both_formats(self):
        code, out, err = self.plot()
        self.assertEqual(code, 0, err)
        self.assertEqual(self.figures(), ["energies.png", "energies.svg", "sigma_yy.png", "sigma_yy.svg"])
        self.assertEqual([line.split(":")[0] for line in out.splitlines() if line.startswith("t = ")],
                         ["t = 0.5 s", "t = 1 s", "t = 1.5 s", "t = 2.5 s"])
        # deviations 15, 5, 5, 15 of 25: sqrt((225 + 25)/2)/25
        self.assertIn("raw min -40.0 kPa, smoothed min -25.0 kPa, RMS(raw - smoothed)/RMS(smoothed) = 0.447", out)

    def test_draws_the_times_asked_for_and_compares(self):
        other = self.case.parent / "other"
        shutil.copytree(self.case, other)
        code, out, err = self.plot("-time", "2", "-compare", "../other")
        self.assertEqual(code, 0, err)
        self.assertIn("t = 2 s", out)
        self.assertNotIn("t = 1 s", out)
        self.assertIn("comparison.png", self.figures())
        self.assertIn("small", out)
        self.assertIn("other", out)

    def test_picks_times_of_a_run_that_has_others(self):
        shutil.rmtree(self.case / "1.5")
        code, out, _ = self.plot()
        self.assertEqual(code, 0)
        self.assertEqual([line.split(":")[0] for line in out.splitlines() if line.startswith("t = ")],
                         ["t = 0.5 s", "t = 1 s", "t = 2 s", "t = 2.5 s"])

    def test_ranges_and_nearest_times(self):
        for wanted, drawn in (("0.5:1", ["0.5", "1"]), (":0.6,2.2:", ["0", "0.5", "2.5"]), ("1.1", ["1"]), ("2.7", ["2.5"])):
            code, out, err = self.plot("-time", wanted)
            self.assertEqual(code, 0, err)
            self.assertEqual([line.split()[2] for line in out.splitlines() if line.startswith("t = ")], drawn)
        shutil.rmtree(self.case / "postProcessing" / "figures")
        for wrong in ("0.6:0.9", "2:1", "1:2:3", "a:1", "", ","):
            self.refused("-time", wrong, says=["-time"])

    def test_initial_corners_are_marked_and_titles_tell_percentiles(self):
        code, _, err = self.plot("-time", "1")
        self.assertEqual(code, 0, err)
        svg = (self.case / "postProcessing" / "figures" / "sigma_yy.svg").read_text()
        # matplotlib writes the words of a title as a comment before its glyphs
        self.assertIn("t = 1 s, raw: min -40, p1 -40, max -10.0 kPa, 4 particles", svg)
        self.assertIn("t = 1 s, smoothed: min -25, p1 -25, max -25.0 kPa, 4 particles", svg)
        # the body is one slanted row: two of its particles are nearest to corners of its box, the others to two more
        self.assertGreaterEqual(svg.count("fill: #ffffff; stroke: #000000; stroke-width: 0.8"), 8)

    def test_same_input_same_figure(self):
        folder = self.case / "postProcessing" / "figures"
        self.plot()
        first = (folder / "sigma_yy.svg").read_bytes()
        self.plot()
        self.assertEqual((folder / "sigma_yy.svg").read_bytes(), first)

    def test_refusals(self):
        self.refused("-tiem", "1", says=["-tiem", "did you mean -time?"])
        self.refused("-time", "7", says=["'7'", "0.5, 1, 1.5"])
        self.refused("-time", says=["lacks its argument"])
        self.refused("-component", "xz", says=["'xz'", "xx, yy, zz, xy"])
        self.refused("-range", "0", says=["LOW:HIGH"])
        self.refused("-compare", "nowhere", says=["nowhere"])

    def test_refuses_states_it_cannot_draw(self):
        write_state(self.case / "3", 3, smoothed=False)
        self.refused("-time", "3", says=["run smoothStress first"])
        write_state(self.case / "4", 4, dimension=3)
        self.refused("-time", "4", says=["three-dimensional"])
        (self.case / "5").mkdir()
        (self.case / "5" / "state.h5").write_text("no HDF5\n")
        self.refused("-time", "5", says=["no state of libmpm"])
        (self.case / "postProcessing" / "history.csv").unlink()
        self.refused(says=["history.csv"])


if __name__ == "__main__":
    unittest.main()

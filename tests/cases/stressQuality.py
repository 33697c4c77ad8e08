"""stressQuality end to end on small columns: its numbers against smoothStress, the ledger and sums by numpy; against a
case at twice the resolution; what it says of wrong input.

    stressQuality.py [Test.name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import csv
import math
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"
COLUMN = PROJECT / "cases" / "collapsingSoilColumn"
FIRST = ["time", "noiseYY", "overburdenCorrelation", "overburdenRmsError", "volumeError", "remedyEnergyLoss"]


def run(case, name, *options):
    return subprocess.run([BINARIES / name, *options], cwd=case, text=True, capture_output=True, stdin=subprocess.DEVNULL,
                          timeout=300)


def entry(case, file, word, value):
    path = case / file
    text, count = re.subn(rf"(?m)^(\s*{word}\s+)[^;]*;", rf"\g<1>{value};", path.read_text())
    assert count == 1, f"{word} in {file}: {count} times"
    path.write_text(text)


def make_column(case, cell, end=0.5, shape="linear"):
    """The column of the paper on few cells, solved."""
    case.mkdir()
    for part in ("geometry", "constant", "system"):
        shutil.copytree(COLUMN / part, case / part)
    entry(case, "system/gridDict", "cellSize", cell)
    entry(case, "system/gridDict", "max", "(16 12.8 0)")
    entry(case, "system/mpmSchemes", "shape", shape)
    entry(case, "system/controlDict", "endTime", end)
    control = case / "system/controlDict"
    control.write_text(re.sub(r"(?s)recordStrain.*?\{.*?\}", "", control.read_text()))
    for name in ("seedParticles", "mpmSolve"):
        done = run(case, name)
        if done.returncode:
            raise RuntimeError(done.stderr)


def rows(case, name="stressQuality"):
    with open(case / "postProcessing" / f"{name}.csv") as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


def nodal_by_hand(file):
    """Eq. 11 of sigma_yy with hat functions: {node: stress}, and the share of the space around each that is full."""
    h, origin = float(file["grid/cellSize"][()]), file["grid/origin"][:2]
    x, mass, volume = (file["particles/" + name][:] for name in ("position", "mass", "volume"))
    yy = file["particles/stress"][:, 1]
    sums = {}
    for p in range(len(mass)):
        for node, weight in hats(x[p], origin, h):
            old = sums.get(node, np.zeros(3))
            sums[node] = old + weight * np.array([mass[p], mass[p] * yy[p], volume[p] / h**2])
    return {node: (s[1] / s[0], s[2]) for node, s in sums.items()}


def hats(x, origin, h):
    s = (x - origin) / h
    i, j = (int(v) for v in np.floor(s))
    a, b = s[0] - i, s[1] - j
    weights = {(i, j): (1 - a) * (1 - b), (i + 1, j): a * (1 - b), (i, j + 1): (1 - a) * b, (i + 1, j + 1): a * b}
    return [(node, weight) for node, weight in weights.items() if weight > 0]


class StressQuality(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        for name, cell in (("coarse", 0.8), ("fine", 0.4)):
            make_column(Path(cls.folder.name) / name, cell)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = Path(folder.name)
        for name in ("coarse", "fine"):
            shutil.copytree(Path(self.folder.name) / name, self.top / name)
        self.case = self.top / "coarse"

    def good(self, *options, name="stressQuality"):
        done = run(self.case, name, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def refused(self, *options, says):
        done = run(self.case, "stressQuality", *options)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for part in says:
            self.assertIn(part, done.stderr)
        self.assertFalse((self.case / "postProcessing/stressQuality.csv").exists())

    def test_what_smoothStress_says_too_is_the_same(self):
        self.good(name="smoothStress")
        self.good()
        header = (self.case / "postProcessing/stressQuality.csv").read_text().splitlines()[0].split(",")
        self.assertEqual(header[:6], FIRST)
        self.assertNotIn("errorAgainstRaw", header)
        ours, theirs = rows(self.case), rows(self.case, "smoothStress")
        self.assertEqual([row["time"] for row in ours], [row["time"] for row in theirs])
        self.assertEqual(len(ours), 3)
        for our, their in zip(ours, theirs):
            for a, b in (("noiseYY", "noise"), ("noiseVertical", "noise"), ("noiseByMass", "noiseByMass"),
                         ("noiseFloor", "noiseFloor"), ("overburdenCorrelation", "correlationRaw"),
                         ("overburdenRmsError", "errorRaw"), ("particles", "particles")):
                self.assertAlmostEqual(our[a] / their[b], 1, places=10, msg=a) if their[b] else self.assertEqual(our[a], 0)
        for time in ("0", "0.25", "0.5"):  # nothing was added to the states but by smoothStress
            with h5py.File(self.case / time / "state.h5") as file:
                self.assertEqual(sorted(file["derived"]), ["overburden", "smoothedStress"])

    def test_noise_beyond_the_filter_by_hand(self):
        self.good()
        self.assertEqual(list(rows(self.case)[0])[-3:], ["noiseBeyondFilter", "noiseFloorOfField", "viscosityLoss"])
        for row, time in zip(rows(self.case), ("0", "0.25", "0.5")):
            with h5py.File(self.case / time / "state.h5") as file:
                h, origin = float(file["grid/cellSize"][()]), file["grid/origin"][:2]
                x, mass, raw = (file["particles/position"][:], file["particles/mass"][:], file["particles/stress"][:, 1])
            weights = [hats(place[:2], origin, h) for place in x]

            def smooth(values):
                sums = {}
                for own, m, value in zip(weights, mass, values):
                    for node, w in own:
                        sums[node] = sums.get(node, np.zeros(2)) + w * m * np.array([1, value])
                return np.array([sum(w * sums[node][1] / sums[node][0] for node, w in own) for own in weights])

            def rms(values):
                return math.sqrt(np.mean(values**2))
            once = smooth(raw)
            kept = 2 * once - smooth(once)
            self.assertAlmostEqual(row["noiseBeyondFilter"], rms(raw - kept) / rms(once), 10)
            self.assertAlmostEqual(row["noiseFloorOfField"], rms(kept - smooth(kept)) / rms(once), 10)
            self.assertGreater(row["noiseBeyondFilter"], 1e-3)

    def test_noise_energy_volume_and_tension_against_the_state(self):
        self.good(name="smoothStress")
        table = self.good()
        for row, time in zip(rows(self.case), ("0", "0.25", "0.5")):
            with h5py.File(self.case / time / "state.h5") as file:
                raw, smooth = file["particles/stress"][:], file["derived/smoothedStress"][:]
                mass, volume, volume0 = (file["particles/" + name][:] for name in ("mass", "volume", "volume0"))
                ledger = {name: value[()] for name, value in file["ledger"].items()}
            def rms(values):
                return math.sqrt(np.mean(values**2))
            for c, name in ((0, "XX"), (1, "YY"), (2, "ZZ"), (3, "XY")):
                if rms(smooth[:, c]) > 0:
                    self.assertAlmostEqual(row["noise" + name], rms(raw[:, c] - smooth[:, c]) / rms(smooth[:, c]), 10)
            mean, scale = raw[:, :3].mean(axis=1), rms(smooth[:, :3].mean(axis=1))
            self.assertAlmostEqual(row["meanStress"] / scale, 1, 12)
            self.assertAlmostEqual(row["noiseXYOfMean"], rms(raw[:, 3] - smooth[:, 3]) / scale, 10)
            self.assertAlmostEqual(row["massInTension"], mass[mean > 0].sum() / mass.sum(), 12)
            self.assertLess(row["tensionViolation"], 1e-9)
            self.assertLess(row["yieldViolation"], 1e-9)
            self.assertAlmostEqual(row["volumeError"], ledger["apexVolume"] / 32, 12)
            self.assertAlmostEqual(row["volumeChange"], volume.sum() / volume0.sum() - 1, 12)
            # psi = 0: what grew without stress is what returns to the apex made
            self.assertAlmostEqual(row["inelasticVolumeChange"], row["volumeError"], delta=0.02 * row["volumeError"] + 1e-6)
            self.assertEqual(row["releasedEnergy"], ledger["gravityWork"] or ledger["initialStrainEnergy"])
            self.assertAlmostEqual(row["transferLoss"] * max(row["releasedEnergy"], 1), ledger["transferLoss"], delta=1e-6)
            taken = [abs(ledger.get(name, 0)) for name in ("relaxationLoss", "averagingLoss", "viscosityLoss", "gapWork")]
            self.assertAlmostEqual(row["remedyEnergyLoss"] * max(row["releasedEnergy"], 1), sum(taken), delta=1e-6)
            self.assertIn(f"{row['noiseYY']:.4f}", table)
        self.assertGreater(row["volumeError"], 1e-3)  # the plain scheme makes volume

    def test_against_a_finer_run(self):
        table = self.good("-against", "../fine", "-time", "0.5")
        (row,) = rows(self.case)
        with h5py.File(self.top / "fine/0.5/state.h5") as fine, h5py.File(self.case / "0.5/state.h5") as ours:
            nodes, h, origin = nodal_by_hand(fine), float(fine["grid/cellSize"][()]), fine["grid/origin"][:2]
            x, yy, mass = ours["particles/position"][:], ours["particles/stress"][:, 1], ours["particles/mass"][:]
        error, field, compared = [], [], 0.0
        for p in range(len(mass)):
            around = hats(x[p], origin, h)
            if any(node not in nodes for node, _ in around) or sum(w * nodes[node][1] for node, w in around) < 0.25:
                continue
            field.append(sum(w * nodes[node][0] for node, w in around))
            error.append(yy[p] - field[-1])
            compared += mass[p]
        rms = math.sqrt(np.mean(np.square(error)))
        self.assertAlmostEqual(row["errorAgainstRaw"] / rms, 1, 9)
        self.assertAlmostEqual(row["relativeErrorAgainstRaw"], rms / math.sqrt(np.mean(np.square(field))), 9)
        self.assertAlmostEqual(row["massCompared"], compared / mass.sum(), 12)
        self.assertGreater(row["massCompared"], 0.9)
        self.assertLess(row["errorAgainstSmoothed"], row["errorAgainstRaw"])
        self.assertIn("against fine: 1 of 1 times", table)

    def test_a_known_offset_between_two_cases(self):
        shutil.copytree(self.case, self.top / "other")
        for time in ("0.25", "0.5"):
            for case, stress in (("coarse", (-2e4, -5e4, -3e4, 0)), ("other", (-2e4, -5.3e4, -3e4, 0))):
                with h5py.File(self.top / case / time / "state.h5", "r+") as file:
                    file["particles/stress"][:] = stress
        shutil.rmtree(self.top / "other" / "0.5")
        self.good("-against", "../other")
        first, second, third = rows(self.case)
        self.assertAlmostEqual(second["errorAgainstRaw"], 3e3, 6)
        self.assertAlmostEqual(second["errorAgainstSmoothed"], 3e3, 6)
        self.assertAlmostEqual(second["relativeErrorAgainstSmoothed"], 3 / 53, 9)
        self.assertEqual(second["noiseYY"] < 1e-12, True)
        self.assertEqual(second["checkerboard"], 0)
        for name in ("errorAgainstRaw", "massCompared"):
            self.assertFalse(math.isnan(first[name]))
            self.assertTrue(math.isnan(third[name]))

    def test_stresses_beyond_the_law_are_seen(self):
        with h5py.File(self.case / "0.5/state.h5", "r+") as file:
            stress = file["particles/stress"][:]
            stress[:] = (-2e4, -2e4, -2e4, 0)
            stress[7] = (2e4, 2e4, 2e4, 0)  # the apex is at c cot phi = 1110.6 Pa
            file["particles/stress"][:] = stress
            mass = file["particles/mass"][:]
        self.good("-latestTime")
        (row,) = rows(self.case)
        k, strength = 5.044678, 4492.07
        self.assertAlmostEqual(row["yieldViolation"], (k * 2e4 - 2e4 - strength) / 2e4, 5)
        self.assertAlmostEqual(row["tensionViolation"], (2e4 - 1110.6125) / row["meanStress"], 6)
        self.assertAlmostEqual(row["massInTension"], mass[7] / mass.sum(), 12)

    def test_without_the_first_state_elastic_volume_is_unknown(self):
        shutil.rmtree(self.case / "0")
        self.good()
        for row in rows(self.case):
            self.assertTrue(math.isnan(row["elasticVolumeChange"]) and math.isnan(row["inelasticVolumeChange"]))
            self.assertGreater(row["volumeError"], 0)

    def test_dry_run_writes_nothing(self):
        self.good("-dry-run", "-against", "../fine")
        self.assertFalse((self.case / "postProcessing/stressQuality.csv").exists())

    def test_wrong_input(self):
        self.refused("-against", "nowhere", says=["-against nowhere", "nothing of that name"])
        self.refused("-against", "geometry", says=["-against geometry", "system/"])
        self.refused("-against", says=["-against", "DIR"])
        self.refused("-against", "../fine", "-time", "7", says=["no time near 7"])
        self.refused("-agianst", "../fine", says=["-agianst", "-against"])
        other = self.top / "other"
        shutil.copytree(self.top / "fine", other)
        for time, name in (("0", "3"), ("0.25", "4"), ("0.5", "5")):
            (other / time).rename(other / name)
        self.refused("-against", "../other", says=["-against ../other", "3, 4, 5", "0, 0.25, 0.5"])
        self.refused("-against", "../other", "-latestTime", says=["3, 4, 5", "at least one of 0.5"])
        (other / "3").rename(other / "0")
        with h5py.File(other / "0/state.h5", "r+") as file:
            file.attrs["dimension"] = np.int64(3)
        self.refused("-against", "../other", says=["-against ../other", "dimension 3", "allowed 2"])
        shutil.rmtree(other / "0")
        (other / "0").mkdir()
        (other / "0/state.h5").write_text("no HDF5 at all\n")
        self.refused("-against", "../other", says=["0/state.h5"])
        scheme = self.top / "fine/system/mpmSchemes"
        scheme.write_text("shape qubic;\n")
        self.refused("-against", "../fine", says=["mpmSchemes:1", "qubic", "cubicBSpline"])
        materials = self.case / "constant/materialProperties"
        text = materials.read_text()
        materials.write_text(re.sub(r"(?m)^soil$", "sand", text))
        self.refused(says=["materialProperties", "'soil'", "sand"])
        materials.write_text(text.replace("cohesion", "cohesoin"))
        self.refused(says=["materialProperties", "cohesoin", "cohesion"])
        materials.unlink()
        self.refused(says=["constant/materialProperties"])


if __name__ == "__main__":
    unittest.main()

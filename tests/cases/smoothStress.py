"""smoothStress, state.h5 and the ParaView files from outside: states are written with h5py by the documented layout alone,
results are compared with numpy, the XDMF files are checked against the HDF5 files (and read by VTK where it is installed).

    smoothStress.py [Test.name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import csv
import os
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

import h5py
import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
UTILITY = Path(os.environ.get("MPM_BUILD_DIR", PROJECT / "build")) / "bin" / "smoothStress"
LEDGER_NUMBERS = ("plasticDissipation frictionDissipation wallLoss splitMergeLoss transferLoss dampingDissipation pendingWork staggering initialStaggering finiteStrainWork gravityWork "
                  "tractionWork apexVolume bodyForceWork kineticEnergy initialKineticEnergy initialStrainEnergy "
                  "splitAngularMomentum").split()
LEDGER_VECTORS = "wallImpulse gravityImpulse tractionImpulse dampingImpulse initialMomentum".split()
LEDGER_COUNTS = "apexReturns splits splitsPutOff splitsCapped wallContacts".split()
H = 0.5


def text(value):
    """Fixed-length text, as the layout asks."""
    return np.array(value.encode(), dtype=f"S{max(1, len(value))}")


def write_state(path, time, n=(8, 6), shuffle=True):
    """A block of n particles, two a cell and axis, of random masses and stresses; rows in any order. Returns the columns."""
    random = np.random.default_rng(int(1000 * time) + n[0])
    i, j = (axis.ravel() for axis in np.meshgrid(np.arange(n[0]), np.arange(n[1])))
    count = len(i)
    order = random.permutation(count) if shuffle else np.arange(count)
    position = (np.stack([i, j], axis=1)[order] + 0.5 + random.uniform(-0.2, 0.2, (count, 2))) * H / 2
    columns = {"position": position, "mass": random.uniform(1, 3, count),
               "stress": random.uniform(-2e5, 0, (count, 4)), "id": (10 + np.arange(count))[order].astype("<i8")}
    path.parent.mkdir(parents=True, exist_ok=True)
    with h5py.File(path, "w") as file:
        file.attrs["format"], file.attrs["formatVersion"] = text("libmpm state"), np.int64(2)
        for name, value in (("dimension", 2), ("step", 7), ("nextId", 10 + count)):
            file.attrs[name] = np.int64(value)
        file.attrs["time"], file.attrs["deltaT"], file.attrs["seedSpacing"] = time, 1e-3, np.array([H / 2, H / 2, 0.0])
        file.attrs["largestJacobian"] = file.attrs["stepFactor"] = 1.0
        file.attrs["materials"] = np.array([b"soil"], dtype="S4")
        particles = file.create_group("particles")
        for name, value in columns.items():
            particles[name] = value
        particles["velocity"] = np.zeros((count, 2))
        particles["deformationGradient"] = np.tile([[1.0, 0.25], [0.0, 1.0]], (count, 1, 1))
        particles["length0"] = np.full((count, 2), H / 2)
        particles["volume0"] = particles["volume"] = np.full(count, H * H / 4)
        particles["sortKey"] = np.arange(count)[::-1].astype("<i8")
        particles["material"] = particles["generation"] = np.zeros(count, "<i4")
        file["grid/origin"], file["grid/cellSize"] = np.array([-1.0, -1.0, 0.0]), H
        file["grid/cells"] = np.array([12, 12, 1], "<i8")
        file["grid"].attrs["dimension"] = np.int64(2)
        for name in LEDGER_NUMBERS:
            file["ledger/" + name] = 0.0
        for name in LEDGER_VECTORS:
            file["ledger/" + name] = np.zeros(3)
        for name in LEDGER_COUNTS:
            file["ledger/" + name] = np.int64(0)
        file.create_group("patches")
        file["provenance/version"] = text("by hand")
        write_visualisation(file, columns)
    return columns


def write_visualisation(file, columns):
    """The float32 copies that the .xdmf files point to."""
    count = len(columns["mass"])
    flat = np.zeros((count, 1))
    points = np.hstack([columns["position"], flat])
    half = np.array([[H / 4, 0, 0], [H / 16, H / 4, 0]])  # F l0/2 of the two edges
    corners = [points + a * half[0] + b * half[1] for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    group = file.create_group("visualisation")
    group["points"] = points.astype("<f4")
    group["velocity"] = np.zeros((count, 3), "<f4")
    group["corners"] = np.stack(corners, axis=1).reshape(-1, 3).astype("<f4")
    group["connectivity"] = np.arange(count, dtype="<i4")
    group["cornerConnectivity"] = np.arange(4 * count, dtype="<i4").reshape(-1, 4)
    for k, name in enumerate(("xx", "yy", "zz", "xy")):
        group["sigma_" + name] = columns["stress"][:, k].astype("<f4")


def smoothed_by_hand(columns):
    """Eqs. 11 and 12 with hat functions."""
    s = (columns["position"] + 1.0) / H
    first = np.floor(s).astype(int)
    t = s - first
    weights = np.zeros((len(s), 14, 14))
    for p in range(len(s)):
        for a in (0, 1):
            for b in (0, 1):
                weights[p, first[p, 0] + a, first[p, 1] + b] = abs(1 - a - t[p, 0]) * abs(1 - b - t[p, 1])
    weights = weights.reshape(len(s), -1)
    mass = weights.T @ columns["mass"]
    carries = mass > 0
    nodal = (weights.T @ (columns["mass"][:, None] * columns["stress"]))[carries] / mass[carries, None]
    return weights[:, carries] @ nodal, nodal


class SmoothStress(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "block"
        for name, content in (("system/mpmSchemes", "shape linear;\n"),
                              ("constant/g", "dimensions [0 1 -2 0 0 0 0];\nvalue (0 -9.8 0);\n")):
            path = self.case / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)
        self.columns = {name: write_state(self.case / name / "state.h5", float(name), n)
                        for name, n in (("0", (8, 6)), ("0.5", (8, 8)), ("1", (10, 8)))}

    def run_it(self, *options):
        run = subprocess.run([UTILITY, "-case", self.case, *options], text=True, capture_output=True)
        return run.returncode, run.stdout, run.stderr

    def refused(self, *options, says):
        code, _, err = self.run_it(*options)
        self.assertEqual(code, 1, err)
        self.assertEqual(len(err.strip().splitlines()), 1, err)
        for part in says:
            self.assertIn(part, err)

    def test_smoothed_and_nodal_stress_stand_beside_their_particles(self):
        code, out, err = self.run_it()
        self.assertEqual((code, err), (0, ""))
        for name, columns in self.columns.items():
            smoothed, nodal = smoothed_by_hand(columns)
            with h5py.File(self.case / name / "state.h5") as file:
                field = file["derived/smoothedStress"]
                np.testing.assert_allclose(field[:], smoothed, rtol=1e-12)
                self.assertEqual([component.decode() for component in field.attrs["components"]], ["xx", "yy", "zz", "xy"])
                self.assertEqual(field.attrs["unit"].decode(), "Pa")
                self.assertEqual(len(file["derivedNodal/position"]), len(nodal))
                np.testing.assert_allclose(np.sort(file["derivedNodal/stress"][:, 1]), np.sort(nodal[:, 1]), rtol=1e-12)
                for column in ("position", "mass", "stress", "id"):  # what was there stays, row by row
                    np.testing.assert_array_equal(file["particles/" + column][:], columns[column])

    def test_table_and_csv_tell_the_same(self):
        code, out, _ = self.run_it()
        self.assertEqual(code, 0)
        table = (self.case / "postProcessing" / "smoothStress.csv").read_text().splitlines()
        rows = list(csv.DictReader(table))
        self.assertEqual([row["time"] for row in rows], ["0", "0.5", "1"])
        for row in rows:
            columns = self.columns[row["time"]]
            smoothed, nodal = smoothed_by_hand(columns)
            raw = columns["stress"][:, 1]
            noise = np.sqrt(np.mean((raw - smoothed[:, 1]) ** 2) / np.mean(smoothed[:, 1] ** 2))
            self.assertAlmostEqual(float(row["noise"]), noise, places=12)
            self.assertEqual(float(row["minRaw"]), raw.min())
            self.assertAlmostEqual(float(row["minSmoothed"]) / smoothed[:, 1].min(), 1, places=12)
            self.assertAlmostEqual(float(row["minNodal"]) / nodal[:, 1].min(), 1, places=12)
            self.assertIn(f"{noise:.3f}", out)

    def test_times_are_selected_and_dry_runs_write_nothing(self):
        def derived():
            names = []
            for name in self.columns:
                with h5py.File(self.case / name / "state.h5") as file:
                    if "derived" in file:
                        names.append(name)
            return names

        self.assertEqual(self.run_it("-dry-run")[0], 0)
        self.assertEqual(derived(), [])
        self.assertFalse((self.case / "postProcessing").exists())
        self.assertEqual(self.run_it("-latestTime")[0], 0)
        self.assertEqual(derived(), ["1"])
        self.assertEqual(self.run_it("-time", ":0.6")[0], 0)
        self.assertEqual(derived(), ["0", "0.5", "1"])

    def test_paraview_files_point_to_what_is_there(self):
        self.assertEqual(self.run_it("-time", "0.5:")[0], 0)
        for ending, centre, cells in ((".xdmf", "Node", "Polyvertex"), (".domains.xdmf", "Cell", "Quadrilateral")):
            root = xml.parse(self.case / ("block" + ending)).getroot()
            series = root.find("Domain/Grid")
            self.assertEqual(series.get("CollectionType"), "Temporal")
            grids = series.findall("Grid")
            self.assertEqual([float(grid.find("Time").get("Value")) for grid in grids], [0, 0.5, 1])
            for grid, (name, columns) in zip(grids, self.columns.items()):
                self.check_grid(grid, name, len(columns["mass"]), centre, cells)

    def check_grid(self, grid, name, count, centre, cells):
        topology = grid.find("Topology")
        self.assertEqual((topology.get("TopologyType"), int(topology.get("NumberOfElements"))), (cells, count))
        attributes = {attribute.get("Name"): attribute for attribute in grid.findall("Attribute")}
        expected = ["sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "velocity", "mass", "id"]
        if name != "0":
            expected += ["overburden"] + ["smoothedStress_" + c for c in ("xx", "yy", "zz", "xy")]
        self.assertEqual(list(attributes), expected)
        self.assertEqual({attribute.get("Center") for attribute in attributes.values()}, {centre})
        for item in grid.iter("DataItem"):
            path, dataset = item.text.split(":")
            self.assertEqual(path, f"{name}/state.h5")
            with h5py.File(self.case / path) as file:
                values = file[dataset]
                self.assertEqual(values.shape, tuple(int(n) for n in item.get("Dimensions").split()))
                kind = {"f": "Float", "i": "Int"}[values.dtype.kind]
                self.assertEqual((kind, values.dtype.itemsize), (item.get("NumberType"), int(item.get("Precision"))))

    def test_vtk_reads_both_series(self):
        try:
            from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
            from vtkmodules.vtkIOXdmf2 import vtkXdmfReader
            from vtkmodules.vtkIOXdmf3 import vtkXdmf3Reader
        except ImportError:
            self.skipTest("no VTK with XDMF readers here (package python3-paraview)")
        self.assertEqual(self.run_it()[0], 0)
        for make in (vtkXdmfReader, vtkXdmf3Reader):
            for ending, cell_type in ((".xdmf", 2), (".domains.xdmf", 9)):  # polyvertex, quadrilateral
                reader = make()
                reader.SetFileName(str(self.case / ("block" + ending)))
                reader.UpdateInformation()
                times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
                self.assertEqual(list(times), [0, 0.5, 1])
                reader.UpdateTimeStep(1.0)
                grid = reader.GetOutputDataObject(0)
                while grid.IsA("vtkMultiBlockDataSet"):
                    grid = grid.GetBlock(0)
                columns = self.columns["1"]
                self.assertEqual(grid.GetCellType(0), cell_type)
                self.assertEqual(grid.GetNumberOfCells(), len(columns["mass"]))
                data = grid.GetCellData() if cell_type == 9 else grid.GetPointData()
                smoothed = smoothed_by_hand(columns)[0]
                for p in (0, 5, len(smoothed) - 1):
                    self.assertEqual(data.GetArray("id").GetTuple1(p), columns["id"][p])
                    self.assertAlmostEqual(data.GetArray("smoothedStress_yy").GetTuple1(p) / smoothed[p, 1], 1, places=6)
                    self.assertAlmostEqual(data.GetArray("sigma_xy").GetTuple1(p) / columns["stress"][p, 3], 1, places=6)

    def test_states_that_reach_out_of_their_file_are_refused(self):
        secret = self.case.parent / "secret.h5"
        with h5py.File(secret, "w") as file:
            file["mass"] = np.ones(80)
        path = self.case / "1" / "state.h5"

        def replace(make, name="mass"):
            write_state(path, 1.0, (10, 8))
            with h5py.File(path, "a") as file:
                del file["particles/" + name]
                make(file["particles"])

        replace(lambda group: group.__setitem__("mass", h5py.ExternalLink(str(secret), "/mass")))
        self.refused("-latestTime", says=["/particles/mass", "is a link"])
        replace(lambda group: group.__setitem__("mass", h5py.SoftLink("/particles/volume")))
        self.refused("-latestTime", says=["/particles/mass", "is a link"])
        layout = h5py.VirtualLayout((80,), "<f8")
        layout[:] = h5py.VirtualSource(str(secret), "mass", (80,))
        replace(lambda group: group.create_virtual_dataset("mass", layout))
        self.refused("-latestTime", says=["/particles/mass", "in another file"])
        replace(lambda group: group.create_dataset("mass", (80,), "<f8", external=[(str(secret), 0, 640)]))
        self.refused("-latestTime", says=["/particles/mass", "in another file"])
        replace(lambda group: group.create_dataset("mass", (80,), "<f8", chunks=(80,)))
        self.refused("-latestTime", says=["/particles/mass", "never written"])
        replace(lambda group: group.create_dataset("mass", (1 << 50,), "<f8", chunks=(1 << 20,)))
        self.refused("-latestTime", says=["/particles/mass", "80 expected"])
        replace(lambda group: group.create_dataset("position", (1 << 50, 2), "<f8", chunks=(1 << 16, 2)), "position")
        self.refused("-latestTime", says=["/particles/position", "claims more values than the file's"])
        replace(lambda group: group.create_dataset("mass", data=["heavy"] * 80))
        self.refused("-latestTime", says=["/particles/mass", "64-bit float expected"])
        write_state(path, 1.0, (10, 8))
        with h5py.File(path, "a") as file:
            del file.attrs["materials"]
            file.attrs["materials"] = ["soil"]  # variable length
        self.refused("-latestTime", says=["materials", "fixed length"])

    def test_mistakes_are_told_in_one_line(self):
        self.refused("-time", "7", says=["no time near 7", "0, 0.5, 1"])
        self.refused("-tim", "1", says=["-tim", "-time"])
        (self.case / "system" / "mpmSchemes").write_text("shape cpGIPM;\n")
        self.refused(says=["mpmSchemes:1", "cpGIPM", "cpGIMP"])
        (self.case / "system" / "mpmSchemes").unlink()
        self.refused(says=["system/mpmSchemes", "no such file"])


if __name__ == "__main__":
    unittest.main()

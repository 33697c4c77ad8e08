"""Two bodies in far corners of a box with more than 1,000 times the cells they fill: they move as each does alone in a box
that fits, and memory and time are those of the bodies, not of the box.

    sparseScene.py [SparseScene.test_name ...]     MPM_BUILD_DIR names the build (default: build/)

The lower body is a cube of soil that lands on a rough floor, the upper an elastic one that flies freely, pressed together
at the start so that it rings. Cells are a power of two and boxes begin at whole numbers: the box is no matter of rounding.
"""

import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import h5py
import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
BINARIES = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin"

CELL = 0.125
BOX = 512  # sides of the big box [m]
END = 0.2

CONSTANT = {
    "g": "dimensions [0 1 -2 0 0 0 0]; value (0 -9.8 0);",
    "materialProperties": """
        lower { law mohrCoulomb; density 1800; E 1e6; nu 0.3; cohesion 200; frictionAngle 30; dilationAngle 0;
                initialVelocity (0.5 -1 0); }
        upper { law linearElastic; density 1000; E 1e5; nu 0.3; initialVelocity (-1 2 0);
                initialStress { type uniform; value (-2e3 -1e3 -1e3 3e2 0 0); } }""",
    "boundaryConditions": """
        floor { type friction; mu 0.5; separation on; plane { normal (0 -1 0); position 0; } }""",
}
SYSTEM = {
    "mpmSchemes": "shape uGIMP; stressUpdate MUSL; transfer FLIP; picRate 0;",
    "controlDict": f"""
        application mpmSolve; startFrom firstTime; stopAt endTime; endTime {END}; deltaT 5e-4; adjustTimeStep no;
        writeControl runTime; writeInterval {END}; timePrecision 6; historyInterval 100;""",
}


def square(name, number, x, y, size=1):
    """A physical surface of the geometry; `number` keeps tags apart."""
    p = 10 * number
    corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
    lines = [f"Point({p + i}) = {{{a}, {b}, 0}};" for i, (a, b) in enumerate(corners)]
    lines += [f"Line({p + i}) = {{{p + i}, {p + (i + 1) % 4}}};" for i in range(4)]
    lines += [f"Curve Loop({p}) = {{{p}, {p + 1}, {p + 2}, {p + 3}}};", f"Plane Surface({p}) = {{{p}}};",
              f'Physical Surface("{name}") = {{{p}}};']
    return "\n".join(lines)


BODIES = {"lower": square("lower", 1, 1, 0.0625), "upper": square("upper", 2, BOX - 4, BOX - 6)}


class SparseScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.runs = {"both": cls.run_case("both", ["lower", "upper"], (0, 0), (BOX, BOX)),
                    "lower": cls.run_case("lower", ["lower"], (0, 0), (4, 2)),
                    "upper": cls.run_case("upper", ["upper"], (BOX - 6, BOX - 8), (BOX, BOX))}

    @classmethod
    def run_case(cls, name, bodies, low, high):
        case = cls.folder / name
        for part, files in (("constant", CONSTANT), ("system", SYSTEM)):
            (case / part).mkdir(parents=True)
            for file, text in files.items():
                (case / part / file).write_text(text)
        if "lower" not in bodies:  # the floor lies outside its box
            (case / "constant" / "boundaryConditions").write_text("// free\n")
        (case / "geometry").mkdir()
        (case / "geometry" / "bodies.geo").write_text("".join(BODIES[body] + "\n" for body in bodies))
        (case / "system" / "gridDict").write_text(
            f"dimension 2; min ({low[0]} {low[1]} 0); max ({high[0]} {high[1]} 0); cellSize {CELL};")
        (case / "system" / "seedParticlesDict").write_text("particlesPerCell 2;")
        log = ""
        for utility in ("seedParticles", "mpmSolve", "smoothStress"):
            begin = time.perf_counter()
            done = subprocess.run([BINARIES / utility], cwd=case, capture_output=True, text=True, timeout=600,
                                  stdin=subprocess.DEVNULL)
            if done.returncode != 0:
                raise AssertionError(f"{utility} in {name}: {done.stdout}{done.stderr}")
            if utility == "mpmSolve":
                log, seconds = done.stdout, time.perf_counter() - begin
        bytes_each = float(re.search(r"memory .*, (\d+) bytes a particle", log).group(1))
        with h5py.File(case / f"{END:g}" / "state.h5") as file:
            fields = {field: file[f"particles/{field}"][()] for field in file["particles"]}
            fields["smoothedStress"] = file["derived/smoothedStress"][()]
        order = np.argsort(fields["id"])
        return {"fields": {field: values[order] for field, values in fields.items()}, "seconds": seconds,
                "bytes": bytes_each * len(order)}

    def test_the_box_is_more_than_a_thousand_times_the_material(self):
        particles = len(self.runs["both"]["fields"]["id"])
        self.assertEqual(particles, 2 * 16 * 16)
        self.assertGreater((BOX / CELL) ** 2, 1000 * particles / 4)

    def test_each_body_moves_as_it_does_alone(self):
        both = self.runs["both"]["fields"]
        for body, rows in (("lower", slice(0, 256)), ("upper", slice(256, 512))):
            alone = self.runs[body]["fields"]
            moved = np.linalg.norm(alone["velocity"], axis=1).max() * END
            self.assertGreater(moved, 0.1, "something happens")
            for field, scale in (("position", 1), ("velocity", 1), ("deformationGradient", 1), ("volume", CELL**2 / 4),
                                 ("stress", 1e3), ("smoothedStress", 1e3)):
                difference = np.abs(both[field][rows] - alone[field]).max() / scale
                self.assertLess(difference, 1e-9, f"{field} of the {body} body")

    def test_memory_follows_the_bodies(self):
        alone = max(self.runs["lower"]["bytes"], self.runs["upper"]["bytes"])
        self.assertGreater(alone, 1e6)
        self.assertLess(self.runs["both"]["bytes"], 1.25 * alone)

    def test_time_follows_the_bodies(self):
        alone = self.runs["lower"]["seconds"] + self.runs["upper"]["seconds"]
        self.assertLess(self.runs["both"]["seconds"], 5 * alone + 1)


if __name__ == "__main__":
    unittest.main()

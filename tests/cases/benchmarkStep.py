"""benchmarkStep as a user types it: rows, the JSON file, wrong options. No number of seconds is judged.

    benchmarkStep.py [BenchmarkStep.test_name ...]      MPM_BUILD_DIR names the build (default: build/)
"""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
BINARY = Path(os.environ.get("MPM_BUILD_DIR") or PROJECT / "build").resolve() / "bin" / "benchmarkStep"
MEMBERS = ["dimension", "shape", "stressUpdate", "law", "real", "particles", "threads", "nsPerParticleStep",
           "naiveNsPerParticleStep", "bytesPerParticle", "triadGBs", "fmaGFs", "rooflineShare"]


class BenchmarkStep(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_utility(self, *options, code=0):
        run = subprocess.run([BINARY, *options], cwd=self.folder, text=True, capture_output=True, timeout=300,
                             stdin=subprocess.DEVNULL, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        self.assertEqual(run.returncode, code, run.stdout[-2000:] + run.stderr)
        return run.stdout if code == 0 else run.stderr

    def test_rows(self):
        page = self.run_utility("-quick", "-dimension", "2,3", "-shape", "uGIMP,linear", "-stressUpdate", "USL",
                                "-particles", "800", "-threads", "1,2", "-json", "rows.json")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["rows.json"])
        rows = json.loads((self.folder / "rows.json").read_text())
        self.assertEqual([list(row) for row in rows], [MEMBERS] * 8)
        self.assertEqual([(r["dimension"], r["shape"], r["threads"]) for r in rows],
                         [(d, s, t) for d in (2, 3) for s in ("uGIMP", "linear") for t in (1, 2)])
        for row in rows:
            self.assertEqual((row["stressUpdate"], row["law"], row["real"]), ("USL", "mohrCoulomb", "double"))
            self.assertEqual(row["particles"], 800 if row["dimension"] == 2 else 686)  # 2 x 20^2, 2 x 7^3
            for number in MEMBERS[7:]:
                if number != "bytesPerParticle":  # some hundred particles may fit into memory there is
                    self.assertGreater(row[number], 0, number)
        self.assertIn("naive/ours", page)
        self.assertIn("to particles %", page)

    def test_splitting(self):
        self.run_utility("-quick", "-particles", "800", "-splitting", "-law", "linearElastic", "-json", "rows.json")
        row, = json.loads((self.folder / "rows.json").read_text())
        self.assertIsNone(row["naiveNsPerParticleStep"])  # the naive step does not split
        self.assertEqual(row["law"], "linearElastic")

    def test_shape_without_naive_step(self):
        self.run_utility("-quick", "-particles", "800", "-shape", "quadraticBSpline", "-json", "rows.json")
        row, = json.loads((self.folder / "rows.json").read_text())
        self.assertIsNone(row["naiveNsPerParticleStep"])
        self.assertGreater(row["nsPerParticleStep"], 0)

    def test_wrong_options(self):
        for options, says in [(["-shape", "ugimp"], "did you mean 'uGIMP'"), (["-dimension", "4"], "allowed 2 or 3"),
                              (["-particles", "many"], "7200, 115k or 1.04M"), (["-thread", "2"], "'-threads'"),
                              (["-case", "."], "-case"), (["-json", "nowhere/rows.json"], "nowhere"),
                              (["-naive", "maybe"], "on or off"), (["-picRate", "-1"], ">= 0")]:
            message = self.run_utility(*options, code=1)
            self.assertIn(says, message)
            self.assertIn("--> benchmarkStep: error:", message)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()

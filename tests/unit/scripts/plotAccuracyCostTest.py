"""etc/plotAccuracyCost on small tables made here, and the tables of cases/accuracyAgainstTime."""

import csv
import importlib.util
import subprocess
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[3]
SCRIPT = PROJECT / "etc" / "plotAccuracyCost"
SCENES = PROJECT / "cases" / "accuracyAgainstTime"
COLUMNS = ("row,method,cellSize,particlesPerCell,shape,transfer,order,picRate,stressUpdate,staggeredStart,timeIntegration,"
           "splitting,courant,deltaT,status,reason,errorMeasure,error,errorScale,against,referenceRow,referenceError,"
           "temporalError,spatialError,pareto,cpuSeconds,particles,steps,machine,version").split(",")


def load_tables():
    spec = importlib.util.spec_from_file_location("tables", SCENES / "tables.py")
    tables = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tables)
    return tables


def line(method, h, courant, error, seconds, **more):
    base = dict.fromkeys(COLUMNS, "")
    base.update(row=f"{method}-{h}-{courant}", method=method, cellSize=h, shape=method, courant=courant, deltaT=h * courant,
                status="done", errorMeasure="way", error=error, errorScale=2, against="exact", referenceError=0, pareto=0,
                cpuSeconds=seconds, particles=100, steps=10, machine="a machine", version="1")
    base.update(more)
    return base


def write_table(case, lines):
    (case / "postProcessing").mkdir(parents=True, exist_ok=True)
    with open(case / "postProcessing" / "accuracyCost.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(lines)


LINES = [line("linear", 1, 0.1, 0.3, 0.2, temporalError=0.01, spatialError=0.25), line("linear", 0.5, 0.1, 0.2, 0.9),
         line("linear", 1, 0.05, 0.25, 0.4, spatialError=0.25), line("cpGIMP", 1, 0.1, 0.1, 0.3, pareto=1),
         line("cpGIMP", 0.5, 0.1, 0.02, 1.2, pareto=1), line("CPDI", 0.5, 0.1, "", "", status="failed", reason="yield")]


class PlotAccuracyCost(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.case = Path(folder.name) / "small"
        write_table(self.case, LINES + [line("linear", 1, 0.1, "", "", errorMeasure="force", status="failed")])

    def plot(self, *options):
        run = subprocess.run([SCRIPT, "-case", self.case, *options], text=True, capture_output=True)
        return run.returncode, run.stdout, run.stderr

    def figures(self):
        folder = self.case / "postProcessing" / "figures"
        return sorted(path.name for path in folder.iterdir()) if folder.exists() else []

    def test_one_figure_a_measure_in_both_formats(self):
        code, out, err = self.plot()
        self.assertEqual(code, 0, err)
        self.assertEqual(err, "")
        self.assertEqual(self.figures(), ["accuracyCost-way.png", "accuracyCost-way.svg"])
        self.assertIn("force: no row with an error, nothing to draw", out)
        drawn = (self.case / "postProcessing/figures/accuracyCost-way.svg").read_text()
        for text in ("error against time", "temporal (lines)", "cpGIMP", "Pareto front", "small: way against the exact"):
            self.assertIn(f"<!-- {text}", drawn)
        self.assertNotIn("<!-- CPDI", drawn, "what failed has no curve")

    def test_the_same_table_gives_the_same_bytes(self):
        self.plot()
        before = (self.case / "postProcessing/figures/accuracyCost-way.svg").read_bytes()
        self.plot()
        self.assertEqual((self.case / "postProcessing/figures/accuracyCost-way.svg").read_bytes(), before)

    def test_the_reference_is_no_point_and_its_doubt_is_shaded(self):
        runs = [line("linear", h, 0.1, error, 1, against="finest", referenceRow="linear-0.25-0.1", referenceError=0.05)
                for h, error in ((1, 0.3), (0.5, 0.2), (0.25, 0.05))]
        write_table(self.case, runs)
        code, _, err = self.plot("-output", self.case / "elsewhere")
        self.assertEqual(code, 0, err)
        drawn = (self.case / "elsewhere/accuracyCost-way.svg").read_text()
        self.assertIn("twice the reference", drawn)
        self.assertNotIn("<!-- temporal", drawn)

    def test_what_it_refuses(self):
        for options, says in ((("-measure", "height"), "allowed way, force"), (("-mesure", "way"), "did you mean -measure"),
                              (("-measure",), "lacks its argument"), (("-case", "x"), "given twice")):
            code, _, err = self.plot(*options)
            self.assertEqual(code, 1)
            self.assertIn(says, err)
        (self.case / "postProcessing" / "accuracyCost.csv").unlink()
        self.assertIn("run accuracyCost first", self.plot()[2])
        self.assertEqual(self.figures(), [])


class Tables(unittest.TestCase):
    def test_the_cheapest_run_for_each_error(self):
        tables = load_tables()
        with tempfile.TemporaryDirectory() as folder:
            tables.HERE = Path(folder)
            write_table(Path(folder) / "scene", LINES)
            text = tables.table("scene", "way").splitlines()
        self.assertEqual(text[0], "| " + " | ".join(tables.HEADS) + " |")
        self.assertEqual(text[2:], ["| 3e-01 | linear | 1 | 0.1 | 200 ms | 100 | 10 | 0.3 |",
                                    "| 1e-01 | cpGIMP | 1 | 0.1 | 300 ms | 100 | 10 | 0.1 |",
                                    "| 3e-02 | cpGIMP | 0.5 | 0.1 | 1.2 s | 100 | 10 | 0.02 |"])

    def test_the_tables_of_the_readme(self):
        tables = load_tables()
        readme = (SCENES / "README.md").read_text()
        found = tables.MARK.findall(readme)
        self.assertEqual({scene for scene, _ in found},
                         {"manufacturedBar", "generalizedVortex", "selfWeightColumn", "collapsingColumn"})
        for scene, measure in found:
            text = readme.split(f"<!-- table {scene} {measure} -->\n")[1].split("<!-- end -->")[0].splitlines()
            rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in text if row.startswith("|")]
            self.assertEqual(rows[0], tables.HEADS)
            self.assertGreaterEqual(len(rows), 4, f"{scene} {measure}")
            for row in rows[2:]:
                self.assertLessEqual(float(row[-1]), 1.01 * float(row[0]), row)
            errors = [float(row[0]) for row in rows[2:]]
            self.assertEqual(errors, sorted(errors, reverse=True))
            self.assertIn(f"({scene}-{measure}.png)", readme)
            self.assertTrue((SCENES / f"{scene}-{measure}.png").is_file())


if __name__ == "__main__":
    unittest.main()

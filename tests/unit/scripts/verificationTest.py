"""tests/verification: what scenes share (orders, tables that go stale, expressions, differences), and that each is complete."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(PROJECT / "tests" / "verification"))
import verification as v

SCENES = sorted(path.parent for path in (PROJECT / "tests" / "verification").glob("*/check.py"))


def study(errors, values=(10, 20, 40), parameter="N", loose=False):
    out = v.Study("a", parameter, values, loose)
    out.errors["error"] = list(errors)
    return out


class Orders(unittest.TestCase):
    def test_by_halving_and_by_fit(self):
        np.testing.assert_allclose(study([4e-2, 1e-2, 2.5e-3]).orders("error"), 2)
        self.assertAlmostEqual(study([4e-2, 1e-2, 2.5e-3]).fit("error"), 2)
        np.testing.assert_allclose(study([1, 2, 4], (0.1, 0.2, 0.4), "dt").orders("error"), 1)
        np.testing.assert_allclose(study([1, 3, 9], (10, 30, 90)).orders("error"), -1)

    def test_a_missing_error_is_no_order(self):
        orders = study([4e-2, float("nan"), 2.5e-3]).orders("error")
        self.assertTrue(np.isnan(orders).all())
        self.assertAlmostEqual(study([4e-2, float("nan"), 2.5e-3]).fit("error"), 2)


class Tables(unittest.TestCase):
    def table(self, first, order=1.98, floor=0.0):
        return [("", ["variant", "error", "orders"], [["a", v.Number(first, floor=floor), [v.order_of(order), v.order_of(2)]]])]

    def test_numbers_go_stale_in_their_leading_digits(self):
        printed = v.markdown(self.table(1.234e-3))
        self.assertEqual(v.differences(self.table(1.234e-3), printed), [])
        self.assertEqual(v.differences(self.table(1.25e-3), printed), [])  # 1.3 %
        self.assertEqual(len(v.differences(self.table(1.3e-3), printed)), 1)
        self.assertEqual(v.differences(self.table(1.234e-3, order=2.02), printed), [])
        self.assertEqual(len(v.differences(self.table(1.234e-3, order=2.1), printed)), 1)
        self.assertEqual(len(v.differences(self.table(float("nan")), printed)), 1)

    def test_round_off_is_round_off(self):
        printed = v.markdown(self.table(3e-15, floor=1e-12))
        self.assertIn("< 1e-12", printed)
        self.assertEqual(v.differences(self.table(7e-13, floor=1e-12), printed), [])
        self.assertEqual(len(v.differences(self.table(7e-10, floor=1e-12), printed)), 1)

    def test_rows_of_the_long_version_may_be_left_out_and_no_others(self):
        printed = v.markdown(self.table(1e-3))
        row = next(line for line in printed.split("\n") if "1.00e-03" in line)
        first = row.strip("|").split("|")[0].strip()
        more = printed.replace(row, row + "\n" + row.replace(first, "night"))
        self.assertTrue(v.differences(self.table(1e-3), more))
        self.assertEqual(v.differences(self.table(1e-3), v.without(more, [["night"]])), [])
        self.assertTrue(v.differences(self.table(1e-3), v.without(more, [["nigh"]])))
        self.assertTrue(v.differences(self.table(1e-3), v.without(printed, [[first]])))

    def test_words_rows_and_titles_must_be_the_same(self):
        printed = v.markdown(self.table(1e-3))
        self.assertTrue(v.differences(self.table(1e-3) + self.table(1e-3), printed))
        self.assertTrue(v.differences(self.table(1e-3), printed.replace("| a |", "| b |")))
        self.assertTrue(v.differences(self.table(1e-3), printed.replace("variant", "shape")))
        self.assertTrue(v.differences(self.table(1e-3), ""))


class Exact(unittest.TestCase):
    def test_expressions_are_those_of_the_dictionary(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bodyForce"
            path.write_text('constants { A 2; R "sqrt(X^2 + Y^2)"; lambda 3; } // "no"\n'
                            'value ("A*sin(pi*X)*R" 0\n "-lambda*t");\n')
            X, Y = np.array([0.5, 0.25]), np.array([1.0, 2.0])
            found = v.expressions(path)(X=X, Y=Y, t=4.0)
        np.testing.assert_allclose(found, np.stack([2 * np.sin(np.pi * X) * np.hypot(X, Y), 0 * X, -12 + 0 * X], axis=1))

    def test_body_force_of_a_known_motion(self):
        """u = (a t^2/2) X in a bar with P = mu (F - 1/F): F uniform, so b = a X."""
        X = np.linspace(0.1, 1, 5)[:, None]
        b = v.body_force_of(lambda Y, t: 0.05 * t**2 * Y, v.neo_hookean(0, 3e3), 1000, X, 1.0, 1e-2, 1e-2)
        np.testing.assert_allclose(b, 0.1 * X, atol=1e-12)

    def test_piola_stress_in_the_plane(self):
        F = np.array([[[1.2, 0.3], [-0.1, 0.9]]])
        P = v.neo_hookean(2.0, 3.0)(F)[0]
        inverse = np.linalg.inv(F[0]).T
        np.testing.assert_allclose(P, 2 * np.log(np.linalg.det(F[0])) * inverse + 3 * (F[0] - inverse), atol=1e-14)


class Scenes(unittest.TestCase):
    def test_there_are_some(self):
        self.assertGreaterEqual(len(SCENES), 5)

    def test_each_has_its_theory_with_a_table(self):
        for scene in SCENES:
            with self.subTest(scene.name):
                text = (scene / "theory.md").read_text()
                for heading in ("## Set-up", "## Solution", "## Measured", "## References"):
                    self.assertIn(heading, text)
                table = text.split(v.BEGIN)[1].split(v.END)[0]
                self.assertRegex(table, r"\| --- \|")
                self.assertRegex((scene / "check.py").read_text(), r"(?s)^\"\"\".*\nMeasured: .*\nPass: ")

    def test_an_unknown_scene_is_refused_by_name(self):
        run = subprocess.run([PROJECT / "tests" / "verification" / "check", "nonsense"], text=True, capture_output=True)
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, "found no scene 'nonsense'.*suddenGravity")


if __name__ == "__main__":
    unittest.main()

"""helical experiment correspondence at few runs: theorem 1 holds, labels are found, figures repeat for a seed."""

import math
import unittest

from helical_command import run, run_json

# Right labels of a study of the same set-up; a few runs scatter around their own mean.
LEAST_RIGHT = {4: 0.95, 6: 0.77, 9: 0.73, 12: 0.60, 15: 0.45}
RUNS = 60
FIELDS = {"n", "labelings_mean", "labelings_max", "bound", "full_search", "time_us", "hull_consistent", "right_min_de",
          "right_min_de_literal", "right_affine_seed"}


def without_times(report):
    return [{k: v for k, v in row.items() if not k.endswith("time_us")} for row in report["markers"]]


class Correspondence(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.code, cls.report = run_json("experiment", "correspondence", "--runs", RUNS, "--seed", 1)

    def test_every_number_of_markers_has_every_field(self):
        self.assertEqual(self.code, 0)
        self.assertEqual(self.report["runs"], RUNS)
        self.assertEqual([row["n"] for row in self.report["markers"]], list(range(3, 16)))
        for row in self.report["markers"]:
            self.assertLessEqual(FIELDS, set(row))

    def test_labelings_stay_below_theorem_one_and_full_search(self):
        for row in self.report["markers"]:
            self.assertAlmostEqual(row["bound"], 3 ** (row["n"] / 3))
            self.assertEqual(row["full_search"], math.factorial(row["n"]))
            self.assertLessEqual(row["labelings_mean"], row["labelings_max"])
            self.assertLessEqual(row["labelings_max"], row["bound"] * (1 + 1e-12))

    def test_right_labels_at_least_as_often_as_known(self):
        for row in self.report["markers"]:
            self.assertLessEqual(row["right_min_de"], row["hull_consistent"])
            wanted = LEAST_RIGHT.get(row["n"])
            if wanted is not None:
                scatter = 2 * math.sqrt(wanted * (1 - wanted) / RUNS)
                self.assertGreaterEqual(row["right_min_de"], wanted - scatter, row)

    def test_affine_seed_needs_no_guess(self):
        for row in self.report["markers"]:
            if row["n"] == 3:
                self.assertIsNone(row["right_affine_seed"])
            else:
                self.assertGreaterEqual(row["right_affine_seed"], 0.85, row)

    def test_nested_polygons_beat_the_full_search(self):
        for row in self.report["markers"]:
            if row["n"] == 7:
                self.assertGreater(row["full_search_time_us"] / row["time_us"], 50)

    def test_repeats_for_a_seed(self):
        first, second, other = (run_json("experiment", "correspondence", "--markers", "5-8", "--runs", 10, "--seed",
                                         seed)[1] for seed in (3, 3, 4))
        self.assertEqual(without_times(first), without_times(second))
        self.assertNotEqual(without_times(first), without_times(other))

    def test_readable_table(self):
        result = run("experiment", "correspondence", "--markers", 6, "--runs", 5)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Theorem 1's bound held", result.stdout)

    def test_bad_usage(self):
        for markers in ("2", "3-99", "9-4", "4-", "few", "4-6x"):
            with self.subTest(markers):
                result = run("experiment", "correspondence", "--markers", markers)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cure:", result.stderr)
                self.assertEqual(result.stdout, "")
        for arguments in (["experiment"], ["experiment", "loop"], ["experiment", "correspondence", "--runs", "0"]):
            with self.subTest(arguments):
                self.assertEqual(run(*arguments).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=["experiment_correspondence_test"], verbosity=2)

"""helical experiment matsukawa2010 at few runs: the contract's fields, figures where this build draws them."""

import json
import pathlib
import tempfile
import unittest

from helical_command import run, run_json

RUNS = 2
ARMS = ["camera-1-alone", "A", "B", "default"]
FIELDS = {"name", "tracker", "calibrator", "landed", "rate", "ci95", "pose_rms_after_13s_m", "camera3_used_after_13s",
          "camera3_error_m", "camera3_error_deg"}


class Matsukawa2010(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.code, cls.report = run_json("experiment", "matsukawa2010", "--runs", RUNS, "--seed", 1, "--no-images")

    def test_four_arms_with_each_tracker(self):
        self.assertEqual(self.code, 0)
        self.assertEqual(self.report["runs"], RUNS)
        flown = {(arm["tracker"], arm["name"]) for arm in self.report["arms"]}
        self.assertEqual(flown, {(tracker, name) for tracker in ("paper", "helical") for name in ARMS})
        for arm in self.report["arms"]:
            self.assertLessEqual(FIELDS, set(arm))

    def test_figures_agree_with_each_other(self):
        for arm in self.report["arms"]:
            self.assertEqual(sum(arm["outcomes"].values()), RUNS)
            self.assertEqual(arm["rate"], arm["landed"] / RUNS)
            self.assertLessEqual(arm["ci95"][0], arm["rate"])
            self.assertGreaterEqual(arm["ci95"][1], arm["rate"])
            if arm["name"] == "camera-1-alone":
                self.assertIsNone(arm["calibrator"])
                self.assertIsNone(arm["camera3_error_m"]["median"])
                self.assertEqual(arm["camera3_used_after_13s"], 0)
            else:
                self.assertLessEqual(arm["camera3_error_m"]["median"], arm["camera3_error_m"]["p90"])

    def test_camera_3_carries_experiment_b(self):
        for arm in self.report["arms"]:
            if arm["name"] == "B":
                self.assertGreater(arm["camera3_used_after_13s"], 0.5)
                self.assertLess(arm["camera3_error_m"]["median"], 0.02)

    def test_results_and_figures_or_a_word_why_not(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "results"
            result = run("experiment", "matsukawa2010", "--runs", 1, "--no-images", "--out", out)
            if result.returncode == 2:
                self.assertIn("build with Qt 6", result.stderr)
                return
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(json.loads((out / "matsukawa2010.json").read_text())["runs"], 1)
            self.assertEqual(len((out / "flights.csv").read_text().splitlines()), 1 + 8)
            for tracker in ("paper", "helical"):
                names = {file.name for file in (out / f"figures-{tracker}").iterdir()}
                self.assertEqual(names, {f"fig{n:02}.{kind}" for n in range(6, 12) for kind in ("png", "pdf")})

    def test_bad_usage(self):
        self.assertEqual(run("experiment", "matsukawa2010").returncode, 2)
        self.assertEqual(run("experiment", "matsukawa2010", "--runs", 0).returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=["experiment_matsukawa2010"])

"""helical experiment calibration: named conditions, each with all fields, intervals around their values."""

import unittest

from helical_command import run, run_json

FIELDS = {"name", "calibrator", "rmse_over_crlb", "orientation_rmse_over_crlb", "success", "success_ci95",
          "time_to_1cm_s", "nees", "nees_in_band", "step_us"}


class Calibration(unittest.TestCase):
    def test_conditions_that_are_asked_for_and_all_fields(self):
        code, report = run_json("experiment", "calibration", "--runs", 6, "--only",
                                "outliers-10,marker-error-1mm-self-calibrated,knock-5deg")
        self.assertEqual(code, 0)
        rows = {row["name"]: row for row in report["conditions"]}
        self.assertEqual(list(rows), ["outliers-10", "marker-error-1mm-self-calibrated", "knock-5deg"])
        for row in rows.values():
            self.assertLessEqual(FIELDS, set(row))
        for mark in ("1s", "5s", "13s"):
            ratio = rows["outliers-10"]["rmse_over_crlb"][mark]
            self.assertLessEqual(ratio["ci95"][0], ratio["value"])
            self.assertGreaterEqual(ratio["ci95"][1], ratio["value"])
        self.assertEqual(rows["outliers-10"]["success"], 1.0)
        self.assertLess(rows["marker-error-1mm-self-calibrated"]["rmse_over_crlb"]["13s"]["value"], 2.5)
        knock = rows["knock-5deg"]
        self.assertEqual(knock["found_in_time"]["value"], 1.0)
        self.assertEqual(knock["wrong_alarms"], 0)
        self.assertIsNone(knock["rmse_over_crlb"])

    def test_methods_that_are_asked_for(self):
        code, report = run_json("experiment", "calibration", "--runs", 2, "--only", "asymmetric",
                                "--calibrator", "ekf,joint")
        self.assertEqual(code, 0)
        self.assertEqual({row["calibrator"] for row in report["conditions"]}, {"joint", "ekf"})
        self.assertEqual({row["name"] for row in report["conditions"]}, {"asymmetric"})

    def test_unknown_conditions_are_refused(self):
        done = run("experiment", "calibration", "--only", "weather")
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main(argv=["experiment_calibration_test"], verbosity=2)

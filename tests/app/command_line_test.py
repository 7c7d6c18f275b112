"""The command line is a contract: names, fields, exit codes, and errors that say where, what and how to mend it."""

import os
import subprocess
import tempfile
import unittest

from helical_command import BINARY, SOURCE, WALL_CLOCK, run, run_json, without


class Fly(unittest.TestCase):
    def test_report_has_every_field(self):
        code, report = run_json("fly", "--no-images", "--seed", 7)
        self.assertEqual(code, 0)
        self.assertEqual(report["outcome"], "landed")
        for field in ("duration_s", "simulated_over_wall", "tracking", "control", "cameras", "server_us",
                      "frame_to_command_us", "selected_features", "failsafes", "session"):
            self.assertIn(field, report)
        self.assertLessEqual({"position_rms_m", "orientation_rms_deg", "lost_s"}, set(report["tracking"]))
        self.assertEqual({"position_rms_m", "height_rms_m", "yaw_rms_deg"}, set(report["control"]))
        self.assertEqual([camera["id"] for camera in report["cameras"]], [1, 2, 3])
        self.assertEqual([camera["calibrated"] for camera in report["cameras"]], [True, True, True])
        for camera in report["cameras"]:
            self.assertLessEqual({"id", "calibrated", "frames", "dropped", "extraction_us", "calibration"}, set(camera))
            self.assertIsNone(camera["extraction_us"]["p50"])
            self.assertLessEqual({"method", "time_to_1cm_s", "position_error_m", "orientation_error_deg",
                                  "position_sigma_m", "orientation_sigma_deg", "crlb_position_m",
                                  "crlb_orientation_deg", "nees", "bumps_detected"}, set(camera["calibration"]))
        self.assertGreater(report["simulated_over_wall"], 20)

    def test_repeats_for_a_seed(self):
        first, second, other = (run_json("fly", "--no-images", "--seed", seed)[1] for seed in (7, 7, 8))
        self.assertEqual(without(first, *WALL_CLOCK), without(second, *WALL_CLOCK))
        self.assertNotEqual(without(first, *WALL_CLOCK), without(other, *WALL_CLOCK))

    def test_images_report_extraction_times(self):
        code, report = run_json("fly", "--duration", 13)
        self.assertEqual((code, report["outcome"]), (0, "landed"))
        for camera in report["cameras"]:
            self.assertGreater(camera["extraction_us"]["p50"], 0)
            self.assertEqual(camera["dropped"], 0)

    def test_failsafe_landing_is_a_failure(self):
        code, report = run_json("fly", "--no-images", "--occlude", "1@10-99", "--occlude", "2@10-99",
                                "--occlude", "3@10-99")
        self.assertEqual((code, report["outcome"]), (1, "failsafe-landed"))
        self.assertEqual(report["failsafes"], ["no-pose-coast", "no-pose-descent", "no-pose-cut", "no-pose-neutral"])

    def test_nothing_calibrated_is_aborted_with_null_figures(self):
        code, report = run_json("fly", "--no-images", "--uncalibrated", "1,2", "--duration", 13)
        self.assertEqual((code, report["outcome"]), (1, "aborted"))
        self.assertIsNone(report["control"]["position_rms_m"])
        self.assertIsNone(report["tracking"]["nees"])

    def test_every_option_is_taken(self):
        code, report = run_json("fly", "--no-images", "--plan", "waypoints", "--seed", 3, "--gust", 0.5, "--vary", 0.1,
                                "--pixel-noise", 0.3, "--outliers", 0.01, "--rate", 90, "--occlude", "2@9-10",
                                "--bump", "3@8:5,0.05")
        self.assertEqual((code, report["outcome"]), (0, "landed"))

    def test_balls_that_are_off_are_found_and_saved(self):
        with tempfile.TemporaryDirectory() as folder:
            saved = os.path.join(folder, "found.toml")
            off = ("fly", "--no-images", "--seed", 2, "--marker-error", 0.001, "--focal-error", 0.003)
            code, report = run_json(*off, "--refine", 12, "--refine-markers", 0.001, "--refine-focal", 0.01,
                                    "--save-calibration", saved)
            self.assertEqual((code, report["outcome"]), (0, "landed"))
            _, plain = run_json(*off)
            self.assertEqual([camera["focal_scale"] for camera in plain["cameras"]], [1, 1, 1])
            self.assertNotEqual(report["markers_m"], plain["markers_m"])
            self.assertNotEqual(report["cameras"][0]["focal_scale"], 1)
            self.assertLess(report["tracking"]["orientation_rms_deg"], plain["tracking"]["orientation_rms_deg"])
            _, again = run_json(*off, "--calibration", saved)
            self.assertEqual(again["markers_m"], report["markers_m"])
            self.assertLess(again["tracking"]["orientation_rms_deg"],
                            0.6 * plain["tracking"]["orientation_rms_deg"])

    def test_realtime_with_images_keeps_pace_and_drops_nothing(self):
        code, report = run_json("fly", "--realtime", "--duration", 15)
        self.assertEqual((code, report["outcome"]), (0, "landed"))
        self.assertGreater(report["simulated_over_wall"], 0.95)
        self.assertLess(report["simulated_over_wall"], 1.05)
        print([(c["frames"], c["dropped"], c["extraction_us"]) for c in report["cameras"]], report["server_us"])
        for camera in report["cameras"]:
            self.assertGreater(camera["frames"], 600)
            # A machine that stalls for longer than a camera's buffer loses frames; a rig that cannot keep up loses many.
            self.assertLess(camera["dropped"], 0.01 * camera["frames"])

    def test_calibration_in_flight_is_reported(self):
        code, report = run_json("fly", "--no-images", "--calibrator", "growing-gauss-newton", "--initial-error", "10,0.3",
                                "--occlude", "2@13-60")
        self.assertEqual((code, report["outcome"]), (0, "landed"))
        calibration = report["cameras"][2]["calibration"]
        self.assertEqual(calibration["method"], "growing-gauss-newton")
        self.assertTrue(report["cameras"][2]["calibrated"])
        self.assertLess(calibration["position_error_m"], 0.02)
        self.assertLess(calibration["orientation_error_deg"], 1)
        self.assertGreater(calibration["position_sigma_m"], 0)
        self.assertIsNone(report["cameras"][0]["calibration"]["method"])

    def test_readable_report_goes_to_stdout_and_progress_to_stderr(self):
        result = run("fly", "--no-images")
        self.assertTrue(result.stdout.startswith("landed after"))
        self.assertNotIn("%", result.stderr.replace("100 %", ""))


class Errors(unittest.TestCase):
    def assert_refused(self, result, *words, code=2):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertEqual(result.stdout, "")
        for word in words:
            self.assertIn(word, result.stderr)

    def test_bad_options(self):
        self.assert_refused(run("fly", "--occlude", "9@1-2"), "no camera '9'", "cure:", "1, 2, 3")
        self.assert_refused(run("fly", "--occlude", "2@x"), "2@x", "cure:")
        self.assert_refused(run("fly", "--occlude", "2@9-3"), "cure:")
        self.assert_refused(run("fly", "--bump", "2@1"), "cure:")
        self.assert_refused(run("fly", "--plan", "looping"), "looping", "hover")
        self.assert_refused(run("fly", "--duration", "3"), "too short", "cure:")
        self.assert_refused(run("fly", "--seed", "abc"))
        self.assert_refused(run("fly", "--vary", "2"))
        self.assert_refused(run("fly", "--marker-error", "1"))
        self.assert_refused(run("fly", "--refine-markers", "1"))
        self.assert_refused(run("fly", "--refine-focal", "-0.1"))
        self.assert_refused(run("fly", "--refine-focal", "0.01"), "--refine-focal requires --refine")
        self.assert_refused(run("fly", "--no-images", "--calibrator", "kalman"), "kalman", "joint")
        self.assert_refused(run("fly", "--initial-error", "15"))
        self.assert_refused(run("loop"))

    def test_bad_rig_files_name_file_line_and_cure(self):
        with open(os.path.join(SOURCE, "resources", "rigs", "paper.toml"), encoding="utf-8") as file:
            good = file.read()
        lines = good.splitlines()
        cases = {
            "wrong type": (good.replace("fx = 567.6", 'fx = "wide"', 1), lines.index("fx = 567.6") + 1),
            "unknown key": (good.replace("fx = 567.6", "fx = 567.6\nfocal = 3", 1), lines.index("fx = 567.6") + 2),
            "two of one id": (good.replace("id = 2", "id = 1", 1), lines.index("id = 2") + 1),
            "negative focal length": (good.replace("fx = 567.6", "fx = -567.6", 1), lines.index("fx = 567.6") + 1),
        }
        with tempfile.TemporaryDirectory() as folder:
            for name, (text, line) in cases.items():
                path = os.path.join(folder, "rig.toml")
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
                with self.subTest(name):
                    self.assert_refused(run("fly", "--rig", path), f"{path}:{line}", "cure:")
        self.assert_refused(run("fly", "--rig", path), path, "cure:")

    def test_window_without_a_display(self):
        without = run()
        self.assertEqual(without.returncode, 1)
        self.assertIn("DISPLAY is not set", without.stderr)
        self.assertIn("cure:", without.stderr)
        dead = run(DISPLAY=":7777")
        self.assertEqual(dead.returncode, 1)
        self.assertIn("no X server answers", dead.stderr)

    def test_rig_before_a_sub_command_is_not_ignored(self):
        self.assert_refused(run("--rig", "/nonexistent.toml", "fly", "--no-images"), "--rig", "cure:")

    def test_full_disk_is_said(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            result = subprocess.run([BINARY, "fly", "--no-images", "--json"], stdout=full, stderr=subprocess.PIPE,
                                    text=True, timeout=600)
        self.assertEqual(result.returncode, 1)
        self.assertIn("cannot be written", result.stderr)

    def test_help_and_version(self):
        for arguments in (["--help"], ["fly", "--help"], ["detect", "--help"]):
            result = run(*arguments)
            self.assertEqual(result.returncode, 0)
            self.assertIn("--", result.stdout)
        self.assertRegex(run("--version").stdout, r"^helical \d+\.\d+\.\d+")


if __name__ == "__main__":
    unittest.main(argv=["command_line_test"], verbosity=2)

"""Two flights over each other: one table, one report, the paper's figures 6 to 11."""

import pathlib
import re
import tempfile
import unittest

from helical_command import run, run_json


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = pathlib.Path(cls.folder.name)
        cls.files, cls.reports = [], []
        for name, method in (("sharp", "joint"), ("plain", "ekf")):
            file = cls.place / f"{name}.mcap"
            code, report = run_json("fly", "--no-images", "--seed", 4, "--duration", 16, "--calibrator", method,
                                    "--session", file)
            assert code == 0, report
            cls.files.append(file)
            cls.reports.append(report)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_the_table_says_what_the_flights_said(self):
        code, compared = run_json("compare", *self.files)
        self.assertEqual((code, len(compared["sessions"]), compared["report"]), (0, 2, None))
        for side, flown, file in zip(compared["sessions"], self.reports, self.files):
            self.assertEqual((side["session"], side["complete"], side["outcome"]), (str(file), True, "landed"))
            self.assertAlmostEqual(side["tracking_mm"], 1e3 * flown["tracking"]["position_rms_m"], places=9)
            self.assertAlmostEqual(side["hover_height_mm"], 1e3 * flown["control"]["height_rms_m"], places=9)
            learnt = flown["cameras"][2]["calibration"]
            self.assertAlmostEqual(side["camera_3_position_error_mm"], 1e3 * learnt["position_error_m"], places=6)
            self.assertEqual(side["camera_3_one_cm_after_s"], learnt["time_to_1cm_s"])
            self.assertGreater(side["zero_s"], 0.0)
        self.assertEqual([side["calibrator"] for side in compared["sessions"]], ["joint", "ekf"])

    def test_people_get_the_same_table(self):
        result = run("compare", *self.files)
        self.assertEqual(result.returncode, 0, result.stderr)
        for words in ("A  ", "B  ", "hover error, height (RMS) [mm]", "camera 3: position error at the end [mm]", "ekf"):
            self.assertIn(words, result.stdout)

    def test_report_and_figures(self):
        report, figures = self.place / "two.pdf", self.place / "figures"
        result = run("compare", *self.files, "--out", report, "--figures", figures)
        if "draws no figures" in result.stderr:
            self.skipTest("no figures in this build")
        self.assertEqual(result.returncode, 0, result.stderr)
        content = report.read_bytes()
        self.assertTrue(content.startswith(b"%PDF-"))
        self.assertGreaterEqual(len(re.findall(rb"/Type /Page\b", content)), 5)
        stems = {f"fig{number:02}" for number in range(6, 12)} | {"tracking", "latency"}
        self.assertEqual({file.name for file in figures.iterdir()},
                         {f"{stem}.{suffix}" for stem in stems for suffix in ("png", "pdf")})

    def test_what_cannot_be_is_refused(self):
        foreign = self.place / "foreign.mcap"
        foreign.write_text("no session\n", encoding="utf-8")
        for arguments in ((self.files[0],), (self.files[0], foreign), (self.files[0], self.place / "missing.mcap")):
            result = run("compare", *arguments)
            self.assertEqual((result.returncode, result.stdout), (2, ""), arguments)
            self.assertIn("cure:", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["compare_test"], verbosity=2)

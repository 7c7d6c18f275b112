"""Sessions as films, figures, reports and tables for other programs."""

import csv
import pathlib
import re
import struct
import tempfile
import unittest

import plot_csv
from helical_command import run, run_json
from mcap_parser import McapFile, pose


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.place = pathlib.Path(cls.folder.name)
        cls.file = cls.place / "flight.mcap"
        cls.code, cls.report = run_json("fly", "--seed", 4, "--duration", 14, "--calibrator", "joint",
                                        "--occlude", "2@9-11", "--session", cls.file, "--session-images", "jpeg@15",
                                        "--session-images", "3=off")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def export(self, formats, name):
        result = run("export", self.file, "--format", formats, "--out", self.place / name)
        if "this build draws none" in result.stderr:
            self.skipTest("no figures in this build")
        self.assertEqual(result.returncode, 0, result.stderr)
        files = [pathlib.Path(line) for line in result.stdout.splitlines()]
        for file in files:
            self.assertGreater(file.stat().st_size, 0, file)
        return {file.name: file for file in files}, result.stderr

    def test_films_show_the_flight_of_cameras_with_images(self):
        films, told = self.export("mp4", "films")
        self.assertEqual(set(films), {"camera_1.mp4", "camera_2.mp4"})
        self.assertIn("camera 3", told)
        found = self.place / "found.csv"
        self.assertEqual(run("detect", films["camera_1.mp4"], "--csv", found).returncode, 0)
        with open(found, newline="", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        length_s = McapFile(self.file).messages[-1][1] * 1e-9
        self.assertAlmostEqual(max(int(row["frame"]) for row in rows) / 30.0, length_s, delta=1.0)
        self.assertGreater(len(rows), 900)  # three balls and more of each picture

    def test_figures_and_a_report(self):
        files, _ = self.export("png,pdf", "figures")
        stems = {"fig06", "fig07", "fig08", "fig09", "fig10", "fig11", "tracking", "calibration",
                 "calibration_orientation", "residuals", "sticks", "latency", "latency_histogram"}
        self.assertEqual(set(files), {f"{stem}.{suffix}" for stem in stems for suffix in ("png", "pdf")} | {"report.pdf"})
        for name, file in files.items():
            content = file.read_bytes()
            if name.endswith(".png"):
                width, height = struct.unpack(">II", content[16:24])
                self.assertEqual(width, 1004)
                self.assertGreater(height, 400)
            else:
                self.assertTrue(content.startswith(b"%PDF-"))
        pages = len(re.findall(rb"/Type /Page\b", files["report.pdf"].read_bytes()))
        self.assertGreaterEqual(pages, 5)

    def test_streams_and_a_span(self):
        result = run("export", self.file, "--format", "csv", "--streams", "/helicopter/pose,/sticks", "--from", 6, "--to", 8,
                     "--out", self.place / "span")
        self.assertEqual(result.returncode, 0, result.stderr)
        names = {pathlib.Path(line).name for line in result.stdout.splitlines()}
        self.assertEqual(names, {"helicopter_pose.csv", "sticks.csv", "rig.toml", "plan.toml", "settings.json", "README.md"})
        for name in ("helicopter_pose.csv", "sticks.csv"):
            with open(self.place / "span" / name, newline="", encoding="utf-8") as table:
                times = [float(row["time_s [s]"]) for row in csv.DictReader(table)]
            self.assertTrue(all(6.0 <= time <= 8.0 for time in times))
            self.assertEqual(len(times), 121)  # both ends count

    def test_a_ten_line_script_plots_the_tables(self):
        tables, _ = self.export("csv", "tables")
        picture = self.place / "plot.svg"
        columns = [f"pose.pose.position.{axis} [m]" for axis in "xyz"]
        plot_csv.plot(tables["helicopter_pose.csv"], columns, picture)
        lines = re.findall(r'points="([^"]*)"', picture.read_text(encoding="utf-8"))
        recorded = McapFile(self.file).of("/helicopter/pose")
        self.assertEqual(len(lines), 3)
        for axis, line in enumerate(lines):
            points = [tuple(map(float, point.split(","))) for point in line.split()]
            self.assertEqual(len(points), len(recorded))
            for (time_s, value), (time, payload) in zip(points, recorded):
                self.assertEqual(round(1e9 * time_s), time)
                self.assertEqual(-value, pose(payload)[axis])
        self.assertIn("cameras_1_track.csv", tables)
        self.assertNotIn("cameras_1_image_raw_compressed.csv", tables)

    def test_what_cannot_be_is_refused(self):
        bare = self.place / "bare.mcap"
        self.assertEqual(run_json("fly", "--no-images", "--duration", 14, "--session", bare)[0], 0)
        for arguments in (("export", bare, "--format", "mp4", "--out", self.place / "no"),
                          ("export", bare, "--format", "xls", "--out", self.place / "no"),
                          ("export", bare, "--format", "csv", "--streams", "/nothing", "--out", self.place / "no"),
                          ("export", bare, "--format", "csv", "--from", 5, "--to", 4, "--out", self.place / "no"),
                          ("fly", "--session", self.place / "x.mcap", "--session-images", "gif"),
                          ("fly", "--session", self.place / "x.mcap", "--session-images", "9=jpeg"),
                          ("fly", "--session", self.place / "x.mcap", "--session-images", "jpeg@fast")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn("cure:", result.stderr, arguments)


if __name__ == "__main__":
    unittest.main(argv=["export_test"], verbosity=2)

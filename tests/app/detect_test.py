"""helical detect on images that this test draws, on broken ones, and on a real recording where there is one."""

import csv
import os
import tempfile
import unittest

from helical_command import SOURCE, run

RECORDING = os.path.join(SOURCE, "..", "shared", "data", "ball", "ball2.mp4")
COLUMNS = ["frame", "time_s", "marker", "u_px", "v_px", "radius_px", "area_px", "sigma_px"]


def write_picture(path, discs, width=160, height=120):
    """A grey PPM with green discs (u, v, radius)."""
    pixels = bytearray()
    for y in range(height):
        for x in range(width):
            green = any((x - u) ** 2 + (y - v) ** 2 <= r * r for u, v, r in discs)
            pixels += bytes((30, 190, 40) if green else (120, 118, 122))
    with open(path, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (width, height) + bytes(pixels))


def rows_of(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
        return rows


class Detect(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_image(self):
        write_picture(self.path("a.ppm"), [(40, 30, 6), (100.4, 80, 9)])
        result = run("detect", self.path("a.ppm"), "--csv", self.path("out.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = rows_of(self.path("out.csv"))
        self.assertEqual(list(rows[0]), COLUMNS)
        found = sorted((float(row["u_px"]), float(row["v_px"])) for row in rows)
        self.assertEqual(len(found), 2)
        self.assertAlmostEqual(found[0][0], 40, delta=0.3)
        self.assertAlmostEqual(found[0][1], 30, delta=0.3)
        self.assertAlmostEqual(found[1][0], 100.4, delta=0.3)

    def test_folder_in_order(self):
        os.mkdir(self.path("frames"))
        for i in range(4):
            write_picture(self.path(f"frames/{i:03}.ppm"), [(30 + 20 * i, 60, 7)])
        result = run("detect", self.path("frames"), "--csv", self.path("out.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = rows_of(self.path("out.csv"))
        self.assertEqual([int(row["frame"]) for row in rows], [0, 1, 2, 3])
        for i, row in enumerate(rows):
            self.assertAlmostEqual(float(row["u_px"]), 30 + 20 * i, delta=0.3)

    def test_background_hides_what_stands_still(self):
        write_picture(self.path("still.ppm"), [(40, 30, 6)])
        write_picture(self.path("both.ppm"), [(40, 30, 6), (100, 80, 9)])
        result = run("detect", self.path("both.ppm"), "--background", self.path("still.ppm"), "--csv",
                     self.path("out.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = rows_of(self.path("out.csv"))
        self.assertEqual(len(rows), 1)
        self.assertAlmostEqual(float(rows[0]["u_px"]), 100, delta=0.3)

    def test_bad_input(self):
        write_picture(self.path("a.ppm"), [])
        with open(self.path("broken.png"), "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n and nothing more")
        cases = [
            [self.path("absent.png"), "--csv", self.path("out.csv")],
            [self.path("broken.png"), "--csv", self.path("out.csv")],
            [self.path("a.ppm"), "--hsv", "green", "--csv", self.path("out.csv")],
            [self.path("a.ppm"), "--hsv", "90-30,0-255,300-400", "--csv", self.path("out.csv")],
            [self.path("a.ppm"), "--csv", self.path("absent/out.csv")],
            [self.path("a.ppm")],
        ]
        for arguments in cases:
            with self.subTest(arguments=arguments):
                result = run("detect", *arguments)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertTrue(result.stderr)

    def test_full_disk_is_said(self):
        write_picture(self.path("a.ppm"), [(40, 30, 6)])
        result = run("detect", self.path("a.ppm"), "--csv", "/dev/full")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("cure:", result.stderr)

    @unittest.skipUnless(os.path.exists(RECORDING), "SKIPPED: the recording ball2.mp4 is not here")
    def test_real_recording(self):
        result = run("detect", RECORDING, "--hsv", "30-85,60-255,50-255", "--csv", self.path("ball.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        found = {row["frame"] for row in rows_of(self.path("ball.csv"))}
        print(f"ball found in {len(found)} of 1004 frames")
        self.assertGreaterEqual(len(found), 873)


if __name__ == "__main__":
    unittest.main(argv=["detect_test"], verbosity=2)

"""helical detect on images that this test draws, on broken ones, and on a real recording where there is one."""

import csv
import os
import struct
import tempfile
import unittest
import zlib

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


def write_png(path, width=160, height=120):
    """One green square before grey, incompressible enough that its cut-off half misses rows."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + bytes((97 * x * y) % 50 + (60 if 50 < x < 65 and 50 < y < 65 and c == 1 else 30)
                                  for x in range(width) for c in range(3)) for y in range(height))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def write_video(path, frames, width=160, height=120):
    """An AVI of plain frames without compression, each with a green square."""
    def chunk(kind, data):
        return kind + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)
    size = 3 * width * height
    header = struct.pack("<14I", 33333, size * 30, 0, 0x10, frames, 0, 1, size, width, height, 0, 0, 0, 0)
    stream = b"vids" + b"DIB " + struct.pack("<IHHIIIIIIIIHHHH", 0, 0, 0, 0, 1, 30, 0, frames, size, 0, 0,
                                             0, 0, width, height)
    shape = struct.pack("<IiiHHIIiiII", 40, width, height, 1, 24, 0, size, 0, 0, 0, 0)
    row = lambda y: b"".join(b"\x1e\xbe\x28" if 60 < x < 75 and 50 < y < 65 else b"\x78\x76\x7a"
                             for x in range(width))
    picture = chunk(b"00db", b"".join(row(y) for y in reversed(range(height))))
    index = b"".join(b"00db" + struct.pack("<III", 0x10, 4 + i * len(picture), size) for i in range(frames))
    lists = chunk(b"LIST", b"hdrl" + chunk(b"avih", header) +
                  chunk(b"LIST", b"strl" + chunk(b"strh", stream) + chunk(b"strf", shape)))
    body = b"AVI " + lists + chunk(b"LIST", b"movi" + picture * frames) + chunk(b"idx1", index)
    with open(path, "wb") as file:
        file.write(chunk(b"RIFF", body))


def cut(path, share):
    with open(path, "r+b") as file:
        file.truncate(int(os.path.getsize(path) * share))


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

    def expect_error_at(self, media, frame):
        result = run("detect", self.path(media), "--csv", self.path("out.csv"))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(f"frame {frame}", result.stderr)
        self.assertIn("cure:", result.stderr)

    def test_cut_off_images_name_the_frame(self):
        for name, write in (("a.png", write_png), ("a.ppm", lambda path: write_picture(path, []))):
            with self.subTest(name=name):
                write(self.path(name))
                self.assertEqual(run("detect", self.path(name), "--csv", self.path("out.csv")).returncode, 0)
                cut(self.path(name), 0.6)
                self.expect_error_at(name, 0)

    def test_a_wrong_file_in_a_folder_names_the_frame(self):
        for name, damage in (("cut", lambda path: cut(path, 0.6)),
                             ("empty", lambda path: cut(path, 0.0)),
                             ("text", lambda path: open(path, "w", encoding="utf-8").write("no picture")),
                             ("size", lambda path: write_png(path, 80, 60))):
            with self.subTest(name=name):
                os.mkdir(self.path(name))
                for i in range(4):
                    write_png(self.path(f"{name}/{i}.png"))
                damage(self.path(f"{name}/2.png"))
                self.expect_error_at(name, 2)

    def test_a_cut_off_video_names_the_frame(self):
        write_video(self.path("film.avi"), 10)
        result = run("detect", self.path("film.avi"), "--csv", self.path("out.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([int(row["frame"]) for row in rows_of(self.path("out.csv"))], list(range(10)))
        cut(self.path("film.avi"), 0.45)
        self.expect_error_at("film.avi", 4)

    def test_a_video_that_is_none_names_the_frame(self):
        with open(self.path("film.mp4"), "wb") as file:
            file.write(bytes(range(256)) * 40)
        self.expect_error_at("film.mp4", 0)

    @unittest.skipUnless(os.path.exists(RECORDING), "SKIPPED: the recording ball2.mp4 is not here")
    def test_a_cut_off_recording_names_the_frame(self):
        with open(RECORDING, "rb") as whole, open(self.path("film.mp4"), "wb") as file:
            file.write(whole.read()[:-900000])
        result = run("detect", self.path("film.mp4"), "--csv", self.path("out.csv"))
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertRegex(result.stderr, r"frame \d+")

    def test_full_disk_is_said(self):
        write_picture(self.path("a.ppm"), [(40, 30, 6)])
        result = run("detect", self.path("a.ppm"), "--csv", "/dev/full")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("cure:", result.stderr)

    @unittest.skipUnless(os.path.exists(RECORDING), "SKIPPED: the recording ball2.mp4 is not here")
    def test_real_recording(self):
        result = run("detect", RECORDING, "--hsv", "30-85,60-255,50-255", "--csv", self.path("ball.csv"))
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = rows_of(self.path("ball.csv"))
        found = {row["frame"] for row in rows}
        print(f"ball found in {len(found)} of 1004 frames, {len(rows)} markers")
        self.assertGreaterEqual(len(found), 873)


if __name__ == "__main__":
    unittest.main(argv=["detect_test"], verbosity=2)

"""Recordings in the place of cameras: a rig of files is played to its end, and bad files are said to be bad."""

import pathlib
import struct
import tempfile
import unittest
import zlib

from helical_command import run, run_json

RIG = """format_version = 1
"""
CAMERA = """
[[camera]]
id = {id}
source = "file:{path}"
size = [{width}, 48]
[camera.intrinsics]
fx = 60.0
fy = 60.0
cx = 31.5
cy = 23.5
[camera.device]
rate_hz = 50.0
"""


def png(path, grey, width=64, height=48):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = (b"\0" + bytes([grey]) * width) * height
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


class Recordings(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def images(self, name, count):
        (self.folder / name).mkdir()
        for i in range(count):
            png(self.folder / name / f"{i}.png", 40 + i)

    def rig(self, *cameras, width=64):
        text = RIG + "".join(CAMERA.format(id=i + 1, path=path, width=width) for i, path in enumerate(cameras))
        (self.folder / "rig.toml").write_text(text, encoding="utf-8")
        return self.folder / "rig.toml"

    def test_lock_step_plays_every_frame_of_each(self):
        self.images("a", 40)
        self.images("b", 60)
        code, report = run_json("fly", "--rig", self.rig("a", "b"))
        self.assertEqual(code, 0)
        self.assertEqual([(c["frames"], c["dropped"]) for c in report["cameras"]], [(40, 0), (60, 0)])
        self.assertGreater(report["duration_s"], 1.2)

    def test_real_time_keeps_the_pace(self):
        self.images("a", 50)
        code, report = run_json("fly", "--realtime", "--rig", self.rig("a"))
        self.assertEqual(code, 0)
        self.assertEqual(report["cameras"][0]["frames"] + report["cameras"][0]["dropped"], 50)
        self.assertLess(report["simulated_over_wall"], 1.1)

    def test_bad_files(self):
        self.images("a", 10)
        wrong_size = run("fly", "--rig", self.rig("a", width=32))
        self.assertEqual(wrong_size.returncode, 2)
        self.assertIn("64x48", wrong_size.stderr)
        absent = run("fly", "--rig", self.rig("nowhere.mp4"))
        self.assertEqual(absent.returncode, 2)
        self.assertIn("nowhere.mp4", absent.stderr)
        damaged = self.folder / "a" / "7.png"
        damaged.write_bytes(damaged.read_bytes()[:60])
        cut_off = run("fly", "--rig", self.rig("a"))
        self.assertEqual(cut_off.returncode, 2)
        self.assertIn("frame 7", cut_off.stderr)


if __name__ == "__main__":
    unittest.main(argv=["recordings_test"])

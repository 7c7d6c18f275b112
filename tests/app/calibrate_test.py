"""helical calibrate on recordings that this test makes up, on broken ones, and on real ones where they are."""

import csv
import glob
import math
import os
import random
import tempfile
import tomllib
import unittest

from helical_command import SOURCE, run, run_json

CALISCOPE = os.path.join(SOURCE, "..", "shared", "data", "caliscope", "post_optimization")
CHESSBOARDS = os.environ.get("HELICAL_OPENCV_DOC", "/usr/share/doc/opencv-doc/examples/data")

RIG = """format_version = 1
""" + "".join(f"""
[[camera]]
id = {i}
size = [640, 480]
[camera.intrinsics]
fx = 550.0
fy = 550.0
cx = 319.5
cy = 239.5
""" for i in (1, 2, 3))


def look_at(eye):
    """Rows of camera_from_world's rotation, for a camera at `eye` that looks at (0, 0, 0.5)."""
    forward = [a - b for a, b in zip((0.0, 0.0, 0.5), eye)]
    length = math.hypot(*forward)
    z = [v / length for v in forward]
    x = [z[1], -z[0], 0.0]
    length = math.hypot(*x)
    x = [v / length for v in x]
    y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
    return x, y, z


EYES = {1: (2.5, 0.0, 1.2), 2: (-1.2, 2.2, 1.5), 3: (-1.2, -2.2, 1.0)}


def project(camera, point):
    rows = look_at(EYES[camera])
    apart = [a - b for a, b in zip(point, EYES[camera])]
    x, y, z = (sum(a * b for a, b in zip(row, apart)) for row in rows)
    return 319.5 + 550.0 * x / z, 239.5 + 550.0 * y / z


def light(t):
    return 0.6 * math.sin(1.3 * t), 0.6 * math.cos(1.7 * t), 0.5 + 0.4 * math.sin(0.9 * t)


def light_rows(seconds=15.0):
    draw = random.Random(3)
    for k in range(int(seconds * 30)):
        for camera in EYES:
            u, v = project(camera, light(k / 30))
            yield k / 30, camera, u + draw.gauss(0, 0.3), v + draw.gauss(0, 0.3)


class Calibrate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def write_rows(self, rows, header="time_s,camera,u_px,v_px"):
        return self.write("obs.csv", header + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows))

    def rig(self, observations, *more, rig=RIG):
        return run_json("calibrate", "rig", "--observations", observations, "--rig", self.write("in.toml", rig), "--out",
                        self.path("out.toml"), *more)


class Rig(Calibrate):
    def test_waved_light_with_a_known_distance(self):
        apart = math.dist(EYES[1], EYES[2])
        code, report = self.rig(self.write_rows(light_rows()), "--scale", f"1,2={apart}")
        self.assertEqual(code, 0, report)
        self.assertIn(report["verdict"], ("good", "usable"))
        self.assertEqual(report["scale"], "metric")
        for camera in report["cameras"]:
            self.assertLess(camera["reprojection_rms_px"], 0.6)
            self.assertLess(camera["rejected"], 0.02 * camera["observations"])
        with open(self.path("out.toml"), "rb") as file:
            cameras = tomllib.load(file)["camera"]
        centres = {}
        for camera in cameras:
            pose = camera["pose"]
            w, x, y, z = pose["rotation_wxyz"]
            rotation = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
            t = pose["translation_m"]
            centres[camera["id"]] = [-sum(rotation[k][i] * t[k] for k in range(3)) for i in range(3)]
            self.assertEqual(len(pose["covariance"]), 36)
        for a, b in ((1, 2), (1, 3), (2, 3)):
            self.assertAlmostEqual(math.dist(centres[a], centres[b]), math.dist(EYES[a], EYES[b]), delta=0.02)
        self.assertEqual(run("calibrate", "rig", "--observations", self.path("obs.csv"), "--rig", self.path("out.toml"),
                             "--out", self.path("again.toml")).returncode, 0)

    def test_without_a_scale_it_says_so(self):
        code, report = self.rig(self.write_rows(light_rows()))
        self.assertEqual(code, 0, report)
        self.assertEqual(report["scale"], "arbitrary")

    def test_balls_and_focal_lengths_that_are_off_are_found_and_written(self):
        told = [(0.15, 0.1, 0.0), (-0.12, 0.14, 0.02), (-0.15, -0.1, 0.0), (0.13, -0.15, 0.03), (0.0, 0.02, -0.06)]
        draw = random.Random(5)
        true = [[value + draw.gauss(0, 0.001) for value in ball] for ball in told]
        rows = []
        for k in range(240):
            t = k / 30
            turn, tilt, (x, y, z) = 2 * math.sin(0.7 * t), 0.6 * math.sin(1.1 * t), light(t)
            for camera in EYES:
                for marker, (a, b, c) in enumerate(true):
                    b, c = math.cos(tilt) * b - math.sin(tilt) * c, math.sin(tilt) * b + math.cos(tilt) * c
                    a, b = math.cos(turn) * a - math.sin(turn) * b, math.sin(turn) * a + math.cos(turn) * b
                    u, v = project(camera, (x + a, y + b, z + c))
                    rows.append((t, camera, u + draw.gauss(0, 0.2), v + draw.gauss(0, 0.2), marker, *told[marker]))
        rows = self.write_rows(rows, "time_s,camera,u_px,v_px,marker,body_x_m,body_y_m,body_z_m")
        rig = RIG.replace("550.0", "553.0") + "[helicopter]\nmarkers_m = " + str([list(ball) for ball in told]) + "\n"
        _, plain = self.rig(rows, rig=rig)
        code, report = self.rig(rows, "--refine-markers", 0.001, "--refine-focal", 0.01, rig=rig)
        self.assertEqual(code, 0, report)
        self.assertLess(report["sigma_px"], min(0.25, plain["sigma_px"]))
        self.assertEqual(len(report["points"]), 5)
        self.assertEqual(plain["points"], [])
        with open(self.path("out.toml"), "rb") as file:
            written = tomllib.load(file)
        for camera, solved in zip(written["camera"], report["cameras"]):
            self.assertAlmostEqual(camera["intrinsics"]["fx"], 553.0 * solved["focal_scale"], delta=1e-6)
            self.assertAlmostEqual(camera["intrinsics"]["fx"], 550.0, delta=max(1.0, 4 * 550 * solved["focal_sigma"]))
        found = written["helicopter"]["markers_m"]

        def misshape(balls):
            return sum((math.dist(balls[i], balls[j]) - math.dist(true[i], true[j])) ** 2
                       for i in range(5) for j in range(i))
        self.assertLess(misshape(found), 0.3 * misshape(told))
        text = run("calibrate", "rig", "--observations", rows, "--rig", self.path("in.toml"), "--out",
                   self.path("again.toml"), "--refine-markers", "0.001", "--refine-focal", "0.01").stdout
        self.assertIn("focal length of camera 1:", text)
        self.assertIn("points of the body: moved by", text)
        self.assertEqual(run("calibrate", "rig", "--observations", self.write_rows(light_rows(3.0)), "--rig",
                             self.path("in.toml"), "--out", self.path("light.toml"), "--refine-focal",
                             "0.01").returncode, 2)

    def test_bad_input(self):
        good = list(light_rows(3.0))
        header = "time_s,camera,u_px,v_px\n"
        cases = [("", 2), (header, 2), (header + "0,1,nan,3\n", 2), (header + "0,9,1,3\n", 2),
                 (header + "0,1,1\n", 2), ("time_s,camera,u_px\n0,1,1\n", 2), ("\0\0\0\n", 2)]
        for text, expected in cases:
            with self.subTest(text[-20:]):
                result = run("calibrate", "rig", "--observations", self.write("bad.csv", text), "--rig",
                             self.write("in.toml", RIG), "--out", self.path("bad.toml"))
                self.assertEqual(result.returncode, expected, result.stderr)
                self.assertIn("cure:", result.stderr)
                self.assertFalse(os.path.exists(self.path("bad.toml")))
        for scale in ("1,2", "1,2=0", "1,1=2", "1,9=2", "a=b", "1,2=nan"):
            with self.subTest(scale):
                result = run("calibrate", "rig", "--observations", self.write_rows(good), "--rig", self.path("in.toml"),
                             "--out", self.path("bad.toml"), "--scale", scale)
                self.assertEqual(result.returncode, 2, result.stderr)

    def test_bad_recordings_have_a_bad_verdict_and_write_nothing(self):
        good = list(light_rows(8.0))
        apart = [(t + 100 * (camera == 3), camera, u, v) for t, camera, u, v in good]
        few = good[:12]
        still = [(t, camera, *project(camera, (0.1, 0.1, 0.5))) for t, camera, _, _ in good]
        for name, rows in (("apart", apart), ("few", few), ("still", still)):
            with self.subTest(name):
                code, report = self.rig(self.write_rows(rows))
                self.assertEqual(code, 1, report)
                self.assertEqual(report["verdict"], "bad")
                self.assertTrue(report["reasons"])
                self.assertFalse(os.path.exists(self.path("out.toml")))


class RealRig(Calibrate):
    """github mprib/caliscope: four webcams and a board."""

    LIMITS = {"0": 1.25, "1": 2.05, "2": 1.79, "3": 1.45}

    def test_four_webcams(self):
        if not os.path.isdir(CALISCOPE):
            self.skipTest(f"SKIPPED: {CALISCOPE} is not there")
        with open(os.path.join(CALISCOPE, "camera_array.toml"), "rb") as file:
            cameras = tomllib.load(file)["cameras"].values()
        rig = "format_version = 1\n"
        for c in cameras:
            m = c["matrix"]
            rig += (f"[[camera]]\nid = {c['cam_id']}\nsize = {c['size']}\n[camera.intrinsics]\nfx = {m[0][0]}\n"
                    f"fy = {m[1][1]}\ncx = {m[0][2]}\ncy = {m[1][2]}\ndistortion = {c['distortions']}\n")
        with open(os.path.join(CALISCOPE, "calibration", "extrinsic", "CHARUCO", "xy_CHARUCO.csv"),
                  newline="", encoding="utf-8") as file:
            rows = [(r["sync_index"], r["cam_id"], r["img_loc_x"], r["img_loc_y"], r["keypoint_id"])
                    for r in csv.DictReader(file)]
        table = self.write_rows(rows, "time_s,camera,u_px,v_px,marker")
        for trust in ([], ["--trust-stamps"]):
            code, report = self.rig(table, *trust, rig=rig)
            self.assertEqual(code, 0, report)
            for camera in report["cameras"]:
                self.assertLessEqual(camera["reprojection_rms_px"], self.LIMITS[camera["id"]], camera)
                self.assertLessEqual(camera["rejected"], 0.01 * camera["observations"], camera)
            if trust:
                self.assertEqual({camera["late_s"] for camera in report["cameras"]}, {0.0})
            else:  # nothing triggered the second webcam: three quarters of a period of 1 s
                self.assertAlmostEqual(report["cameras"][1]["late_s"], -0.72, delta=0.1)
                self.assertLess(report["cameras"][1]["reprojection_rms_px"], 1.0)


class Intrinsics(Calibrate):
    def test_real_chessboards(self):
        images = {side: sorted(glob.glob(os.path.join(CHESSBOARDS, side + "[01]?.jpg"))) for side in ("left", "right")}
        if len(images["left"]) != 13:
            self.skipTest(f"SKIPPED: the Debian package opencv-doc is not installed ({CHESSBOARDS})")
        for side, limit in (("left", 0.196), ("right", 0.2075)):
            code, report = run_json("calibrate", "intrinsics", *images[side], "--board", "9x6", "--square", "0.025",
                                    "--out", self.path(side + ".toml"))
            self.assertEqual(code, 0, report)
            self.assertLessEqual(report["reprojection_rms_px"], limit)
            self.assertEqual(report["without_board"], [])
            self.assertAlmostEqual(report["fx"], 536, delta=6)

    def test_bad_input(self):
        gray = self.write("gray.pgm", "P2\n32 32\n255\n" + "128 " * 1024)
        cases = [["--board", "9by6", "--square", "0.02"], ["--board", "1x1", "--square", "0.02"],
                 ["--board", "9x6", "--square", "-1"], ["--board", "9x6", "--square", "0.02"],
                 ["--board", "5x4", "--square", "0.03", "--charuco", "DICT_1,0.02"],
                 ["--board", "5x4", "--square", "0.03", "--charuco", "DICT_4X4_50"],
                 ["--board", "5x4", "--square", "0.03", "--charuco", "DICT_4X4_50,0.04"]]
        for options in cases:
            with self.subTest(options):
                result = run("calibrate", "intrinsics", gray, *options, "--out", self.path("out.toml"))
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cure:", result.stderr)
        self.assertEqual(run("calibrate", "intrinsics", self.path("absent.png"), "--board", "9x6", "--square", "1",
                             "--out", self.path("out.toml")).returncode, 2)


class Convert(Calibrate):
    def convert(self, *arguments):
        return run("calibrate", "convert", *arguments)

    def test_there_and_back(self):
        rig = RIG.replace("cy = 239.5", "cy = 239.5\ndistortion = [-0.1, 0.02, 0.001, -0.002, 0.0]")
        rig += "[camera.pose]\nrotation_wxyz = [0.6, 0.0, 0.8, 0.0]\ntranslation_m = [1.0, 2.0, 3.0]\n"
        rig = rig.replace("\n[[camera]]\nid = 3", "[camera.pose]\nrotation_wxyz = [1.0, 0.0, 0.0, 0.0]\n"
                          "translation_m = [0.0, 0.0, 0.0]\n\n[[camera]]\nid = 3")
        original = self.write("rig.toml", rig)
        for to in ("opencv", "ros"):
            with self.subTest(to):
                result = self.convert(original, self.path("one.yaml"), "--to", to, "--camera", 2)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(self.convert(self.path("one.yaml"), self.path("back.toml")).returncode, 0)
                with open(self.path("back.toml"), "rb") as file:
                    back = tomllib.load(file)["camera"][0]
                self.assertEqual(back["intrinsics"], tomllib.loads(rig)["camera"][1]["intrinsics"])
        result = self.convert(original, self.path("chain.yaml"), "--to", "kalibr")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.convert(self.path("chain.yaml"), self.path("back.toml")).returncode, 0)
        with open(self.path("back.toml"), "rb") as file:
            self.assertEqual(len(tomllib.load(file)["camera"]), 3)

    def test_files_as_others_write_them(self):
        opencv = """%YAML:1.0
---
image_width: 640
image_height: 480
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,
       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [ -2.66e-01, -3.86e-02, 1.78e-03, -2.81e-04, 2.38e-01 ]
"""
        kalibr = """cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
cam1:
  T_cn_cnm1:
  - [0.999997, -0.002312, -0.000343, -0.110074]
  - [0.002317, 0.999898, 0.014090, 0.000399]
  - [0.000311, -0.014091, 0.999901, -0.000854]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, -0.0001, -3.5e-05]
  distortion_model: radtan
  intrinsics: [457.6, 456.1, 379.9, 255.2]
  resolution: [752, 480]
"""
        for text, count, fx in ((opencv, 1, 535.91573396163199), (kalibr, 2, 458.6)):
            result = self.convert(self.write("in.yaml", text), self.path("out.toml"))
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(self.path("out.toml"), "rb") as file:
                cameras = tomllib.load(file)["camera"]
            self.assertEqual(len(cameras), count)
            self.assertEqual(cameras[0]["intrinsics"]["fx"], fx)
        self.assertAlmostEqual(cameras[1]["pose"]["translation_m"][0], -0.110074)

    def test_bad_files(self):
        for text in ("", "a", "a: 1", "camera_matrix: [1, 2", "camera_matrix: {data: [1, 2, 3]}", "cam0:\n  camera_model: omni\n",
                     "[" * 200, "- " * 200, "K: [1, 0, 2, 0, 1, 2, 0, 0, 1]\nD: [0, 0]\n", "a: 1\na: 2\n",
                     "K: [nan, 0, 2, 0, 1, 2, 0, 0, 1]\nD: []\nwidth: 3\nheight: 4\n"):
            with self.subTest(text[:30]):
                result = self.convert(self.write("in.yaml", text), self.path("out.toml"))
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertIn("cure:", result.stderr)


if __name__ == "__main__":
    unittest.main(argv=["calibrate_test"])

"""Virtual cameras are real ones to other clients, and `helical fly` says what is wrong with cameras."""

import subprocess
import unittest

from helical_command import run, run_json
from virtual_rig import VirtualRig


def client(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


class OtherClients(unittest.TestCase):
    def test_arv_tool_reads_and_sets_features(self):
        with VirtualRig(1) as rig:
            address = rig.addresses[0]
            features = client("arv-tool-0.8", "-a", address, "features")
            for name in ("ExposureTime", "BalanceRatio", "TriggerMode", "PtpEnable", "ChunkEnable", "GevSCPSPacketSize"):
                self.assertIn(name, features.stdout)
            set_ = client("arv-tool-0.8", "-a", address, "control", "PixelFormat=BayerRG8", "ExposureTime=1500",
                          "Width=320", "OffsetX=64", "PixelFormat", "ExposureTime", "Width", "PayloadSize")
            for value in ("BayerRG8", "1500", "320", str(320 * 480)):
                self.assertIn(value, set_.stdout)
            refused = client("arv-tool-0.8", "-a", address, "control", "Width=1000")
            self.assertNotIn("Width = 1000", refused.stdout)

    def test_arv_camera_test_streams(self):
        with VirtualRig(2) as rig:
            streamed = client("arv-camera-test-0.8", "-n", rig.addresses[1], "-f", "30", "--duration", "3",
                              "-w", "320", "-h", "240", "-i", "8000", "--no-packet-socket")  # fits its small buffer
            self.assertEqual(streamed.returncode, 0, streamed.stderr)
            self.assertRegex(streamed.stdout, r"n_completed_buffers\s*=\s*[1-9]\d", streamed.stdout)
        self.assertGreater(rig.report["cameras"][1]["frames"], 10)


class Devices(unittest.TestCase):
    def test_lists_what_virtual_cameras_offer(self):
        with VirtualRig(7) as rig:
            code, report = run_json("devices")
            found = {camera["source"]: camera for camera in report["cameras"]}
            camera = found["aravis:" + rig.addresses[0]]
            self.assertEqual((code, camera["kind"], camera["owner"]), (0, "GigE Vision", "free"))
            self.assertEqual(camera["size"], [640, 480])
            self.assertIn("BayerRG8", camera["formats"])
            self.assertEqual(camera["rate_hz"], [1, 240])

    def test_doctor_finds_the_rigs_cameras_and_misses_them(self):
        with VirtualRig(8) as rig:
            checks = {check["check"]: check for check in run_json("doctor", "--rig", rig.file)[1]["checks"]}
            self.assertEqual(checks["Camera 2"]["verdict"], "good")
            self.assertIn("receive buffer", checks)
            for check in checks.values():
                self.assertEqual(check["verdict"] == "good", check["cure"] is None, check)
            file = rig.file
            rig.process.terminate()
            rig.process.wait(timeout=60)
            code, report = run_json("doctor", "--rig", file)
            self.assertEqual(code, 3)
            self.assertEqual([c["verdict"] for c in report["checks"] if c["check"] == "Camera 2"], ["bad"])


class BadInput(unittest.TestCase):
    def fails(self, code, says, *arguments):
        result = run(*arguments)
        self.assertEqual((result.returncode, result.stdout), (code, ""), result.stderr)
        for word in (says, "cure:"):
            self.assertIn(word, result.stderr)

    def test_camera_that_is_not_there(self):
        rig = VirtualRig(3)
        self.fails(3, rig.addresses[0], "fly", "--realtime", "--rig", rig.file)

    def test_what_the_camera_does_not_offer(self):
        with VirtualRig(4) as rig:
            for file, says in ((rig.write("format.toml", format='"Mono12"'), "BayerRG8"),
                               (rig.write("rate.toml", rate_hz="500.0"), "240")):
                self.fails(2, says, "fly", "--realtime", "--rig", file)

    def test_two_owners(self):
        with VirtualRig(5) as rig:
            self.fails(1, "address", "serve", "--rig", rig.file)

    def test_options_that_cannot_be(self):
        rig = VirtualRig(6)
        self.fails(2, "--realtime", "fly", "--rig", rig.file)
        self.fails(2, "--gust", "fly", "--realtime", "--gust", "2", "--rig", rig.file)
        self.fails(2, "2@8-11", "serve", "--mute", "2@8", "--rig", rig.file)
        self.fails(2, "there is no camera", "serve", "--mute", "9@8-11", "--rig", rig.file)
        self.fails(2, "0.01", "serve", "--loss", "2@8-11:7", "--rig", rig.file)


if __name__ == "__main__":
    unittest.main(argv=["serve_test"])

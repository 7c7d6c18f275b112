"""Two processes, closed loop, real time: cameras behind the real protocol, sticks back over loopback."""

import json
import unittest

from helical_command import run
from virtual_rig import VirtualRig


def fly(rig, *options):
    result = run("fly", "--realtime", "--json", "--rig", rig.file, "--duration", 14, *options)
    return result, json.loads(result.stdout)


class Flight(unittest.TestCase):
    def test_lands_on_three_cameras(self):
        with VirtualRig(11) as rig:
            result, report = fly(rig)
        self.assertEqual((result.returncode, report["outcome"]), (0, "landed"), result.stderr)
        for camera in report["cameras"]:
            # what this machine's load costs is the rig's doing, or a packet's that was asked for again
            self.assertLessEqual(camera["dropped"], 0.05 * camera["frames"])
        self.assertTrue(rig.report["flown"] and rig.report["at_rest"] and not rig.report["crashed"], rig.report)
        self.assertIsNone(report["touchdown_m_s"])  # nobody tells it the truth

    def test_flies_on_while_a_camera_is_away(self):
        with VirtualRig(12, "--mute", "2@6-8", "--loss", "1@0-99:0.01") as rig:
            result, report = fly(rig)
        self.assertEqual((result.returncode, report["outcome"]), (0, "landed"), result.stderr)
        self.assertEqual([camera["returns"] for camera in report["cameras"]], [0, 1, 0])
        self.assertGreater(report["cameras"][0]["resent_packets"], 0)
        self.assertFalse(rig.report["crashed"], rig.report)


if __name__ == "__main__":
    unittest.main(argv=["virtual_flight_test"])

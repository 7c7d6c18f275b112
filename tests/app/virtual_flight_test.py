"""Two processes, closed loop, real time: cameras behind the real protocol, sticks back over loopback."""

import json
import unittest

from helical_command import run
from virtual_rig import VirtualRig


def fly(rig, *options):
    result = run("fly", "--realtime", "--json", "--rig", rig.file, *options)
    return result, json.loads(result.stdout)


class Flight(unittest.TestCase):
    def test_lands_on_three_cameras(self):
        with VirtualRig(11) as rig:
            result, report = fly(rig, "--duration", 14)
        self.assertEqual((result.returncode, report["outcome"]), (0, "landed"), result.stderr)
        for camera in report["cameras"]:
            # what this machine's load costs is the rig's doing, or a packet's that was asked for again
            self.assertLessEqual(camera["dropped"], 0.05 * camera["frames"])
        self.assertTrue(rig.report["flown"] and rig.report["at_rest"] and not rig.report["crashed"], rig.report)
        self.assertGreater(report["transfer_us"]["p50"], 0)
        self.assertIsNone(report["touchdown_m_s"])  # nobody tells it the truth

    def test_flies_on_while_cameras_are_away(self):
        # Cable out, power off, another host: one camera after the other, and packets of the first get lost.
        with VirtualRig(12, "--mute", "2@5-8", "--reboot", "3@9-10", "--taken", "1@11.5-12.5",
                        "--loss", "1@0-11:0.01") as rig:
            result, report = fly(rig, "--duration", 20)
        self.assertEqual((result.returncode, report["outcome"]), (0, "landed"), result.stderr)
        for camera, away_s in zip(report["cameras"], (1, 3, 1)):
            self.assertGreaterEqual(camera["returns"], 1, report)
            self.assertGreater(camera["longest_gap_s"], away_s - 0.1)
        self.assertGreater(rig.report["cameras"][0]["resent_packets"], 0)
        self.assertFalse(rig.report["crashed"], rig.report)


if __name__ == "__main__":
    unittest.main(argv=["virtual_flight_test"])

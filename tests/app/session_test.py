"""Sessions: recorded, read by a stranger, cut off, mended, exported and replayed."""

import csv
import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import unittest

from helical_command import BINARY, WALL_CLOCK, run, run_json, without
from mcap_parser import McapFile, pose

FLIGHT = ("fly", "--no-images", "--seed", 7, "--calibrator", "joint")


def without_run(report):
    """What must be the same however and wherever the flight was recorded."""
    return without(report, *WALL_CLOCK, "session", "replay")


class Session(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = str(pathlib.Path(cls.folder.name) / "flight.mcap")
        cls.code, cls.report = run_json(*FLIGHT, "--session", cls.file)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def path(self, name):
        return str(pathlib.Path(self.folder.name) / name)

    def cut(self, name, share):
        content = pathlib.Path(self.file).read_bytes()
        pathlib.Path(self.path(name)).write_bytes(content[:int(share * len(content))])
        return self.path(name)

    def test_recording_does_not_change_the_flight(self):
        code, alone = run_json(*FLIGHT)
        self.assertEqual((self.code, self.report["session"], alone["session"]), (code, self.file, None))
        self.assertEqual(without_run(self.report), without_run(alone))

    def test_a_stranger_reads_every_message(self):
        file = McapFile(self.file)
        self.assertTrue(file.complete)
        self.assertLessEqual({"rig.toml", "plan.toml", "settings.json"}, set(file.attachments))
        self.assertEqual(json.loads(file.attachments["settings.json"])["calibrator"], "joint")
        types = dict(file.channels.values())
        self.assertEqual(types["/helicopter/pose"], "geometry_msgs/msg/PoseWithCovarianceStamped")
        self.assertEqual(types["/tf"], "tf2_msgs/msg/TFMessage")
        self.assertEqual(types["/events"], "rcl_interfaces/msg/Log")
        ticks = len(file.of("/flight/state"))
        self.assertEqual(ticks, len(file.of("/sticks")))
        for camera in self.report["cameras"]:
            self.assertEqual(len(file.of(f"/cameras/{camera['id']}/observation")), camera["frames"])
        truth = dict(file.of("/truth/pose"))
        errors = [max(abs(a - b) for a, b in zip(pose(tracked)[:3], pose(truth[time])[:3]))
                  for time, tracked in file.of("/helicopter/pose")]
        self.assertGreater(len(errors), 1000)
        self.assertLess(sorted(errors)[len(errors) // 2], 0.01)

    def test_tables_hold_the_same_numbers(self):
        result = run("export", self.file, "--format", "csv", "--out", self.path("tables"))
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(self.path("tables/helicopter_pose.csv"), newline="", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        recorded = McapFile(self.file).of("/helicopter/pose")
        self.assertEqual(len(rows), len(recorded))
        for row, (time, payload) in zip(rows, recorded):
            self.assertEqual(round(1e9 * float(row["time_s [s]"])), time)
            self.assertEqual(tuple(float(row[f"pose.pose.position.{axis} [m]"]) for axis in "xyz"), pose(payload)[:3])
        readme = pathlib.Path(self.path("tables/README.md")).read_text(encoding="utf-8")
        for file in result.stdout.split():
            if file.endswith(".csv"):
                self.assertIn(pathlib.Path(file).name, readme)

    def test_replay_is_the_same_bit_for_bit(self):
        code, report = run_json("replay", self.file)
        self.assertEqual((code, report["replay"]["bit_for_bit"], report["replay"]["changed"]), (0, True, False))
        self.assertEqual(report["replay"]["different_ticks"], 0)
        for field in ("outcome", "tracking", "control", "failsafes", "selected_features"):
            self.assertEqual(report[field], self.report[field])

    def test_replay_answers_what_would_have_been_known(self):
        code, report = run_json("replay", self.file, "--occlude", "1@10-12", "--occlude", "2@10-12",
                                "--calibrator", "ekf")
        self.assertEqual((code, report["replay"]["bit_for_bit"], report["replay"]["changed"]), (0, False, True))
        self.assertGreater(report["replay"]["different_ticks"], 100)
        self.assertEqual(report["cameras"][2]["calibration"]["method"], "ekf")

    def test_a_fork_without_changes_is_the_flight_that_was(self):
        code, report = run_json("replay", self.file, "--fork-at", 12)
        self.assertEqual((code, report["fork"]["different_before"]), (0, 0))
        self.assertEqual((report["fork"]["would_have_crashed"], report["fork"]["recorded_crashed"]), (False, False))
        for field in ("outcome", "duration_s", "tracking", "control", "failsafes"):
            self.assertEqual(report[field], self.report[field])

    def test_a_fork_flies_on_in_the_world_itself(self):
        blind = [part for camera in (1, 2, 3) for part in ("--occlude", f"{camera}@12-60")]
        code, report = run_json("replay", self.file, "--fork-at", 12, *blind)
        self.assertEqual(report["fork"]["different_before"], 0)
        self.assertEqual(code, 1 if report["fork"]["would_have_crashed"] else 0)
        self.assertNotEqual(report["failsafes"], [])
        self.assertGreater(report["tracking"]["lost_s"], 1.0)

    def test_a_pipe_that_nobody_reads_does_not_end_the_flight(self):
        pipe = self.path("pipe")
        os.mkfifo(pipe)
        with subprocess.Popen([BINARY, *map(str, FLIGHT), "--json", "--session", pipe], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as flight:
            with open(pipe, "rb") as reader:
                reader.read(100_000)  # beyond its head: before that the flight has not begun
            out, told = flight.communicate(timeout=600)
        self.assertEqual(flight.returncode, 0, told)
        self.assertEqual(without_run(json.loads(out)), without_run(self.report))
        self.assertIn("cut off", told)

    def test_a_cut_file_is_read_and_mended(self):
        cut = self.cut("cut.mcap", 0.6)
        before = McapFile(cut)
        self.assertFalse(before.complete)
        self.assertGreater(len(before.messages), 1000)
        self.assertEqual(run_json("replay", cut)[1]["replay"]["bit_for_bit"], True)
        self.assertEqual(run("recover", cut).returncode, 0)
        after = McapFile(cut)
        self.assertTrue(after.complete)
        # Topic by topic: events and the rest have chunks of their own, whose order is nobody's promise.
        self.assertEqual(*(sorted(file.messages, key=lambda message: message[0]) for file in (after, before)))
        self.assertEqual(after.attachments, before.attachments)
        self.assertIn("nothing to mend", run("recover", cut).stdout)

    def test_a_killed_flight_loses_the_last_moment_at_most(self):
        file = self.path("killed.mcap")
        with subprocess.Popen([BINARY, "fly", "--no-images", "--realtime", "--session", file],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as flight:
            while not has_ticks(file):
                self.assertIsNone(flight.poll())
            flight.send_signal(signal.SIGKILL)
        self.assertEqual(run("recover", file).returncode, 0)
        self.assertTrue(McapFile(file).complete)
        self.assertEqual(run_json("replay", file)[1]["replay"]["bit_for_bit"], True)

    def test_a_full_disk_does_not_end_the_flight(self):
        file = self.path("full.mcap")
        limited = subprocess.run([BINARY, *map(str, FLIGHT), "--json", "--session", file], capture_output=True,
                                 text=True, timeout=600, restore_signals=False, preexec_fn=lambda:
                                 resource.setrlimit(resource.RLIMIT_FSIZE, (300000, 300000)))
        self.assertEqual(limited.returncode, 0)
        self.assertEqual(without_run(json.loads(limited.stdout)), without_run(self.report))
        self.assertIn("cut off", limited.stderr)
        self.assertIn("cure:", limited.stderr)
        self.assertGreater(len(McapFile(file).messages), 100)
        self.assertEqual(run("recover", file).returncode, 0)

    def test_errors_name_the_file_and_the_cure(self):
        foreign = self.path("foreign.mcap")
        pathlib.Path(foreign).write_text("no session\n", encoding="utf-8")
        for command in (("replay", foreign), ("recover", foreign), ("replay", self.path("missing.mcap")),
                        ("export", foreign, "--format", "csv", "--out", self.path("no")),
                        ("fly", "--no-images", "--session", "/no/such/folder/a.mcap"),
                        ("export", self.file, "--format", "mp4", "--out", self.path("no")),
                        ("replay", self.file, "--calibrator", "nobody"),
                        ("replay", self.file, "--occlude", "9@1-2"),
                        ("replay", self.file, "--fork-at", "999"),
                        ("replay", self.file, "--fork-at", "12", "--occlude", "1@5-6")):
            result = run(*command)
            self.assertEqual(result.returncode, 2, command)
            self.assertIn("cure:", result.stderr, command)
            self.assertEqual(result.stdout, "", command)


def has_ticks(file):
    """While it is being written even the first bytes may be missing."""
    try:
        return os.path.exists(file) and bool(McapFile(file).of("/flight/state"))
    except AssertionError:
        return False


if __name__ == "__main__":
    unittest.main(argv=["session_test"], verbosity=2)

"""The two commands explain themselves from any folder, refuse what they do not know and share their package lists."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1)).resolve()


def run(*command):
    with tempfile.TemporaryDirectory() as elsewhere:
        return subprocess.run(command, cwd=elsewhere, capture_output=True, text=True, timeout=60)


class Scripts(unittest.TestCase):
    def test_help_is_on_stdout_and_does_nothing_else(self):
        for script in ("app/run", "tests/run"):
            for option in ("--help", "-h"):
                done = run(str(ROOT / script), option)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.startswith(f"Usage: {script}"))
                self.assertEqual(done.stderr, "")

    def test_unknown_option_of_the_tests_is_bad_usage(self):
        for options in (["--nonsense"], ["--label"]):
            done = run(str(ROOT / "tests/run"), *options)
            self.assertEqual(done.returncode, 2)
            self.assertIn("Usage: tests/run", done.stderr)

    def test_scripts_parse(self):
        for script in ("app/run", "app/setup.sh", "tests/run", ".ci/run"):
            self.assertEqual(run("bash", "-n", str(ROOT / script)).stderr, "")

    def test_a_failing_step_ends_the_script_and_shows_the_end_of_its_log(self):
        with tempfile.TemporaryDirectory() as root:
            done = run("bash", "-c", f"set -euo pipefail; root={root}; source {ROOT}/app/setup.sh; "
                       "quietly Good good echo '[1/1] fine'; quietly Bad bad bash -c 'echo the reason; exit 3'; echo on")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the reason", done.stderr)
        self.assertIn(f"{root}/build/logs/bad.log", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_a_package_is_not_installed_for_the_sake_of_a_command_that_is_there(self):
        with tempfile.TemporaryDirectory() as root:
            listed = pathlib.Path(root) / "packages.txt"
            listed.write_text("bash\nno-such-package=bash  # comes with bash\n", encoding="utf-8")
            done = run("bash", "-c", f"set -euo pipefail; root={root}; source {ROOT}/app/setup.sh; "
                       f"install_packages {listed}; echo on")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((done.stdout, done.stderr), ("on\n", ""))

    def test_no_package_is_listed_twice(self):
        names = []
        for listed in ("app/packages.txt", "tests/packages.txt"):
            for line in (ROOT / listed).read_text(encoding="utf-8").splitlines():
                names += line.split("#")[0].split()
        self.assertGreater(len(names), 10)
        self.assertEqual(len(names), len(set(names)))


if __name__ == "__main__":
    unittest.main()

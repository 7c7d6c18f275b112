"""What a desktop needs to know of Helical is valid and gets installed: launcher, AppStream metainfo, icon, manual page."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

BINARY = Path(sys.argv[1])
TREE = Path(sys.argv[2])
FOLDER = TREE / "resources/desktop"
NAME = "org.helical.GroundControl"


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Desktop(unittest.TestCase):
    def test_launcher(self):
        result = run("desktop-file-validate", FOLDER / f"{NAME}.desktop")
        self.assertEqual((result.returncode, result.stdout + result.stderr), (0, ""))

    def test_metainfo(self):
        result = run("appstreamcli", "validate", "--no-net", FOLDER / f"{NAME}.metainfo.xml")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_they_name_each_other(self):
        metainfo = xml.parse(FOLDER / f"{NAME}.metainfo.xml").getroot()
        self.assertEqual(metainfo.findtext("id"), NAME)
        self.assertEqual(metainfo.findtext("launchable"), f"{NAME}.desktop")
        launcher = (FOLDER / f"{NAME}.desktop").read_text()
        self.assertIn(f"Icon={NAME}\n", launcher)
        self.assertIn(f"Exec={metainfo.findtext('provides/binary')}\n", launcher)

    def test_icon(self):
        icon = xml.parse(FOLDER / f"{NAME}.svg").getroot()
        self.assertTrue(icon.tag.endswith("svg"))
        self.assertEqual(icon.get("width"), icon.get("height"))

    def test_manual_page(self):
        page = FOLDER / "helical.1"
        result = subprocess.run(["man", "--warnings", "--encoding=UTF-8", "-P", "cat", "-l", str(page)],
                                capture_output=True, text=True, check=False,
                                env={"LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80",
                                     "PATH": "/usr/local/bin:/usr/bin:/bin"})
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("Esc", result.stdout)


class Installed(unittest.TestCase):
    """What `cmake --install` puts under a prefix works there, and without the source tree."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.prefix = Path(cls.folder.name) / "usr"
        build = BINARY.parent.parent
        result = run("cmake", "--install", build, "--prefix", cls.prefix)
        if result.returncode != 0:
            raise RuntimeError(result.stdout + result.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_files_are_where_a_desktop_looks(self):
        for file in ("bin/helical", "bin/helical-output", "bin/helical-video.so", "lib/udev/rules.d/60-helical.rules",
                     "share/man/man1/helical.1", "share/helical/manual/manual.md", "share/helical/rigs/paper.toml", "share/helical/translations/helical_de.ts",
                     f"share/applications/{NAME}.desktop", f"share/metainfo/{NAME}.metainfo.xml",
                     f"share/icons/hicolor/scalable/apps/{NAME}.svg"):
            self.assertTrue((self.prefix / file).is_file(), file)

    def test_it_flies_from_there(self):
        environment = {key: value for key, value in os.environ.items() if key != "HELICAL_RESOURCES"}
        plan = self.prefix / "share/helical/plans/hover.toml"
        (plan.parent / "installed.toml").write_text(plan.read_text())  # a plan that the source tree lacks
        result = subprocess.run([self.prefix / "bin/helical", "fly", "--no-images", "--plan", "installed"],
                                capture_output=True, text=True, check=False, env=environment, cwd=self.folder.name)
        self.assertEqual(result.returncode, 0, result.stderr)


missing = [tool for tool in ("desktop-file-validate", "appstreamcli", "man") if shutil.which(tool) is None]
if missing:
    sys.exit(f"missing: {', '.join(missing)}; tests/packages.txt lists their packages")
unittest.main(argv=sys.argv[:1])

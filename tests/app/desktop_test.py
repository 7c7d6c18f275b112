"""What a desktop needs to know of Helical is valid: launcher, AppStream metainfo, icon, manual page."""
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

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


missing = [tool for tool in ("desktop-file-validate", "appstreamcli", "man") if shutil.which(tool) is None]
if missing:
    sys.exit(f"missing: {', '.join(missing)}; tests/packages.txt lists their packages")
unittest.main(argv=sys.argv[:1])

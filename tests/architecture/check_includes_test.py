"""Feeds check_includes.py small source trees, good and bad, and sees it tell them apart."""

import pathlib
import tempfile
import unittest

import check_includes

README = """
| folder | its job | may use |
|---|---|---|
| `base` | clock | the standard library |
| `geometry` | rotations | Eigen |
| `cameras` | frames | |
| `markers` | centroids | `cameras` |
| `pipeline` | threads | `all` |
"""

GOOD = {
    "engine/README.md": README,
    "engine/base/clock.h": "#include <cstdint>\n#include <sys/stat.h>\n",
    "engine/geometry/rotation.h": '#include <Eigen/Core>\n#include "engine/base/clock.h"\n',
    "engine/cameras/frame.h": '#include "engine/base/clock.h"\n',
    "engine/markers/extractor.h": '#include "engine/cameras/frame.h"\n',
    "engine/markers/extractor.cpp": '#include <opencv2/core.hpp>\n#include "engine/markers/extractor.h"\n',
    "engine/pipeline/engine.h": '#include "engine/markers/extractor.h"\n',
    "ui/window.h": '#include <QWidget>\n#include "engine/pipeline/engine.h"\n#include "ui/panel.h"\n',
    "ui/panel.h": '#include "engine/geometry/rotation.h"\n',
}


def problems(changed):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in {**GOOD, **changed}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        return check_includes.check(root)


class CheckIncludes(unittest.TestCase):
    def test_good_tree_has_no_problem(self):
        self.assertEqual(problems({}), [])

    def test_bad_trees_are_found_with_file_and_line(self):
        bad = {
            "a folder that may not be used": (
                "engine/cameras/frame.h", '#include <vector>\n#include "engine/markers/extractor.h"\n', 2),
            "base uses geometry": ("engine/base/clock.h", '#include "engine/geometry/rotation.h"\n', 1),
            "geometry uses cameras": ("engine/geometry/rotation.h", '#include "engine/cameras/frame.h"\n', 1),
            "Qt in a header": ("engine/markers/extractor.h", "#include <QImage>\n", 1),
            "Qt in a source": ("engine/markers/extractor.cpp", "\n#include <QtCore/QString>\n", 2),
            "OpenCV in a header": ("engine/markers/extractor.h", "#include <opencv2/core.hpp>\n", 1),
            "toml++ in a header": ("engine/base/clock.h", "#  include <toml++/toml.h>\n", 1),
            "path from the same folder": ("engine/markers/extractor.cpp", '#include "extractor.h"\n', 1),
            "engine uses ui": ("engine/pipeline/engine.h", '#include "ui/panel.h"\n', 1),
            "ui behind the facade": ("ui/panel.h", '#include "engine/markers/extractor.h"\n', 1),
        }
        for name, (path, text, line) in bad.items():
            with self.subTest(name):
                found = problems({path: text})
                self.assertTrue(found)
                self.assertTrue(all(p.startswith(f"{path}:{line}: ") for p in found), found)

    def test_folder_without_a_row_is_found(self):
        self.assertTrue(problems({"engine/extras/a.h": ""}))

    def test_cycle_in_the_table_is_found(self):
        table = README.replace("| frames | |", "| frames | `markers` |")
        self.assertTrue(any("through others" in p for p in problems({"engine/README.md": table})))


if __name__ == "__main__":
    unittest.main()

"""Checks every #include of the source tree against the rules of engine/README.md.

usage: check_includes.py SOURCE_TREE
The table of engine/README.md is the one place that says which folder may use which.
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
ROW = re.compile(r"^\| `(\w+)` \|[^|]*\|([^|]*)\|", re.MULTILINE)
QT = re.compile(r"^(Q[A-Z]\w*|Qt\w*|q[a-z]+plot\.h)(/|$)")
SUFFIXES = {".h", ".cpp"}

# What everything may use, and what an engine folder's headers may show of the world outside.
FOUNDATION = {"base", "geometry"}
HEADER_THIRD_PARTY = re.compile(r"^Eigen/")

# The engine as the window knows it: the facade and value types; and, while no engine runs, what the guided calibration
# of a transmitter tries its channels with.
UI_MAY_INCLUDE = re.compile(
    r"^(engine/pipeline/(calibration_order|engine|flight_view|snapshot|white_board)\.h"
    r"|engine/config/\w+\.h"
    r"|engine/flight/(controller_options|flight_change|flight_plan|flight_state)\.h"
    r"|engine/(base|geometry|helicopter)/\w+\.h"
    r"|engine/cameras/frame\.h"
    r"|engine/markers/(marker_options|observation)\.h"
    r"|engine/experiments/flight_trace\.h"
    r"|engine/session/(export_selection|film_writer|flight_playback|session_comparison|session_summary)\.h"
    r"|engine/tracking/track\.h"
    r"|engine/transmitter/(channel_measurement|direction_check|transmitter_options)\.h)$"
)

# Headers of the C++ standard library have no slash and no suffix; these are the C and POSIX ones we use.
C_HEADERS = re.compile(r"^(sys/\w+|fcntl|unistd|poll|pthread|sched|signal|time|errno|immintrin|x86intrin|cpuid)\.h$")


def allowed_folders(readme):
    """Folder to the set of folders it may include, itself and the foundation included."""
    allowed = {}
    for folder, uses in ROW.findall(readme):
        allowed[folder] = {folder} | set(re.findall(r"`(\w+)`", uses))
    every = set(allowed)
    for folder, uses in allowed.items():
        if "all" in uses:
            allowed[folder] = every
        elif folder == "base":
            allowed[folder] = {"base"}
        elif folder == "geometry":
            allowed[folder] = FOUNDATION
        else:
            allowed[folder] = uses | FOUNDATION
    return allowed


def is_third_party(header):
    return ("/" in header or header.endswith((".h", ".hpp"))) and not C_HEADERS.match(header)


def problems_of_engine(path, folder, header, quoted, allowed):
    if QT.match(header):
        yield "the engine never includes Qt"
    if not quoted:
        if path.suffix == ".h" and is_third_party(header) and not HEADER_THIRD_PARTY.match(header):
            yield "Eigen is the only third-party library that engine headers may include"
        return
    if not header.startswith("engine/"):
        yield "engine files include each other from the root, and nothing else"
        return
    used = header.split("/")[1]
    if used not in allowed.get(folder, set()):
        yield f"engine/{folder} may not use engine/{used}"


def problems_of_ui(header, quoted):
    if quoted and header.startswith("engine/") and not UI_MAY_INCLUDE.match(header):
        yield "ui knows the engine by its facade and value types only"
    if quoted and not header.startswith(("engine/", "ui/")):
        yield "ui files include each other from the root, and nothing else"


def problems_of_file(root, path, allowed):
    text = path.read_text(encoding="utf-8")
    where = path.relative_to(root)
    for match in INCLUDE.finditer(text):
        quoted, header = match.group(1) == '"', match.group(2)
        if where.parts[0] == "engine":
            found = problems_of_engine(path, where.parts[1], header, quoted, allowed)
        else:
            found = problems_of_ui(header, quoted)
        line = text.count("\n", 0, match.start(2)) + 1
        for problem in found:
            yield f"{where}:{line}: includes {header}: {problem}"


def cycles(allowed):
    """A folder that reaches itself through what others may use."""
    for start in allowed:
        seen, waiting = set(), list(allowed[start] - {start})
        while waiting:
            folder = waiting.pop()
            if folder == start:
                yield f"engine/README.md: {start} may use itself through others"
                break
            if folder not in seen:
                seen.add(folder)
                waiting += allowed.get(folder, set()) - {folder}


def check(root):
    readme = (root / "engine" / "README.md").read_text(encoding="utf-8")
    allowed = allowed_folders(readme)
    problems = list(cycles(allowed))
    for folder in sorted(p.name for p in (root / "engine").iterdir() if p.is_dir() and any(p.iterdir())):
        if folder not in allowed:
            problems.append(f"engine/{folder} is missing in the table of engine/README.md")
    for top in ("engine", "ui"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SUFFIXES:
                problems += problems_of_file(root, path, allowed)
    return problems


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    problems = check(root)
    print("\n".join(problems) if problems else "every include keeps to the rules")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()

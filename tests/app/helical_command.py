"""Runs the helical binary as a user's script would."""

import json
import os
import subprocess
import sys

BINARY = sys.argv[1] if len(sys.argv) > 1 else "helical"
SOURCE = sys.argv[2] if len(sys.argv) > 2 else "."


def run(*arguments, **environment):
    """Without a display, unless `environment` names one."""
    inherited = {k: v for k, v in os.environ.items()
                 if k not in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")}
    return subprocess.run([BINARY, *map(str, arguments)], capture_output=True, text=True, timeout=600,
                          env={**inherited, **environment})


def run_json(*arguments):
    """The one object on stdout; fails on anything else there."""
    result = run(*arguments, "--json")
    return result.returncode, json.loads(result.stdout)


WALL_CLOCK = ("simulated_over_wall", "server_us", "extraction_us")


def without(value, *fields):
    """A report without these fields, at any depth: what is left must repeat for a seed."""
    if isinstance(value, dict):
        return {k: without(v, *fields) for k, v in value.items() if k not in fields}
    if isinstance(value, list):
        return [without(v, *fields) for v in value]
    return value

"""`helical serve` in a process of its own, on loopback addresses that no other test has."""

import json
import os
import pathlib
import subprocess
import tempfile

from helical_command import BINARY, SOURCE


class VirtualRig:
    """`with VirtualRig(net, ...) as rig`: cameras on 127.8.NET.2 and so on, until the block ends."""

    def __init__(self, net, *options, **changes):
        self.options = [str(option) for option in options]
        self.addresses = [f"127.8.{net}.{camera + 2}" for camera in range(3)]
        text = (pathlib.Path(SOURCE) / "resources/rigs/virtual-gige.toml").read_text(encoding="utf-8")
        for camera, address in enumerate(self.addresses):
            text = text.replace(f'"aravis:127.0.0.{camera + 2}"', f'"aravis:{address}"')
        self.text = text.replace("127.0.0.1:5391", f"127.8.{net}.1:5391")
        self.folder = tempfile.TemporaryDirectory()
        self.file = self.write("rig.toml", **changes)
        self.report = None

    def write(self, name, **changes):
        """The rig with keys of every [camera.device] changed: format='"Mono8"'."""
        lines = []
        for line in self.text.splitlines():
            key = line.split(" = ")[0]
            lines.append(f"{key} = {changes[key]}" if key in changes else line)
        path = pathlib.Path(self.folder.name) / name
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return str(path)

    def __enter__(self):
        self.process = subprocess.Popen([BINARY, "serve", "--json", "--rig", self.file, *self.options],
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                        env={**os.environ, "LC_ALL": "C"})
        for line in self.process.stderr:
            if "sticks are taken" in line:
                break
        else:
            raise AssertionError("serve ended: " + self.process.stdout.read())
        return self

    def __exit__(self, *_):
        self.process.terminate()
        out, _ = self.process.communicate(timeout=60)
        self.report = json.loads(out) if out else None
        self.folder.cleanup()

"""Fails when a binary loads Qt 5: Debian's VTK and OpenCV bring it along if the wrong parts of them are linked."""

import subprocess
import sys


def main():
    loaded = subprocess.run(["ldd", sys.argv[1]], check=True, capture_output=True, text=True).stdout
    if "not found" in loaded:
        sys.exit(f"{sys.argv[1]} misses libraries:\n{loaded}")
    qt5 = [line.strip() for line in loaded.splitlines() if "libQt5" in line]
    if qt5:
        sys.exit(f"{sys.argv[1]} loads Qt 5:\n" + "\n".join(qt5))
    print(f"{len(loaded.splitlines())} libraries, none of them Qt 5")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Makes a wheel of the package that is built: for pip, in a virtual environment of the Python that it was built for.

    make_wheel.py BUILD_DIR OUT_DIR

Prints the path of the wheel. It holds all of HL that it needs; the libraries of Debian that HL uses (protobuf, OpenSSL,
TBB, assimp, ...) must be there, as scripts/deps installs them.
"""
import email
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

from wheel.wheelfile import WheelFile


def make(build: Path, out: Path) -> Path:
    metadata = (build / "python/METADATA").read_text(encoding="utf-8")
    version = email.message_from_string(metadata)["Version"]
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_")
    out.mkdir(parents=True, exist_ok=True)
    path = out / f"hl-{version}-{tag}-{tag}-{platform}.whl"
    info = f"hl-{version}.dist-info"
    with WheelFile(path, "w") as wheel, tempfile.TemporaryDirectory() as folder:
        for file in sorted((build / "python/hl").iterdir()):
            if file.suffix == ".so":
                stripped = Path(folder) / file.name
                subprocess.run(["strip", "--strip-unneeded", "-o", stripped, file], check=True)
                wheel.write(stripped, f"hl/{file.name}")
            elif file.is_file():
                wheel.write(file, f"hl/{file.name}")
        wheel.writestr(f"{info}/METADATA", metadata)
        wheel.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\nGenerator: make_wheel\nRoot-Is-Purelib: false\n"
                                        f"Tag: {tag}-{tag}-{platform}\n")
    return path


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    print(make(Path(sys.argv[1]), Path(sys.argv[2])))

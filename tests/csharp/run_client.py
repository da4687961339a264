#!/usr/bin/env python3
"""Runs one case of test_client.exe against an hld of its own.

    run_client.py MONO PROGRAM HLD CASE
"""
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "examples"))
from run_example import Server  # noqa: E402

TOKEN = "right-token-of-the-test"


def main(mono, program, hld, case):
    with tempfile.TemporaryDirectory() as folder:
        token = Path(folder, "token")
        token.write_text(TOKEN + "\n", encoding="utf-8")
        token.chmod(0o600)
        server = Server(hld, "", ["--explore", "off"] + (["--token-file", str(token)] if case.endswith("Token") else []))
        client = subprocess.Popen([mono, program, case, f"hl://{server.address}"], stdout=subprocess.PIPE, text=True)
        stopped = False
        for line in client.stdout:
            print(line, end="")
            if line == "open\n":
                server.stop()
                stopped = True
        code = client.wait()
        if not stopped:
            server.stop()
    return code


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

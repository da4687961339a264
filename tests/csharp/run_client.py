#!/usr/bin/env python3
"""Runs one case of test_client.exe against an hld of its own.

    run_client.py MONO PROGRAM HLD CASE
"""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "examples"))
from run_example import Server  # noqa: E402

TOKEN = "right-token-of-the-test"
# Mono's own waiting for sockets by poll() fails an assertion of its own now and then (threadpool-io-poll.c); by epoll it
# does not.
ENVIRONMENT = {**os.environ, "MONO_ENABLE_AIO": "1"}


def run(mono, program, hld, case):
    """0 when the case has come to its end. Not the exit code of Mono, which may fail an assertion of its own
    (mono-threads.c) when a program ends that has given up a connection."""
    with tempfile.TemporaryDirectory() as folder:
        token = Path(folder, "token")
        token.write_text(TOKEN + "\n", encoding="utf-8")
        token.chmod(0o600)
        server = Server(hld, "", ["--explore", "off"] + (["--token-file", str(token)] if case.endswith("Token") else []))
        client = subprocess.Popen([mono, program, case, f"hl://{server.address}"], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, env=ENVIRONMENT,
                                  cwd=folder)  # Mono writes its crashes there
        stopped = passed = False
        for line in client.stdout:
            print(line, end="")
            passed = passed or line == "passed\n"
            if line == "open\n":
                server.stop()
                stopped = True
        client.wait()
        if not stopped:
            server.stop()
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(run(*sys.argv[1:]))

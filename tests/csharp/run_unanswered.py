#!/usr/bin/env python3
"""A program that reaches a server which never answers says so in one line, and has failed.

    run_unanswered.py PROGRAM...: it is called with the URL and with how many seconds it may take
"""
import os
import socket
import subprocess
import sys


def main():
    with socket.create_server(("127.0.0.1", 0)) as silent:
        result = subprocess.run([*sys.argv[1:], f"hl://127.0.0.1:{silent.getsockname()[1]}", "1"], capture_output=True,
                                text=True, env={**os.environ, "MONO_ENABLE_AIO": "1"}, check=False)
    said = result.stderr.splitlines()
    print(result)
    return 0 if result.returncode == 1 and len(said) == 1 and "no server has answered within 1 s" in said[0] else 1


if __name__ == "__main__":
    sys.exit(main())

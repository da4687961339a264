#!/usr/bin/env python3
"""Runs an example and checks that it ends well and has printed what it should.

    run_example.py [--server HLD] [--folder FOLDER] --expect REGEX ... -- COMMAND...

In COMMAND the words URL, WS_URL, PAGE_URL and SECONDS are replaced. Without --server URL is inproc:; with it an hld is
started, whose simulated hand strokes whatever is there. How long something takes depends on the machine, so that the
example may go on for longer and longer until all of its lines have come; --until-lines ends it as soon as they have.
"""
import argparse
import os
import re
import signal
import subprocess
import sys
import threading

DURATIONS_S = [2, 8, 16, 64]


class Server:
    """A running hld on a free port; `address` is HOST:PORT."""

    def __init__(self, hld, folder, options=("--explore", "on")):
        command = [hld, "--port", "0", *options] + (["--page-dir", folder] if folder else [])
        self.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        for line in self.process.stderr:
            found = re.search(r"event=ready address=http://(\S+?)/", line)
            if found:
                self.address = found.group(1)
                break
        else:
            raise SystemExit("hld has not become ready")
        # Its log must go somewhere, or it stops when the pipe is full.
        threading.Thread(target=lambda: sys.stderr.writelines("hld: " + line for line in self.process.stderr), daemon=True).start()

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        if self.process.wait(60) != 0:
            raise SystemExit(f"hld has ended with code {self.process.returncode}")


def missing(expected, output):
    return [pattern for pattern in expected if not re.search(pattern, output, re.MULTILINE)]


def run_to_the_end(command, seconds):
    done = subprocess.run([str(seconds) if word == "SECONDS" else word for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=seconds + 300, check=False)
    if done.returncode != 0:
        raise SystemExit(f"exit code {done.returncode}:\n{done.stdout}")
    return done.stdout


def stop_group(process):
    """Ends the program and all that it has started."""
    os.killpg(process.pid, signal.SIGKILL)
    process.wait(60)


def run_until_lines(command, expected):
    """For programs without an end of their own, such as a browser."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
    watch = threading.Timer(sum(DURATIONS_S), stop_group, [process])
    watch.start()
    output = ""
    for line in process.stdout:
        output += line
        if not missing(expected, output):
            break
    watch.cancel()
    stop_group(process)
    return output


def check(arguments, command):
    if arguments.until_lines:
        output = run_until_lines(command, arguments.expect)
        lacking = missing(arguments.expect, output)
    else:
        for seconds in DURATIONS_S:
            output = run_to_the_end(command, seconds)
            lacking = missing(arguments.expect, output)
            if not lacking:
                break
    print(output)
    if lacking:
        raise SystemExit(f"not printed: {lacking}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--server", default="")
    parser.add_argument("--folder", default="")
    parser.add_argument("--expect", action="append", default=[])
    parser.add_argument("--until-lines", action="store_true")
    parser.add_argument("command", nargs="+")
    arguments = parser.parse_args()
    server = Server(arguments.server, arguments.folder) if arguments.server else None
    address = server.address if server else ""
    places = {"URL": f"hl://{address}" if server else "inproc:", "WS_URL": f"ws://{address}/hl",
              "PAGE_URL": f"http://{address}"}
    command = [re.sub(r"^(URL|WS_URL|PAGE_URL)(?=$|/)", lambda match: places[match.group(1)], word) for word in arguments.command]
    try:
        check(arguments, command)
    finally:
        if server:
            server.stop()


if __name__ == "__main__":
    main()

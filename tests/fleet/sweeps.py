"""What the tests of sweeps share: a folder with small paths, and the program as a user calls it."""
import math
import os
import re
import signal
import subprocess
import time
from pathlib import Path

PATIENCE_S = 120


def write_path(file, rows=100, deepest_m=0.03, way_m=0.02):
    """Down onto the top of a ball of radius 0.1 m, along it, and up again."""
    lines = ["t,x,y,z"]
    for i in range(rows):
        part = i / rows
        lines.append(f"{i * 1e-3:.3f},{way_m * math.cos(6 * part):.9f},0,{0.11 - deepest_m * math.sin(math.pi * part):.9f}")
    Path(file).write_text("\n".join(lines) + "\n", encoding="utf-8")


class Sweep:
    """A sweep's file, and calls of hl on it."""
    def __init__(self, hl, file, text):
        self.hl, self.file = str(hl), Path(file)
        self.file.write_text(text, encoding="utf-8")

    def command(self, *options):
        return [self.hl, "sweep", str(self.file), *map(str, options)]

    def call(self, *options, **more):
        return subprocess.run(self.command(*options), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              timeout=PATIENCE_S, check=False, **more)

    def run(self, *options):
        """The hash of its manifest."""
        done = self.call(*options)
        if done.returncode != 0:
            raise AssertionError(f"{options}: code {done.returncode}: {done.stdout}{done.stderr}")
        return manifest_hash(done.stdout)

    def start(self, *options):
        return subprocess.Popen(self.command(*options), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def kill_at(self, seconds, *options):
        """Ends the sweep, and with it its workers, `seconds` after its start. Whether it still ran."""
        process = self.start(*options)
        try:
            process.wait(timeout=seconds)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return True


def manifest_hash(text):
    return re.search(r"manifest: .* sha256 ([0-9a-f]{64})", text).group(1)


def workers_of(process):
    """The ids of a sweep's worker processes."""
    try:
        children = Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text(encoding="utf-8").split()
    except OSError:
        return []
    return [int(child) for child in children]


def kill_a_worker(process):
    """Waits for workers, and ends one."""
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end and process.poll() is None:
        for worker in workers_of(process):
            try:
                os.kill(worker, signal.SIGKILL)
                return True
            except ProcessLookupError:
                pass
    return False

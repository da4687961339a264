#!/usr/bin/env python3
"""A sweep by Slurm: a cluster of one node, of this machine, for this test alone, as whoever runs it. The manifest must be
that of the same sweep without Slurm.

    run_slurm.py HL

Prints why, and "skipped", where there is no Slurm. Whatever it has started has ended when it ends.
"""
import ctypes
import getpass
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from sweeps import Sweep, manifest_hash, write_path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo")
PATIENCE_S = 60
PR_SET_CHILD_SUBREAPER = 36
PATH = os.pathsep.join([os.environ["PATH"], "/usr/sbin", "/sbin"])

CONFIGURATION = """ClusterName=hl
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
PriorityType=priority/basic
ReturnToService=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES MaxTime=10
"""

SWEEP = """scenes = "sphere:2000"
paths = "path.csv"
seeds = {first = 1, count = 30}
[options]
tremor = 0.0005
radius = [0.001, 0.002]
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_until(what, holds):
    end = time.monotonic() + PATIENCE_S
    while not holds():
        if time.monotonic() > end:
            raise AssertionError(f"{what} has not come about within {PATIENCE_S} s")
        time.sleep(0.05)


class Cluster:
    """munged, slurmctld and slurmd in a folder."""
    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, "PATH": PATH, "SLURM_CONF": str(folder / "slurm.conf")}
        for name in ("state", "spool"):
            (folder / name).mkdir()
        self.configuration = folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(folder=folder, ports=free_ports(2), user=getpass.getuser()),
                                      encoding="utf-8")
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)

    def start(self, *command):
        with (self.folder / f"{command[0]}.log").open("wb") as log:
            subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=self.environment)

    def begin(self):
        self.start("munged", "--foreground", "--force", f"--key-file={self.folder}/munge.key",
                   f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                   f"--log-file={self.folder}/munged.own.log", f"--seed-file={self.folder}/munged.seed")
        wait_until("a socket of munged", (self.folder / "munge.socket").exists)
        self.start("slurmctld", "-D", "-c", "-f", self.configuration)
        self.start("slurmd", "-D", "-N", "localhost", "-f", self.configuration)
        wait_until("an idle node", lambda: self.ask("sinfo", "-h", "-o", "%T") == "idle")

    def ask(self, *command):
        done = subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                              check=False)
        return done.stdout.strip() if done.returncode == 0 else "no answer"

    def logs(self):
        return "".join(f"---- {file.name}\n{file.read_text(encoding='utf-8', errors='replace')[-2000:]}\n"
                       for file in sorted(self.folder.rglob("*.log")))


def end_all_children():
    """Also those that daemons have left: this process is the next parent of whatever it has brought about."""
    while True:
        children = Path(f"/proc/self/task/{os.getpid()}/children").read_text(encoding="utf-8").split()
        if not children:
            return
        for child in children:
            os.kill(int(child), signal.SIGKILL)
        for child in children:
            os.waitpid(int(child), 0)


def by_slurm(cluster, sweep):
    """The manifest's hash of a sweep that was begun and killed here, and ended by Slurm."""
    sweep.kill_at(0.15, "--jobs", 2)
    done = sweep.call("--slurm", "--parts", 4, "--slurm-options", "--time=5 --comment='two words'", env=cluster.environment)
    print(done.stdout + done.stderr, end="")
    if done.returncode != 0:
        raise AssertionError("it was not submitted")
    wait_until("an empty queue", lambda: cluster.ask("squeue", "-h") == "")
    last = done.stdout.split("then job ")[1].split()[0]
    return manifest_hash((sweep.file.with_suffix(".sweep") / "slurm" / f"{last}.log").read_text(encoding="utf-8"))


def run(hl, folder):
    cluster = Cluster(folder)
    try:
        cluster.begin()
        work = folder / "a folder"
        work.mkdir()
        write_path(work / "path.csv")
        sweep = Sweep(hl, work / "sweep.toml", SWEEP)
        with_slurm = by_slurm(cluster, sweep)
        without = sweep.run("--out", work / "without")
        print(f"by Slurm     {with_slurm}\nwithout it   {without}")
        return with_slurm == without
    except AssertionError:
        print(cluster.logs())
        raise
    finally:
        end_all_children()


def main():
    missing = [name for name in PROGRAMS if not shutil.which(name, path=PATH)]
    if missing:
        print(f"skipped: there is no {missing[0]} here (scripts/deps --test)")
        return 0
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    with tempfile.TemporaryDirectory(prefix="hl_slurm_") as folder:
        return 0 if run(Path(sys.argv[1]).resolve(), Path(folder)) else 1


if __name__ == "__main__":
    sys.exit(main())

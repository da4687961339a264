#!/usr/bin/env python3
"""hl sweep from the outside: the bits of hl trace, the same manifest however it was run, failures, and numpy.

    test_sweeps.py HL [unittest's arguments]
"""
import csv
import hashlib
import json
import os
import pty
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import numpy as np

from sweeps import PATIENCE_S, Sweep, kill_a_worker, workers_of, write_path

HL = Path(sys.argv.pop(1)).resolve()
EXAMPLE = Path(__file__).resolve().parent.parent.parent / "examples" / "sweeps" / "friction.toml"
SMALL = """scenes = ["sphere:2000", "ball.obj"]
paths = ["short.csv", "long.csv"]
seeds = [7, 8]
[options]
radius = [0.001, 0.002]
dynamic-friction = 0.3
tremor = 0.0005
"""
# A pyramid with its top where the ball has it.
BALL = "mtllib ball.mtl\nv -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


class Sweeps(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name)
        write_path(self.folder / "short.csv", 60)
        write_path(self.folder / "long.csv", 150)
        (self.folder / "ball.obj").write_text(BALL, encoding="utf-8")
        (self.folder / "ball.mtl").write_text("newmtl a\n", encoding="utf-8")

    def sweep(self, text=SMALL, name="sweep.toml"):
        return Sweep(HL, self.folder / name, text)

    def table(self, out="sweep.sweep"):
        return np.load(self.folder / out / "result.npz")

    def trace_of(self, words):
        """The CSV of one trace, without its last column, the time."""
        out = self.folder / "trace.csv"
        subprocess.run([HL, "trace", *words, "--out", out], check=True, cwd=self.folder, stderr=subprocess.DEVNULL)
        with out.open(encoding="utf-8") as rows:
            return np.array([[float(number) for number in row[:16]] for row in list(csv.reader(rows))[1:]])

    def test_rows_are_those_of_hl_trace(self):
        sweep = self.sweep("rows = true\n" + SMALL)
        sweep.run("--jobs", 2)
        table = self.table()
        lines = sweep.call("--dry-run").stdout.splitlines()[:-1]
        self.assertEqual(len(lines), 16)
        begins = table["row_begin"]
        for i, line in enumerate(lines):
            rows = slice(begins[i], begins[i + 1])
            kept = np.column_stack([table[name][rows] for name in (
                "t", "finger", "proxy", "target", "force", "contacts", "iterations", "row_injected_J")])
            trace = self.trace_of(line.split("hl trace ")[1].split())
            self.assertTrue(np.array_equal(kept, trace), line)
            depth = np.linalg.norm(trace[:, 4:7] - trace[:, 1:4], axis=1)
            touches = trace[:, 13] > 0
            self.assertGreater(np.count_nonzero(touches), 10)
            self.assertAlmostEqual(table["gap_max_m"][i], depth.max(), delta=1e-15)
            self.assertAlmostEqual(table["gap_mean_m"][i], depth[touches].mean(), delta=1e-12)
            self.assertEqual(table["contact_ticks"][i], np.count_nonzero(touches))

    def test_table_says_what_each_task_was(self):
        self.sweep().run()
        table = self.table()
        self.assertEqual(list(table["scene"][[0, -1]]), ["sphere:2000", "ball.obj"])
        self.assertEqual(list(table["path"][:8:4]), ["short.csv", "long.csv"])
        self.assertEqual(list(table["seed"][:4]), [7, 8, 7, 8])
        self.assertEqual(list(table["radius"][:4]), [0.001, 0.001, 0.002, 0.002])
        self.assertTrue((table["dynamic_friction"] == 0.3).all())
        self.assertEqual(table["ticks"].dtype, np.int64)
        self.assertEqual(list(table["ticks"][:8:4]), [60, 150])
        self.assertTrue((table["failure"] == "").all())
        ended = sum(table[name] for name in table.files if name.startswith("ended_"))
        self.assertTrue((ended == table["ticks"]).all())

    def test_options_that_are_not_given_everywhere(self):
        self.sweep('scenes = "sphere:2000"\npaths = "short.csv"\n[[options]]\nstiffness = [0.5, 1]\n'
                   '[[options]]\nledger = "strict"\n').run()
        table = self.table()
        np.testing.assert_array_equal(table["stiffness"], [0.5, 1, np.nan])
        self.assertEqual(list(table["ledger"]), ["", "", "strict"])
        self.assertEqual(list(table["seed"]), [-1, -1, -1])

    def test_manifest_is_the_same_for_any_number_of_jobs_and_any_place(self):
        sweep = self.sweep()
        hashes = {sweep.run("--jobs", jobs, "--out", self.folder / f"out{jobs}") for jobs in (1, 2, 8)}
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir()
        for name in ("short.csv", "long.csv", "ball.obj", "ball.mtl"):
            (elsewhere / name).write_bytes((self.folder / name).read_bytes())
        hashes.add(Sweep(HL, elsewhere / "other.toml", SMALL).run())
        self.assertEqual(len(hashes), 1)
        manifest = (self.folder / "out1" / "manifest.json").read_bytes()
        self.assertEqual(hashes, {hashlib.sha256(manifest).hexdigest()})
        told = json.loads(manifest)
        self.assertEqual(len(told["tasks"]), 16)
        self.assertEqual(told["tasks"][0]["options"]["radius"], "0.001")
        self.assertEqual((self.folder / "out1" / "result.npz").read_bytes(), (self.folder / "out8" / "result.npz").read_bytes())

    def test_what_is_done_is_not_done_again(self):
        sweep = self.sweep()
        sweep.run()
        results = sorted((self.folder / "sweep.sweep" / "results").rglob("*.result"))
        self.assertEqual(len(results), 16)
        times = [file.stat().st_mtime_ns for file in results]
        self.assertIn("0 tasks run", sweep.call().stderr)
        self.assertEqual([file.stat().st_mtime_ns for file in results], times)
        results[3].write_bytes(results[3].read_bytes()[:-1])  # no result any more
        self.assertIn("1 tasks run", sweep.call().stderr)
        with (self.folder / "ball.mtl").open("a", encoding="utf-8") as materials:  # the scene's file names it
            materials.write("# changed\n")
        self.assertIn("8 tasks run", sweep.call().stderr)
        self.sweep(SMALL.replace("[7, 8]", "[7, 8, 9]"))
        self.assertIn("8 tasks run", sweep.call().stderr)

    def test_killed_at_random_it_loses_nothing(self):
        text = SMALL.replace("[7, 8]", "{first = 1, count = 20}")
        undisturbed = self.sweep(text).run("--jobs", 2, "--out", self.folder / "undisturbed")
        sweep, draw = self.sweep(text), random.Random(1)
        for _ in range(4):
            sweep.kill_at(draw.uniform(0.02, 0.2), "--jobs", 2)
        self.assertEqual(sweep.run("--jobs", 2), undisturbed)
        self.assertEqual(list((self.folder / "sweep.sweep" / "results").rglob("*.part*")), [])

    def test_workers_die_with_the_sweep(self):
        write_path(self.folder / "long.csv", 200_000)
        process = self.sweep(SMALL.replace("2000", "200000")).start("--jobs", 2)
        workers = []
        while len(workers) < 2:
            workers = workers_of(process)
        process.send_signal(signal.SIGKILL)
        process.wait()
        end = time.monotonic() + PATIENCE_S
        while any(self.is_alive(worker) for worker in workers):
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)

    @staticmethod
    def is_alive(process):
        try:
            state = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0]
        except OSError:
            return False
        return state != "Z"  # its new parent may be one that never asks

    def test_a_killed_worker_is_one_failed_task_until_the_next_run(self):
        write_path(self.folder / "long.csv", 20_000)
        sweep = self.sweep()
        process = sweep.start("--jobs", 2)
        self.assertTrue(kill_a_worker(process))
        self.assertEqual(process.wait(timeout=PATIENCE_S), 1)
        told = sweep.call("--status").stdout
        self.assertIn("15 done, 1 failed, 0 left", told)
        failure = [text for text in self.table()["failure"] if text]
        self.assertEqual(len(failure), 1)
        self.assertTrue(failure[0].startswith("its process was ended by signal 9 (Killed)"), failure)
        self.assertEqual(np.count_nonzero(np.isnan(self.table()["force_max_N"])), 1)
        self.assertEqual(sweep.run(), sweep.run("--out", self.folder / "undisturbed"))

    def test_bad_inputs_fail_their_own_tasks_alone(self):
        (self.folder / "long.csv").write_text("t,x,y,z\n0,0,0,nan\n", encoding="utf-8")
        sweep = self.sweep()
        done = sweep.call("--jobs", 2)
        self.assertEqual(done.returncode, 1)
        self.assertIn("16 tasks: 8 done, 8 failed", done.stdout)
        self.assertIn("long.csv:2: a row must be finite numbers t,x,y,z", done.stderr)
        failures = json.loads((self.folder / "sweep.sweep" / "manifest.json").read_text(encoding="utf-8"))["tasks"]
        self.assertEqual({task.get("failure") for task in failures},
                         {None, "long.csv:2: a row must be finite numbers t,x,y,z"})
        write_path(self.folder / "long.csv", 150)
        self.assertEqual(sweep.run(), sweep.run("--out", self.folder / "good"))

    def test_no_result_is_of_files_that_were_changed_meanwhile(self):
        write_path(self.folder / "long.csv", 60_000)  # some time for each task
        names = ("short.csv", "ball.obj")             # they come after it
        text = ('scenes = ["sphere:2000", "ball.obj"]\npaths = ["long.csv", "short.csv"]\nseeds = [1, 2, 3, 4]\n'
                '[options]\ntremor = 0.0005\n')
        before = {name: (self.folder / name).read_bytes() for name in names}
        undisturbed = self.sweep(text).run("--out", self.folder / "undisturbed")
        process = self.sweep(text).start("--jobs", 1)
        while not workers_of(process):
            pass
        write_path(self.folder / "short.csv", 61)
        (self.folder / "ball.obj").write_text(BALL.replace("0.1\n", "0.11\n"), encoding="utf-8")
        self.assertEqual(process.wait(timeout=PATIENCE_S), 1)
        failures = {task["failure"] for task in json.loads((self.folder / "sweep.sweep" / "manifest.json").read_text(
            encoding="utf-8"))["tasks"] if "failure" in task}
        self.assertEqual(failures, {name + ": has been changed since the sweep began: run it again" for name in names})
        for name in names:
            (self.folder / name).write_bytes(before[name])
        self.assertEqual(self.sweep(text).run(), undisturbed)

    def test_parts_and_a_finish_are_the_whole(self):
        sweep = self.sweep()
        whole = sweep.run()
        parts = ["--out", self.folder / "parts"]
        for part in (2, 0):
            self.assertEqual(sweep.call("--part", f"{part}/3", *parts).returncode, 0)
        early = sweep.call("--finish", *parts)
        self.assertEqual(early.returncode, 2)
        self.assertIn("5 of 16 tasks are not done", early.stderr)
        self.assertIn("11 done, 0 failed, 5 left", sweep.call("--status", *parts).stdout)
        sweep.call("--part", "1/3", *parts)
        self.assertEqual(sweep.run("--finish", *parts), whole)

    def test_two_at_once_in_one_folder_do_no_harm(self):
        sweep = self.sweep(SMALL.replace("[7, 8]", "{first = 1, count = 8}"))
        whole = sweep.run("--out", self.folder / "whole")
        others = [sweep.start("--jobs", 2), sweep.start("--jobs", 1)]
        self.assertEqual([other.wait(timeout=PATIENCE_S) for other in others], [0, 0])
        self.assertEqual(sweep.run(), whole)
        self.assertEqual(list((self.folder / "sweep.sweep" / "results").rglob("*.part*")), [])

    def test_another_sweep_than_expected_is_refused(self):
        sweep = self.sweep()
        name = sweep.call("--dry-run").stdout.split()[-1]
        self.assertEqual(sweep.call("--expect", name, "--part", "0/16").returncode, 0)
        write_path(self.folder / "long.csv", 151)
        refused = sweep.call("--expect", name, "--part", "0/16")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("is another sweep here", refused.stderr)

    def test_bad_calls_are_one_line_and_code_two(self):
        sweep = self.sweep()
        broken = self.sweep('scenes = "teapot"\npaths = "short.csv"\n[options]\nstifness = 1\n', "broken.toml")
        beyond = self.sweep('scenes = "teapot"\npaths = "short.csv"\n[options]\nstiffness = [0.5,\n2]\n', "beyond.toml")
        missing = self.sweep('scenes = "teapot"\npaths = "none.csv"\n', "missing.toml")
        for call, said in (
                (broken.call(), "broken.toml:4: there is no 'stifness' in options: is 'stiffness' meant?"),
                (beyond.call(), "beyond.toml:5: --stiffness: '2' is not a number from 0 to 1"),
                (missing.call(), "none.csv: there is no such file"),
                (sweep.call("--jobs", 0), "--jobs"),
                (sweep.call("--part", "3/3"), "is not K/N"),
                (sweep.call("--part", "x"), "is not K/N"),
                (sweep.call("--status", "--dry-run"), "excludes"),
                (sweep.call("--parts", 3), "requires"),
                (sweep.call("--out", "/proc/none"), "/proc/none"),
                (Sweep(HL, self.folder / "gone.toml", "").call(), "gone.toml:1: there are no scenes")):
            self.assertEqual(call.returncode, 2, call)
            self.assertEqual(call.stdout, "", call)
            self.assertEqual(call.stderr.count("\n"), 1, call)
            self.assertIn(said, call.stderr)

    def test_progress_is_told_on_a_terminal(self):
        write_path(self.folder / "long.csv", 150_000)  # longer than the 0.2 s between two lines
        terminal, other = pty.openpty()
        done = subprocess.run(self.sweep().command("--jobs", 2), stdout=subprocess.DEVNULL, stderr=other, check=True)
        os.close(other)
        told = os.read(terminal, 100_000).decode()
        os.close(terminal)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(told, r"\r\d+ of 16 tasks, \S+ a second, \d+ s left")

    def test_the_example_can_be_run(self):
        done = subprocess.run([HL, "sweep", EXAMPLE, "--dry-run"], stdout=subprocess.PIPE, text=True, check=True)
        self.assertTrue(done.stdout.splitlines()[-1].startswith("1100 tasks; sweep "))

    def test_slurms_calls_can_be_looked_at(self):
        done = self.sweep().call("--slurm", "--dry-run", "--parts", 4, "--slurm-options", "--time=10")
        self.assertEqual(done.returncode, 0, done.stderr)
        array, last = done.stdout.splitlines()
        self.assertIn("'--array=0-3'", array)
        self.assertIn(" --time=10 ", array)
        self.assertIn("--dependency=afterany:ARRAY", last)
        self.assertFalse((self.folder / "sweep.sweep").exists())


if __name__ == "__main__":
    os.environ.pop("SLURM_JOB_ID", None)
    unittest.main()

"""hl.read_recording against `hl replay --csv`."""
import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import hl

HL = os.environ["HL_PROGRAM"]


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.file = Path(cls.folder.name) / "session.hlr"
        subprocess.run([HL, "record", "teapot", "--out", cls.file, "--duration", "2", "--port", "0", "--no-open"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def test_the_steps_are_those_of_hl_replay(self):
        table = Path(self.folder.name) / "steps.csv"
        subprocess.run([HL, "replay", self.file, "--csv", table], check=True, stdout=subprocess.DEVNULL)
        recording = hl.read_recording(self.file)
        with table.open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(recording.steps))
        for row, step in zip(rows, recording.steps):
            self.assertEqual(float(row["t"]), step["t"])
            for name in ("finger", "proxy", "force"):
                self.assertEqual([float(row[f"{name}_{axis}"]) for axis in "xyz"], step[name].tolist())
            self.assertEqual(row["state"], hl.STATES[step["state"]])
            self.assertEqual(int(row["touching"]), step["touching"])

    def test_what_it_says_of_itself(self):
        recording = hl.read_recording(self.file)
        self.assertEqual((recording.version, recording.damage, recording.black_box), (hl.__version__, "", False))
        self.assertGreater(recording.duration, 1.0)
        self.assertEqual(recording.servo_rate, 1000.0)
        self.assertGreater(len(recording.ticks), 1000)
        self.assertGreater(recording.ticks["contacts"].max(), 0)

    def test_a_file_that_is_cut_is_read_as_far_as_it_goes(self):
        cut = Path(self.folder.name) / "cut.hlr"
        whole = self.file.read_bytes()
        cut.write_bytes(whole[: len(whole) // 2])
        recording = hl.read_recording(cut)
        self.assertNotEqual(recording.damage, "")
        self.assertGreater(len(recording.steps), 0)

    def test_what_is_no_recording_is_refused(self):
        wrong = Path(self.folder.name) / "wrong.hlr"
        wrong.write_bytes(b"not a recording at all")
        for file in (wrong, Path(self.folder.name) / "missing.hlr"):
            with self.assertRaisesRegex(hl.InvalidValueError, file.name):
                hl.read_recording(file)


if __name__ == "__main__":
    unittest.main()

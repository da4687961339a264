"""hl.read_recording against `hl replay --csv`."""
import csv
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import hl
import numpy as np

HL = os.environ["HL_PROGRAM"]


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.file = Path(cls.folder.name) / "session.hlr"
        path = Path(cls.folder.name) / "path.csv"
        path.write_text("t,x,y,z,qw,qx,qy,qz,gripper_rad\n"
                        "0,0,0.1,0,1,0,0,0,0\n0.5,0,0,0,0.8,0,0.6,0,0.3\n9,0,0,0,0.8,0,0.6,0,0.3\n")
        subprocess.run([HL, "record", "teapot", "--out", cls.file, "--duration", "2", "--port", "0", "--no-open",
                        "--device", "sim:omega7", "--hand-path", path],
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
            self.assertEqual([float(row[f"stylus_q{part}"]) for part in "xyzw"], step["rotation"].tolist())
            self.assertEqual([float(row[f"spin_{axis}"]) for axis in "xyz"], step["spin"].tolist())
            self.assertEqual(float(row["gripper_rad"]), step["gripper"])

    def test_the_stylus_is_turned_as_the_path_says(self):
        steps = hl.read_recording(self.file).steps
        np.testing.assert_allclose(np.linalg.norm(steps["rotation"], axis=1), 1, atol=1e-12)
        np.testing.assert_allclose(np.abs(steps["rotation"][-1]), [0, 0.6, 0, 0.8], atol=2e-3)
        self.assertAlmostEqual(steps["gripper"][-1], 0.3, delta=2e-3)
        self.assertGreater(np.abs(steps["spin"]).max(), 1)

    def test_what_it_says_of_itself(self):
        recording = hl.read_recording(self.file)
        self.assertEqual((recording.version, recording.damage, recording.black_box), (hl.__version__, "", False))
        self.assertGreater(recording.duration, 1.0)
        self.assertEqual(recording.servo_rate, 1000.0)
        self.assertGreater(len(recording.ticks), 1000)
        self.assertGreater(recording.ticks["contacts"].max(), 0)

    def test_of_several_devices_each_has_a_file_with_its_name(self):
        file = Path(self.folder.name) / "hands.hlr"
        subprocess.run([HL, "record", "teapot", "--out", file, "--duration", "1", "--port", "0", "--no-open",
                        "--device", "sim", "--device", "pen=sim:touch"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        left, pen = (hl.read_recording(file.with_name(f"hands-{name}.hlr")) for name in ("left", "pen"))
        self.assertEqual((left.label, pen.label), ("left", "pen"))
        self.assertEqual(pen.device, "simulated 3D Systems Touch")
        self.assertEqual(hl.read_recording(self.file).label, "")

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

"""Each example in Python runs and draws a picture."""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["HL_SOURCE"])
# What each must print, to have done its work.
EXPECTED = {
    "01_a_force.py": "",
    "02_many_fingers.py": r"[1-9]\d+ of 65536 fingers touch",
    "03_friction.py": r"mu_d 0.4: drag / normal force = 0\.400000",
    "04_distances.py": "",
    "05_live.py": r"[1-9]\d+ states, largest force (0\.[1-9]|[1-9])",
    "06_a_recording.py": r"[1-9]\d{3} steps",
    "07_a_button.py": r"pressed by [1-4]\.\d+ mm, largest force [1-9]",
    "08_a_depth_camera.py": r"[1-9]\d+ states, largest force [1-9]",
}


class Examples(unittest.TestCase):
    def test_all_are_listed(self):
        self.assertEqual({file.name for file in (SOURCE / "examples/python").glob("*.py")}, set(EXPECTED))

    def test_each_runs_and_draws(self):
        with tempfile.TemporaryDirectory() as folder:
            session = Path(folder) / "session.hlr"
            subprocess.run([os.environ["HL_PROGRAM"], "record", "teapot", "--out", session, "--duration", "3", "--port", "0",
                            "--no-open"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            for name, expected in EXPECTED.items():
                with self.subTest(name):
                    picture = Path(folder) / f"{name}.png"
                    words = [session] if "recording" in name else []
                    done = subprocess.run([sys.executable, SOURCE / "examples/python" / name, picture, *words], text=True,
                                          check=False, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))
                    self.assertIsNotNone(re.search(expected, done.stdout), done.stdout)
                    self.assertGreater(picture.stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()

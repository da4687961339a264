"""The wheel in a new virtual environment, without a network."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE, BUILD = Path(os.environ["HL_SOURCE"]), Path(os.environ["PYTHONPATH"]).parent
PROGRAM = """
import hl
felt = hl.trace(hl.Scene("teapot", size=0.1), [[0, 0, 0.1, 0], [0.001, 0, 0, 0]])
print(hl.__file__, hl.__version__, felt.force[-1])
"""


class Wheel(unittest.TestCase):
    def test_it_installs_and_computes(self):
        environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
        with tempfile.TemporaryDirectory() as folder:
            def run(*command):
                done = subprocess.run(list(map(str, command)), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                      check=False, env=environment, cwd=folder)
                self.assertEqual(done.returncode, 0, done.stdout)
                return done.stdout

            wheel = run(sys.executable, SOURCE / "python/make_wheel.py", BUILD, folder).strip()
            # numpy is Debian's.
            run(sys.executable, "-m", "venv", "--system-site-packages", "venv")
            run("venv/bin/pip", "install", "--no-index", wheel)
            said = run("venv/bin/python", "-c", PROGRAM)
            self.assertIn(str(Path(folder) / "venv"), said)
            self.assertIn("hl", run("venv/bin/pip", "show", "hl"))


if __name__ == "__main__":
    unittest.main()

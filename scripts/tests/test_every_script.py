"""Every script runs from the state that a checkout leaves it in: says what it does, refuses what it does not know."""
import os
import subprocess
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def scripts():
    """The programs of scripts/ and bench/, those written in C++ not among them."""
    for folder in ("scripts", "bench"):
        for path in sorted((ROOT / folder).iterdir()):
            if path.is_file() and os.access(path, os.X_OK):
                yield path


def run(path, *words):
    return subprocess.run([path, *words], capture_output=True, text=True, cwd="/", timeout=120, check=False)


class EveryScript(unittest.TestCase):
    def test_says_what_it_does(self):
        for path in scripts():
            with self.subTest(path.name):
                done = run(path, "--help")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(path.name, done.stdout)

    def test_refuses_an_option_that_it_does_not_know(self):
        for path in scripts():
            if path.name == "run":  # its options are those of hl touch, which is built first
                continue
            with self.subTest(path.name):
                done = run(path, "--no-such-option")
                self.assertNotEqual(done.returncode, 0)
                self.assertNotIn("Traceback", done.stderr)
                self.assertTrue(done.stderr.strip())

    def test_is_found(self):
        self.assertGreater(len(list(scripts())), 12)


if __name__ == "__main__":
    unittest.main()

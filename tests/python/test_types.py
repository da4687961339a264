"""The types of the package: mypy --strict over it, and over the examples as its users write them."""
import os
import subprocess
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ["HL_SOURCE"])


class Types(unittest.TestCase):
    def check(self, *words):
        done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", os.devnull, *words], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]})
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_package_is_fully_typed(self):
        self.check("--strict", "--ignore-missing-imports", "-p", "hl")

    def test_examples_agree_with_them(self):
        self.check("--ignore-missing-imports", *map(str, sorted((SOURCE / "examples/python").glob("*.py"))))


if __name__ == "__main__":
    unittest.main()

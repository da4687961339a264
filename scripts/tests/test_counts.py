"""counts compares within 5 % either way, and knows new and vanished cases."""
import importlib.machinery
import importlib.util
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parent.parent / "counts"
LOADER = importlib.machinery.SourceFileLoader("counts", str(SCRIPT))
counts = importlib.util.module_from_spec(importlib.util.spec_from_loader("counts", LOADER))
LOADER.exec_module(counts)

CASE = ("plain", 1000)


class Counts(unittest.TestCase):
    def test_five_percent_either_way_is_the_same(self):
        for now in (951, 1000, 1049):
            self.assertEqual(counts.compare({CASE: 1000}, {CASE: now})[1], True, now)

    def test_more_and_less_are_reported_with_before_now_and_percent(self):
        for now, words in ((1060, "+6.0 %  SLOWER"), (900, "-10.0 %  better: keep it")):
            report, same = counts.compare({CASE: 1000}, {CASE: now})
            self.assertFalse(same)
            self.assertIn(f"1000 -> {now:>7} instructions a tick, {words}", " ".join(report))

    def test_new_and_vanished_cases_are_differences(self):
        self.assertFalse(counts.compare({}, {CASE: 1000})[1])
        self.assertFalse(counts.compare({CASE: 1000}, {})[1])

    def test_what_is_written_is_read(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "counts" / "ticks.csv"
            counts.write(path, {CASE: 1000})
            self.assertEqual(counts.read(path), {CASE: 1000})


if __name__ == "__main__":
    unittest.main()

"""suites runs the tests of a suite in one process and counts each, also those that a crash kept from being written."""
import stat
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import suites  # noqa: E402

# Stands for a program of GoogleTest: writes the report of two cases and ends with the code in $CODE.
PROGRAM = """#!/bin/sh
for word; do case "$word" in --gtest_output=xml:*) report="${word#--gtest_output=xml:}" ;; esac; done
echo "$*" >>"$CALLS"
if [ -z "$CRASH" ]; then echo '<testsuites><testcase name="a"/><testcase name="b"/></testsuites>' >"$report"; fi
exit "${CODE:-0}"
"""


def test_of(program, name, environment=()):
    return {"name": name, "command": [str(program), f"--gtest_filter={name}", "--more"],
            "properties": [{"name": "ENVIRONMENT", "value": list(environment)}]}


class Suites(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.calls = Path(folder.name) / "calls"
        self.program = Path(folder.name) / "program"
        self.program.write_text(PROGRAM)
        self.program.chmod(self.program.stat().st_mode | stat.S_IXUSR)

    def run_two(self, *environment):
        tests = [test_of(self.program, name, [f"CALLS={self.calls}", *environment]) for name in ("S.a", "S.b")]
        return suites.run_group(tests, 60)

    def test_a_suite_is_one_process(self):
        cases, printed = self.run_two()
        self.assertEqual(len(cases), 2)
        self.assertIsNone(printed)
        self.assertEqual(self.calls.read_text().count("\n"), 1)
        self.assertIn("--more --gtest_filter=S.a:S.b", self.calls.read_text())

    def test_a_crash_is_a_failure(self):
        for environment in (["CODE=139", "CRASH=1"], ["CODE=1"], ["CRASH=1"]):
            cases, printed = self.run_two(*environment)
            self.assertEqual(sum(case.find("failure") is not None for case in cases), 1)
            self.assertIsNotNone(printed)

    def test_what_is_no_google_test_is_judged_by_its_code(self):
        for code in (0, 3):
            script = {"name": "script", "command": ["sh", "-c", f"exit {code}"], "properties": []}
            cases, printed = suites.run_group([script], 60)
            self.assertEqual([case.find("failure") is not None for case in cases], [code != 0])
            self.assertEqual(printed is not None, code != 0)

    def test_groups_are_by_program_and_suite(self):
        other = {"name": "script", "command": ["sh", "x"], "properties": []}
        disabled = {**test_of("/p", "S.d"), "properties": [{"name": "DISABLED", "value": True}]}
        tests = [test_of("/p", "S.a"), other, test_of("/p", "S.b"), test_of("/q", "S.a"), test_of("/p", "All/T.x/0"), disabled]
        names = [[test["name"] for test in group] for group in suites.grouped(tests)]
        self.assertEqual(names, [["S.a", "S.b"], ["script"], ["S.a"], ["All/T.x/0"]])


if __name__ == "__main__":
    unittest.main()

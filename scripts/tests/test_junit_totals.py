"""junit_totals counts cases as passed, failed and skipped, whichever program wrote the report."""
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import junit_totals  # noqa: E402


class JunitTotals(unittest.TestCase):
    def totals(self, text):
        return junit_totals.totals(ElementTree.fromstring(text))

    def test_counts_the_cases_of_ctest(self):
        report = """<testsuite tests="4" failures="1"><testcase name="a" status="run"/>
          <testcase name="b" status="fail"><failure message=""/></testcase>
          <testcase name="c" status="notrun"><skipped message=""/></testcase>
          <testcase name="d" status="disabled"/></testsuite>"""
        self.assertEqual(self.totals(report), (1, 1, 2))

    def test_counts_nested_suites_and_errors(self):
        report = """<testsuites><testsuite><testcase name="a"/></testsuite>
          <testsuite><testcase name="b"><error/></testcase><testcase name="c"/></testsuite></testsuites>"""
        self.assertEqual(self.totals(report), (2, 1, 0))

    def test_what_a_failed_case_said_is_reported(self):
        report = """<testsuite><testcase name="good"><system-out>fine</system-out></testcase>
          <testcase name="bad"><failure message="Failed"/><system-out>one
          two</system-out></testcase></testsuite>"""
        [(name, lines)] = junit_totals.failures(ElementTree.fromstring(report), 2)
        self.assertEqual((name, [line.strip() for line in lines]), ("bad", ["one", "two"]))

    def test_an_unreadable_report_is_code_2(self):
        self.assertEqual(junit_totals.main(["/nonexistent.xml"]), 2)


if __name__ == "__main__":
    unittest.main()

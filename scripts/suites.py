#!/usr/bin/env python3
"""Runs tests that ctest knows, one process for each GoogleTest suite in place of one for each test.

    scripts/suites.py BUILD-DIR --label-regex REGEX [--exclude-regex REGEX] --output-junit REPORT.xml
                      [--timeout SECONDS] [--jobs 2]

A program with AddressSanitizer takes half a second to start: for a thousand short tests that is most of their time.
What is chosen, and each test's folder and environment, is what ctest says of it; other tests run as ctest runs them.
Prints at its end the output of each process that failed. Exit code 1 when a test failed, 2 when there is none.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

FILTER = "--gtest_filter="


def arguments_of(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build_dir")
    parser.add_argument("--label-regex", required=True)
    parser.add_argument("--exclude-regex", default="^$")
    parser.add_argument("--output-junit", required=True)
    parser.add_argument("--timeout", type=float, default=900, help="of one process, s")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args(words)


def chosen_tests(arguments):
    """The tests as ctest lists them: name, command and properties."""
    command = ["ctest", "--test-dir", arguments.build_dir, "--show-only=json-v1", "--label-regex", arguments.label_regex,
               "--exclude-regex", arguments.exclude_regex]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["tests"]


def split_command(test):
    """The command without its filter, and the filter; None for what is no test of GoogleTest."""
    command = test["command"]
    filters = [word.removeprefix(FILTER) for word in command if word.startswith(FILTER)]
    return tuple(word for word in command if not word.startswith(FILTER)), filters[0] if filters else None


def property_of(test, name, otherwise):
    return next((each["value"] for each in test["properties"] if each["name"] == name), otherwise)


def suite_of(test):
    name = split_command(test)[1]
    return name.split(".")[0] if name else test["name"]


def grouped(tests):
    """Lists of tests that one process runs: those of one suite of one program."""
    groups = {}
    for test in tests:
        if not property_of(test, "DISABLED", False):
            groups.setdefault((split_command(test)[0], suite_of(test)), []).append(test)
    # Long ones first, so that no processor waits for the last.
    return sorted(groups.values(), key=len, reverse=True)


def result(name, text=None):
    """One testcase of a JUnit report; failed with `text`."""
    case = ElementTree.Element("testcase", name=name)
    if text is not None:
        ElementTree.SubElement(case, "failure", message=text)
    return case


def cases_of(report, group, code):
    """The testcases that a process has written; one that failed for what it did not come to write."""
    if split_command(group[0])[1] is None:
        return [result(suite_of(group[0]), None if code == 0 else f"exit code {code}")]
    cases = list(ElementTree.parse(report).getroot().iter("testcase")) if report.exists() else []
    failed = any(case.find("failure") is not None for case in cases)
    if len(cases) != len(group) or (code != 0 and not failed):
        cases.append(result(suite_of(group[0]), f"exit code {code}, {len(cases)} of {len(group)} tests reported"))
    return cases


def run_group(group, timeout_s):
    """Runs the tests of one group; returns their testcases and, if one failed, what the process printed."""
    command, name = split_command(group[0])
    environment = dict(os.environ, **dict(each.split("=", 1) for each in property_of(group[0], "ENVIRONMENT", [])))
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.xml"
        words = list(command)
        if name:
            words += [FILTER + ":".join(split_command(test)[1] for test in group), f"--gtest_output=xml:{report}"]
        try:
            done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout_s, env=environment,
                                  cwd=property_of(group[0], "WORKING_DIRECTORY", None), text=True, errors="replace")
            code, printed = done.returncode, done.stdout
        except subprocess.TimeoutExpired as late:
            code, printed = f"none within {timeout_s} s", (late.stdout or b"").decode(errors="replace")
        cases = cases_of(report, group, code)
    failed = any(case.find("failure") is not None for case in cases)
    return cases, printed if failed else None


def main(words):
    arguments = arguments_of(words)
    groups = grouped(chosen_tests(arguments))
    if not groups:
        print("suites: no test is chosen", file=sys.stderr)
        return 2
    root, failures = ElementTree.Element("testsuite", name="suites"), []
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = pool.map(lambda group: run_group(group, arguments.timeout), groups)
        for done, (group, (cases, printed)) in enumerate(zip(groups, results), 1):
            root.extend(cases)
            print(f"{done}/{len(groups)} {suite_of(group[0])}: {len(cases)} tests", flush=True)
            if printed is not None:
                failures.append(f"{printed}\n{suite_of(group[0])} FAILED")
    ElementTree.ElementTree(root).write(arguments.output_junit)
    print(*failures, sep="\n")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

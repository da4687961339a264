"""check_names finds names that two sources of a folder give, in small trees made for the purpose, and nothing else."""
import sys
import unittest
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent.parent), str(Path(__file__).resolve().parent)]
import check_names  # noqa: E402
from small_tree import SmallTree  # noqa: E402


def source(private):
    return f"namespace hl {{\n\nnamespace {{\n\n{private}\n\n}}  // namespace\n\n}}  // namespace hl\n"


class CheckNames(SmallTree):
    def faults(self):
        return check_names.check(self.root)

    def pair(self, first, second):
        self.write("src/geometry/a.cpp", source(first))
        self.write("src/geometry/b.cpp", source(second))
        return self.faults()

    def test_a_constant_of_two_sources_is_one_fault_with_both_lines(self):
        self.assertEqual(self.pair("constexpr double kNear = 0.05;", "\nconst double kNear = 1e-6;"),
                         ["src/geometry/b.cpp:6: hl::kNear is in src/geometry/a.cpp:5 too"])

    def test_types_and_arrays_count(self):
        self.assertEqual(len(self.pair("struct Row {\n  int a;\n};", "using Row = int;")), 1)
        self.assertEqual(len(self.pair("constexpr int kAll[2] = {1, 2};", "constexpr std::array<int, 2> kAll{1, 2};")), 1)

    def test_functions_count_when_their_parameters_have_the_same_types(self):
        one = "double apart(const Vec3& a, double limit = 1) {\n  return 0;\n}"
        self.assertEqual(len(self.pair(one, "double apart(const Vec3& other,\n             double most) {\n}")), 1)
        self.assertEqual(self.pair(one, "double apart(const Quat& other, double most) {\n}"), [])

    def test_what_is_declared_ahead_or_within_a_function_is_not_given_twice(self):
        body = "int f(int a) {\n  constexpr int kHere = 1;\n  return kHere;\n}"
        self.assertEqual(self.pair("int f(int a);\n" + body, body.replace("f(int", "g(int")), [])

    def test_other_namespaces_and_other_folders_are_apart(self):
        self.write("src/geometry/a.cpp", source("constexpr int kOne = 1;"))
        self.write("src/geometry/b.cpp", source("constexpr int kOne = 1;").replace(" hl", " hl::other"))
        self.write("src/scene/a.cpp", source("constexpr int kOne = 1;"))
        self.assertEqual(self.faults(), [])

    def test_sources_that_include_themselves_are_left_out(self):
        vectors = '#include "hwy/foreach_target.h"\n' + source("constexpr int kOne = 1;")
        self.assertEqual(self.pair("constexpr int kOne = 1;", "") + self.faults(), [])
        self.write("src/geometry/b.cpp", vectors)
        self.assertEqual(self.faults(), [])

    def test_the_program_ends_with_code_1_on_a_fault(self):
        self.pair("constexpr int kOne = 1;", "constexpr int kOne = 1;")
        self.assertEqual(check_names.main([str(self.root)]), 1)


if __name__ == "__main__":
    unittest.main()

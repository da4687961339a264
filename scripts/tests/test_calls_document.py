"""docs/calls.md names every call of hl.h and no other, and only constants that there are."""
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


class CallsDocument(unittest.TestCase):
    def setUp(self):
        self.document = read("docs/calls.md")
        self.header = read("include/hl/hl.h")

    def declared(self):
        return set(re.findall(r"^HL_API [\w* ]*?\b(hl[A-Z]\w*)\(", self.header, re.MULTILINE))

    def test_the_header_is_understood(self):
        self.assertEqual(len(self.declared()), len(re.findall(r"^HL_API ", self.header, re.MULTILINE)))

    def test_every_call_is_listed_and_every_listed_call_exists(self):
        # hlProxy*, hlGet*v: families, not calls
        listed = set(re.findall(r"\bhl[A-Z]\w*\b(?!\*)", self.document))
        self.assertEqual(self.declared() - listed, set())
        self.assertEqual(listed - self.declared(), set())

    def test_every_constant_exists(self):
        constants = set(re.findall(r"\bHL_[A-Z0-9_]+\b", read("include/hl/hl_types.h")))
        self.assertEqual(set(re.findall(r"\bHL_[A-Z0-9_]+\b", self.document)) - constants, set())

    def test_no_two_constants_of_hl_have_the_same_number(self):
        numbers = re.findall(r"\bHL_\w+ = (0x48[0-9A-Fa-f]{3})\b", read("include/hl/hl_types.h"))
        self.assertGreater(len(numbers), 100)
        self.assertEqual([number for number in set(numbers) if numbers.count(number) > 1], [])


if __name__ == "__main__":
    unittest.main()

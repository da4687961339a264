"""The reference has every call, constant and type of the public headers, each with its text, and asks for nothing."""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
from reference_headers import read_headers, without_detail  # noqa: E402

INCLUDE = ROOT / "include/hl"


def source(name):
    return (INCLUDE / name).read_text(encoding="utf-8")


class Reference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder, "reference.html")
            subprocess.run([ROOT / "scripts/reference", "--out", out], check=True)
            cls.page = out.read_text(encoding="utf-8")
        cls.entries = [entry for header in read_headers(INCLUDE) for section in header.sections
                       for entry in section.entries]
        cls.names = [name for entry in cls.entries for name in entry.names]

    def test_every_call_is_in_it_once(self):
        declared = [name for file in ("hl.h", "hl_batch.h", "hl_teleop.h")
                    for name in re.findall(r"^(?:HL_API|static inline) [^;(]*?\b(hl[A-Z]\w*)\(", source(file), re.MULTILINE)]
        self.assertGreater(len(declared), 100)
        self.assertEqual(sorted(name for name in self.names if re.match(r"hl[A-Z]", name)), sorted(declared))

    def test_every_constant_and_type_is_in_it(self):
        types = source("hl_types.h") + source("hl_batch.h") + source("hl_teleop.h")
        constants = set(re.findall(r"\b(HL_\w+) =", types))
        self.assertGreater(len(constants), 100)
        named = set(re.findall(r"^typedef struct (\w+)", types, re.MULTILINE))
        self.assertEqual((constants | named) - set(self.names), set())

    def test_every_class_and_function_of_cpp_is_in_it(self):
        public = without_detail(source("hl.hpp"))
        declared = re.findall(r"^(?:(?:class|struct)(?: \[\[nodiscard\]\])?|concept) (\w+)", public, re.MULTILINE)
        functions = re.findall(r"^(?:inline )?\w[\w:<>, ]* (\w+)\(", public, re.MULTILINE)
        wanted = set(declared + functions)
        self.assertGreater(len(wanted), 15)
        self.assertEqual(wanted - set(self.names), set())

    def test_every_entry_has_code_and_text_and_a_place_of_its_own(self):
        for entry in self.entries:
            with self.subTest(entry.names[0]):
                self.assertTrue(entry.code.strip())
                self.assertTrue(entry.text.strip())
        places = re.findall(r'<article id="([^"]+)"', self.page)
        self.assertEqual(len(places), len(self.entries))
        self.assertEqual(len(places), len(set(places)))

    def test_its_links_lead_somewhere(self):
        places = set(re.findall(r'<article id="([^"]+)"', self.page))
        self.assertEqual(set(re.findall(r'href="#([^"]+)"', self.page)) - places, set())

    def test_it_asks_for_nothing(self):
        self.assertNotRegex(self.page, r"(?:src|href)=\"(?!#)|@import|url\(|fetch\(")


if __name__ == "__main__":
    unittest.main()

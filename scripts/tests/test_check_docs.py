"""check_docs finds long lines, dead links and names that HL does not have, and passes clean documents."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import check_docs  # noqa: E402


class CheckDocs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "docs").mkdir()
        (self.root / "README.md").write_text("[a page](docs/page.md#part)\n", encoding="utf-8")

    def write(self, text):
        (self.root / "docs/page.md").write_text(text, encoding="utf-8")
        return check_docs.check(self.root)

    def test_clean_documents_pass(self):
        self.assertEqual(self.write("x" * 120 + "\n[back](../README.md), [far](https://example.org/x)\n"), [])

    def test_a_long_line_is_named(self):
        self.assertEqual(self.write("short\n" + "long " * 25 + "\n"),
                         ["docs/page.md:2: 125 characters, and 120 are the most"])

    def test_a_header_of_a_csv_cannot_be_broken(self):
        self.assertEqual(self.write("```\n" + ",".join(["column"] * 20) + "\n```\n"), [])

    def test_a_link_that_leads_nowhere_is_named(self):
        self.assertEqual(self.write("![plot](figures/none.png)\n"), ["docs/page.md:1: figures/none.png does not exist"])

    def test_code_has_no_links(self):
        self.assertEqual(self.write("```\n[=](double t)\n```\n"), [])

    def test_a_call_or_constant_that_there_is_not_is_named(self):
        (self.root / "include/hl").mkdir(parents=True)
        (self.root / "include/hl/hl.h").write_text("void hlFlush(void); enum { HL_FORCE = 1 };\n", encoding="utf-8")
        self.assertEqual(self.write("`hlFlush` and `HL_FORCE`, families as `hlProxy*`\n"), [])
        self.assertEqual(self.write("`hlFlushed`\n`HL_POWER`\n"),
                         ["docs/page.md:1: hlFlushed is in no header of include/hl",
                          "docs/page.md:2: HL_POWER is in no header of include/hl"])

    def test_names_of_another_library_are_only_in_its_column(self):
        self.assertEqual(self.write("| OpenHaptics | HL |\n|---|---|\n| `hlEndFrame` | nothing |\n"), [])
        self.assertEqual(self.write("| OpenHaptics | HL |\n|---|---|\n| nothing | `hlEndFrame` |\n"),
                         ["docs/page.md:3: hlEndFrame is in no header of include/hl"])

    def test_a_variable_of_the_environment_is_in_the_sources(self):
        (self.root / "src").mkdir()
        (self.root / "src/token.cpp").write_text('getenv("HL_TOKEN")\n', encoding="utf-8")
        self.assertEqual(self.write("`HL_TOKEN`\n"), [])


if __name__ == "__main__":
    unittest.main()

"""tests/docs finds the blocks of a document, how each is tested, and commands and options that there are not."""
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/docs"))
import blocks  # noqa: E402
import commands  # noqa: E402


class Blocks(unittest.TestCase):
    def one(self, text):
        found = blocks.blocks_of(text, "page.md")
        self.assertEqual(len(found), 1)
        return found[0]

    def test_a_block_is_run_unless_the_line_before_says_otherwise(self):
        block = self.one("words\n```c\nint a;\n\nint b;\n```\nwords\n")
        self.assertEqual((block.where, block.kind, block.text, block.how), ("page.md:2", "c", "int a;\n\nint b;\n", "run"))

    def test_the_comment_before_it_says_how(self):
        for comment, how, argument in (("frame f.c", "frame", "f.c"), ("by Docs.Name", "by", "Docs.Name"),
                                       ("not run, it takes hours", "not run", "it takes hours")):
            block = self.one(f"<!-- test: {comment} -->\n```c\n```\n")
            self.assertEqual((block.how, block.argument), (how, argument))

    def test_mistakes_are_reported(self):
        for text in ("<!-- test: later -->\n```c\n```\n", "<!-- test: not run -->\n```c\n```\n", "```\nwords\n```\n",
                     "```cobol\n```\n", "```c\nint a;\n"):
            with self.assertRaises(SystemExit):
                blocks.blocks_of(text, "page.md")


class CommandsOfHl(unittest.TestCase):
    def setUp(self):
        self.commands = commands.Commands(ROOT, {"hl": "hl", "hld": "hld"})
        helps = {("hl", "touch"): "--port INT", ("hld",): "--config FILE"}
        self.commands.help_of = lambda *command: helps.get(command)

    def test_what_exists_passes(self):
        self.assertEqual(self.commands.faults_of("hl touch a.obj --port 1  # words\nhld --config \\\n  f && ls --all\n"
                                                 "scripts/test --style\ncmake --preset dev\nscripts/run --port 2\n"), [])

    def test_what_does_not_exist_is_named(self):
        for text, fault in (("hl fly", "there is no hl fly"), ("hl touch --fast", "hl has no option --fast"),
                            ("hl touch --por 1", "hl has no option --por"),
                            ("ls | hld --quick=1", "hld has no option --quick"), ("scripts/none", "there is no scripts/none"),
                            ("scripts/test --none", "scripts/test has no option --none"),
                            ("build/dev/bin/none", "there is no program none"),
                            ("cmake --preset none", "there is no preset none")):
            self.assertEqual(self.commands.faults_of(text), [fault])


if __name__ == "__main__":
    unittest.main()

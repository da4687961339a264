"""installed_links takes out links that lead nowhere, and leaves others, pictures and code as they are."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import installed_links  # noqa: E402

WRITTEN = """See [the calls](calls.md#limits), [`a.h`](../src/a.h), [one\nexample](../examples/1.c), [HL](https://hl.example).
![A picture](../src/a.png)

```c
f[0](x);
```
"""
READ = WRITTEN.replace("[`a.h`](../src/a.h)", "`a.h`")


class InstalledLinks(unittest.TestCase):
    def test_dead_links_become_their_words(self):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name in ("docs", "examples"):
                (root / name).mkdir()
            (root / "docs/calls.md").touch()
            (root / "examples/1.c").touch()
            (root / "docs/page.md").write_text(WRITTEN, encoding="utf-8")
            installed_links.main([folder])
            self.assertEqual((root / "docs/page.md").read_text(encoding="utf-8"), READ)


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Searches build/reference.html in a browser.

    search_reference.py CHROMIUM REFERENCE
"""
import re
import subprocess
import sys
import tempfile


def shown(chromium, reference, words):
    """Names of the entries that a search leaves."""
    with tempfile.TemporaryDirectory() as profile:
        page = subprocess.run([chromium, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
                               "--dump-dom", f"file://{reference}?q={words}"], stdout=subprocess.PIPE, text=True,
                              check=True).stdout
    articles = re.findall(r'<article id="([^"]+)"([^>]*)>', page)
    return [name for name, rest in articles if "hidden" not in rest], len(articles)


def main(chromium, reference):
    found, entries = shown(chromium, reference, "hlFlush")
    assert "hlFlush" in found and len(found) < entries, found
    found, _ = shown(chromium, reference, "texture+BUMP")
    assert "HL_STIFFNESS" in found and "hlFlush" not in found, found
    found, _ = shown(chromium, reference, "nosuchword")
    assert not found, found
    found, _ = shown(chromium, reference, "")
    assert len(found) == entries, found


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""usage: tests/docs_test.py
Whether the site of scripts/docs, without the headers, is whole: every link of every page leads to a file, and to a place in it, that is
there; every page is in the navigation. Skipped without pandoc."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[1]


class Page(HTMLParser):
    """The anchors of a page, and the links in it: of the navigation, and all others."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.in_navigation, self.navigation = set(), [], False, []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.in_navigation |= tag == "nav"
        self.anchors.add(attributes.get("id"))
        for link in filter(None, (attributes.get("href"), attributes.get("src"))):
            (self.navigation if self.in_navigation else self.links).append(link)

    def handle_endtag(self, tag):
        self.in_navigation &= tag != "nav"


def broken(pages):
    """What leads nowhere, of {path: Page}."""
    for path, page in pages.items():
        for link in page.links + page.navigation:
            file, _, anchor = unquote(link).partition("#")
            target = (path.parent / file).resolve() if file else path
            if "://" in link:
                continue
            if not target.is_file():
                yield f"{path.name}: {link}: no such file"
            elif anchor and anchor not in pages[target].anchors:
                yield f"{path.name}: {link}: no such place"


@unittest.skipUnless(shutil.which("pandoc"), "pandoc is not installed")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory())).resolve()
        subprocess.run([sys.executable, ROOT / "scripts" / "docs", "--pages-only", "-o", cls.folder], check=True, capture_output=True)
        cls.pages = {path: Page(path) for path in cls.folder.rglob("*.html")}

    def test_no_link_is_broken(self):
        self.assertEqual([], list(broken(self.pages)))

    def test_a_broken_link_would_be_seen(self):
        path = self.folder / "index.html"
        page = self.pages[path]
        page.links += ["nowhere.html", "files.html#nowhere"]
        self.addCleanup(page.links.__delitem__, slice(-2, None))
        self.assertEqual(["index.html: nowhere.html: no such file", "index.html: files.html#nowhere: no such place"],
                         list(broken({**self.pages, path: page})))

    def test_every_page_is_there_and_leads_to_all_others(self):
        wanted = {f"{page.stem}.html" for page in (ROOT / "docs").glob("*.md")} | {"index.html"}
        for name in wanted:
            self.assertEqual(wanted, set(self.pages[self.folder / name].navigation), name)


if __name__ == "__main__":
    unittest.main(verbosity=2)

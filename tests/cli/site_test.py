"""The pages as a web site: mkdocs has nothing to warn of, and every link and picture is there."""

import html.parser
import pathlib
import subprocess
import tempfile
import unittest
import urllib.parse

from pages import PAGES
from program import ROOT


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.targets, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.targets += [attributes[key] for key in ("href", "src") if attributes.get(key)]
        self.anchors.add(attributes.get("id"))


class Cases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.site = pathlib.Path(folder.name, "site")
        command = [ROOT / "scripts/site", cls.site]
        cls.result = subprocess.run(command, capture_output=True, text=True, timeout=280)

    def test_no_warnings(self):
        self.assertEqual((self.result.returncode, self.result.stdout, self.result.stderr), (0, "", ""))

    def test_every_page_is_there(self):
        for page in PAGES:
            name = page.relative_to(ROOT).with_suffix(".html")
            name = name.with_name("index.html") if name.stem == "README" else name
            self.assertTrue((self.site / name).is_file(), name)

    def test_links_lead_somewhere(self):
        pages = {path: Links(path.read_text(encoding="utf-8")) for path in self.site.glob("**/*.html")}
        for path, links in pages.items():
            for target in links.targets if path.name != "404.html" else []:
                parts = urllib.parse.urlsplit(target)
                if parts.scheme or target in (".", "..", "/"):
                    continue
                linked = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
                self.assertTrue(linked.exists(), f"{path.relative_to(self.site)}: {target}")
                if parts.fragment and linked in pages:
                    self.assertIn(parts.fragment, pages[linked].anchors, f"{path.relative_to(self.site)}: {target}")


if __name__ == "__main__":
    unittest.main()

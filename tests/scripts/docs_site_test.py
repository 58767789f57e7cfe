"""scripts/docs_site: where the links of a page lead, and which lead nowhere. What pandoc makes is written by hand."""

import importlib.machinery
import importlib.util
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("docs_site", str(ROOT / "scripts" / "docs_site"))
docs_site = importlib.util.module_from_spec(importlib.util.spec_from_loader("docs_site", LOADER))
LOADER.exec_module(docs_site)

PAGES = {"README.md", "docs/safety.md", "docs/actors/executor.md"}


class Links(unittest.TestCase):
    def moved(self, html, page="docs/actors/executor.md"):
        wanted = set()
        return docs_site.moved(html, page, PAGES, wanted), wanted

    def test_a_link_to_a_document_leads_to_its_page_and_heading(self):
        html, wanted = self.moved('<a href="../safety.md#people">')
        self.assertEqual(html, '<a href="../safety.html#people">')
        self.assertEqual(wanted, set())

    def test_what_is_no_document_comes_along_as_it_is(self):
        html, wanted = self.moved('<img src="../pictures/map.png"> <a href="../../config/godwit.json">')
        self.assertEqual(html, '<img src="../pictures/map.png"> <a href="../../config/godwit.json">')
        self.assertEqual(wanted, {"docs/pictures/map.png", "config/godwit.json"})

    def test_other_places_and_headings_of_the_same_page_stay(self):
        for link in ("https://px4.io/a.md", "mailto:a@b.c", "#above"):
            self.assertEqual(self.moved(f'<a href="{link}">'), (f'<a href="{link}">', set()))

    def test_links_that_lead_nowhere_are_found_with_their_page(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "a.html").write_text('<h1 id="top"></h1> <a href="b.html#there"> <a href="#top"> <a href="https://x">')
            (folder / "b.html").write_text('<h2 id="there"></h2> <a href="a.html#gone"> <a href="c.html"> <img src="d.png">')
            self.assertEqual(docs_site.broken_links(folder), ["b.html: a.html#gone", "b.html: c.html", "b.html: d.png"])

    def test_each_document_of_the_tree_becomes_a_page_and_people_start_with_the_readme(self):
        pages = docs_site.pages()
        self.assertEqual(pages[0], "README.md")
        self.assertIn("docs/actors/executor.md", pages)
        self.assertEqual(len(pages), len(set(pages)))
        for page in pages:
            self.assertIn(f'class="here" aria-current="page">', docs_site.navigation(page, {name: name for name in pages}))


if __name__ == "__main__":
    unittest.main()

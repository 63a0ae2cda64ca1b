"""Checks the links of a built site: every page, picture and place that one of its pages names has to be there."""

import html.parser
import urllib.parse


#: Schemes of addresses outside the site, and of bytes in a page.
ELSEWHERE = ("http", "https", "mailto", "data")


class Names(html.parser.HTMLParser):
    """The links of a page and the places in it."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        own = dict(attributes)
        for name in ("href", "src"):
            if own.get(name) and not (tag == "link" and own.get("rel") in ("canonical", "prev", "next")):
                self.links.append(own[name])
        for name in ("id", "name"):
            if own.get(name):
                self.places.add(own[name])


def broken(site):
    """Returns what no file or place of the site answers to: page, link."""
    pages = {path: Names(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    found = []
    for path, names in pages.items():
        if path == site / "404.html":
            continue
        for link in names.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ELSEWHERE or parts.netloc:
                continue
            target = path if not parts.path else (path.parent / urllib.parse.unquote(parts.path)).resolve()
            if target.is_dir():
                target = target / "index.html"
            place = urllib.parse.unquote(parts.fragment)
            if not target.is_file():
                found.append((path.relative_to(site).as_posix(), link))
            elif place and target in pages and place not in pages[target].places:
                found.append((path.relative_to(site).as_posix(), link))
    return found

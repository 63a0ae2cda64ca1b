"""Pages that the repository has already: their links lead to pages of the site, or to GitHub."""

import posixpath
import re

from . import BLOB, ROOT, write

#: Files of the repository and the pages that they become.
PAGES = {
    "BENCHMARKS.md": "benchmarks.md",
    "ARCHITECTURE.md": "architecture.md",
    "CONTRIBUTING.md": "contributing.md",
    "CHANGELOG.md": "changelog.md",
    "python/DATASETS.md": "datasets.md",
    "tests/geometry/reports/README.md": "reports.md",
    "tests/corpus/README.md": "corpus.md",
}
#: Sentences of the site that stand under the title of a page.
NOTES = {
    "reports.md": "Every row is a test of the repository, which runs at each change. A fault of geograd's own is a "
    "report, too: [write it](https://github.com/geograd/geograd/issues).\n",
}
#: Titles of pages that have none.
TITLES = {"corpus.md": "The corpus of planted faults"}
LINK = re.compile(r"(\]\()([^)\s]+)(\))")


def page(file):
    """Returns the text of a page, and its links as they are on the site."""
    text = (ROOT / file).read_text(encoding="utf-8")
    parts = re.split(r"(```.*?```)", text, flags=re.S)
    parts[::2] = [LINK.sub(lambda match: match[1] + moved(match[2], file) + match[3], part) for part in parts[::2]]
    # A block that Rust's documentation does not run is Rust all the same.
    return "".join(parts).replace("```ignore\n", "```rust\n")


def with_inputs(text):
    """Returns the page of reports, with a link to the inputs of each field as numbers."""
    module = (ROOT / "tests" / "geometry" / "reports" / "mod.rs").read_text(encoding="utf-8")
    for name, file in re.findall(r'\("([^"]+)", (\w+)::reports\(\)\)', module):
        link = f"[The inputs as numbers]({BLOB}tests/geometry/reports/{file}.rs)"
        head = f"\n## {name}\n"
        if head not in text:
            raise LookupError(f"the page of reports has no heading {name!r}")
        text = text.replace(head, f"{head}\n{link}\n")
    return text


def moved(target, file):
    """Returns where a link of a file leads on the site."""
    if re.match(r"[a-z]+:(?!:)|#", target):
        return target
    path, _, place = target.partition("#")
    own = posixpath.normpath(posixpath.join(posixpath.dirname(file), path))
    place = f"#{place}" if place else ""
    if own in PAGES:
        return PAGES[own] + place
    if "::" in own or not (ROOT / own).exists():
        # A path of Rust's documentation.
        return BLOB + posixpath.dirname(file)
    return BLOB + own + place


def make(pages):
    """Writes the pages."""
    for file, name in PAGES.items():
        text = page(file)
        if name == "reports.md":
            text = with_inputs(text)
        title = TITLES.get(name)
        if title:
            # Headings of the file are parts of the page.
            parts = re.split(r"(```.*?```)", text, flags=re.S)
            parts[::2] = [re.sub(r"^#", "##", part, flags=re.M) for part in parts[::2]]
            text = f"# {title}\n\n" + "".join(parts)
        head, _, rest = text.partition("\n\n")
        write(
            pages / name,
            f"{head}\n\n{NOTES.get(name, '')}\n{rest}\n\n---\n\n[The source of this page]({BLOB}{file})\n",
        )

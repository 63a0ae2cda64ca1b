"""Makers of pages: each writes its pages into the folder that the generator reads."""

import pathlib

#: The root of the repository.
ROOT = pathlib.Path(__file__).resolve().parents[3]
#: The folder of the site's sources.
DOCS = ROOT / "python" / "docs"
#: The address of a file of the repository.
BLOB = "https://github.com/geograd/geograd/blob/main/"


def write(path, text):
    """Writes a page; its folder is made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")

"""Draws the pictures of the gallery, and writes their page."""

import ast
import importlib
import sys
import warnings

from . import BLOB, DOCS, write

FOLDER = DOCS / "gallery"
ORDER = [
    "landscape",
    "descent",
    "own_function",
    "arm",
    "distance_field",
    "suppression",
    "scan",
    "losses",
    "enclosing",
    "kinks",
]
HEAD = """# Gallery

Scripts of the tree draw these pictures when this site is built, with calls of the package and Matplotlib.
"""


def said(name):
    """Returns the title and the text of a picture, of the head of its script."""
    title, _, text = ast.get_docstring(ast.parse((FOLDER / f"{name}.py").read_text(encoding="utf-8"))).partition(
        "\n\n"
    )
    return title, text


def drawn(name):
    """Returns a picture of the gallery."""
    if str(FOLDER) not in sys.path:
        sys.path.insert(0, str(FOLDER))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return importlib.import_module(name).draw()


def make(pages):
    """Writes all pictures and their page."""
    assert sorted(ORDER) == sorted(path.stem for path in FOLDER.glob("*.py") if path.stem != "style")
    (pages / "gallery").mkdir(parents=True, exist_ok=True)
    text = [HEAD]
    for name in ORDER:
        figure = drawn(name)
        # No date, so that the same tree draws the same bytes.
        figure.savefig(
            pages / "gallery" / f"{name}.svg", bbox_inches="tight", pad_inches=0.06, metadata={"Date": None}
        )
        title, words = said(name)
        text.append(
            f'## {title}\n\n<div class="picture" markdown>\n![{title}](gallery/{name}.svg)\n</div>\n\n{words}\n\n'
            f"[The script]({BLOB}python/docs/gallery/{name}.py)\n"
        )
    write(pages / "gallery.md", "\n".join(text))
    import matplotlib.pyplot as plt

    plt.close("all")

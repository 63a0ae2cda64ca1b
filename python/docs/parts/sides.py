"""Runs the pairs of calls on the pages "instead of", and puts their values below them.

A pair is two blocks of code after a comment such as `<!-- sides: shapely within 1e-12 -->`. Blocks before it are run
first, for both. The last line of a block is its value. A comment may record a value for builds without the library:
`says 1.5 (parry2d-f64 0.31.1)` is the library's, `right 1.5 (closed form)` an independent one.
"""

import ast
import contextlib
import importlib.util
import io
import re
from dataclasses import dataclass

import numpy as np

from . import DOCS, write

FOLDER = DOCS / "pages" / "instead"
PAIR = re.compile(
    r"<!-- sides: (?P<library>\w+) within (?P<within>[\d.e+-]+)"
    r"(?: (?P<how>says|right) (?P<number>.*?) \((?P<source>.*?)\))? -->\n"
    r"```(?P<language>\w+)\n(?P<theirs>.*?)```\n+```python\n(?P<ours>.*?)```\n",
    re.S,
)
BLOCK = re.compile(r"```python\n(.*?)```\n", re.S)


@dataclass
class Pair:
    """A call of another library and geograd's, with their values."""

    library: str
    within: float
    how: str
    source: str
    recorded: object
    theirs: object
    ours: object

    @property
    def difference(self):
        """The largest difference from the value on the left; None where there is none."""
        other = self.theirs if self.theirs is not None else self.recorded
        return (
            None
            if other is None
            else float(np.max(np.abs(np.asarray(self.ours, float) - np.asarray(other, float)), initial=0.0))
        )


def value(code, names):
    """Runs code, and returns the value of its last line."""
    tree = ast.parse(code)
    last = tree.body.pop()
    assert isinstance(last, ast.Expr), f"no value: {code}"
    with contextlib.redirect_stdout(io.StringIO()):
        exec(compile(tree, "page", "exec", dont_inherit=True), names)
        result = eval(compile(ast.Expression(last.value), "page", "eval", dont_inherit=True), names)
    if hasattr(result, "detach"):
        result = result.detach().numpy()
    return np.asarray(result.array if hasattr(result, "array") else result, float)


def needed(code):
    return re.findall(r"^(?:import|from) (\w+)", code, re.M)


def run(match, names):
    """Returns a pair with its values; `names` are those of the blocks before it."""
    theirs = None
    if match["language"] == "python" and all(map(importlib.util.find_spec, needed(match["theirs"]))):
        theirs = value(match["theirs"], dict(names))
    recorded = None if match["number"] is None else np.asarray(ast.literal_eval(match["number"]), float)
    ours = value(match["ours"], dict(names))
    return Pair(match["library"], float(match["within"]), match["how"], match["source"], recorded, theirs, ours)


def pairs(text):
    """Returns all pairs of a page, run, with the places of their text."""
    names, found, place = {}, [], 0
    for match in PAIR.finditer(text):
        for block in BLOCK.findall(text[place : match.start()]):
            exec(compile(block, "page", "exec", dont_inherit=True), names)
        found.append((match, run(match, names)))
        place = match.end()
    return found


def shown(x):
    """Returns numbers to six digits."""
    x = np.asarray(x, float)
    texts = [f"{0.0 if number == 0 else number:.6g}".replace("-", "−") for number in x.ravel()]
    return texts[0] if x.ndim == 0 else ", ".join(texts)


def said(pair):
    """Returns the line below a pair."""
    ours = f"geograd: **{shown(pair.ours)}**"
    apart = "the same bits" if pair.difference == 0 else f"apart by {pair.difference or 0:.0e}"
    if pair.theirs is not None:
        return f"{pair.library}: **{shown(pair.theirs)}** · {ours} · {apart}"
    if pair.how == "says":
        return f"{pair.library}: **{shown(pair.recorded)}** ({pair.source}) · {ours} · {apart}"
    if pair.how == "right":
        return f"{pair.library}: not run here · {ours} · right: **{shown(pair.recorded)}** ({pair.source})"
    return f"{pair.library}: not installed where this site was built · {ours}"


def page(text):
    """Returns a page with pairs side by side, and their values."""
    made, place = [], 0
    for match, pair in pairs(text):
        made += [
            text[place : match.start()],
            '<div class="sides" markdown>\n\n',
            f'```{match["language"]} title="{match["library"]}"\n{match["theirs"]}```\n\n',
            f'```python title="geograd"\n{match["ours"]}```\n\n</div>\n\n',
            f'<div class="values" markdown>\n{said(pair)}\n</div>\n',
        ]
        place = match.end()
    return "".join([*made, text[place:]])


def make(pages):
    """Writes the pages."""
    for path in sorted(FOLDER.glob("*.md")):
        text = page(path.read_text(encoding="utf-8"))
        # Two columns of code need the width.
        write(pages / "instead" / path.name, f"---\nhide: [toc]\n---\n\n{text}")

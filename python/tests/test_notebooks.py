"""Notebooks of the site run as scripts, without the libraries that build the site: one for each commit, or all.

`GEOGRAD_SHARE` is the name of a commit, which chooses the notebook; `GEOGRAD_ALL_ROWS=1` runs all of them.
"""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import pytest

pytest.importorskip("matplotlib")

FOLDER = pathlib.Path(__file__).parents[1] / "docs" / "notebooks"
NAMES = sorted(path.stem for path in FOLDER.glob("*.py"))


def libraries(text):
    """The packages that a notebook imports, also where it says so if one is missing."""
    return set(re.findall(r"^ *(?:import|from) (\w+)", text, re.M))


def chosen():
    """The notebooks of this run: those whose libraries are there, or one of them."""
    texts = {name: (FOLDER / f"{name}.py").read_text("utf-8") for name in NAMES}
    fit = [name for name, text in texts.items() if all(map(importlib.util.find_spec, libraries(text)))]
    share = os.environ.get("GEOGRAD_SHARE", "")
    if os.environ.get("GEOGRAD_ALL_ROWS") or not fit:
        return fit
    return [fit[int(share, 16) % len(fit)] if re.fullmatch("[0-9a-f]+", share) else fit[0]]


def test_there_are_notebooks_and_one_runs_everywhere():
    assert len(NAMES) >= 5 and "geograd" in libraries((FOLDER / "own_function.py").read_text("utf-8"))
    assert 1 <= len(chosen()) <= len(NAMES)


@pytest.mark.parametrize("name", chosen())
def test_a_notebook_runs(name):
    own = {**os.environ, "MPLBACKEND": "Agg", "MATPLOTLIBRC": str(FOLDER / "matplotlibrc")}
    done = subprocess.run([sys.executable, f"{name}.py"], cwd=FOLDER, env=own, capture_output=True, text=True, timeout=900)
    assert done.returncode == 0, done.stderr[-2000:]

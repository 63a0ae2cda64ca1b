"""Stubs, documentation and names, which are made of the table."""

import pathlib
import re
import subprocess
import sys

import pytest

import geograd
from geograd import _core

PYTHON = pathlib.Path(__file__).parents[1]


def test_stubs_are_those_of_the_table():
    done = subprocess.run([sys.executable, PYTHON / "stubs.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_every_verb_says_what_it_is():
    for verb in _core.verbs():
        call = getattr(geograd, verb)
        assert call.__name__ == verb and verb in geograd.__all__
        for row in _core.rows(verb):
            assert len(row["summary"]) > 15 and row["summary"].endswith("."), row["name"]
            assert row["summary"] in call.__doc__
            assert f"{verb}(" in call.__doc__
    for name, fields, _ in _core.shapes():
        if fields:
            assert all(field in getattr(geograd, name).__doc__ for field, _, _ in fields)


def test_names_are_there():
    assert set(geograd.__all__) <= set(dir(geograd))
    assert len(_core.verbs()) >= 55 and sum(len(_core.rows(verb)) for verb in _core.verbs()) >= 190


def test_no_other_library_is_imported():
    code = "import sys, geograd; print([x for x in ('torch', 'jax', 'shapely', 'pyarrow') if x in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"


@pytest.mark.parametrize("name", ["iou", "distance"])
def test_help(name):
    import pydoc

    assert "Rows:" in pydoc.render_doc(getattr(geograd, name))


def test_what_a_package_index_shows():
    package = pathlib.Path(geograd.__file__).parent
    assert (package / "py.typed").exists()
    # Relative links lead nowhere there.
    links = re.findall(r"\]\(([^)]*)\)", (PYTHON / "README.md").read_text())
    assert links and all(link.startswith(("https://", "#")) for link in links), links
    for name in ("LICENSE-MIT", "LICENSE-APACHE"):
        assert (PYTHON / name).read_text() == (PYTHON.parent / name).read_text()


def test_headlines_are_of_verbs_of_several_kinds():
    from geograd._headlines import HEADLINES

    for name, head in HEADLINES.items():
        text = getattr(geograd, name).__doc__
        assert text.startswith(head + "\n\nRows:\n") and len(text.splitlines()) > 6, name
    # A verb whose rows differ begins with a sentence on one of its kinds only where that is said of all.
    assert geograd.centroid.__doc__.splitlines()[0] == "The centre of the area, of the volume, or of points."

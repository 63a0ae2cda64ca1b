"""Python is level with Rust: every public function of the library has a name in Python or a reason why not (level.txt)."""

import pathlib
import re

import pytest

import geograd

HERE = pathlib.Path(__file__).parent
SOURCES = HERE.parents[1] / "src"


def functions():
    """The public functions of every file, methods included."""
    found = {}
    for file in sorted(SOURCES.rglob("*.rs")):
        names = set(re.findall(r"^\s*pub (?:const )?fn (\w+)", file.read_text(), re.MULTILINE))
        if names:
            found[file.relative_to(SOURCES).as_posix()] = names
    return found


def lines():
    """The lines of the table: file, functions, answer."""
    for line in (HERE / "level.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            file, names, answer = line.split(": ", 2)
            yield file, names.split(), answer


def unlisted(functions, lines):
    """The functions that no line names, and the lines that name what is not there."""
    left = {file: set(names) for file, names in functions.items()}
    wild, stale = set(), []
    for file, names, _ in lines:
        if file not in functions or (names != ["*"] and not set(names) <= functions[file]):
            stale.append((file, *names))
        elif names == ["*"]:
            wild.add(file)
        else:
            left[file] -= set(names)
    return {(file, name) for file, names in left.items() if file not in wild for name in names}, stale


@pytest.mark.skipif(not SOURCES.exists(), reason="the sources of the library are not beside the package")
def test_every_public_function_of_rust_has_a_name_or_a_reason():
    missing, stale = unlisted(functions(), list(lines()))
    assert not missing, f"add to level.txt, with a name in Python or a reason: {sorted(missing)}"
    assert not stale, f"remove from level.txt, which names what is not there: {stale}"


def test_a_function_without_a_line_is_found():
    own = {"a.rs": {"f", "g"}, "b.rs": {"h"}}
    table = [("a.rs", ["f"], "area"), ("c.rs", ["f"], "area"), ("b.rs", ["*"], "- inside"), ("a.rs", ["i"], "area")]
    assert unlisted(own, table) == ({("a.rs", "g")}, [("c.rs", "f"), ("a.rs", "i")])


def test_names_of_python_are_there():
    for file, names, answer in lines():
        if answer.startswith("- "):
            assert len(answer) > 5, f"{file} {names}: a reason is needed"
            continue
        for name in answer.split():
            own = geograd
            for part in name.split("."):
                assert hasattr(own, part), f"{file} {' '.join(names)}: geograd.{name} is not there"
                own = getattr(own, part)

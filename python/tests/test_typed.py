"""Type checkers in their strict modes: a user's script that they accept, and mistakes that they find."""

import functools
import importlib.util
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import pytest

import geograd

FOLDER = pathlib.Path(__file__).parent / "typed"
FILES = (FOLDER / "script.py", FOLDER / "every.py", FOLDER / "mistakes.py")
PACKAGE = pathlib.Path(geograd.__file__).parents[1]
STUBS = sorted(map(str, (PACKAGE / "geograd").glob("*.pyi")))
MISTAKES = [i for i, line in enumerate((FOLDER / "mistakes.py").read_text().splitlines(), 1) if line.endswith("# mistake")]

needs = [pytest.mark.skipif(importlib.util.find_spec(name) is None, reason=f"{name} is missing") for name in ("torch", "jax")]
pytestmark = [*needs, pytest.mark.slow]


@functools.lru_cache(maxsize=None)
def by_mypy():
    """Errors of both files, by file and line."""
    pytest.importorskip("mypy")
    # Imported modules count by their types, not by their code.
    options = ["--strict", "--follow-imports=silent", "--ignore-missing-imports", "--no-error-summary"]
    with tempfile.TemporaryDirectory() as cache:
        command = [sys.executable, "-m", "mypy", *options, "--cache-dir", cache, *map(str, FILES), *STUBS]
        done = subprocess.run(command, capture_output=True, text=True, timeout=900, cwd=PACKAGE)
    assert not done.stderr, done.stderr
    found = re.findall(r"([^/\\\n]+):(\d+): error: (.*)", done.stdout)
    return [(name, int(line), text) for name, line, text in found]


@functools.lru_cache(maxsize=None)
def by_pyright():
    pytest.importorskip("pyright")
    # The strict mode, but for what NumPy, torch and JAX leave open.
    of = ("MemberType", "VariableType", "ArgumentType", "ParameterType", "LambdaType")
    settings = {
        "include": [file.name for file in FILES],
        "strict": [file.name for file in FILES],
        "extraPaths": [str(PACKAGE)],
        **{f"reportUnknown{kind}": False for kind in of},
        "reportUnusedExpression": False,
        "reportMissingTypeStubs": False,
    }
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "pyrightconfig.json").write_text(json.dumps(settings))
        for file in FILES:
            shutil.copy(file, folder)
        command = [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable, "-p", folder]
        done = subprocess.run(command, capture_output=True, text=True, timeout=900)
    if not done.stdout.lstrip().startswith("{"):
        pytest.skip(f"pyright does not run here: {done.stderr[-200:]}")
    found = json.loads(done.stdout)
    assert found["summary"]["filesAnalyzed"] >= 3
    errors = [one for one in found["generalDiagnostics"] if one["severity"] == "error"]
    return [(pathlib.Path(one["file"]).name, one["range"]["start"]["line"] + 1, one["message"]) for one in errors]


CHECKERS = pytest.mark.parametrize("checker", [by_mypy, by_pyright], ids=["mypy", "pyright"])


# The script of every submodule imports an engine, of which pyright reads the types.
ENGINE = pytest.mark.skipif(importlib.util.find_spec("datafusion") is None, reason="datafusion is missing")


@CHECKERS
@pytest.mark.parametrize("name", ["script.py", pytest.param("every.py", marks=ENGINE)])
def test_a_script_is_accepted(checker, name):
    assert [one for one in checker() if one[0] == name] == []


@CHECKERS
def test_every_mistake_is_found(checker):
    assert len(MISTAKES) == 23
    assert sorted({line for name, line, _ in checker() if name == "mistakes.py"}) == MISTAKES


def test_stubs_have_no_errors_such_as_overloads_that_overlap():
    assert [one for one in by_mypy() if one[0].endswith(".pyi")] == []


def test_the_script_runs():
    done = subprocess.run([sys.executable, FOLDER / "script.py"], capture_output=True, text=True, timeout=300)
    if "No module named 'pyarrow'" in done.stderr or "No module named 'ray'" in done.stderr:
        pytest.skip("pyarrow is missing")
    assert done.returncode == 0 and done.stdout == "(2,) 4 (1,) torch.Size([])\nTrue True\n", done.stderr


def test_the_script_of_every_submodule_runs():
    done = subprocess.run([sys.executable, FOLDER / "every.py"], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr[-2000:]
    assert done.stdout == "(1,) torch.Size([1]) (1,)\ntorch.Size([]) True\n"


def test_scripts_use_every_submodule():
    package, text = PACKAGE / "geograd", "".join(file.read_text() for file in FILES)
    names = [path.stem for path in package.glob("*.py") if not path.stem.startswith("_")]
    assert len(names) >= 14 and [name for name in names if not re.search(rf"\bgeograd\.{name}\b|import .*\b{name}\b", text)] == []

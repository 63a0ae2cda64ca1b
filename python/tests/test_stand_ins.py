"""What the modules that stand in for other libraries have in common: names, documentation, types, imports."""

import importlib
import pathlib
import re
import subprocess
import sys

import pytest

import geograd

#: The modules, and what each needs to be imported.
MODULES = {
    "geoarrow": "pyarrow", "mmrotate": "torch", "shapely": "shapely", "supervision": "numpy", "torchvision": "torch",
    "ultralytics": "torch",
}
PACKAGE = pathlib.Path(geograd.__file__).parent
OWN = [*MODULES, "_angle_versions", "_outlines", "_recorded", "_tensors"]


@pytest.mark.parametrize("name", MODULES)
def test_every_name_is_there_and_documented(name):
    pytest.importorskip(MODULES[name], reason=f"{MODULES[name]} is not installed: geograd.{name} is not tested")
    module = importlib.import_module(f"geograd.{name}")
    assert module.__doc__.startswith(("Stands in for ", "Shapes ")) and ">>> " in module.__doc__
    assert list(module.__all__) == sorted(module.__all__)
    for own in module.__all__:
        # Classes of the library in question are made on demand.
        if own in vars(module):
            text = getattr(module, own).__doc__
            assert text and len(text.splitlines()[0]) <= 120, own
            if not isinstance(getattr(module, own), type):
                assert re.match(r"(Returns|Puts) ", text), own


def test_no_stand_in_is_imported_with_the_package():
    others = [name for name in OWN if name != "_outlines"]
    code = f"import sys, geograd; print([x for x in {others} if 'geograd.' + x in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_types_are_strict():
    pytest.importorskip("mypy", reason="mypy is not installed: types are not checked")
    modules = [part for name in OWN for part in ("-m", f"geograd.{name}")]
    options = ["--strict", "--follow-imports=silent", "--cache-dir", "/dev/null"]
    command = [sys.executable, "-m", "mypy", *options, *modules]
    done = subprocess.run(command, capture_output=True, text=True, cwd=PACKAGE.parent)
    assert re.search(r"Success|Found \d+ error", done.stdout), done.stdout + done.stderr
    files = tuple(str(pathlib.Path("geograd") / f"{name}.py") for name in OWN)
    assert not [line for line in done.stdout.splitlines() if line.startswith(files)]

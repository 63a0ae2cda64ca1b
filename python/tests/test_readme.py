"""The programs of README print what README says."""

import contextlib
import importlib.util
import io
import pathlib
import re

import numpy as np

import geograd

README = pathlib.Path(__file__).parents[1] / "README.md"
TEXT = README.read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```\n+```text\n(.*?)```", TEXT, re.S)


def test_every_program_has_an_output():
    assert len(BLOCKS) == TEXT.count("```python\n") >= 5


def test_readme_is_short():
    assert len(TEXT.split()) <= 700


def test_programs_print_what_readme_shows():
    # One after another: later ones use what earlier ones define.
    names, ran = {}, 0
    for code, shown in BLOCKS:
        needed = re.findall(r"^import (torch|jax)", code, re.M)
        if not all(importlib.util.find_spec(name) for name in needed):
            continue
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, str(README), "exec", dont_inherit=True), names)
        assert printed.getvalue() == shown
        ran += 1
    assert ran >= 4


def test_calls_of_the_table_exist():
    calls = set(re.findall(r"`[^`]*?geograd\.(?:torch\.)?(\w+)[.(]", TEXT))
    assert {"iou", "giou", "intersection_volume"} <= calls
    for name in calls - {"torch", "jax", "GIoULoss"}:
        assert hasattr(geograd, name), name


def test_calls_of_the_table_run():
    # The calls that need NumPy only, on arrays of their shapes.
    rng = np.random.default_rng(2)
    low = rng.uniform(0, 1, (4, 2))
    solid = np.concatenate([rng.uniform(1, 2, (4, 6)), np.tile([1.0, 0, 0, 0], (4, 1))], -1)
    boxes = {"Aabb2": np.concatenate([low, low + 1], -1), "Obb2": rng.uniform(1, 2, (4, 5)), "Obb3": solid}
    calls = [call for call in re.findall(r"\| `(geograd\.[^`]*\))`", TEXT) if "torch" not in call]
    assert len(calls) == 5
    for call in calls:
        kind = re.search(r'kind="(\w+)"', call)
        a = b = boxes[kind[1]] if kind else geograd.Obb2(boxes["Obb2"])
        result = eval(call, {"geograd": geograd, "a": a, "b": b, "points": low, "rings": [[(2, 0), (3, 0), (3, 1)]] * 4})
        assert result.shape == ((4, 4) if "all_pairs" in call else (4,)) and (result > 0).any(), call

"""Programs as JavaScript: what is written for rows and functions of one's own, and the bits that Node computes."""

import json
import shutil
import subprocess

import numpy as np
import pytest

import geograd


@geograd.function
def loss(a: geograd.Obb2, b: geograd.Obb2, weight: float):
    turn = geograd.arctan2(geograd.sin(a.heading - b.heading), geograd.cos(a.heading - b.heading))
    return geograd.log(2 - geograd.iou(a, b)) + weight * geograd.exp(-turn * turn)


def run(folder, module, name, inputs):
    """The results of a module for lists of numbers."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("SKIPPED: node is not installed, so no module of JavaScript was run")
    (folder / "module.mjs").write_text(module)
    (folder / "inputs.json").write_text(json.dumps(inputs.tolist()))
    script = (
        f"import {{ {name} as of }} from './module.mjs'; import {{ readFileSync }} from 'node:fs';"
        "const inputs = JSON.parse(readFileSync('inputs.json', 'utf8'));"
        "console.log(JSON.stringify(inputs.map((x) => of(x))));"
    )
    (folder / "run.mjs").write_text(script)
    ran = subprocess.run([node, "run.mjs"], cwd=folder, capture_output=True, text=True, check=True)
    return np.array(json.loads(ran.stdout), dtype=np.float64)


@pytest.mark.parametrize("form", ["value", "value_grad", "hessian"])
def test_a_function_of_ones_own_has_its_bits(tmp_path, boxes, form):
    a, b = boxes
    inputs = np.concatenate([a, b, np.linspace(-1, 1, len(a))[:, None]], 1)
    found = run(tmp_path, loss.javascript(form=form), "loss", inputs)
    program = loss.program_of(form)
    np.testing.assert_array_equal(found, [program.eval(list(x)) for x in inputs])
    if form == "value_grad":
        value, gradients = loss.value_grad(a, b, inputs[:, 10])
        np.testing.assert_array_equal(found[:, 0], value)
        np.testing.assert_array_equal(found[:, 1:6], gradients[0])


def test_a_row_has_its_bits(tmp_path, boxes):
    a, b = boxes
    module = geograd.giou.javascript(kind=("Obb2", "Obb2"), form="value_grad", name="score")
    found = run(tmp_path, module, "score", np.concatenate([a, b], 1))
    value, (by_a, by_b) = geograd.giou.value_grad(a, b, kind="Obb2")
    np.testing.assert_array_equal(found, np.concatenate([value[:, None], by_a, by_b], 1))


def test_32_bits_have_their_bits(tmp_path, boxes):
    a, b = boxes
    inputs = np.concatenate([a, b, np.linspace(-1, 1, len(a))[:, None]], 1).astype(np.float32)
    program = loss.program_of("value_grad", np.float32)
    found = run(tmp_path, program.javascript("single"), "single", inputs)
    np.testing.assert_array_equal(found, [program.eval(list(x)) for x in inputs])
    # Other numbers are rounded first.
    wide = inputs + 1e-9
    np.testing.assert_array_equal(run(tmp_path, program.javascript("single"), "single", wide), found)


#: Four of six corners, and their count.
POLYGON = np.array([0, 0, 3, 0, 3, 4, 0, 1, 0, 0, 0, 0, 4.0])


@pytest.mark.parametrize("double", [False, True])
def test_a_replay_of_a_search_has_its_bits(tmp_path, double):
    diagonal = geograd.diameter.replay(geograd.ConvexPolygon6(POLYGON), form="value_grad", double=double)
    dtype = np.float64 if double else np.float32
    near = np.array([POLYGON, POLYGON + 0.1 * (np.arange(13) < 8)])
    value, gradient = geograd.diameter.value_grad(near.astype(dtype), kind="ConvexPolygon6")
    expected = np.concatenate([value[:, None], gradient[:, :12]], 1)
    inputs = near[:, :12].astype(dtype)
    np.testing.assert_array_equal(run(tmp_path, diagonal.javascript("diagonal"), "diagonal", inputs), expected)
    assert "polygon.vertices[0].x" in diagonal.c("diagonal") and "void diagonal(" in diagonal.c_header("diagonal")
    assert "program_of_row" in diagonal.cuda("diagonal")
    # A straight line is its own replay.
    box = np.array([0.0, 0, 2, 1, 0.3])
    assert str(geograd.area.replay(box, kind="Obb2")) == str(geograd.area.program(kind="Obb2"))


def test_a_module_says_what_it_takes():
    module = geograd.iou.javascript(kind=("Obb2", "Obb2"))
    assert "export function iou(x) {" in module and "a.x, a.y, a.width, a.height, a.heading, b.x" in module
    assert "import" not in module
    assert "export function loss(x) {" in loss.javascript()
    assert "export function other(x) {" in loss.javascript("other")


def test_what_has_no_javascript_says_why():
    with pytest.raises(TypeError, match="reserved or not an identifier"):
        loss.javascript("let")
    with pytest.raises(TypeError, match="searches"):
        geograd.iou.javascript(kind=("ConvexPolygon5", "ConvexPolygon5"))
    with pytest.raises(TypeError, match="must name one row"):
        geograd.iou.javascript(kind=("Obb2", "Circle"))
    with pytest.raises(TypeError, match="a program for each record"):
        geograd.diameter.program(kind="ConvexPolygon6")
    with pytest.raises(TypeError, match="any length"):
        geograd.length.replay(geograd.Paths(np.zeros((3, 2)), [0, 3]))
    with pytest.raises(ValueError, match="of one item, not of 2"):
        geograd.diameter.replay(np.stack([POLYGON, POLYGON]), kind="ConvexPolygon6")
    with pytest.raises(ValueError, match="beyond the polygon's capacity"):
        geograd.diameter.replay(np.append(POLYGON[:12], 9.0), kind="ConvexPolygon6")


def test_the_functions_that_wgsl_calls_are_there():
    text = loss.wgsl()
    called = {word.split("(")[0] for word in text.split() if word.startswith("program_")}
    assert {"program_ln", "program_exp", "program_atan2"} <= called
    for name in called:
        assert f"fn {name}(" in geograd.WGSL
    # The largest number, whose shortest digits Chromium refuses.
    assert "3.4028235e38f" not in geograd.function(lambda x: geograd.minimum(x, 3.4028234663852886e38)).wgsl("least")

"""Columns of Arrow in and out, without copies; groups; the grouped join."""

import os
import subprocess
import sys

import numpy as np
import pytest

import geograd

pa = pytest.importorskip("pyarrow")
arrow = pytest.importorskip("geograd.arrow")

RNG = np.random.default_rng(3)
A = RNG.uniform(1, 3, (60, 5))
B = A + RNG.normal(0, 0.3, A.shape)


def lists(x, dtype=pa.float64(), name="element"):
    return pa.FixedSizeListArray.from_arrays(pa.array(x.reshape(-1), dtype), type=pa.list_(pa.field(name, dtype), x.shape[1]))


def address(numbers):
    return numbers.__array_interface__["data"][0]


@pytest.mark.parametrize("name", ["element", "item"])
def test_lists_are_lent_and_given_without_a_copy(name):
    column = lists(A, name=name)
    numbers = arrow.array(column, "Obb2")
    assert numbers.shape == (60, 5) and address(numbers) == column.flatten().buffers()[1].address
    part = arrow.array(column.slice(10, 20))
    assert address(part) == address(numbers) + 10 * 5 * 8
    value = geograd.iou(arrow.shapes(column, "Obb2"), geograd.Obb2(B))
    given = arrow.column(value)
    assert given.buffers()[1].address == address(value)
    rows = arrow.column(geograd.Obb2(B), element=name)
    assert rows.type == pa.list_(pa.field(name, pa.float64()), 5)
    assert rows.flatten().buffers()[1].address == address(np.ascontiguousarray(B))


def test_structs_by_the_names_of_fields():
    names = arrow._FIELDS["Obb2"]
    shuffled = [3, 0, 4, 1, 2]
    column = pa.StructArray.from_arrays([pa.array(A[:, k]) for k in shuffled], [names[k] for k in shuffled])
    np.testing.assert_array_equal(arrow.array(column, "Obb2"), A)
    back = arrow.column(geograd.Obb2(A), layout="struct")
    assert [back.type.field(k).name for k in range(5)] == names
    np.testing.assert_array_equal(arrow.array(back, "Obb2"), A)
    with pytest.raises(TypeError, match="no field heading"):
        arrow.array(pa.StructArray.from_arrays([pa.array(A[:, k]) for k in range(4)], names[:4]), "Obb2")
    table = pa.table({f"box.{name}": A[:, k] for k, name in enumerate(names)})
    np.testing.assert_array_equal(arrow.fields(table, "Obb2", "box.").array, A)
    with pytest.raises(KeyError, match="no column truth"):
        arrow.fields(table, "Obb2", "truth.")


def structs(x, dtype=np.float64):
    """A column of structs, fields in another order than the shape's."""
    names = arrow._FIELDS["Obb2"]
    order = [3, 0, 4, 1, 2]
    return pa.StructArray.from_arrays([pa.array(x[:, k].astype(dtype)) for k in order], [names[k] for k in order])


def test_structs_are_lent_field_by_field():
    column = structs(A)
    lent = arrow.shapes(column, "Obb2")
    for name in arrow._FIELDS["Obb2"]:
        assert address(getattr(lent, name)) == column.field(name).buffers()[1].address
    assert len(lent) == 60 and lent[3].width == A[3, 2] and "Obb2" in repr(lent)
    np.testing.assert_array_equal(lent.array, A)
    np.testing.assert_array_equal(arrow.shapes(column.slice(7, 20), "Obb2").array, A[7:27])
    table = pa.table({f"box.{name}": A[:, k].copy() for k, name in enumerate(arrow._FIELDS["Obb2"])})
    assert address(arrow.fields(table, "Obb2", "box.").y) == table["box.y"].chunk(0).buffers()[1].address

    # A struct that is null has numbers below it, which mean nothing; a number may be null, too.
    lanes = [column.field(k) for k in range(5)]
    null = pa.StructArray.from_arrays(lanes, fields=list(column.type), mask=pa.array(np.arange(60) == 17))
    lanes[2] = pa.array([None if k == 23 else 1.5 for k in range(60)])
    inner = pa.StructArray.from_arrays(lanes, [field.name for field in column.type])
    for form in (arrow.shapes, arrow.array):
        with pytest.raises(ValueError, match="`column` item 17: is null"):
            form(null, "Obb2")
        with pytest.raises(ValueError, match="`box` item 7: is null"):
            form(null.slice(10), "Obb2", "box")
        with pytest.raises(ValueError, match=f"`column.{inner.type.field(2).name}` item 23: is null"):
            form(inner, "Obb2")


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("count", [0, 1, 60, 5000])
def test_lent_fields_have_the_bits_of_rows(count, dtype):
    a, b = (np.resize(x, (count, 5)).astype(dtype) for x in (A, B))
    lent = [arrow.shapes(structs(x, dtype), "Obb2") for x in (a, b)]
    rows = [geograd.Obb2(x) for x in (a, b)]
    same = lambda x, y: np.testing.assert_array_equal(np.asarray(x), np.asarray(y), strict=True)
    same(geograd.iou(*lent), geograd.iou(*rows))
    same(geograd.iou(lent[0], rows[1]), geograd.iou(*rows))
    same(geograd.iou(rows[0], lent[1]), geograd.iou(*rows))
    for one in (b[:1], b[:1].reshape(-1)):
        if one.size:
            same(geograd.iou(lent[0], geograd.Obb2(one)), geograd.iou(rows[0], geograd.Obb2(one)))
    same(geograd.corners(lent[0]), geograd.corners(rows[0]))
    (value, by), (wanted, by_rows) = geograd.iou.value_grad(*lent), geograd.iou.value_grad(*rows)
    for own, other in zip((value, *by), (wanted, *by_rows)):
        same(own, other)
    bars = np.linspace(0, 1, count, dtype=dtype)
    for own, other in zip(geograd.iou.vjp(*lent, bars), geograd.iou.vjp(*rows, bars)):
        same(own, other)
    out = np.empty(count, dtype)
    assert geograd.iou(*lent, out=out) is out
    same(out, wanted)
    # Calls of two lists, and shapes of broadcasting.
    if count == 60:
        matrix = np.empty((60, 60), dtype)
        groups = ([0, 20, 20, 60], [0, 10, 30, 60])
        upstream = np.linspace(0, 1, 3600, dtype=dtype).reshape(60, 60)
        for x, y in (lent, (lent[0], rows[1]), (rows[0], lent[1])):
            same(geograd.iou.all_pairs(x, y), geograd.iou.all_pairs(*rows))
            same(geograd.iou.all_pairs(x, y, out=matrix), geograd.iou.all_pairs(*rows))
            for form in (
                lambda *of: geograd.iou.above(*of, 0.3), lambda *of: geograd.iou.above(*of, 0.3, groups=groups),
                geograd.iou.row_max, lambda *of: geograd.iou.column_max(*of, groups=groups),
                lambda *of: geograd.iou.all_pairs_vjp(*of, upstream), lambda *of: geograd.iou.sum_grad(*of)[1],
            ):
                for own, other in zip(form(x, y), form(*rows)):
                    same(own, other)
        scores = np.arange(60, dtype=dtype)
        same(geograd.iou.suppress(lent[0], scores, 0.2), geograd.iou.suppress(rows[0], scores, 0.2))
        same(geograd.iou(lent[0], geograd.Obb2(b[:, None])), geograd.iou(rows[0], geograd.Obb2(b[:, None])))
        with pytest.raises(ValueError, match="`b`"):
            geograd.iou(lent[0], geograd.Obb2(b[:7]))


NO_COPY = """
import re, sys
import numpy as np
import geograd
from geograd import _core
geograd.set_num_threads(1)
count, (form, layout) = 400_000, sys.argv[1:]
rng = np.random.default_rng(1)
lanes = [np.sort(rng.uniform(0, 1e6, count)), *(rng.uniform(1, 2, count) for _ in range(4))]
a = geograd.Obb2(_core.Columns(lanes) if layout == "apart" else np.stack(lanes, axis=-1))
b = a if form != "all_pairs" else geograd.Obb2(np.array([[1.0, 1, 2, 2, 0]]))
offsets, out = np.arange(0, count + 1, 50), np.zeros(count)
calls = {
    "items": lambda: geograd.iou(a, b),
    "out": lambda: geograd.iou(a, b, out=out),
    "all_pairs": lambda: geograd.iou.all_pairs(a, b),
    "above": lambda: geograd.iou.above(a, b, 0.999),
    "groups": lambda: geograd.iou.above(a, b, 0.9, groups=(offsets, offsets)),
    "row_max": lambda: geograd.iou.row_max(a, b, groups=(offsets, offsets)),
}
status = lambda name: int(re.search(name + r":\\s+(\\d+)", open("/proc/self/status").read())[1]) / 1024
geograd.iou(geograd.Obb2(np.ones((1, 5))), geograd.Obb2(np.ones((1, 5))))
open("/proc/self/clear_refs", "w").write("5")
before = status("VmRSS")
calls[form]()
print(status("VmHWM") - before)
"""


@pytest.mark.skipif(not os.path.exists("/proc/self/clear_refs"), reason="peaks of memory are Linux's")
@pytest.mark.parametrize("form", ["items", "out", "all_pairs", "above", "groups", "row_max"])
def test_no_call_copies_lent_fields(form):
    # A copy of one argument is 15 MiB: the peak of a call on fields apart is that on rows, which are lent as they lie.
    def peak(layout):
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        done = subprocess.run([sys.executable, "-c", NO_COPY, form, layout], capture_output=True, text=True, env=environment)
        assert done.returncode == 0, done.stderr
        return float(done.stdout)

    assert peak("apart") < peak("together") + 8


def test_flaws_of_lent_fields_are_named():
    bad = np.resize(A, (5000, 5)).copy()
    bad[4321, 2] = -1
    with pytest.raises(ValueError, match="item 4321.*width is negative"):
        geograd.iou(arrow.shapes(structs(bad), "Obb2"), geograd.Obb2(np.resize(B, (5000, 5))))
    mixed = pa.StructArray.from_arrays(
        [pa.array(A[:, k].astype(np.float32 if k else np.float64)) for k in range(5)], arrow._FIELDS["Obb2"]
    )
    np.testing.assert_allclose(arrow.shapes(mixed, "Obb2").array, A, rtol=1e-6)
    with pytest.raises(ValueError, match="columns"):
        geograd._core.Columns([np.zeros(3), np.zeros(4)])
    with pytest.raises(TypeError, match="Obb2 is made of"):
        geograd.Obb2(geograd._core.Columns([np.zeros(3)] * 4))


def test_polars():
    polars = pytest.importorskip("polars")
    series = polars.Series("box", A, dtype=polars.Array(polars.Float64, 5))
    np.testing.assert_array_equal(arrow.array(series, "Obb2"), A)
    frame = polars.from_arrow(pa.table({"box": arrow.column(geograd.Obb2(A)), "iou": arrow.column(A[:, 0])}))
    np.testing.assert_array_equal(arrow.array(frame["box"], "Obb2"), A)
    names = arrow._FIELDS["Obb2"]
    structs = polars.DataFrame({name: A[:, k] for k, name in enumerate(names)}).to_struct("box")
    np.testing.assert_array_equal(arrow.array(structs, "Obb2"), A)


def test_points_of_geoarrow():
    # Interleaved points are lists of two, separate ones structs of x and y.
    points = A[:, :2].copy()
    np.testing.assert_array_equal(arrow.array(lists(points, name="xy"), "Vec2"), points)
    separate = pa.StructArray.from_arrays([pa.array(points[:, 0].copy()), pa.array(points[:, 1].copy())], ["x", "y"])
    np.testing.assert_array_equal(arrow.shapes(separate, "Vec2").array, points)

    class Point(pa.ExtensionType):
        def __init__(self):
            super().__init__(pa.list_(pa.field("xy", pa.float64()), 2), "geoarrow.point")

        def __arrow_ext_serialize__(self):
            return b""

        @classmethod
        def __arrow_ext_deserialize__(cls, storage, serialized):
            return cls()

    column = pa.ExtensionArray.from_storage(Point(), lists(points, name="xy"))
    assert address(arrow.array(column, "Vec2")) == column.storage.flatten().buffers()[1].address


def test_bad_columns_are_named():
    with pytest.raises(TypeError, match="`a`: lists of 5 numbers are needed for Obb2"):
        arrow.array(lists(A[:, :4].copy()), "Obb2", "a")
    with pytest.raises(TypeError, match="lists of any length"):
        arrow.array(pa.array([[1.0], [2.0, 3.0]]), "Obb2")
    with pytest.raises(ValueError, match="`a` item 1: is null"):
        arrow.array(pa.array([[1.0] * 5, None], pa.list_(pa.float64(), 5)), "Obb2", "a")
    with pytest.raises(ValueError, match="`a` item 1: a number is null"):
        arrow.array(pa.array([[1.0] * 5, [1, 1, None, 1, 1]], pa.list_(pa.float64(), 5)), "Obb2", "a")
    with pytest.raises(TypeError, match="a column of numbers"):
        arrow.array(pa.array(["x"]))
    wrong = A.copy()
    wrong[7, 0] = np.nan
    with pytest.raises(ValueError, match="item 7: center.x is not a finite number|item 7: x is not a finite number"):
        geograd.iou(arrow.shapes(lists(wrong), "Obb2"), geograd.Obb2(B))


def test_groups_of_sorted_columns():
    keys, a, b = arrow.groups(pa.array([1, 1, 4, 6]), pa.chunked_array([[2, 4], [4, 6]]))
    assert keys.to_pylist() == [1, 2, 4, 6]
    np.testing.assert_array_equal(a, [0, 2, 2, 3, 4])
    np.testing.assert_array_equal(b, [0, 0, 1, 3, 4])
    keys, a, b = arrow.groups(pa.array(["x", "y"]), pa.array(["y"]).dictionary_encode())
    assert keys.to_pylist() == ["x", "y"] and a.tolist() == [0, 1, 2] and b.tolist() == [0, 0, 1]
    keys, a, b = arrow.groups(pa.array([], pa.int64()), pa.array([], pa.int64()))
    assert len(keys) == 0 and a.tolist() == b.tolist() == [0]
    with pytest.raises(ValueError, match="`b` item 2: group 1 comes after 2: sort"):
        arrow.groups(pa.array([1, 2]), pa.array([1, 2, 1]))
    with pytest.raises(ValueError, match="`a` item 1: is null"):
        arrow.groups(pa.array([1, None]), pa.array([1]))
    with pytest.raises(TypeError, match="groups are"):
        arrow.groups(pa.array([0.5]), pa.array([1]))


def test_grouped_join_of_tables():
    frame = np.sort(RNG.integers(0, 9, 60))
    other = np.sort(RNG.integers(2, 12, 60))
    left = pa.table({"frame": frame, "box": lists(A, pa.float32())})
    right = pa.table({"frame": other, "truth": lists(B, pa.float32())})
    found = arrow.join("iou", left, right, 0.1, on="frame", a="box", b="truth", kind="Obb2")
    matrix = geograd.iou.all_pairs(A.astype(np.float32), B.astype(np.float32), kind="Obb2")
    i, j = np.nonzero((matrix > np.float32(0.1)) & (frame[:, None] == other[None, :]))
    np.testing.assert_array_equal(found["left_row"], i)
    np.testing.assert_array_equal(found["right_row"], j)
    np.testing.assert_array_equal(found["value"], matrix[i, j])
    assert len(i) > 20
    with pytest.raises(KeyError, match="no column boxes"):
        arrow.join("iou", left, right, 0.1, on="frame", a="boxes", b="truth", kind="Obb2")


def test_apply_appends_results_to_tables_and_batches():
    apply = arrow.Apply("iou", ["a", "b"], "Obb2", grad=True)
    table = pa.table({"frame": np.arange(60), "a": lists(A), "b": lists(B)})
    done = apply(table)
    value, (by_a, by_b) = geograd.iou.value_grad(A, B, kind="Obb2")
    assert done.column_names == ["frame", "a", "b", "value", "value_by_a", "value_by_b"]
    np.testing.assert_array_equal(done["value"], value)
    np.testing.assert_array_equal(arrow.array(done["value_by_b"]), by_b)
    # As Spark's mapInArrow calls it: an iterator of batches in, one out.
    batches = list(arrow.Apply("iou", ["a", "b"], "Obb2").batches(table.to_batches(max_chunksize=25)))
    assert [batch.num_rows for batch in batches] == [25, 25, 10]
    np.testing.assert_array_equal(pa.Table.from_batches(batches)["value"], value)
    with pytest.raises(KeyError, match="no column b"):
        apply(table.drop_columns(["b"]))
    with pytest.raises(ValueError, match="no verb"):
        arrow.Apply("ious", ["a"], "Obb2")


def test_the_program_of_the_page_prints_what_it_shows(capsys):
    import pathlib
    import re

    text = (pathlib.Path(__file__).parents[1] / "DATASETS.md").read_text(encoding="utf-8")
    ((code, shown),) = re.findall(r"```python\n(.*?)```\n+```text\n(.*?)```", text, re.S)
    exec(compile(code, "DATASETS.md", "exec", dont_inherit=True), {})
    assert capsys.readouterr().out == shown


def test_a_frame_of_polars():
    polars = pytest.importorskip("polars")
    a, b = np.random.default_rng(1).uniform(1, 3, (2, 4, 5))
    frame = polars.from_arrow(pa.table({"name": list("abcd"), "a": geograd.arrow.column(a), "b": geograd.arrow.column(b)}))
    made = geograd.arrow.Apply("iou", ["a", "b"], "Obb2")(frame)
    assert isinstance(made, polars.DataFrame) and made.columns == ["name", "a", "b", "value"]
    np.testing.assert_array_equal(made["value"], geograd.iou(a, b, kind="Obb2"))
    with pytest.raises(TypeError, match="`a`: a column is needed, not a table of name, a, b"):
        geograd.iou(frame, frame, kind="Obb2")
    with pytest.raises(TypeError, match="a table or a batch of Arrow or Polars is needed, not dict"):
        geograd.arrow.Apply("iou", ["a", "b"], "Obb2")({"a": a})
    with pytest.raises(ValueError, match="no verb is called 'iuo'; is it iou"):
        geograd.arrow.Apply("iuo", ["a", "b"], "Obb2")

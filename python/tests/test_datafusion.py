"""Verbs and the grouped join under DataFusion, in this process."""

import numpy as np
import pytest

import geograd

pa = pytest.importorskip("pyarrow")
datafusion = pytest.importorskip("datafusion")
parquet = pytest.importorskip("pyarrow.parquet")

import geograd.arrow
import geograd.datafusion

RNG = np.random.default_rng(5)
A = RNG.uniform(1, 3, (500, 5)).astype(np.float32)
B = (A + RNG.normal(0, 0.3, A.shape)).astype(np.float32)


@pytest.fixture
def context(tmp_path):
    table = pa.table({"frame": RNG.integers(0, 20, 500), "a": geograd.arrow.column(A), "b": geograd.arrow.column(B)})
    parquet.write_table(table, tmp_path / "boxes.parquet")
    made = datafusion.SessionContext()
    made.register_parquet("boxes", str(tmp_path / "boxes.parquet"))
    return made


def test_a_verb_in_sql_on_a_parquet_file(context):
    assert geograd.datafusion.register(context, "iou", "Obb2") == "iou_obb2"
    found = context.sql("select iou_obb2(a, b) as iou from boxes").to_arrow_table()["iou"]
    np.testing.assert_array_equal(found, geograd.iou(A, B, kind="Obb2"))
    assert found.type == pa.float32()


def test_a_verb_that_gives_a_shape(context):
    name = geograd.datafusion.register(context, "corners", "Obb2", name="edges")
    found = context.sql(f"select {name}(a) as corners from boxes").to_arrow_table()["corners"]
    np.testing.assert_array_equal(geograd.arrow.array(found), geograd.corners(A, kind="Obb2").array)


def test_columns_of_double_precision():
    made = datafusion.SessionContext()
    a, b = A.astype("f8"), B.astype("f8")
    columns = {"a": geograd.arrow.column(a), "b": geograd.arrow.column(b)}
    made.register_record_batches("boxes", [[pa.RecordBatch.from_pydict(columns)]])
    assert geograd.datafusion.register(made, "iou", "Obb2", precision="f64") == "iou_obb2"
    found = made.sql("select iou_obb2(a, b) as iou from boxes").to_arrow_table()["iou"]
    np.testing.assert_array_equal(found, geograd.iou(a, b, kind="Obb2"))
    with pytest.raises(ValueError, match="precision is 'f32' or 'f64', not 'f16'"):
        geograd.datafusion.register(made, "iou", "Obb2", precision="f16")


def test_the_grouped_join(context):
    boxes = context.table("boxes")
    joined = geograd.datafusion.join(context, "iou", boxes, boxes, 0.3, on="frame", a="a", b="b", kind="Obb2").to_arrow_table()
    frame = context.sql("select frame from boxes").to_arrow_table()["frame"].to_numpy()
    matrix = geograd.iou.all_pairs(A, B, kind="Obb2")
    i, j = np.nonzero((matrix > np.float32(0.3)) & (frame[:, None] == frame[None, :]))
    assert joined.num_rows == len(i) > 500
    np.testing.assert_array_equal(joined["frame"], joined["right_frame"])
    np.testing.assert_array_equal(np.sort(joined["value"].to_numpy()), np.sort(matrix[i, j]))
    again = geograd.iou(geograd.arrow.array(joined["a"]), geograd.arrow.array(joined["right_b"]), kind="Obb2")
    np.testing.assert_array_equal(joined["value"], again)


def test_what_is_wrong_is_said(context):
    with pytest.raises(ValueError, match="no shape|no row of iou takes Car"):
        geograd.datafusion.udf("iou", "Car")
    with pytest.raises(KeyError, match="no column image"):
        geograd.datafusion.join(context, "iou", context.table("boxes"), context.table("boxes"), 0.3, on="image", a="a", b="b", kind="Obb2")
    geograd.datafusion.register(context, "iou", "Obb2")
    wrong = A.copy()
    wrong[3, 2] = -1
    context.from_arrow(pa.table({"a": geograd.arrow.column(wrong)}), name="wrong")
    with pytest.raises(Exception, match="item 3: width is negative"):
        context.sql("select iou_obb2(a, a) from wrong").collect()

"""Spark's ``mapInArrow`` calls a verb on columns of structs, with the bits of a call in process."""

import os
import sys

import numpy as np
import pytest

import geograd

pytest.importorskip("pyarrow")
pytest.importorskip("pyspark")

from geograd import arrow  # noqa: E402
from pyspark.sql import SparkSession  # noqa: E402
from pyspark.sql.types import DoubleType, LongType, StructField, StructType  # noqa: E402

FIELDS = ["x", "y", "width", "height", "heading"]


@pytest.fixture(scope="module")
def spark():
    # Workers are started by name: `python3`, which may be another installation.
    os.environ.setdefault("PYSPARK_PYTHON", sys.executable)
    build = SparkSession.builder.master("local[2]")
    for name, value in {
        "spark.ui.enabled": "false",
        "spark.driver.bindAddress": "127.0.0.1",
        "spark.driver.host": "127.0.0.1",
    }.items():
        build = build.config(name, value)
    try:
        session = build.getOrCreate()
    except Exception as error:  # Without a Java runtime there is no session.
        pytest.skip(f"no session of Spark: {error}")
    yield session
    session.stop()


def test_a_verb_in_map_in_arrow(spark):
    random = np.random.default_rng(0)

    def boxes():
        sides = [random.uniform(0, 5, (60, 2)), random.uniform(1, 3, (60, 2)), random.uniform(-3, 3, (60, 1))]
        return np.hstack(sides)

    a, b = boxes(), boxes()
    shape = StructType([StructField(name, DoubleType()) for name in FIELDS])
    schema = StructType([StructField("frame", LongType()), StructField("a", shape), StructField("b", shape)])
    rows = [(i, tuple(x.tolist()), tuple(y.tolist())) for i, (x, y) in enumerate(zip(a, b))]
    frame = spark.createDataFrame(rows, schema).repartition(3)
    given = StructType([*schema.fields, StructField("value", DoubleType())])
    done = frame.mapInArrow(arrow.Apply("iou", ["a", "b"], "Obb2").batches, given).collect()
    done = sorted(done, key=lambda row: row.frame)
    expected = geograd.iou(a, b, kind="Obb2")
    assert [row.frame for row in done] == list(range(60))
    np.testing.assert_array_equal([row.value for row in done], expected)
    assert (expected > 0).sum() > 10

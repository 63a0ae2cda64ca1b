"""Verbs and jobs on Ray with two worker processes."""

import os

import numpy as np
import pytest

import geograd

pa = pytest.importorskip("pyarrow")
ray = pytest.importorskip("ray")

import geograd.arrow
import geograd.ray

RNG = np.random.default_rng(5)
A = RNG.uniform(1, 3, (2000, 5)).astype(np.float32)
B = (A + RNG.normal(0, 0.3, A.shape)).astype(np.float32)


@pytest.fixture(scope="module")
def cluster():
    ray.init(num_cpus=2, include_dashboard=False, logging_level="error", log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False
    yield
    ray.shutdown()


def test_a_verb_on_batches_of_parquet(cluster, tmp_path):
    import pyarrow.parquet as parquet

    for k in range(2):
        own = slice(1000 * k, 1000 * (k + 1))
        table = pa.table({"row": np.arange(2000)[own], "a": geograd.arrow.column(A[own]), "b": geograd.arrow.column(B[own])})
        parquet.write_table(table, tmp_path / f"{k}.parquet")
    data = ray.data.read_parquet(str(tmp_path))
    done = geograd.ray.map(data, "iou", ["a", "b"], "Obb2", grad=True)
    table = pa.concat_tables(ray.get(done.to_arrow_refs())).sort_by("row")
    value, (by_a, _) = geograd.iou.value_grad(A, B, kind="Obb2")
    np.testing.assert_array_equal(table["value"], value)
    np.testing.assert_array_equal(geograd.arrow.array(table["value_by_a"]), by_a)


def test_a_function_of_files(cluster):
    # Within the test, so that Ray sends it by value: workers do not find the modules of tests.
    def judge(path):
        return {"path": path, "process": os.getpid(), "threads": geograd.get_num_threads()}

    paths = [f"{'x' * k}.parquet" for k in range(1, 9)]
    done = geograd.ray.Files(judge).run(paths)
    assert [row["path"] for row in done] == paths
    assert all(row["threads"] == 1 and row["process"] != os.getpid() for row in done)
    with pytest.raises(TypeError):
        geograd.ray.Files("judge")

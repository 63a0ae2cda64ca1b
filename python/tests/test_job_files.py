"""The job of average precision where files are missing or others than before."""

import json
import os
import re
import shutil

import pytest

pytest.importorskip("pyarrow")

from test_jobs import judged, run


@pytest.fixture
def data(tmp_path):
    run("dataset_ap", "--make", 4, "--frames", 6, "--data", tmp_path / "data")
    return tmp_path / "data"


@pytest.mark.parametrize("again", [False, True], ids=["first run", "second run"])
@pytest.mark.parametrize("name", ["detections", "truths"])
def test_a_missing_file_is_named_or_its_sequence_left_out(data, tmp_path, name, again):
    out = tmp_path / "out"
    if again:
        run("dataset_ap", "--data", data, "--out", out)
    path = data / name / "00002.parquet"
    path.unlink()
    said = run("dataset_ap", "--data", data, "--out", out, code=1)
    assert str(path) in said and "no such file" in said
    printed = run("dataset_ap", "--data", data, "--out", out, "--skip")
    assert "3 sequences" in printed
    # As of a data set that never had the sequence.
    for other in ("detections", "truths"):
        (data / other / "00002.parquet").unlink(missing_ok=True)
    run("dataset_ap", "--data", data, "--out", tmp_path / "other")
    assert judged(out) == judged(tmp_path / "other")


def test_an_older_file_in_place_of_a_newer_one_is_computed(data, tmp_path):
    out = tmp_path / "out"
    run("dataset_ap", "--data", data, "--out", out)
    before = judged(out)
    path = data / "detections" / "00001.parquet"
    shutil.copy(data / "detections" / "00003.parquet", path)
    os.utime(path, (1, 1))
    run("dataset_ap", "--data", data, "--out", out)
    run("dataset_ap", "--data", data, "--out", tmp_path / "new")
    assert judged(out) == judged(tmp_path / "new") != before


def test_a_damaged_result_is_computed_again(data, tmp_path):
    out = tmp_path / "out"
    run("dataset_ap", "--data", data, "--out", out)
    before = judged(out)
    result = out / "00001.json"
    result.write_text(result.read_text()[:100])
    run("dataset_ap", "--data", data, "--out", out)
    assert judged(out) == before and json.loads(result.read_text())["sequence"] == "00001"


def test_no_files_at_all(tmp_path):
    said = run("dataset_ap", "--data", tmp_path, code=1)
    assert re.search("no truths", said)

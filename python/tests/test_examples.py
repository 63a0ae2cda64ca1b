"""The scripts of `examples` run, on small sizes, and their results hold."""

import csv
import importlib.util
import os
import pathlib
import re
import subprocess
import sys

import numpy as np
import pytest

import geograd

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
NEEDS = {
    "match_kitti": ["matplotlib"],
    "train_head": ["torch", "matplotlib"],
    "gauss_newton": ["matplotlib"],
    "geojson_overlap": ["geopandas", "matplotlib"],
    "planted_fault": [],
    "dataset_ap": ["pyarrow"],
    "map_overlay": ["geopandas", "pyarrow"],
    "obb_ap": [],
}


def run(name, *arguments, code=0):
    """The output of a script, which has to end with a code."""
    for needed in NEEDS[name]:
        pytest.importorskip(needed)
    command = [sys.executable, str(EXAMPLES / f"{name}.py"), *map(str, arguments)]
    # The package that the tests have, wherever it is.
    paths = [str(pathlib.Path(geograd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    done = subprocess.run(
        command, capture_output=True, text=True, timeout=300,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths)), "PYTHONIOENCODING": "utf-8"}, encoding="utf-8",
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout if code == 0 else done.stderr


def number(text, pattern):
    return float(re.search(pattern, text)[1])


def is_picture(path):
    # The signature of PNG, and more than a blank page.
    return path.read_bytes()[:4] == b"\x89PNG" and path.stat().st_size > 5000


def rows(path):
    return list(csv.DictReader(path.open()))


def test_every_script_is_here():
    # `jobs` is what two of them share.
    assert {path.stem for path in EXAMPLES.glob("*.py")} == {*NEEDS, "jobs"}


@pytest.mark.parametrize("name", NEEDS)
def test_help_has_an_example(name, capsys, monkeypatch):
    for needed in NEEDS[name]:
        pytest.importorskip(needed)
    # In this process, as PyTorch is slow to import.
    monkeypatch.syspath_prepend(EXAMPLES)
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    with pytest.raises(SystemExit) as ended:
        script.main(["--help"])
    shown = capsys.readouterr().out
    assert ended.value.code == 0 and f"python {name}.py" in shown and "--help" in shown


def test_match_kitti_finds_most_labels(tmp_path):
    printed = run("match_kitti", "--frames", 20, "--out", tmp_path)
    assert 0.75 < number(printed, r"recall ([\d.]+)") < 1
    assert 0.6 < number(printed, r"IoU of matches: mean ([\d.]+)") < 0.95
    matches = rows(tmp_path / "matches.csv")
    assert len(matches) > 10 and all(0.5 < float(row["iou"]) <= 1 for row in matches)
    # No label and no detection twice.
    for column in ("label", "detection"):
        assert len({row[column] for row in matches}) == len(matches)
    assert is_picture(tmp_path / "frame.png")


def test_match_kitti_reads_files(tmp_path):
    # A car and a region without labels; the car turned by half a turn and moved by a quarter of its length, and a better
    # box with a lower score, which comes too late.
    label = "0 1 Car 0 0 -1.6 600 170 700 250 1.5 1.6 4.0 2.0 1.7 20.0 0.0"
    region = "0 -1 DontCare -1 -1 -10 500 170 510 180 -1 -1 -1 -1000 -1000 -1000 -10"
    moved = f"0 -1 Car -1 -1 -10 600 170 700 250 1.5 1.6 4.0 3.0 1.7 20.0 {np.pi:.12f} 0.9"
    (tmp_path / "labels.txt").write_text(f"{label}\n{region}\n")
    better = f"{label} 0.8"
    (tmp_path / "detections.txt").write_text(f"{better}\n{moved}\n")
    files = ["--labels", tmp_path / "labels.txt", "--detections", tmp_path / "detections.txt"]
    printed = run("match_kitti", *files, "--out", tmp_path)
    (match,) = rows(tmp_path / "matches.csv")
    assert match["detection"] == "1" and number(printed, r"best IoU of a label: mean ([\d.]+)") == 1
    # Three metres of five.
    assert float(match["iou"]) == pytest.approx(0.6, abs=1e-6)


def test_match_kitti_names_a_bad_line(tmp_path):
    for line, why in [("0 1 Car 0 0", "17 or 18 columns"), (" ".join(["0", "1", "Car", *"x" * 14]), "'x'")]:
        (tmp_path / "labels.txt").write_text(f"\n{line}\n")
        printed = run("match_kitti", "--labels", tmp_path / "labels.txt", "--out", tmp_path, code=1)
        assert "labels.txt:2: " in printed and why in printed and "Traceback" not in printed


def test_gauss_newton_finds_the_arm(tmp_path):
    printed = run("gauss_newton", "--noise", 0, "--out", tmp_path)
    assert number(printed, r"differences: (\S+)") < 1e-7
    assert number(printed, r"m before, (\S+) m after") < 1e-12
    assert is_picture(tmp_path / "calibration.png")


def test_geojson_overlap_agrees_with_shapely(tmp_path):
    printed = run("geojson_overlap", "--count", 60, "--out", tmp_path)
    assert number(printed, r"overlaps by (\S+) m²") < 1e-9
    shared = [float(row["square_metres"]) for row in rows(tmp_path / "overlaps.csv")]
    assert len(shared) > 3 and shared == sorted(shared, reverse=True)
    assert is_picture(tmp_path / "overlaps.png")


@pytest.mark.slow
def test_train_head_learns(tmp_path):
    printed = run("train_head", "--steps", 40, "--batch", 32, "--out", tmp_path)
    for name in ("GIoU", "ProbIoU"):
        first, last = re.search(rf"^{name} +loss ([\d.]+) to ([\d.]+)", printed, re.M).groups()
        assert float(last) < 0.9 * float(first)
    assert is_picture(tmp_path / "curves.png") and is_picture(tmp_path / "boxes.png")


@pytest.mark.slow
def test_the_harness_refuses_the_planted_faults():
    printed = run("planted_fault", "--samples", 15)
    assert "accepted the right gradient and refused the others" in printed


def test_obb_ap():
    lines = run("obb_ap", "--images", 20, "--seed", 3).splitlines()
    assert lines[1].split() == ["probiou", "exact"] * 3
    table = {line.split()[0]: [float(x) for x in line.split()[1:]] for line in lines[2:]}
    assert set(table) == {"tank", "car", "ship", "bridge"}
    for row in table.values():
        # Probabilistic IoU is the larger score of boxes that are near, so that more of them count.
        assert len(row) == 6 and all(0.2 < exact <= by_gaussians < 1 for by_gaussians, exact in zip(row[::2], row[1::2]))
        assert row[2] - row[3] > 0.1

"""The jobs on whole data sets: in process and by Ray, killed and run again, on bad files."""

import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import geograd

pa = pytest.importorskip("pyarrow")
parquet = pytest.importorskip("pyarrow.parquet")

import geograd.arrow
import geograd.metric

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


def command(name, *arguments):
    return [sys.executable, str(EXAMPLES / f"{name}.py"), *map(str, arguments)]


def environment():
    paths = [str(pathlib.Path(geograd.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, paths))}


def run(name, *arguments, code=0, **options):
    done = subprocess.run(
        command(name, *arguments), capture_output=True, text=True, timeout=300, env=environment(), **options
    )
    assert done.returncode == code, done.stdout + done.stderr
    assert "Traceback" not in done.stderr or code == 0, done.stderr
    return done.stdout if code == 0 else done.stderr


def judged(folder):
    return (folder / "report.txt").read_text()


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """Twelve sequences, and what the job in this process finds in them."""
    folder = tmp_path_factory.mktemp("data")
    printed = run("dataset_ap", "--make", 12, "--frames", 15, "--data", folder)
    assert "12 sequences, 180 frames" in printed and "peak memory" in printed
    return folder


def test_average_precision_is_that_of_all_frames_at_once(data):
    # All sequences as one, with a plain loop over frames in place of groups.
    found, truths = ([parquet.read_table(path) for path in sorted((data / name).glob("*.parquet"))] for name in ("detections", "truths"))
    first, second, iou, before = [], [], [], [0, 0]
    scores, alphas, counts = [], [[], []], [[], []]
    for a, b in zip(found, truths):
        classes = [np.array(x["class"].to_pylist()) for x in (a, b)]
        ours, theirs = np.flatnonzero(classes[0] == "Car"), np.flatnonzero(np.isin(classes[1], ["Car", "Van"]))
        boxes = [geograd.convert(geograd.arrow.shapes(x["box"], "KittiBox")) for x in (a, b)]
        matrix = geograd.iou.all_pairs(boxes[0][ours], boxes[1][theirs])
        same = a["frame"].to_numpy()[ours][:, None] == b["frame"].to_numpy()[theirs][None, :]
        i, j = np.nonzero(same & (matrix > 0.7))
        first.append(i + before[0])
        second.append(j + before[1])
        iou.append(matrix[i, j].astype(float))
        before = [before[0] + len(ours), before[1] + len(theirs)]
        scores.append(a["score"].to_numpy()[ours])
        alphas[0].append(b["alpha"].to_numpy()[theirs])
        alphas[1].append(a["alpha"].to_numpy()[ours])
        counts[0].append(np.where(a["image"].to_numpy()[ours] < 25, 1, 0))
        full = (b["occluded"].to_numpy() <= 1) & (b["truncated"].to_numpy() <= 0.3) & (b["image"].to_numpy() > 25)
        counts[1].append(np.where((full & (classes[1] == "Car"))[theirs], 0, 1))
    join = np.concatenate
    own = geograd.metric.kitti(
        join(scores), [join(first), join(second), join(iou)], 0.7, angles=[join(alphas[0]), join(alphas[1])],
        truths=join(counts[1]), detections=join(counts[0]),
    )
    assert json.loads(judged(data / "results"))["Car moderate"] == [own["ap"], own["aos"], own["truths"]]
    assert 0.3 < own["aos"] < own["ap"] < 1


def test_average_precision_by_ray_is_the_same(data, tmp_path):
    pytest.importorskip("ray")
    run("dataset_ap", "--data", data, "--out", tmp_path, "--ray", 2)
    assert judged(tmp_path) == judged(data / "results")


@pytest.mark.slow
def test_a_killed_job_goes_on_where_it_stopped(data, tmp_path):
    folder = tmp_path / "data"
    run("dataset_ap", "--make", 40, "--frames", 60, "--data", folder, "--out", tmp_path / "whole")
    out = tmp_path / "out"
    job = subprocess.Popen(command("dataset_ap", "--data", folder, "--out", out), env=environment(), stdout=subprocess.DEVNULL)
    while len(list(out.glob("*.json"))) < 3:
        assert job.poll() is None
        time.sleep(0.001)
    job.kill()
    assert job.wait() == -signal.SIGKILL
    done = {path: path.stat().st_mtime_ns for path in out.glob("*.json")}
    assert 3 <= len(done) < 40
    for path in done:
        json.loads(path.read_text())
    run("dataset_ap", "--data", folder, "--out", out)
    assert len(list(out.glob("*.json"))) == 40
    assert all(path.stat().st_mtime_ns == before for path, before in done.items())
    assert judged(out) == judged(tmp_path / "whole")


def test_a_killed_worker_of_ray_loses_and_doubles_no_file(tmp_path):
    ray = pytest.importorskip("ray")
    import geograd.ray

    def judge(path):
        flag = pathlib.Path(path + ".tried")
        if path.endswith("3") and not flag.exists():
            flag.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        with open(path, "x") as file:
            file.write("once")
        return {"path": path, "process": os.getpid()}

    ray.init(num_cpus=2, include_dashboard=False, logging_level="error", log_to_driver=False)
    try:
        ray.data.DataContext.get_current().enable_progress_bars = False
        paths = [str(tmp_path / str(k)) for k in range(8)]
        done = geograd.ray.Files(judge).run(paths)
    finally:
        ray.shutdown()
    assert (tmp_path / "3.tried").exists()
    assert [row["path"] for row in done] == paths and all(pathlib.Path(path).read_text() == "once" for path in paths)


def broken(data, tmp_path, change, name="detections"):
    """The data set with one changed file: it, and the file."""
    folder = tmp_path / "data"
    for own in ("detections", "truths"):
        (folder / own).mkdir(parents=True)
        for path in (data / own).glob("*.parquet"):
            os.link(path, folder / own / path.name)
    path = folder / name / "00004.parquet"
    whole = parquet.read_table(path)
    path.unlink()
    change(path, whole)
    return folder, path


def column(table, name, values):
    return table.set_column(table.column_names.index(name), name, values)


def replaced(name, make):
    return lambda path, table: parquet.write_table(column(table, name, make(table)), path)


def boxes(table, row, number):
    numbers = geograd.arrow.array(table["box"]).copy()
    numbers[row, 3] = number
    return geograd.arrow.column(numbers)


BAD = {
    "corrupt": (lambda path, table: path.write_bytes(b"PAR1 and nothing of use"), ""),
    "missing column": (lambda path, table: parquet.write_table(table.drop_columns(["alpha"]), path), "no column alpha"),
    "list width": (
        replaced("box", lambda t: geograd.arrow.column(geograd.arrow.array(t["box"])[:, :6].copy())),
        "`box`: lists of 7 numbers are needed",
    ),
    "null": (replaced("score", lambda t: pa.array([*t["score"].to_pylist()[:-1], None])), r"row \d+: score is null"),
    "not a number": (replaced("box", lambda t: boxes(t, 5, np.nan)), r"item 5: .*not a finite number"),
    "unsorted": (replaced("frame", lambda t: pa.array(t["frame"].to_numpy()[::-1].copy())), r"frame` item \d+: group .* sort the table"),
}


@pytest.mark.parametrize("why", BAD)
def test_a_bad_file_is_named_or_left_out(data, tmp_path, why):
    change, message = BAD[why]
    folder, path = broken(data, tmp_path, change)
    out = tmp_path / "out"
    said = run("dataset_ap", "--data", folder, "--out", out, code=1)
    assert str(path) in said and re.search(message, said)
    # The sequences before it are done, whole ones; there is no report.
    assert not (out / "report.txt").exists() and not list(out.glob("*00004*")) and not list(out.glob("*.part"))
    printed = run("dataset_ap", "--data", folder, "--out", out, "--skip")
    assert "11 sequences" in printed and (out / "report.txt").exists()


def test_a_full_disk_leaves_nothing_half_written(data, tmp_path):
    def small():
        # Any file ends at some bytes, as on a full disk.
        resource.setrlimit(resource.RLIMIT_FSIZE, (4000, 4000))

    said = run("dataset_ap", "--data", data, "--out", tmp_path, code=1, preexec_fn=small)
    assert f"dataset_ap: {tmp_path}/00000.json: " in said and list(tmp_path.iterdir()) == []
    pytest.importorskip("geopandas")
    run("map_overlay", *MAP, "--out", tmp_path / "a")
    layers = ["--a", tmp_path / "a" / "a.parquet", "--b", tmp_path / "a" / "b.parquet", "--tile", 120]
    said = run("map_overlay", *layers, "--out", tmp_path / "b", code=1, preexec_fn=small)
    assert f"map_overlay: {tmp_path}/b/parts/a/000000.parquet: " in said
    assert [path.name for path in (tmp_path / "b").rglob("*") if path.is_file()] == ["job.json"]


MAP = ["--count", 300, "--tile", 120]


def overlaps(folder):
    return parquet.read_table(folder / "overlaps.parquet")


@pytest.mark.slow
def test_overlaps_of_two_maps_are_those_of_geopandas(tmp_path):
    pytest.importorskip("geopandas")
    printed = run("map_overlay", *MAP, "--out", tmp_path / "a", "--check")
    assert "areas differ by" in printed
    # Other tiles, other borders: the same pairs, each once.
    layers = ["--a", tmp_path / "a" / "a.parquet", "--b", tmp_path / "a" / "b.parquet"]
    run("map_overlay", *layers, "--tile", 47, "--out", tmp_path / "b", "--check")
    own, other = overlaps(tmp_path / "a"), overlaps(tmp_path / "b")
    assert own.num_rows > 200
    for name in ("a", "b"):
        np.testing.assert_array_equal(own[name], other[name])
    assert len(set(zip(own["a"].to_pylist(), own["b"].to_pylist()))) == own.num_rows
    # A second run computes what is missing, and nothing else.
    rows = sorted((tmp_path / "a" / "rows").glob("*.parquet"))
    rows[1].unlink()
    before = rows[0].stat().st_mtime_ns
    run("map_overlay", *MAP, "--out", tmp_path / "a")
    assert rows[1].exists() and rows[0].stat().st_mtime_ns == before and overlaps(tmp_path / "a").equals(own)
    said = run("map_overlay", *layers, "--tile", 60, "--out", tmp_path / "a", code=1)
    assert "other layers or options" in said


def test_overlaps_by_ray_are_the_same(tmp_path):
    pytest.importorskip("geopandas")
    pytest.importorskip("ray")
    run("map_overlay", *MAP, "--out", tmp_path / "a")
    layers = ["--a", tmp_path / "a" / "a.parquet", "--b", tmp_path / "a" / "b.parquet"]
    run("map_overlay", *layers, "--tile", 120, "--out", tmp_path / "b", "--ray", 2)
    assert overlaps(tmp_path / "a").equals(overlaps(tmp_path / "b"))


def test_a_bad_layer_is_named(tmp_path):
    pytest.importorskip("geopandas")
    (tmp_path / "bad.parquet").write_bytes(b"PAR1")
    said = run("map_overlay", "--a", tmp_path / "bad.parquet", "--out", tmp_path / "out", code=1)
    assert "bad.parquet" in said
    said = run("map_overlay", "--a", tmp_path / "none.parquet", "--out", tmp_path / "other", code=1)
    assert "none.parquet" in said


def test_blocks_of_a_map_are_read_one_after_another(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    run("map_overlay", *MAP, "--out", tmp_path / "a")
    own = overlaps(tmp_path / "a")
    # Row groups of 64 buildings, and a file without any.
    whole = geopandas.read_parquet(tmp_path / "a" / "a.parquet")
    whole.to_parquet(tmp_path / "a.parquet", row_group_size=64)
    whole = geopandas.read_parquet(tmp_path / "a" / "b.parquet")
    whole.to_file(tmp_path / "b.gpkg")
    layers = ["--a", tmp_path / "a.parquet", "--b", tmp_path / "b.gpkg", "--tile", 120]
    run("map_overlay", *layers, "--block", 50, "--out", tmp_path / "b", "--check")
    assert len(list((tmp_path / "b" / "parts" / "a").iterdir())) == 5 and len(list((tmp_path / "b" / "parts" / "b").iterdir())) == 6
    assert overlaps(tmp_path / "b").equals(own)
    # Blocks that are there stay; one that is gone comes again.
    part = tmp_path / "b" / "parts" / "a" / "000003.parquet"
    before, kept = part.read_bytes(), part.with_name("000002.parquet").stat().st_mtime_ns
    part.unlink()
    run("map_overlay", *layers, "--block", 50, "--out", tmp_path / "b")
    assert part.read_bytes() == before and part.with_name("000002.parquet").stat().st_mtime_ns == kept


def test_degrees_and_geometries_of_all_kinds(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    # A hundredth of a degree at 45 N: 788 m by 1111 m. Two of one feature, a bow tie, a point, nothing.
    square = lambda x, y, side=0.01: shapely.box(9 + x, 45 + y, 9 + x + side, 45 + y + side)
    bow = shapely.Polygon([(9, 45), (9.01, 45.01), (9.01, 45), (9, 45.01)])
    a = [shapely.MultiPolygon([square(0, 0), square(0.03, 0)]), bow, shapely.Point(9, 45), None, square(0.06, 0)]
    b = [square(0.005, 0.005), square(0.005, 0, 0.05)]
    for name, own in (("a", a), ("b", b)):
        geopandas.GeoDataFrame(geometry=own, crs="EPSG:4326").to_parquet(tmp_path / f"{name}.parquet", row_group_size=2)
    layers = ["--a", tmp_path / "a.parquet", "--b", tmp_path / "b.parquet", "--tile", 300]
    said = run("map_overlay", *layers, "--out", tmp_path / "out", "--check")
    assert "3 polygons of a.parquet, 3 geometries left out" in said
    found = overlaps(tmp_path / "out")
    assert found["a"].to_pylist() == [0, 0, 0] and found["b"].to_pylist() == [0, 1, 1]
    np.testing.assert_allclose(found["square_metres"], [0.25 * 876e3, 0.5 * 876e3, 876e3], rtol=2e-3)


def test_a_corrupt_block_is_named_and_the_others_stay(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    run("map_overlay", *MAP, "--out", tmp_path / "a")
    path = tmp_path / "a.parquet"
    geopandas.read_parquet(tmp_path / "a" / "a.parquet").to_parquet(path, row_group_size=64, compression=None)
    group = parquet.read_metadata(path).row_group(3).column(1)
    with open(path, "r+b") as file:
        file.seek(group.data_page_offset)
        file.write(b"\xa5" * 300)
    layers = ["--a", path, "--b", tmp_path / "a" / "b.parquet", "--tile", 120]
    said = run("map_overlay", *layers, "--out", tmp_path / "out", code=1)
    assert f"{path}: " in said
    there = [path.name for path in sorted((tmp_path / "out" / "parts" / "a").iterdir())]
    assert there == ["000000.parquet", "000001.parquet", "000002.parquet"] and not (tmp_path / "out" / "overlaps.parquet").exists()

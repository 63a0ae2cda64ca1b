"""Figures of BENCHMARKS.md on whole data sets: processor time of joins from Parquet, on one thread, and peak memory.

    python python/benches/datasets.py join               10^6 by 10^6 rotated boxes in 20,000 frames, four ways
    python python/benches/datasets.py join --boxes 1e7 --ways read,geograd
    python python/benches/datasets.py overlay            two maps of 10^5 buildings, beside geopandas.overlay
    python python/benches/datasets.py groups             one call of groups and a call a group, on the CPU and on a GPU
    python python/benches/datasets.py ray                what Ray costs a task

Every way runs in a process of its own, `--runs` times in turn; figures are medians.
"""

import argparse
import importlib
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

THRESHOLD = 0.3
CELL = 8.0


def boxes(folder, count, frames, seed=1):
    """Truths and detections as Parquet, a frame in 100 by 100 metres; and their cells, for joins on cells."""
    import pyarrow as pa
    import pyarrow.parquet as parquet

    import geograd.arrow

    rng = np.random.default_rng(seed)
    frame = np.sort(rng.integers(0, frames, count)).astype(np.int32)
    a = np.c_[rng.uniform(0, 100, (count, 2)), rng.uniform(3, 5, count), rng.uniform(1.5, 2.5, count), rng.uniform(-3, 3, count)]
    b = a + rng.normal(0, 1, a.shape) * [0.3, 0.3, 0.1, 0.1, 0.05]
    for name, own in (("a", a), ("b", b)):
        own = own.astype(np.float32)
        lists = geograd.arrow.column(own)
        parquet.write_table(pa.table({"frame": frame, "box": lists}), folder / f"{name}.parquet")
        reach = 0.5 * np.hypot(own[:, 2], own[:, 3])
        low, high = (np.floor((own[:, :2] + s * reach[:, None]) / CELL).astype(np.int32) for s in (-1, 1))
        rows, cells = [], []
        for dx in range(2):
            for dy in range(2):
                x, y = low[:, 0] + dx, low[:, 1] + dy
                here = np.flatnonzero((x <= high[:, 0]) & (y <= high[:, 1]))
                rows.append(here)
                cells.append((x[here] * 1000 + y[here]).astype(np.int32))
        rows, cells = np.concatenate(rows), np.concatenate(cells)
        order = np.argsort(rows, kind="stable")
        rows, cells = rows[order], cells[order]
        table = {"frame": frame[rows], "cell": cells, "id": rows, "box": lists.take(pa.array(rows))}
        parquet.write_table(pa.table(table), folder / f"{name}_cells.parquet")


def load(folder):
    import pyarrow.parquet as parquet

    return [parquet.read_table(folder / f"{name}.parquet", use_threads=False) for name in "ab"]


def read(folder):
    return len(load(folder)[0]), 0.0


def grouped(folder):
    import geograd.arrow

    geograd.set_num_threads(1)
    found = geograd.arrow.join("iou", *load(folder), THRESHOLD, on="frame", a="box", b="box", kind="Obb2")
    return found.num_rows, float(np.sum(found["value"], dtype=np.float64))


def calls(folder):
    import geograd.arrow

    geograd.set_num_threads(1)
    tables = load(folder)
    _, *offsets = geograd.arrow.groups(tables[0]["frame"], tables[1]["frame"])
    a, b = (geograd.arrow.array(table["box"], "Obb2") for table in tables)
    count, total = 0, 0.0
    for k in range(len(offsets[0]) - 1):
        own, other = (x[k : k + 2] for x in offsets)
        _, _, iou = geograd.iou.above(a[own[0] : own[1]], b[other[0] : other[1]], THRESHOLD, kind="Obb2")
        count, total = count + len(iou), total + float(np.sum(iou, dtype=np.float64))
    return count, total


def datafusion(folder):
    import datafusion

    import geograd
    import geograd.datafusion

    geograd.set_num_threads(1)
    context = datafusion.SessionContext(datafusion.SessionConfig().with_target_partitions(1))
    name = geograd.datafusion.register(context, "iou", "Obb2")
    for side in "ab":
        context.register_parquet(side, str(folder / f"{side}_cells.parquet"))
    found = context.sql(
        f"select count(*) n, sum(v) s from (select a.id i, b.id j, min({name}(a.box, b.box)) v from a join b"
        f" on a.frame = b.frame and a.cell = b.cell where {name}(a.box, b.box) > {THRESHOLD} group by a.id, b.id)"
    ).to_pydict()
    return found["n"][0], found["s"][0]


def library_in_datafusion(folder):
    import datafusion

    import geograd
    import geograd.datafusion

    geograd.set_num_threads(1)
    context = datafusion.SessionContext(datafusion.SessionConfig().with_target_partitions(1))
    a, b = (context.read_parquet(str(folder / f"{side}.parquet")) for side in "ab")
    found = geograd.datafusion.join(context, "iou", a, b, THRESHOLD, on="frame", a="box", b="box", kind="Obb2")
    values = found.to_arrow_table()["value"]
    return len(values), float(np.sum(values, dtype=np.float64))


def geopandas(folder):
    import geopandas as gpd
    import shapely

    import geograd.arrow

    frames = []
    for table in load(folder):
        corners = geograd.corners(geograd.arrow.shapes(table["box"], "Obb2")).array.astype(float).reshape(-1, 4, 2)
        # Frames apart in space.
        corners[..., 0] += 1000.0 * table["frame"].to_numpy()[:, None]
        frames.append(gpd.GeoDataFrame(geometry=shapely.polygons(corners)))
    a, b = frames
    found = a.sjoin(b, predicate="intersects")
    one, other = a.geometry.to_numpy()[found.index], b.geometry.to_numpy()[found["index_right"]]
    shared = shapely.area(shapely.intersection(one, other))
    iou = shared / (shapely.area(one) + shapely.area(other) - shared)
    return int((iou > THRESHOLD).sum()), float(iou[iou > THRESHOLD].sum())


def maps():
    sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "examples"))
    import map_overlay

    return map_overlay


def overlay_geograd(folder):
    import contextlib
    import io

    import pyarrow.parquet as parquet

    import geograd

    geograd.set_num_threads(1)
    out = pathlib.Path(tempfile.mkdtemp(dir=folder))
    with contextlib.redirect_stdout(io.StringIO()):
        layers = [f"--{name}={folder / name}.parquet" for name in "ab"]
        maps().main([*layers, "--tile", "1000", "--out", str(out)])
    found = parquet.read_table(out / "overlaps.parquet")
    return found.num_rows, sum(found["square_metres"].to_pylist())


def overlay_geopandas(folder):
    import geopandas as gpd

    layers = [gpd.read_parquet(folder / f"{name}.parquet", columns=["geometry"]) for name in "ab"]
    found = gpd.overlay(*layers, keep_geom_type=True).area
    found = found[found > 0.01]
    return len(found), float(found.sum())


WAYS = {
    "read": ("reading both files", read),
    "geograd": ("geograd.arrow.join", grouped),
    "calls": ("a call of `above` a frame", calls),
    "inside": ("geograd.datafusion.join", library_in_datafusion),
    "datafusion": ("DataFusion, join on cells, which were there", datafusion),
    "geopandas": ("GeoPandas, sjoin, then areas", geopandas),
    "overlay_geograd": ("map_overlay.py, tiles of 1 km, from files to a file", overlay_geograd),
    "overlay_geopandas": ("geopandas.overlay, from files", overlay_geopandas),
}


IMPORTS = {
    "inside": ["geograd.datafusion"], "datafusion": ["geograd.datafusion"], "geopandas": ["geopandas"],
    "overlay_geograd": ["geopandas"], "overlay_geopandas": ["geopandas"],
}


def one(way, folder):
    # Imports are the same few tenths of a second for any size.
    for module in ["pyarrow.parquet", "geograd.arrow", *IMPORTS.get(way, [])]:
        importlib.import_module(module)
    before, start = time.process_time(), time.perf_counter()
    count, total = WAYS[way][1](folder)
    cpu = time.process_time() - before
    # The peak of this program alone: `ru_maxrss` counts the parent, too.
    peak = int(re.search(r"VmHWM:\s+(\d+)", pathlib.Path("/proc/self/status").read_text())[1]) / 1024
    print(json.dumps({"cpu": cpu, "wall": time.perf_counter() - start, "count": count, "total": total, "peak": peak}))


def compare(ways, folder, runs):
    """Ways in turn, so that a machine loaded by other work loads all of them."""
    found = {way: [] for way in ways}
    for _ in range(runs):
        for way in ways:
            command = [sys.executable, __file__, "one", "--ways", way, "--data", str(folder)]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                print(f"| {WAYS[way][0]} | failed: {done.stderr.strip().splitlines()[-1]} |")
                return
            found[way].append(json.loads(done.stdout.splitlines()[-1]))
    print("| way | processor seconds | wall | peak MiB | pairs | sum |\n| --- | ---: | ---: | ---: | ---: | ---: |")
    for way, own in found.items():
        cpu, wall, peak = (statistics.median(x[name] for x in own) for name in ("cpu", "wall", "peak"))
        print(f"| {WAYS[way][0]} | {cpu:.2f} | {wall:.1f} | {peak:.0f} | {own[0]['count']} | {own[0]['total']:.1f} |")


def groups(count, runs):
    """Rotated boxes in frames of 50: the pairs above a threshold by one call, and by a call a frame."""
    import geograd

    rng = np.random.default_rng(1)
    a = np.c_[rng.uniform(0, 100, (count, 2)), rng.uniform(3, 5, count), rng.uniform(1.5, 2.5, count), rng.uniform(-3, 3, count)]
    b = a + rng.normal(0, 1, a.shape) * [0.3, 0.3, 0.1, 0.1, 0.05]
    a, b = (geograd.Obb2(x.astype(np.float32)) for x in (a, b))
    offsets = np.append(np.arange(0, count, 50), count)

    def one_call(backend):
        return len(geograd.iou.above(a, b, THRESHOLD, groups=(offsets, offsets), backend=backend)[2])

    def calls(backend):
        frames = [slice(*own) for own in zip(offsets, offsets[1:])]
        return sum(len(geograd.iou.above(a[own], b[own], THRESHOLD, backend=backend)[2]) for own in frames)

    geograd.set_num_threads(1)
    print(f"{count} by {count} boxes in {len(offsets) - 1} frames, one thread\n")
    print("| machine | one call: wall ms | a call a frame: wall ms | pairs |\n| --- | ---: | ---: | ---: |")
    for backend in ("cpu", "gpu"):
        try:
            found = [form(backend) for form in (one_call, calls)]
        except RuntimeError as error:
            print(f"| {backend} | {error} |")
            continue
        walls = []
        for form in (one_call, calls):
            own = []
            for _ in range(runs):
                start = time.perf_counter()
                form(backend)
                own.append(1000 * (time.perf_counter() - start))
            walls.append(statistics.median(own))
        print(f"| {backend} | {walls[0]:.1f} | {walls[1]:.1f} | {found[0]}, {found[1]} |")


def processor_seconds():
    """Processor time of this process and of all that it started, those that ended included."""
    stats, seconds = {}, 0.0
    for path in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = path.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue
        stats[int(path.parent.name)] = int(fields[1]), sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")
    tree = {os.getpid()}
    while more := {own for own, (parent, _) in stats.items() if parent in tree} - tree:
        tree |= more
    for own in tree:
        seconds += stats[own][1]
    return seconds


def tasks(count):
    """Tasks of half a second of processor time each, by two processes of Ray: what there is beside that work."""
    import ray

    import geograd.ray

    ray.init(num_cpus=2, include_dashboard=False, logging_level="error", log_to_driver=False)
    ray.data.DataContext.get_current().enable_progress_bars = False

    def busy(path):
        start = time.process_time()
        while time.process_time() < start + 0.5:
            pass
        return {"path": path}

    geograd.ray.Files(busy).run(range(2))
    before, start = processor_seconds(), time.perf_counter()
    geograd.ray.Files(busy).run(range(count))
    wall, cpu = time.perf_counter() - start, processor_seconds() - before
    print(f"{count} tasks of 0.5 s of processor time by two processes: {wall:.1f} s, {cpu:.1f} s of processor time,")
    print(f"{1000 * (cpu / count - 0.5):.0f} ms of processor time a task beside the work")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["join", "overlay", "groups", "ray", "one"])
    parser.add_argument("--ways", default="read,geograd,calls,inside,datafusion,geopandas")
    parser.add_argument("--boxes", type=float, default=1e6)
    parser.add_argument("--frames", type=float, help="default: 50 boxes a frame")
    parser.add_argument("--buildings", type=float, default=1e5)
    parser.add_argument("--tasks", type=int, default=240)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--data", type=pathlib.Path)
    options = parser.parse_args()
    if options.what == "one":
        return one(options.ways, options.data)
    if options.what == "groups":
        return groups(int(options.boxes), options.runs)
    if options.what == "ray":
        return tasks(options.tasks)
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        if options.what == "join":
            boxes(folder, int(options.boxes), int(options.frames or options.boxes / 50))
            return compare(options.ways.split(","), folder, options.runs)
        for k, name in enumerate("ab"):
            maps().synthetic(folder / f"{name}.parquet", int(options.buildings), k)
        compare(["overlay_geograd", "overlay_geopandas"], folder, options.runs)


if __name__ == "__main__":
    main()

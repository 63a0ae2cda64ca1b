"""Pairs of overlapping buildings of two maps, with the shared area and the IoU of each pair, tile by tile.

    python map_overlay.py                                # two synthetic layers
    python map_overlay.py --a old.parquet --b new.geojson --tile 500
    python map_overlay.py --a old.parquet --b new.parquet --ray 2

Layers are GeoParquet or any file that geopandas reads, in one system of coordinates; degrees are projected to metres first. A
building that crosses the border of tiles is in all of them; a pair counts in the tile of the lower left corner of the box that
their bounds share, so that it comes once. A task computes a row of tiles in one grouped call and writes OUT/rows/ROW.parquet,
whole or not at all. A second run computes the rows that are missing.
"""

import argparse
import functools
import json
import os
import pathlib
import tempfile
import time

import numpy as np

import geograd

try:
    import geopandas
    import pyarrow as pa
    import pyarrow.parquet as parquet
    import shapely
except ImportError as error:
    raise SystemExit(f"{error}: pip install geopandas pyarrow") from None


def write_whole(path, write):
    """Writes a file under another name and renames it, so that no reader and no later run finds half of one."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        write(part)
        with open(part, "rb") as file:
            os.fsync(file.fileno())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def synthetic(path, count, seed, town=7):
    """Buildings in rows of streets: rectangles, pentagons, L shapes; the same town for all seeds, surveyed with errors."""
    rng = np.random.default_rng(town)
    w, h = rng.uniform(8, 18, (2, count)) / 2
    sort = rng.choice(3, count, p=[0.7, 0.15, 0.15])
    turn = rng.normal(0, 0.3, count)
    side = int(np.ceil(np.sqrt(count)))
    place = 22.0 * np.stack([np.arange(count) % side, np.arange(count) // side], -1) + rng.normal(0, 2, (count, 2))
    errors = np.random.default_rng(seed)
    place, turn = place + errors.normal(0, 0.8, (count, 2)), turn + errors.normal(0, 0.02, count)
    there = errors.random(count) < 0.95
    zero = np.zeros(count)
    forms = [
        [(-w, -h), (w, -h), (w, h), (-w, h)],
        [(-w, -h), (w, -h), (w, h / 2), (zero, h), (-w, h / 2)],
        [(-w, -h), (w, -h), (w, zero), (zero, zero), (zero, h), (-w, h)],
    ]
    made = np.empty(count, object)
    for k, form in enumerate(forms):
        own = np.flatnonzero(sort == k)
        xy = np.array([[x[own], y[own]] for x, y in form]).transpose(2, 0, 1)
        sine, cosine = np.sin(turn[own])[:, None], np.cos(turn[own])[:, None]
        xy = np.stack([cosine * xy[..., 0] - sine * xy[..., 1], sine * xy[..., 0] + cosine * xy[..., 1]], -1)
        made[own] = shapely.polygons(xy + place[own, None])
    frame = geopandas.GeoDataFrame({"building": np.flatnonzero(there)}, geometry=made[there], crs="EPSG:32632")
    write_whole(path, frame.to_parquet)


@functools.lru_cache(maxsize=2)
def layer(path, crs=None):
    """Valid single polygons of a file in metres, outer rings counterclockwise, and the row of the file that each is of."""
    try:
        frame = geopandas.read_parquet(path) if path.endswith(".parquet") else geopandas.read_file(path)
    except Exception as error:  # Each format has errors of its own.
        raise ValueError(f"{path}: {str(error).splitlines()[0]}") from None
    if frame.crs is not None and (crs or frame.crs.is_geographic):
        frame = frame.to_crs(crs or frame.estimate_utm_crs())
    frame = frame.explode()
    usable = (frame.geom_type == "Polygon") & frame.is_valid & ~frame.is_empty
    if not usable.any():
        raise ValueError(f"{path}: no valid polygon among {len(frame)} geometries")
    polygons = shapely.orient_polygons(frame.geometry[usable].to_numpy())
    return polygons, frame.index.to_numpy()[usable], frame.crs, int((~usable).sum())


def convex_parts(polygons):
    """Convex quadrilaterals that make up all polygons, and where those of each begin; of a triangle the last vertex twice."""
    rings, rows, owners = shapely.get_exterior_ring(polygons), [], []
    sizes = shapely.get_num_coordinates(rings) - 1
    rest = np.ones(len(polygons), bool)

    def add(xy, owner):
        rows.append(xy.reshape(-1, 8))
        owners.append(owner)

    for size, cuts in ((3, [[0, 1, 2, 2]]), (4, [[0, 1, 2, 3]]), (5, [[0, 1, 2, 3], [0, 3, 4, 4]])):
        own = np.flatnonzero((sizes == size) & (shapely.get_num_interior_rings(polygons) == 0))
        xy = shapely.get_coordinates(rings[own]).reshape(-1, size + 1, 2)[:, :-1]
        edge = np.roll(xy, -1, axis=1) - xy
        following = np.roll(edge, -1, axis=1)
        convex = (edge[..., 0] * following[..., 1] > edge[..., 1] * following[..., 0]).all(axis=1)
        for cut in cuts:
            add(xy[convex][:, cut], own[convex])
        rest[own[convex]] = False
    left = np.flatnonzero(rest)
    triangles, of = shapely.get_parts(shapely.constrained_delaunay_triangles(polygons[left]), return_index=True)
    xy = shapely.get_coordinates(shapely.orient_polygons(triangles)).reshape(-1, 4, 2)
    add(xy[:, [0, 1, 2, 2]], left[of])
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(rows)[order], np.searchsorted(owner[order], np.arange(len(polygons) + 1))


def shared_areas(a, b, i, j):
    """Areas that the polygons a[i] and b[j] share."""
    # Large coordinates cost digits: near the origin.
    shift = np.round(shapely.bounds(a[i])[:, :2].min(axis=0)) if len(i) else np.zeros(2)
    parts = []
    for polygons, chosen in ((a, i), (b, j)):
        used, place = np.unique(chosen, return_inverse=True)
        parts.append((*convex_parts(shapely.transform(polygons[used], lambda xy: xy - shift)), place))
    (rows_a, starts_a, at_a), (rows_b, starts_b, at_b) = parts
    counts_a, counts_b = np.diff(starts_a)[at_a], np.diff(starts_b)[at_b]
    # Every part of one with every part of the other.
    sizes = counts_a * counts_b
    pair = np.repeat(np.arange(len(i)), sizes)
    place = np.arange(len(pair)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    one, other = starts_a[at_a][pair] + place // counts_b[pair], starts_b[at_b][pair] + place % counts_b[pair]
    shared = geograd.intersection_area(geograd.Vec2x4(rows_a[one]), geograd.Vec2x4(rows_b[other]))
    return np.bincount(pair, shared, minlength=len(i)).astype(float)


def in_tiles(bounds, origin, tile, row):
    """Shapes by tile of a row of tiles: those of each tile, one after another, and the offsets of the tiles."""
    low = np.floor((bounds[:, :2] - origin) / tile).astype(np.int64)
    high = np.floor((bounds[:, 2:] - origin) / tile).astype(np.int64)
    own = np.flatnonzero((low[:, 1] <= row) & (high[:, 1] >= row))
    counts = high[own, 0] - low[own, 0] + 1
    shape = np.repeat(own, counts)
    column = np.repeat(low[own, 0], counts) + np.arange(len(shape)) - np.repeat(np.cumsum(counts) - counts, counts)
    order = np.argsort(column, kind="stable")
    return shape[order], column[order]


def overlaps(a, b, origin, tile, row, least):
    """Pairs of a row of tiles, each once: rows of both lists, shared areas, IoU."""
    bounds = [shapely.bounds(x) for x in (a, b)]
    (shape_a, column_a), (shape_b, column_b) = (in_tiles(x, origin, tile, row) for x in bounds)
    columns = np.union1d(column_a, column_b)
    offsets = tuple(np.searchsorted(x, np.append(columns, columns[-1:] + 1)) for x in (column_a, column_b))
    boxes = [geograd.Aabb2(bounds[k][shape] - np.tile(origin, 2)) for k, shape in enumerate((shape_a, shape_b))]
    # All tiles of the row in one call.
    first, second, _ = geograd.intersection_area.above(*boxes, 0.0, groups=offsets)
    i, j = shape_a[first], shape_b[second]
    corner = np.floor((np.maximum(bounds[0][i, :2], bounds[1][j, :2]) - origin) / tile)
    here = (corner[:, 0] == column_a[first]) & (corner[:, 1] == row)
    i, j = i[here], j[here]
    shared = shared_areas(a, b, i, j)
    told = shared > least
    i, j, shared = i[told], j[told], shared[told]
    return i, j, shared, shared / (shapely.area(a[i]) + shapely.area(b[j]) - shared)


def plan(options):
    """The lower left corner of the first tile, and how many rows of tiles there are."""
    bounds = np.array([shapely.total_bounds(own[0]) for own in layers(options)])
    origin = np.floor(bounds[:, :2].min(axis=0) / options["tile"]) * options["tile"]
    return origin, int(np.floor((bounds[:, 3].max() - origin[1]) / options["tile"])) + 1


def layers(options):
    a = layer(options["a"])
    # The second layer in the coordinates of the first.
    return a, layer(options["b"], a[2])


def task(options, row):
    """Computes a row of tiles unless its result is there."""
    path = pathlib.Path(options["out"]) / "rows" / f"{row:06}.parquet"
    if not path.exists():
        a, b = layers(options)
        i, j, shared, iou = overlaps(a[0], b[0], plan(options)[0], options["tile"], row, options["least"])
        own = pa.table({"a": a[1][i], "b": b[1][j], "square_metres": shared, "iou": iou})
        write_whole(path, lambda part: parquet.write_table(own, part))
    return {"path": str(row)}


def row_of(options, path):
    """A task of Ray."""
    return task(options, int(path))


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--a", type=pathlib.Path, help="a layer (default: a synthetic one)")
    parser.add_argument("--b", type=pathlib.Path, help="another layer (default: a synthetic one)")
    parser.add_argument("--count", type=int, default=2000, help="buildings of a synthetic layer (default 2000)")
    parser.add_argument("--tile", type=float, default=250.0, help="the side of a tile (m, default 250)")
    parser.add_argument("--least", type=float, default=0.01, help="the least area that is told (m², default 0.01)")
    parser.add_argument("--ray", type=int, metavar="N", help="run N processes of Ray (default: this process alone)")
    parser.add_argument("--check", action="store_true", help="compare with geopandas.overlay")
    parser.add_argument("--out", type=pathlib.Path, help="a folder for results (default: a temporary one)")
    options = parser.parse_args(arguments)
    if not options.tile > 0:
        raise SystemExit("--tile: a length above zero is needed")
    out = (options.out or pathlib.Path(tempfile.mkdtemp(prefix="map_overlay_"))).absolute()
    (out / "rows").mkdir(parents=True, exist_ok=True)
    files = []
    for k, name in enumerate("ab"):
        path = getattr(options, name)
        if path is None:
            path = out / f"{name}.parquet"
            if not path.exists():
                synthetic(path, options.count, k)
        files.append(str(path.absolute()))
    job = {"a": files[0], "b": files[1], "tile": options.tile, "least": options.least, "out": str(out)}
    start, before = time.perf_counter(), time.process_time()
    # Rows of tiles that are there have to be of the same job.
    written = {**job, "changed": [os.stat(name).st_mtime_ns for name in files if os.path.exists(name)]}
    record = out / "job.json"
    if not record.exists():
        write_whole(record, lambda part: part.write_text(json.dumps(written)))
    elif json.loads(record.read_text()) != written:
        raise SystemExit(f"map_overlay: {out} has results of other layers or options: name another folder by --out")
    try:
        _, rows = plan(job)
        if options.ray:
            try:
                import ray
            except ImportError as error:
                raise SystemExit(f"{error}: pip install 'ray[data]'") from None
            import geograd.ray

            ray.init(num_cpus=options.ray, include_dashboard=False, logging_level="error", log_to_driver=False)
            ray.data.DataContext.get_current().enable_progress_bars = False
            # By its name: a process imports this file, and keeps the layers that it has read.
            import map_overlay

            geograd.ray.Files(functools.partial(map_overlay.row_of, job)).run(range(rows))
        else:
            for row in range(rows):
                task(job, row)
    except (ValueError, OSError) as error:
        raise SystemExit(f"map_overlay: {str(error).strip().splitlines()[-1]}") from None
    found = pa.concat_tables([parquet.read_table(out / "rows" / f"{row:06}.parquet") for row in range(rows)])
    found = found.sort_by([("a", "ascending"), ("b", "ascending"), ("square_metres", "ascending")])
    write_whole(out / "overlaps.parquet", lambda part: parquet.write_table(found, part))
    wall, cpu = time.perf_counter() - start, time.process_time() - before
    a, b = layers(job)
    for own, name in ((a, files[0]), (b, files[1])):
        print(f"{len(own[0])} polygons of {pathlib.Path(name).name}, {own[3]} geometries left out: no valid polygons")
    shared = found["square_metres"].to_numpy()
    print(f"{found.num_rows} pairs share more than {options.least} m², {shared.sum():.2f} m² in all, mean IoU {np.mean(found['iou']):.3f}")
    print(f"{rows} rows of tiles of {options.tile:g} m: {wall:.2f} s, {cpu:.2f} s of processor time of this process")
    if options.check:
        before = time.process_time()
        frames = [geopandas.GeoDataFrame({name: own[1]}, geometry=own[0]) for name, own in zip("ab", (a, b))]
        theirs = geopandas.overlay(*frames, keep_geom_type=True)
        theirs["square_metres"] = theirs.area
        theirs = theirs[theirs.square_metres > options.least].sort_values(["a", "b", "square_metres"])
        took = time.process_time() - before
        same = len(theirs) == found.num_rows and all((theirs[name].to_numpy() == found[name].to_numpy()).all() for name in "ab")
        error = np.abs(theirs.square_metres.to_numpy() - shared).max(initial=0.0) if same else np.inf
        print(f"geopandas.overlay: {len(theirs)} pairs, areas differ by {error:.1e} m² at most, {took:.2f} s of processor time")
        if error > 1e-6:
            raise SystemExit("the two libraries disagree")
    print(f"results in {out}")


if __name__ == "__main__":
    main()

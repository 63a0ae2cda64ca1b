"""Pairs of overlapping buildings of two maps, with the shared area and the IoU of each pair, tile by tile.

    python map_overlay.py                                # two synthetic layers
    python map_overlay.py --a old.parquet --b new.geojson --tile 500
    python map_overlay.py --a old.parquet --b new.parquet --ray 2

Layers are GeoParquet (geometries as WKB) or any file that geopandas reads; degrees are projected to metres first. A building
that crosses the border of tiles is in all of them; a pair counts in the tile of the lower left corner of the box that their bounds
share, so that it comes once.

A first task for every block of a layer (a row group of Parquet, or --block features) writes OUT/parts/LAYER/BLOCK.parquet, where
each row of tiles has row groups of its own. A task for every row of tiles reads these, computes the row in one grouped call and
writes OUT/rows/ROW.parquet. So memory holds a block, a row of tiles or the result, and no layer. Files are written whole or not at
all: a second run computes those that are missing.
"""

import argparse
import functools
import json
import os
import pathlib
import tempfile
import time

import numpy as np

from jobs import each, peak, said, write_whole

import geograd

try:
    import geopandas
    import pyarrow as pa
    import pyarrow.parquet as parquet
    import pyproj
    import shapely
except ImportError as error:
    raise SystemExit(f"{error}: pip install geopandas pyarrow") from None


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


# Blocks of a layer.


@functools.lru_cache(maxsize=2)
def opened(path):
    """A file of Parquet, and the name and system of coordinates of its geometries."""
    file = parquet.ParquetFile(path, pre_buffer=False, buffer_size=1 << 20)
    geo = json.loads((file.schema_arrow.metadata or {}).get(b"geo", b"null"))
    if geo is None:
        raise ValueError("no GeoParquet: the metadata `geo` are missing")
    own = geo["columns"][geo["primary_column"]]
    if own["encoding"] != "WKB":
        raise ValueError(f"geometries are {own['encoding']}, not WKB")
    return file, geo["primary_column"], own.get("crs", "OGC:CRS84")


def named(path, error):
    return ValueError(f"{path}: {str(error).splitlines()[0]}")


def blocks(path, block):
    """The number of blocks of a layer."""
    try:
        if path.endswith(".parquet"):
            return opened(path)[0].metadata.num_row_groups
        import pyogrio

        return -(-pyogrio.read_info(path, force_feature_count=True)["features"] // block)
    except Exception as error:  # Each format has errors of its own.
        raise named(path, error) from None


def geometries(path, number, block):
    """Geometries of a block, at most so many at a time: they, the row of the file of the first, the system of coordinates."""
    try:
        yield from read(path, number, block)
    except Exception as error:
        raise named(path, error) from None


def read(path, number, block):
    if not path.endswith(".parquet"):
        frame = geopandas.read_file(path, rows=slice(number * block, (number + 1) * block))
        yield frame.geometry.to_numpy(), number * block, frame.crs
        return
    file, name, crs = opened(path)
    crs = None if crs is None else pyproj.CRS.from_user_input(crs)
    first = sum(file.metadata.row_group(k).num_rows for k in range(number))
    for batch in file.iter_batches(batch_size=block, row_groups=[number], columns=[name]):
        yield shapely.from_wkb(batch.column(0).to_numpy(zero_copy_only=False)), first, crs
        first += len(batch)


def system_of(path, block):
    """The system of coordinates in which a layer is computed, as text; empty where the file names none."""
    for _, (own, _, crs) in zip(range(1), geometries(path, 0, block)):
        if crs is None:
            return ""
        own = geopandas.GeoSeries(own, crs=crs)
        return (own.estimate_utm_crs() if own.crs.is_geographic else own.crs).to_wkt()
    return ""


def polygons(own, crs, system):
    """Valid single polygons of geometries in a system of coordinates, outer rings counterclockwise; which geometry each is of;
    how many parts of geometries are none."""
    single, of = shapely.get_parts(own, return_index=True)
    if crs is not None and system:
        single = geopandas.GeoSeries(single, crs=crs).to_crs(system).to_numpy()
    usable = (shapely.get_type_id(single) == 3) & shapely.is_valid(single) & ~shapely.is_empty(single)
    left_out = int((~usable).sum() + shapely.is_missing(own).sum())
    return shapely.orient_polygons(single[usable]), of[usable], left_out


def block_task(options, path):
    """Writes the polygons of a block by rows of tiles, unless they are there."""
    layer, number = path.split("/")
    to = pathlib.Path(options["out"]) / "parts" / layer / f"{int(number):06}.parquet"
    if not to.exists():
        write_whole(to, functools.partial(write_block, options, options[layer], int(number)))
    return {"path": path, "peak": peak()}


def write_block(options, path, number, to):
    counts = [0, 0]
    schema = pa.schema([("row", pa.int64()), ("id", pa.int64()), ("polygon", pa.binary())])
    with parquet.ParquetWriter(to, schema) as writer:
        for own, first, crs in geometries(path, number, options["block"]):
            own, of, left_out = polygons(own, crs, options["system"])
            counts = [counts[0] + len(own), counts[1] + left_out]
            bounds = shapely.bounds(own)
            low, high = (np.floor(bounds[:, k] / options["tile"]).astype(np.int64) for k in (1, 3))
            shape, row = repeated(np.arange(len(own)), low, high)
            order = np.argsort(row, kind="stable")
            shape, row = shape[order], row[order]
            table = pa.table([row, of[shape] + first, shapely.to_wkb(own[shape])], schema=schema)
            ends = np.flatnonzero(np.diff(row, prepend=row[:1] - 1, append=row[-1:] + 1))
            for start, end in zip(ends[:-1], ends[1:]):
                # A row group: what a task reads.
                writer.write_table(table.slice(start, end - start))
        writer.add_key_value_metadata({"counts": json.dumps(counts)})


def repeated(shapes, low, high):
    """Every shape once for each of its tiles from `low` to `high`: the shape, and the tile."""
    counts = high - low + 1
    tile = np.repeat(low, counts) + np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    return np.repeat(shapes, counts), tile


@functools.lru_cache(maxsize=None)
def index(folder, layer):
    """The files of the blocks of a layer: the row groups of each by row of tiles, and how many polygons and others it has."""
    files = []
    for path in sorted((pathlib.Path(folder) / "parts" / layer).glob("*.parquet")):
        metadata, groups = parquet.read_metadata(path), {}
        for k in range(metadata.num_row_groups):
            groups.setdefault(metadata.row_group(k).column(0).statistics.min, []).append(k)
        files.append((path, groups, json.loads(metadata.metadata[b"counts"])))
    return files


def row_of_layer(options, layer, row):
    """The polygons of a layer in a row of tiles, and the row of the file that each is of."""
    parts = [
        parquet.ParquetFile(path).read_row_groups(groups[row], columns=["id", "polygon"])
        for path, groups, _ in index(options["out"], layer) if row in groups
    ]
    table = pa.concat_tables(parts)
    return shapely.from_wkb(table["polygon"].to_numpy()), table["id"].to_numpy()


# A row of tiles.


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


def in_tiles(bounds, tile):
    """Shapes by tile of a row of tiles: those of each tile, one after another, and the tiles."""
    low, high = (np.floor(bounds[:, k] / tile).astype(np.int64) for k in (0, 2))
    shape, column = repeated(np.arange(len(bounds)), low, high)
    order = np.argsort(column, kind="stable")
    return shape[order], column[order]


def overlaps(a, b, tile, row, least):
    """Pairs of the polygons of a row of tiles, each once: rows of both lists, shared areas, IoU."""
    bounds = [shapely.bounds(x) for x in (a, b)]
    (shape_a, column_a), (shape_b, column_b) = (in_tiles(x, tile) for x in bounds)
    columns = np.union1d(column_a, column_b)
    offsets = tuple(np.searchsorted(x, np.append(columns, columns[-1:] + 1)) for x in (column_a, column_b))
    # Large coordinates cost digits: near the origin.
    shift = np.tile(bounds[0][:1, :2].ravel(), 2)
    boxes = [geograd.Aabb2(bounds[k][shape] - shift) for k, shape in enumerate((shape_a, shape_b))]
    # All tiles of the row in one call.
    first, second, _ = geograd.intersection_area.above(*boxes, 0.0, groups=offsets)
    i, j = shape_a[first], shape_b[second]
    corner = np.floor(np.maximum(bounds[0][i, :2], bounds[1][j, :2]) / tile)
    here = (corner[:, 0] == column_a[first]) & (corner[:, 1] == row)
    i, j = i[here], j[here]
    shared = shared_areas(a, b, i, j)
    told = shared > least
    i, j, shared = i[told], j[told], shared[told]
    return i, j, shared, shared / (shapely.area(a[i]) + shapely.area(b[j]) - shared)


def row_task(options, row):
    """Computes a row of tiles unless its result is there."""
    path = pathlib.Path(options["out"]) / "rows" / f"{row}.parquet"
    if not path.exists():
        (a, rows_a), (b, rows_b) = (row_of_layer(options, layer, int(row)) for layer in "ab")
        i, j, shared, iou = overlaps(a, b, options["tile"], int(row), options["least"])
        own = pa.table({"a": rows_a[i], "b": rows_b[j], "square_metres": shared, "iou": iou})
        write_whole(path, lambda part: parquet.write_table(own, part))
    return {"path": row, "peak": peak()}


def whole(path, system):
    """All polygons of a layer, and the row of the file that each is of; for comparisons."""
    parts = []
    for number in range(blocks(path, 1 << 20)):
        for own, first, crs in geometries(path, number, 1 << 20):
            own, of, _ = polygons(own, crs, system)
            parts.append((own, of + first))
    return tuple(np.concatenate(x) for x in zip(*parts))


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--a", type=pathlib.Path, help="a layer (default: a synthetic one)")
    parser.add_argument("--b", type=pathlib.Path, help="another layer (default: a synthetic one)")
    parser.add_argument("--count", type=int, default=2000, help="buildings of a synthetic layer (default 2000)")
    parser.add_argument("--tile", type=float, default=250.0, help="the side of a tile (m, default 250)")
    parser.add_argument("--least", type=float, default=0.01, help="the least area that is told (m², default 0.01)")
    parser.add_argument("--block", type=int, default=1 << 16, help="geometries that are read at a time (default 65536)")
    parser.add_argument("--ray", type=int, metavar="N", help="run N processes of Ray (default: this process alone)")
    parser.add_argument("--check", action="store_true", help="compare with geopandas.overlay")
    parser.add_argument("--out", type=pathlib.Path, help="a folder for results (default: a temporary one)")
    options = parser.parse_args(arguments)
    if not options.tile > 0:
        raise SystemExit("--tile: a length above zero is needed")
    if options.block < 1:
        raise SystemExit("--block: a number above zero is needed")
    out = (options.out or pathlib.Path(tempfile.mkdtemp(prefix="map_overlay_"))).absolute()
    for name in ("rows", "parts/a", "parts/b"):
        (out / name).mkdir(parents=True, exist_ok=True)
    files = []
    for k, name in enumerate("ab"):
        path = getattr(options, name)
        if path is None:
            path = out / f"{name}.parquet"
            if not path.exists():
                synthetic(path, options.count, k)
        files.append(str(path.absolute()))
    start, before = time.perf_counter(), time.process_time()
    # Results that are there have to be of the same job.
    job = {"a": files[0], "b": files[1], "tile": options.tile, "least": options.least, "block": options.block, "out": str(out)}
    written = {**job, "changed": [os.stat(name).st_mtime_ns for name in files if os.path.exists(name)]}
    record = out / "job.json"
    if not record.exists():
        write_whole(record, lambda part: part.write_text(json.dumps(written)))
    elif json.loads(record.read_text()) != written:
        raise SystemExit(f"map_overlay: {out} has results of other layers or options: name another folder by --out")
    # By its name: a process of Ray imports this file.
    import map_overlay

    try:
        # The second layer in the coordinates of the first.
        job["system"] = system_of(job["a"], options.block)
        numbers = [f"{layer}/{k}" for layer in "ab" for k in range(blocks(job[layer], options.block))]
        done = each(functools.partial(map_overlay.block_task, job), numbers, options.ray)
        counts = [np.sum([counts for _, _, counts in index(str(out), layer)], axis=0) for layer in "ab"]
        for layer, own in zip("ab", counts):
            if not own.any() or own[0] == 0:
                raise ValueError(f"{job[layer]}: no valid polygon among {int(np.sum(own))} geometries")
        rows = [{row for _, groups, _ in index(str(out), layer) for row in groups} for layer in "ab"]
        rows = sorted(rows[0] & rows[1])
        done += each(functools.partial(map_overlay.row_task, job), rows, options.ray)
    except (ValueError, OSError) as error:
        raise SystemExit(f"map_overlay: {said(error)}") from None
    empty = pa.table({"a": pa.array([], pa.int64()), "b": pa.array([], pa.int64()), "square_metres": pa.array([], pa.float64())})
    empty = empty.append_column("iou", pa.array([], pa.float64()))
    found = pa.concat_tables([empty, *(parquet.read_table(out / "rows" / f"{row}.parquet") for row in rows)])
    found = found.sort_by([("a", "ascending"), ("b", "ascending"), ("square_metres", "ascending")])
    write_whole(out / "overlaps.parquet", lambda part: parquet.write_table(found, part))
    wall, cpu = time.perf_counter() - start, time.process_time() - before
    for own, name in zip(counts, files):
        print(f"{own[0]} polygons of {pathlib.Path(name).name}, {own[1]} geometries left out: no valid polygons")
    shared = found["square_metres"].to_numpy()
    mean = np.mean(found["iou"]) if found.num_rows else 0.0
    print(f"{found.num_rows} pairs share more than {options.least} m², {shared.sum():.2f} m² in all, mean IoU {mean:.3f}")
    print(f"{len(rows)} rows of tiles of {options.tile:g} m: {wall:.2f} s, {cpu:.2f} s of processor time of this process")
    print(f"peak memory of a process: {max([row['peak'] for row in done] + [peak()]) / 1024:.0f} MiB")
    if options.check:
        before = time.process_time()
        layers = [whole(path, job["system"]) for path in files]
        frames = [geopandas.GeoDataFrame({name: own[1]}, geometry=own[0]) for name, own in zip("ab", layers)]
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

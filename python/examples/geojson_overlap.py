"""Finds the polygons of a GeoJSON file that overlap, and by how much; shapely computes the same areas for comparison.

    python geojson_overlap.py                              # synthetic footprints of buildings
    python geojson_overlap.py --file footprints.geojson

The library takes three kinds of polygons here:
  * boxes along the axes (Aabb2): the bounds, for the search of pairs
  * convex polygons of up to five vertices (ConvexPolygon5): area of intersection
  * rings of any length (Rings): area of one polygon
Concave polygons, longer ones and ones with holes are cut into triangles by shapely first.
"""

import argparse
import pathlib
import tempfile

import numpy as np

import geograd

try:
    import geopandas
    import shapely
    import shapely.affinity
except ImportError as error:
    raise SystemExit(f"{error}: pip install geopandas") from None


def synthetic(path, count, rng):
    """Footprints in a town: rectangles, pentagons, L shapes and courts, some of them in conflict with a neighbour."""
    made = []
    side = int(np.ceil(np.sqrt(count)))
    for k in range(count):
        sort = rng.choice(["rectangle", "pentagon", "L", "court"], p=[0.5, 0.2, 0.2, 0.1])
        w, h = rng.uniform(8, 18, 2)
        if sort == "rectangle":
            shape = shapely.box(-w / 2, -h / 2, w / 2, h / 2)
        elif sort == "pentagon":
            shape = shapely.Polygon([(-w / 2, -h / 2), (w / 2, -h / 2), (w / 2, h / 4), (0, h / 2), (-w / 2, h / 4)])
        elif sort == "L":
            shape = shapely.Polygon([(-w / 2, -h / 2), (w / 2, -h / 2), (w / 2, 0), (0, 0), (0, h / 2), (-w / 2, h / 2)])
        else:
            shape = shapely.box(-w / 2, -h / 2, w / 2, h / 2) - shapely.box(-w / 5, -h / 5, w / 5, h / 5)
        x, y = 18 * (k % side) + rng.normal(0, 2), 18 * (k // side) + rng.normal(0, 2)
        shape = shapely.affinity.rotate(shape, rng.normal(0, 15))
        made.append(shapely.affinity.translate(shape, 500_000 + x, 5_400_000 + y))
    frame = geopandas.GeoDataFrame({"building": range(count)}, geometry=made, crs="EPSG:32632")
    frame.to_crs("EPSG:4326").to_file(path, driver="GeoJSON")


def metric(frame):
    """Single valid polygons in metres, outer rings counterclockwise, about their common centre."""
    if frame.crs is not None and frame.crs.is_geographic:
        frame = frame.to_crs(frame.estimate_utm_crs())
    frame = frame.explode(ignore_index=True)
    usable = (frame.geom_type == "Polygon") & frame.is_valid & ~frame.is_empty
    if not usable.all():
        print(f"{(~usable).sum()} geometries left out: no valid polygons")
    polygons = shapely.orient_polygons(frame.geometry[usable].to_numpy())
    if not len(polygons):
        raise SystemExit("the file has no polygons")
    # Coordinates of a projection have seven digits before the point.
    low_x, low_y, high_x, high_y = shapely.total_bounds(polygons)
    centre = [(low_x + high_x) / 2, (low_y + high_y) / 2]
    return shapely.transform(polygons, lambda xy: xy - centre)


def is_small_and_convex(polygon):
    """True for a ring of at most five vertices that turns left at all of them."""
    xy = shapely.get_coordinates(polygon)[:-1]
    if len(xy) > 5 or shapely.get_num_interior_rings(polygon):
        return False
    edge = np.roll(xy, -1, axis=0) - xy
    following = np.roll(edge, -1, axis=0)
    return bool(np.all(edge[:, 0] * following[:, 1] - edge[:, 1] * following[:, 0] > 0))


def convex_parts(polygons):
    """Convex polygons that make up all polygons, and where those of each begin."""
    rows, offsets = [], [0]
    for polygon in polygons:
        parts = [polygon]
        if not is_small_and_convex(polygon):
            parts = shapely.orient_polygons(shapely.get_parts(shapely.constrained_delaunay_triangles(polygon)))
        for part in parts:
            xy = shapely.get_coordinates(part)[:-1]
            # Five vertices, of which as many count as the last number says.
            row = np.zeros(11)
            row[: 2 * len(xy)] = xy.ravel()
            row[10] = len(xy)
            rows.append(row)
        offsets.append(len(rows))
    return np.array(rows), np.array(offsets)


def overlaps(polygons):
    """Pairs of polygons, i < j, whose bounds overlap, and their areas of intersection."""
    bounds = geograd.Aabb2(shapely.bounds(polygons))
    i, j, _ = geograd.intersection_area.above(bounds, bounds, 0.0)
    i, j = i[i < j], j[i < j]
    parts, offsets = convex_parts(polygons)
    counts = np.diff(offsets)
    # Every part of one with every part of the other.
    sizes = counts[i] * counts[j]
    pair = np.repeat(np.arange(len(i)), sizes)
    place = np.arange(len(pair)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    a = offsets[i][pair] + place // counts[j][pair]
    b = offsets[j][pair] + place % counts[j][pair]
    shared = geograd.intersection_area(geograd.ConvexPolygon5(parts[a]), geograd.ConvexPolygon5(parts[b]))
    return i, j, np.bincount(pair, shared, minlength=len(i)), len(parts)


def areas(polygons):
    """Areas of polygons, holes taken away, by the signed areas of their rings."""
    rings, owner = shapely.get_rings(polygons, return_index=True)
    return np.bincount(owner, geograd.signed_area(geograd.Rings.of(rings)))


def draw(path, polygons, i, j):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7, 7))
    geopandas.GeoSeries(polygons).plot(ax=axes, facecolor="0.85", edgecolor="0.4", linewidth=0.8)
    if len(i):
        shared = shapely.intersection(polygons[i], polygons[j])
        geopandas.GeoSeries(shared).plot(ax=axes, facecolor="tab:red", edgecolor="tab:red", linewidth=0.8)
    axes.set(xlabel="east (m)", ylabel="north (m)", title=f"{len(polygons)} polygons, {len(i)} overlaps (red)")
    axes.set_aspect("equal")
    figure.savefig(path, dpi=110, bbox_inches="tight")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--file", type=pathlib.Path, help="a file with polygons (default: a synthetic one)")
    parser.add_argument("--count", type=int, default=400, help="polygons of the synthetic file (default 400)")
    parser.add_argument("--least", type=float, default=0.01, help="the least area that is told (m², default 0.01)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, help="a folder for results (default: a temporary one)")
    options = parser.parse_args(arguments)
    out = options.out or pathlib.Path(tempfile.mkdtemp(prefix="geojson_overlap_"))
    out.mkdir(parents=True, exist_ok=True)

    file = options.file
    if file is None:
        file = out / "footprints.geojson"
        synthetic(file, options.count, np.random.default_rng(options.seed))
    polygons = metric(geopandas.read_file(file))

    i, j, shared, parts = overlaps(polygons)
    theirs = shapely.area(shapely.intersection(polygons[i], polygons[j]))
    area_error = np.abs(areas(polygons) - shapely.area(polygons)).max()
    overlap_error = np.abs(shared - theirs).max(initial=0.0)

    told = np.flatnonzero(shared > options.least)
    told = told[np.argsort(-shared[told])]
    with open(out / "overlaps.csv", "w") as table:
        table.write("first,second,square_metres\n")
        table.writelines(f"{i[k]},{j[k]},{shared[k]:.6f}\n" for k in told)
    draw(out / "overlaps.png", polygons, i[told], j[told])

    print(f"{len(polygons)} polygons, {parts} convex parts, {len(i)} pairs of boxes that overlap")
    print(f"{len(told)} pairs share more than {options.least} m², {shared[told].sum():.2f} m² in all")
    for k in told[:5]:
        print(f"  {i[k]:5} and {j[k]:5}: {shared[k]:8.3f} m²")
    print(f"against shapely: areas differ by {area_error:.1e} m² at most, overlaps by {overlap_error:.1e} m²")
    print(f"results in {out}")
    if overlap_error > 1e-6 or area_error > 1e-6:
        raise SystemExit("the two libraries disagree")


if __name__ == "__main__":
    main()

"""Verbs of polygons and paths as formulas of their numbers, of which torch and JAX take second derivatives.

A formula takes as given what the library has decided: how rings turn and lie in each other, and which edges are nearest.
"""

import numpy as np

from . import _core, _polygons, _separation

#: A turn by one radian, after which hardly an edge that people draw is vertical: the sums below divide by widths.
COS, SIN = float(np.cos(1.0)), float(np.sin(1.0))
_LINES = ("length", "perimeter")
_DISTANCES = ("depth", "distance", "signed_distance")


def kind_of(of):
    """The formula of an operation; None where it has none."""
    is_flat = all(own.width == 2 or not hasattr(own, "ends") for own in of.layouts)
    if of.verb in _LINES:
        return "lines"
    if of.verb in _DISTANCES and is_flat:
        return "nearest"
    if is_flat and of.verb in ("area", "signed_area", "centroid"):
        return "turns"
    return "overlap" if of.verb in _polygons.OVERLAPS else None


def following(layout):
    """The vertex after each one; of the last one of an open path it is itself."""
    rings = layout.offsets[0]
    made = np.arange(1, rings[-1] + 1)
    full = rings[:-1] < rings[1:]
    last = rings[1:][full] - 1
    made[last] = last if layout.cls.__name__ == "Polylines" else rings[:-1][full]
    return made


def owner(ends):
    """The item of each vertex."""
    return np.repeat(np.arange(len(ends) - 1), np.diff(ends))


def ranges(starts, counts):
    """The whole numbers of ranges, one range after the other."""
    ends = np.cumsum(counts)
    return np.arange(ends[-1] if len(ends) else 0) + np.repeat(starts - ends + counts, counts)


def _outline(layout, column):
    """The outline of a column of a layout, or of rows of a shape."""
    if not hasattr(layout, "ends"):
        if layout.kind != "Vec2":
            return _separation.outline(column)
        counts = np.arange(layout.count + 1)
        return _separation.Outline(np.asarray(column.array), counts[:-1], counts, counts[:-1], counts, None, None)
    return _separation.Outline(column.vertices, following(layout), layout.ends, None, None, None, None)


def _signs(layout, column, verb):
    """The factor of each ring's signed area in the area of its item: 1, or -1."""
    import geograd

    rings = len(layout.offsets[0]) - 1
    if verb == "signed_area":
        return np.ones(rings)
    by = np.asarray(geograd.area.vjp(column, np.ones(layout.count, column.vertices.dtype)))
    after = following(layout)
    before = np.empty_like(after)
    before[after] = np.arange(len(after))
    v = column.vertices
    raw = np.stack([v[after, 1] - v[before, 1], v[before, 0] - v[after, 0]], 1)
    return np.where(np.bincount(owner(layout.offsets[0]), (by * raw).sum(1), rings) < 0, -1.0, 1.0)


def choices(of, columns):
    """The numbers and places that the formula of an operation takes as given."""
    kind = kind_of(of)
    if kind in ("turns", "overlap"):
        return [_signs(layout, column, of.verb) for layout, column in zip(of.layouts, columns)]
    if kind != "nearest":
        return []
    import geograd

    value = np.asarray(getattr(geograd, of.verb)(*columns))
    _, *edges, _ = _separation.nearest(*[_outline(*own) for own in zip(of.layouts, columns)], of.count)
    return [np.sign(value), *edges]


def sizes(of):
    """The kinds and the counts of the choices of an operation."""
    of, kind = of.whole, kind_of(of)
    if kind in ("turns", "overlap"):
        return [("float", len(own.offsets[0]) - 1) for own in of.layouts]
    return [("float", of.count), ("int", of.count), ("int", of.count)] if kind == "nearest" else []


def value(xp, of, given, xs):
    """The results of an operation by its formula, in the functions of an array library."""
    return _value(xp, of.whole, given, of.spread(xs)).reshape(of.size)


def _value(xp, of, given, xs):
    kind = kind_of(of)
    if kind == "overlap":
        return _overlap(xp, of, given, xs)
    if kind == "nearest":
        return _nearest(xp, of, given, xs)
    (layout,), (x,) = of.layouts, xs
    after, own = following(layout), owner(layout.ends)
    if kind == "lines":
        return xp.sums(_length(xp, x[after] - x), own, layout.count)
    return _turns(xp, of.verb, layout, xp.constant(given[0], x), x, after, own)


def _length(xp, v):
    """The length of vectors, with derivative zero where it is zero."""
    square = (v * v).sum(-1)
    return xp.where(square > 0, xp.sqrt(xp.where(square > 0, square, 1.0)), 0.0)


def _turns(xp, verb, layout, signs, x, after, own):
    if not len(own):
        return x.sum() * xp.constant(np.zeros((layout.count, 2) if verb == "centroid" else layout.count), x)
    # From the first vertex of each item, for its digits.
    start = x[np.minimum(layout.ends[:-1], len(own) - 1)]
    p = x - start[own]
    q = p[after]
    cross = (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) * signs[owner(layout.offsets[0])]
    area = xp.sums(cross, own, layout.count) / 2
    if verb != "centroid":
        return area
    is_none = (area == 0)[:, None]
    moments = xp.sums((p + q) * cross[:, None], own, layout.count) / 6
    counts = xp.constant(np.maximum(np.diff(layout.ends), 1.0), x)[:, None]
    mean = xp.sums(p, own, layout.count) / counts
    return start + xp.where(is_none, mean, moments / xp.where(is_none, 1.0, area[:, None]))


def _spot(xp, p, a, b):
    """The distance of points from segments."""
    along = b - a
    square = (along * along).sum(-1)
    t = ((p - a) * along).sum(-1) / xp.where(square > 0, square, 1.0)
    t = xp.where(t < 0, 0.0, xp.where(t > 1, 1.0, t))
    return _length(xp, p - a - t[:, None] * along)


def _corners(xp, layout, x):
    """The vertices of a column, or of rows of a shape, and the vertex after each."""
    if hasattr(layout, "ends"):
        return x, following(layout)
    kind, count = layout.kind, layout.count
    if kind == "Vec2":
        return x, np.arange(count)
    if kind == "Obb2":
        cos, sin = xp.cos(x[:, 4]), xp.sin(x[:, 4])
        corners = []
        for along, across in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            u, v = along * x[:, 2], across * x[:, 3]
            corners += [x[:, 0] + u * cos - v * sin, x[:, 1] + u * sin + v * cos]
        x = xp.stack(corners, -1)
    else:
        x = x[:, np.array(_separation.CORNERS[kind])]
    size = x.shape[1] // 2
    places = np.arange(count * size).reshape(count, size)
    turned = places[:, ::-1] if kind in ("Segment2", "Capsule2") else np.roll(places, -1, 1)
    return x.reshape(-1, 2), turned.reshape(-1)


def _nearest(xp, of, given, xs):
    signs, *edges = given
    ends = []
    for layout, x, edge in zip(of.layouts, xs, edges):
        vertices, after = _corners(xp, layout, x)
        ends.append((vertices[edge], vertices[xp.whole(after)[edge]]))
    (a, b), (c, d) = ends
    gaps = [_spot(xp, a, c, d), _spot(xp, b, c, d), _spot(xp, c, a, b), _spot(xp, d, a, b)]
    low = gaps[0]
    for gap in gaps[1:]:
        low = xp.where(gap < low, gap, low)
    for layout, x in zip(of.layouts, xs):
        if getattr(layout, "kind", None) in _separation.RADII:
            low = low - x[:, _separation.RADII[layout.kind]]
    return xp.constant(signs, xs[0]) * low


def _overlap(xp, of, given, xs):
    """Areas that two polygons share, by sums over all pairs of their edges."""
    count, ends, areas = of.count, [], []
    for layout, x, signs in zip(of.layouts, xs, given):
        items = np.zeros(count, np.int64) if layout.count == 1 else np.arange(count)
        signs, after = xp.constant(signs, x), following(layout)
        area = _turns(xp, "area", layout, signs, x, after, owner(layout.ends))
        areas.append(area[items])
        counts = np.diff(layout.ends)[items]
        places, rows = ranges(layout.ends[:-1][items], counts), np.repeat(np.arange(count), counts)
        ends.append((x, after, signs[owner(layout.offsets[0])], places, rows, counts))
    # Each edge of `a` with all edges of `b` of its row.
    (x, after_x, signs_x, places_x, rows, _), (y, after_y, signs_y, places_y, _, counts) = ends
    starts = np.cumsum(counts) - counts
    of_x = np.repeat(places_x, counts[rows])
    of_y = places_y[ranges(starts[rows], counts[rows])]
    rows = np.repeat(rows, counts[rows])
    if not len(rows):
        shared = (x.sum() + y.sum()) * xp.constant(np.zeros(count), x)
    else:
        # From a vertex of `a`, for the digits.
        first = x[np.minimum(of.layouts[0].ends[:-1], len(after_x) - 1)]
        origin = first[np.zeros(len(rows), np.int64) if len(first) == 1 else rows]
        turned = [_turned(xp, z[place] - origin) for z, place in ((x, of_x), (x, after_x[of_x]), (y, of_y), (y, after_y[of_y]))]
        shared = xp.sums(_below(xp, *turned) * signs_x[of_x] * signs_y[of_y], rows, count)
    a, b = areas
    if of.verb == "intersection_area":
        return shared
    union = a + b - shared
    if of.verb == "union_area":
        return union
    whole = a if of.verb == "iof" else union
    return xp.where(whole > 0, shared / xp.where(whole > 0, whole, 1.0), 0.0)


def _turned(xp, v):
    """Coordinates after a turn by one radian."""
    return v[:, 0] * COS - v[:, 1] * SIN, v[:, 0] * SIN + v[:, 1] * COS


def _below(xp, p, q, r, s):
    """The signed area below both of two edges, which is that of two polygons once it is summed over all of their edges.

    An edge that runs to the left has the sign 1: it bounds from above what is inside of a counter-clockwise ring.
    """
    lines = []
    for (x0, y0), (x1, y1) in ((p, q), (r, s)):
        is_left = x1 < x0
        slope = (y1 - y0) / xp.where(x1 == x0, 1.0, x1 - x0)
        lines.append((xp.where(is_left, x1, x0), xp.where(is_left, x0, x1), x0, y0, slope, is_left))
    (low_a, high_a, x_a, y_a, slope_a, left_a), (low_b, high_b, x_b, y_b, slope_b, left_b) = lines
    low, high = xp.where(low_a > low_b, low_a, low_b), xp.where(high_a < high_b, high_a, high_b)
    at = lambda x: (y_a + slope_a * (x - x_a), y_b + slope_b * (x - x_b))
    (a0, b0), (a1, b1) = at(low), at(high)
    g, h = a0 - b0, a1 - b1
    # The mean of the smaller one of 0 and a line from g to h.
    depth = xp.where(g < 0, -g, 0.0) + xp.where(h < 0, -h, 0.0)
    height = xp.where(g > 0, g, 0.0) + xp.where(h > 0, h, 0.0)
    crosses = (g < 0) != (h < 0)
    fall = xp.where(crosses, depth * depth / xp.where(depth + height > 0, depth + height, 1.0), depth) / 2
    area = (high - low) * ((b0 + b1) / 2 - fall)
    return xp.where(high > low, xp.where(left_a == left_b, area, -area), 0.0)

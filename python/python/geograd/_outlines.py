"""Outlines of shapes and rings as the formats of geographic data have them: the first vertex again after the last."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

import geograd

Array = NDArray[Any]


def corners(shapes: geograd.Shape) -> Optional[Array]:
    """The corners of boxes, triangles and quadrilaterals, of shape (N, V, 2) in float64; None of other shapes."""
    kind, array = type(shapes).__name__, np.asarray(shapes.array, np.float64)
    rows = array.reshape(-1, array.shape[-1])
    if kind == "Aabb2":
        return rows[:, [0, 1, 2, 1, 2, 3, 0, 3]].reshape(-1, 4, 2)
    if kind == "Obb2":
        rows = np.asarray(geograd.corners(geograd.Obb2(rows)).array)
    return rows.reshape(len(rows), rows.shape[1] // 2, 2) if kind in ("Obb2", "Triangle2", "Vec2x4") else None


def closed(rings: geograd.Paths) -> Tuple[Array, Array]:
    """The vertices of rings, the first of each again after its last, and their offsets."""
    vertices, offsets = np.asarray(rings.vertices, np.float64), np.asarray(rings.offsets, np.int64)
    counts = np.diff(offsets)
    if (counts < 3).any():
        row = int(np.flatnonzero(counts < 3)[0])
        raise ValueError(f"ring {row} has {counts[row]} vertices, and a polygon at least 3")
    return repeated(vertices, offsets, counts), offsets + np.arange(len(offsets))


def repeated(vertices: Array, offsets: Array, counts: Array) -> Array:
    """The vertices of rings of so many vertices, the first of each again after its last."""
    made = np.empty((len(vertices) + len(counts), vertices.shape[1]), vertices.dtype)
    if len(counts) and (counts == counts[0]).all():
        rows = made.reshape(len(counts), -1, vertices.shape[1])
        rows[:, :-1] = vertices.reshape(len(counts), -1, vertices.shape[1])
        rows[:, -1] = rows[:, 0]
        return made
    places = np.arange(len(made)) - np.repeat(np.arange(len(counts)), counts + 1)
    places[offsets[1:] + np.arange(len(counts))] = offsets[:-1]
    return vertices.take(places, axis=0, out=made)


def opened(vertices: Array, offsets: Array) -> Tuple[Array, Array]:
    """The vertices of closed rings without the last of each, and their offsets."""
    if len(offsets) == 1:
        return vertices[:0], offsets
    count = int(offsets[1])
    if count * (len(offsets) - 1) == len(vertices) and (np.diff(offsets) == count).all():
        # Rings of one length are a slice, which copies faster than a choice.
        kept = vertices.reshape(-1, count, vertices.shape[1])[:, :-1].reshape(-1, vertices.shape[1])
    else:
        keep = np.ones(len(vertices), bool)
        keep[offsets[1:] - 1] = False
        kept = vertices.compress(keep, axis=0)
    return kept, offsets - np.arange(len(offsets))


def turned(rings: geograd.Rings, is_outer: Array) -> geograd.Rings:
    """Outer rings counter-clockwise, holes clockwise."""
    if not len(rings):
        return rings
    vertices, offsets = np.asarray(rings.vertices), np.asarray(rings.offsets, np.int64)
    of = np.repeat(np.arange(len(rings)), np.diff(offsets))
    wrong = ((geograd.signed_area(rings) > 0) != is_outer)[of]
    places = np.arange(len(vertices))
    return geograd.Rings(vertices[np.where(wrong, offsets[of] + offsets[of + 1] - 1 - places, places)], offsets)

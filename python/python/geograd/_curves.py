"""Paths of lines, circular arcs and Bézier curves, and Delaunay triangulations of points."""

import re

import numpy as np

from . import _core

# How many numbers each of SVG's commands takes.
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "Q": 4, "T": 2, "C": 6, "S": 4, "A": 7, "Z": 0}


def _points(points, name="points"):
    points = np.asarray(points)
    if points.ndim != 2 or points.shape[1] != 2:
        raise ValueError(f"{name}: an array of shape (N, 2) is needed, not {points.shape}")
    return np.ascontiguousarray(points, np.float64)


def _bars(bars, shape, name):
    bars = np.ascontiguousarray(bars, np.float64)
    if bars.shape != shape:
        raise ValueError(f"{name}: an array of shape {shape} is needed, not {bars.shape}")
    return bars


def _bulge(start, to, radius, is_large, is_positive):
    """The bulge of an arc in SVG's end-point notation."""
    half = 0.5 * np.hypot(*(to - start))
    if half == 0 or radius == 0:
        return 0.0
    ratio = min(half / abs(radius), 1.0)
    bulge = ratio / (1 + np.sqrt((1 - ratio) * (1 + ratio)))
    bulge = 1 / bulge if is_large else bulge
    return bulge if is_positive else -bulge


def _ellipse(start, to, own, tolerance):
    """The numbers of cubic curves for an arc of an ellipse in SVG's end-point notation, six for each; none for a line."""
    radii, turn = np.abs(own[:2]), np.deg2rad(own[2])
    if not radii.all() or (start == to).all():
        return np.zeros(0)
    axes = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    # Coordinates in which the ellipse is a circle of radius one; radii that do not reach are scaled.
    half = 0.5 * ((to - start) @ axes) / radii
    reach = np.hypot(*half)
    radii = radii * max(reach, 1.0)
    half = half / max(reach, 1.0)
    square = half @ half
    way = np.sqrt(max(1 - square, 0.0) / square) * (1 if bool(own[3]) != bool(own[4]) else -1)
    middle = way * np.array([-half[1], half[0]])
    first, last = -half - middle, half - middle
    begin = np.arctan2(first[1], first[0])
    sweep = np.arctan2(first[0] * last[1] - first[1] * last[0], first @ last)
    if own[4] and sweep < 0:
        sweep += 2 * np.pi
    elif not own[4] and sweep > 0:
        sweep -= 2 * np.pi
    # One curve is off the unit circle by `2/27 sin^6 / cos^2` of a quarter of its angle (Goldapp 1991).
    count = max(int(np.ceil(2 * abs(sweep) / np.pi)), 1)
    quarter = abs(sweep) / 4
    allowed = tolerance / radii.max() if tolerance is not None else 1e-6
    while 2 / 27 * np.sin(quarter / count) ** 6 > allowed * np.cos(quarter / count) ** 2:
        count += 1
    angles = begin + sweep * np.arange(count + 1) / count
    points = np.stack([np.cos(angles), np.sin(angles)], -1)
    ahead = 4 / 3 * np.tan(sweep / count / 4) * np.stack([-points[:, 1], points[:, 0]], -1)
    curves = np.stack([points[:-1] + ahead[:-1], points[1:] - ahead[1:], points[1:]], 1)
    center = 0.5 * (start + to) + (radii * middle) @ axes.T
    curves = center + (radii * curves) @ axes.T
    curves[-1, -1] = to
    return curves.ravel()


def _commands(text):
    """The letters of a path in SVG's notation, each with its numbers. A letter stands for all of its repetitions."""
    tokens = re.findall(r"[A-Za-z]|[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[^\s,]", text)
    place = 0
    while place < len(tokens):
        letter = tokens[place]
        count = _TAKES.get(letter.upper())
        if count is None:
            raise ValueError(f"path: a command of SVG is needed, not {letter!r}")
        place += 1
        while True:
            own = []
            while len(own) < count and place < len(tokens):
                token = tokens[place]
                # Flags are single digits, and need nothing between them.
                if letter in "Aa" and len(own) in (3, 4) and token[0] in "01" and len(token) > 1:
                    tokens[place], token = token[1:], token[0]
                else:
                    place += 1
                try:
                    own.append(float(token))
                except ValueError:
                    raise ValueError(f"path: {letter!r} needs {count} numbers, and has {token!r} among them") from None
            if len(own) < count:
                raise ValueError(f"path: {letter!r} needs {count} numbers, not {len(own)}")
            yield letter, np.array(own)
            if count == 0 or place >= len(tokens) or tokens[place].isalpha():
                break
            # Further pairs after a start are lines.
            letter = {"M": "L", "m": "l"}.get(letter, letter)


def _of_svg(text, tolerance=None):
    steps, numbers = [], []
    here = start = np.zeros(2)
    control = None
    for letter, own in _commands(text):
        kind, offset = letter.upper(), here if letter.islower() else np.zeros(2)
        if kind in "HV":
            axis = "HV".index(kind)
            to = here.copy()
            to[axis] = own[0] + offset[axis]
            kind, own = "L", to
        elif kind == "A":
            to = own[5:] + offset
            if own[0] == own[1]:
                own = np.array([*to, _bulge(here, to, own[0], own[3], own[4])])
            else:
                own = _ellipse(here, to, own, tolerance)
                kind, own = ("C", own) if len(own) else ("L", to)
        elif kind != "Z":
            own = own + np.tile(offset, len(own) // 2)
        # A smooth curve begins with the mirror image of the control point before it.
        if kind in "ST":
            smooth = control[1] if control is not None and control[0] == {"S": "C", "T": "Q"}[kind] else here
            kind, own = {"S": "C", "T": "Q"}[kind], np.concatenate([2 * here - smooth, own])
        # Nothing follows an arc smoothly.
        control = (kind, own[-4:-2]) if letter in "QqTtCcSs" else None
        here = start if kind == "Z" else own[:2] if kind == "A" else own[-2:]
        if kind == "M":
            start = here
        steps.append(kind * (len(own) // 6) if kind == "C" else kind)
        numbers.append(own)
    return "".join(steps), np.concatenate([np.zeros(0), *numbers])


class CurvePath:
    """A path of straight lines, circular arcs, quadratic and cubic Bézier curves, in one or more contours.

    ``steps`` has a letter for each step, and ``numbers`` their numbers one after another: ``M x y`` begins a contour, ``L x y`` is a
    line, ``Q x1 y1 x y`` and ``C x1 y1 x2 y2 x y`` are curves, ``Z`` closes the contour. ``A x y bulge`` is an arc; its bulge is the
    tangent of a quarter of its sweep: 0 is straight, 1 half a circle counter-clockwise. Gradients are arrays like ``numbers``.

    >>> path = geograd.CurvePath("MAZ", [0, 0, 2, 0, 1])  # half a disc of radius 1
    >>> area, by = path.area_grad()
    >>> round(area, 6), round(path.length, 6)
    (1.570796, 5.141593)
    >>> path.distance([(1.0, 1.0)])
    array([1.])
    """

    __module__ = "geograd"

    def __init__(self, steps, numbers):
        numbers = np.asarray(numbers)
        if numbers.ndim != 1:
            raise ValueError(f"numbers: an array of one axis is needed, not of shape {numbers.shape}")
        self._steps = steps
        self._core = _core.CurveCore(steps, np.ascontiguousarray(numbers, np.float64))

    @classmethod
    def of_svg(cls, path, *, tolerance=None):
        """The path in SVG's notation: the attribute ``d``. Arcs of circles are exact. Those of ellipses are cubic curves within a
        ``tolerance``: a distance, by default a millionth of the larger radius.

        >>> round(geograd.CurvePath.of_svg("M-3 0 A3 2 0 0 1 3 0 Z").area, 4)  # half an ellipse
        9.4248
        """
        return cls(*_of_svg(path, tolerance))

    def __repr__(self):
        return f"<geograd.CurvePath {self.steps}>"

    def __reduce__(self):
        return CurvePath, (self.steps, self.numbers)

    @property
    def steps(self):
        """The letters of all steps."""
        return self._steps

    @property
    def numbers(self):
        """The numbers of all steps, of shape (K,)."""
        return self._core.numbers()

    @property
    def length(self):
        """The length of all pieces."""
        return self._core.length()

    @property
    def lengths(self):
        """The length of each piece, of shape (P,): one for every step but ``M``, ``Z`` being the line back to the start."""
        return self._core.lengths()

    @property
    def area(self):
        """The signed area of all contours, positive counter-clockwise. A straight line closes those that are open."""
        return self._core.area()

    @property
    def bounds(self):
        """The smallest box around the path, of shape (4,): x and y of the lower corner, then of the upper one. ``None`` without steps."""
        found = self._core.bounds()
        return None if found is None else np.array(found)

    def length_grad(self):
        """The length, and its derivatives by the numbers."""
        return self._core.length_grad()

    def lengths_vjp(self, lengths_bar):
        """The lengths of all pieces, and the cotangents of the numbers from those of the lengths."""
        bars = np.ascontiguousarray(lengths_bar, np.float64)
        if bars.ndim != 1:
            raise ValueError(f"lengths_bar: an array of one axis is needed, not of shape {bars.shape}")
        return self._core.lengths_vjp(bars)

    def area_grad(self):
        """The signed area, and its derivatives by the numbers."""
        return self._core.area_grad()

    def reversed(self):
        """The path in the other direction."""
        return CurvePath(*self._core.reversed())

    def distance(self, points):
        """The distance of each point from the path, of shape (N,); NaN from a path without pieces."""
        return self._core.distance(_points(points))

    def closest(self, points):
        """The place of the path that is nearest to each point, of shape (N, 2). No place is missed."""
        return self._core.closest(_points(points))

    def distance_vjp(self, points, upstream):
        """Cotangents of the numbers and of the points, from those of the distances."""
        points = _points(points)
        return self._core.distance_vjp(points, _bars(upstream, (len(points),), "upstream"))

    def winding_number(self, points):
        """How often the contours go around each point, counter-clockwise ones positive, of shape (N,)."""
        return self._core.winding_number(_points(points))

    def contains(self, points):
        """True for each point around which the contours wind."""
        return self.winding_number(points) != 0

    def flatten(self, tolerance):
        """The vertices of every contour with chords within a tolerance of the path: a list of arrays of shape (V, 2). The
        first vertex of a closed contour is not repeated."""
        return self._core.flatten(float(tolerance))


class Delaunay:
    """The Delaunay triangulation of points of the plane, with exact decisions.

    ``points`` has the shape (N, 2). The first one of points at one place is in triangles. Points on one line have no triangles.

    >>> mesh = geograd.Delaunay([(0, 0), (4, 0), (0, 2), (1, 0.5)])
    >>> len(mesh.triangles), mesh.hull.tolist(), float(mesh.areas.sum())
    (3, [0, 1, 2], 4.0)
    """

    __module__ = "geograd"

    def __init__(self, points):
        self._core = _core.DelaunayCore(_points(points))

    def __len__(self):
        return len(self.areas)

    def __repr__(self):
        return f"<geograd.Delaunay of {len(self)} triangles>"

    @property
    def points(self):
        """The points, of shape (N, 2)."""
        return self._core.points()

    @property
    def triangles(self):
        """The points of each triangle, counter-clockwise, of shape (T, 3)."""
        return self._core.triangles().reshape(-1, 3)

    @property
    def neighbours(self):
        """The triangle opposite each corner of each triangle, of shape (T, 3): -1 at the hull."""
        return self._core.neighbours().reshape(-1, 3)

    @property
    def hull(self):
        """The points of the convex hull, counter-clockwise, those on its edges included; the points along a line if all are on one."""
        return self._core.hull()

    @property
    def firsts(self):
        """For each point the first one at its place, of shape (N,)."""
        return self._core.firsts()

    @property
    def edges(self):
        """The edges, each once, of shape (E, 2)."""
        return self._core.edges().reshape(-1, 2)

    @property
    def areas(self):
        """The area of each triangle, of shape (T,)."""
        return self._core.areas()

    @property
    def circles(self):
        """The centres, of shape (T, 2), and radii of the circles around the triangles."""
        return self._core.circles()

    def locate(self, places):
        """The triangle that contains each place of shape (M, 2), -1 outside of all, of shape (M,).

        Of several, at an edge or a corner, it is the lowest one. Decisions are exact.

        >>> geograd.Delaunay([(0, 0), (4, 0), (0, 4)]).locate([(1, 1), (2, 2), (3, 3)])
        array([ 0,  0, -1])
        """
        return self._core.locate(_points(places, "places"))

    def _corners(self, triangles):
        """The points of triangles by their numbers, of shape (M, 3): zeros for -1."""
        known = self.triangles if len(self) else np.zeros((1, 3), np.int64)
        return np.where(triangles[:, None] >= 0, known[triangles], 0).astype(np.int64)

    def barycentric(self, places):
        """The triangle that contains each place of shape (M, 2), as :meth:`locate`, and the weights of its corners, of shape (M, 3).

        Weights are from 0 to 1 and add up to 1; they are zeros outside of all triangles. The mean of numbers at the corners by
        these weights is their linear interpolation.

        >>> mesh = geograd.Delaunay([(0, 0), (4, 0), (0, 4)])
        >>> triangles, weights = mesh.barycentric([(1, 2)])
        >>> heights = np.array([10.0, 20.0, 30.0])
        >>> (heights[mesh.triangles[triangles]] * weights).sum(1)
        array([22.5])
        """
        triangles, weights = self._core.barycentric(_points(places, "places"))
        return triangles, weights.reshape(-1, 3)

    def barycentric_vjp(self, places, weights_bar):
        """Cotangents of the points and of the places from those of the weights, of shape (M, 3)."""
        places = _points(places, "places")
        return tuple(self._core.barycentric_vjp(places, _bars(weights_bar, (len(places), 3), "weights_bar")))

    def areas_vjp(self, areas_bar):
        """Cotangents of the points from those of the areas."""
        return self._core.areas_vjp(_bars(areas_bar, (len(self),), "areas_bar"))

"""Offsets of polygons and polylines: against shapely, and their derivatives against differences."""

import numpy as np
import pytest

import geograd

shapely = pytest.importorskip("shapely")
FRAME = [[(0, 0), (6, 0), (6, 5), (3, 4), (0, 6)], [(2, 2), (2, 3), (4, 3)]]
HOOK = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (1.0, 1.0)]
STYLES = [dict(join="mitre"), dict(join="mitre", limit=1.2), dict(join="bevel")]


def theirs(style, end="round"):
    return dict(join_style=style["join"], mitre_limit=style.get("limit", 5.0), cap_style=end, quad_segs=16)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("valid", [False, True])
def test_polygons_are_those_of_shapely(style, valid):
    column = geograd.Polygons.of([FRAME, FRAME, FRAME])
    distances = [0.3, -0.3, -4.0]
    made = geograd.buffer(column, distances, valid=valid, **style)
    truth = [shapely.Polygon(FRAME[0], FRAME[1:]).buffer(d, **theirs(style)) for d in distances]
    np.testing.assert_allclose(geograd.area(made), [own.area for own in truth], rtol=1e-13)
    np.testing.assert_allclose(geograd.perimeter(made), [own.length for own in truth], rtol=1e-13)
    assert truth[2].is_empty and len(made[2].vertices) == 0
    assert (column.buffer(distances, valid=valid, **style) == made).all()
    if valid:
        assert shapely.is_valid(made.to_shapely()).all()


@pytest.mark.parametrize("end", ["flat", "square"])
@pytest.mark.parametrize("style", STYLES)
def test_polylines_are_those_of_shapely(style, end):
    made = geograd.buffer(geograd.Polylines.of([HOOK]), 0.4, end=end, **style)
    np.testing.assert_allclose(geograd.area(made), shapely.LineString(HOOK).buffer(0.4, **theirs(style, end)).area, rtol=1e-13)
    assert len(geograd.buffer(geograd.Polylines.of([HOOK]), 0.0).vertices) == 0


def test_arcs_hold_their_tolerance():
    square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]])
    exact = 32 + np.pi
    for tolerance in (1e-1, 1e-3, 1e-5):
        missing = exact - geograd.area(geograd.buffer(square, 1.0, tolerance=tolerance))[0]
        assert 0 < missing < 2 * np.pi * tolerance
    fine, coarse = [geograd.area(geograd.buffer(square, 1.0, chords=n))[0] for n in (64, 4)]
    assert coarse < fine < exact


@pytest.mark.parametrize("of", [geograd.Polygons.of([FRAME, FRAME]), geograd.Polylines.of([HOOK, HOOK])])
@pytest.mark.parametrize("valid", [False, True])
def test_derivatives_are_differences(of, valid):
    def area(vertices, distance):
        column = type(of)(vertices, of.offsets)
        return geograd.area(geograd.buffer(column, distance, join="mitre", end="square", valid=valid)).sum()

    vertices, distance = np.array(of.vertices), np.array([0.2, 0.3])
    made = geograd.buffer(of, distance, join="mitre", end="square", valid=valid)
    upstream = geograd.area.vjp(made, np.ones(2))
    by_vertices, by_distance = geograd.buffer.vjp(of, distance, upstream, join="mitre", end="square", valid=valid)
    step = 1e-6
    for k in range(vertices.size):
        moved = np.zeros(vertices.size)
        moved[k] = step
        moved = moved.reshape(vertices.shape)
        slope = (area(vertices + moved, distance) - area(vertices - moved, distance)) / (2 * step)
        np.testing.assert_allclose(by_vertices.ravel()[k], slope, rtol=1e-6, atol=1e-7)
    for k in range(2):
        moved = np.eye(2)[k] * step
        slope = (area(vertices, distance + moved) - area(vertices, distance - moved)) / (2 * step)
        np.testing.assert_allclose(by_distance[k], slope, rtol=1e-6)
    _, of_all = geograd.buffer.vjp(of, 0.2, 0.0, join="mitre")
    assert of_all.shape == () and of_all == 0


def test_refusals_name_what_is_wrong():
    square = geograd.Polygons.of([[(0, 0), (4, 0), (4, 4), (0, 4)]] * 2)
    for given, words in [
        (dict(distance=np.nan), "distance"),
        (dict(distance=[1.0, 2.0, 3.0]), "one number or 2"),
        (dict(distance=1.0, join="sharp"), "join"),
        (dict(distance=1.0, end="sharp"), "end"),
        (dict(distance=1.0, join="mitre", limit=0.5), "limit is below one"),
        (dict(distance=1.0, tolerance=-1.0), "chords is not positive"),
        (dict(distance=1.0, fill="odd"), "fill"),
    ]:
        with pytest.raises(ValueError, match=words):
            geograd.buffer(square, **given)
    with pytest.raises(TypeError, match="Polylines"):
        geograd.buffer(geograd.Rings.of([[(0, 0), (4, 0), (4, 4)]]), 1.0)
    with pytest.raises(ValueError, match="vertex 0 is repeated"):
        geograd.buffer(geograd.Polylines.of([HOOK, [(1.0, 1.0), (1.0, 1.0)]]), 1.0)


def test_tensors_have_derivatives_by_vertices_and_distance():
    torch = pytest.importorskip("torch")
    import geograd.torch

    column = geograd.torch.Polygons.of([FRAME], requires_grad=True)
    distance = torch.tensor(0.25, dtype=torch.float64, requires_grad=True)
    made = geograd.torch.buffer(column, distance, join="mitre")
    geograd.torch.area(made).sum().backward()
    np.testing.assert_allclose(distance.grad.numpy(), geograd.perimeter(made.column).sum(), rtol=1e-12)
    np.testing.assert_allclose(column.vertices.grad.numpy().sum(0), 0, atol=1e-12)
    line = geograd.torch.Polylines.of([HOOK], requires_grad=True)
    geograd.torch.area(geograd.torch.buffer(line, distance, end="square", join="mitre")).sum().backward()
    assert np.isfinite(line.vertices.grad.numpy()).all()

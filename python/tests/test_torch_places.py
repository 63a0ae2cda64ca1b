"""Weights of the corners around places, on tensors."""

import numpy as np
import pytest

import geograd

torch = pytest.importorskip("torch")
geograd_torch = pytest.importorskip("geograd.torch")

DRAW = np.random.default_rng(11)
POINTS = DRAW.uniform(0, 4, (14, 2))
# Some are outside of all triangles.
PLACES = DRAW.uniform(-1, 5, (30, 2))


def test_weights_are_those_of_numpy_and_pass_gradcheck():
    made = geograd.Delaunay(POINTS)
    triangles, expected = made.barycentric(PLACES)
    points, places = (torch.tensor(own, requires_grad=True) for own in (POINTS, PLACES))
    corners, weights = geograd_torch.barycentric(points, places)
    assert (weights.detach().numpy() == expected).all() and (triangles < 0).any() and (triangles >= 0).any()
    inside = triangles >= 0
    assert (corners.numpy()[inside] == made.triangles[triangles[inside]]).all() and not corners.numpy()[~inside].any()
    apply = lambda points, places: geograd_torch.barycentric(points, places).weights
    assert torch.autograd.gradcheck(apply, (points, places))
    assert torch.autograd.gradgradcheck(apply, (points, places))
    upstream = torch.tensor(DRAW.normal(0, 1, (30, 3)))
    first = torch.autograd.grad((apply(points, places) * upstream).sum(), (points, places))
    again = torch.autograd.grad((apply(points, places) * upstream).sum(), (points, places), create_graph=True)
    assert all((p - q).abs().max() < 1e-11 * (1 + p.abs().max()) for p, q in zip(first, again))


def test_weights_interpolate_a_linear_function():
    points = torch.tensor(POINTS)
    places = torch.tensor(PLACES, requires_grad=True)
    corners, weights = geograd_torch.barycentric(points, places)
    heights = 2.0 * points[:, 0] - 3.0 * points[:, 1] + 1.0
    values = (heights[corners] * weights).sum(1)
    inside = weights.sum(1) > 0.5
    expected = 2.0 * places[:, 0] - 3.0 * places[:, 1] + 1.0
    assert (values - expected)[inside].abs().max() < 1e-13 and not values[~inside].any()
    (slopes,) = torch.autograd.grad(values.sum(), places)
    assert (slopes[inside] - torch.tensor([2.0, -3.0])).abs().max() < 1e-12 and not slopes[~inside].any()


def test_bad_input_is_named_and_points_on_a_line_have_no_weights():
    points = torch.tensor([[0.0, 0], [1, 1], [2, 2]])
    corners, weights = geograd_torch.barycentric(points, torch.tensor([[1.0, 1]]))
    assert not corners.any() and not weights.any()
    with pytest.raises(TypeError, match="points"):
        geograd_torch.barycentric(POINTS, torch.tensor(PLACES))
    with pytest.raises(ValueError, match="places"):
        geograd_torch.barycentric(points, torch.zeros(4, 3))

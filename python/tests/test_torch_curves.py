"""Paths of curves on tensors."""

import numpy as np
import pytest

import geograd

torch = pytest.importorskip("torch")
geograd_torch = pytest.importorskip("geograd.torch")

STEPS, NUMBERS = "MLAQCZ", np.array([0, 0, 2, 0.1, 4, 1, 0.3, 3.5, 2.5, 2.2, 3.3, 1.5, 4, 0.5, 3.2, -0.4, 1.8])


def test_measures_and_distances_are_those_of_numpy_and_pass_gradcheck():
    own = geograd.CurvePath(STEPS, NUMBERS)
    numbers = torch.tensor(NUMBERS, requires_grad=True)
    path = geograd_torch.CurvePath(STEPS, numbers)
    points = torch.tensor(np.random.default_rng(4).uniform(-1, 5, (3, 10, 2)), requires_grad=True)
    assert path.length().item() == own.length and path.area().item() == own.area
    expected = own.distance(points.detach().numpy().reshape(-1, 2)).reshape(3, 10)
    assert (path.distance(points).detach().numpy() == expected).all()
    for f in [lambda x: geograd_torch.CurvePath(STEPS, x).length(), lambda x: geograd_torch.CurvePath(STEPS, x).area()]:
        assert torch.autograd.gradcheck(f, numbers)
    assert torch.autograd.gradcheck(lambda x: geograd_torch.CurvePath(STEPS, x).lengths(), numbers)
    assert torch.autograd.gradcheck(lambda p, x: geograd_torch.CurvePath(STEPS, x).distance(p), (points, numbers))


def test_bad_input_is_named():
    with pytest.raises(TypeError, match="numbers"):
        geograd_torch.CurvePath(STEPS, NUMBERS)
    path = geograd_torch.CurvePath(STEPS, torch.tensor(NUMBERS))
    with pytest.raises(ValueError, match="points"):
        path.distance(torch.zeros(4, 3))
    assert path.distance(torch.zeros(0, 2, dtype=torch.float64)).shape == (0,)

"""Clouds: nearest points and distances against all pairs, ties by lowest index, gradients against differences."""

import pickle

import numpy as np
import pytest

import geograd

RANDOM = np.random.default_rng(11)
POINTS = RANDOM.normal(size=(500, 3))
QUERIES = RANDOM.normal(size=(200, 3))
GRID = RANDOM.integers(-3, 4, (400, 3)).astype(float)
CLOUD = geograd.Cloud(POINTS)


def squares(queries, points):
    return ((queries[:, None] - points[None]) ** 2).sum(-1)


@pytest.mark.parametrize("points, queries", [(POINTS, QUERIES), (GRID, RANDOM.integers(-6, 7, (300, 3)) * 0.5)])
def test_nearest_points_are_those_of_all_pairs(points, queries):
    cloud, all_squares = geograd.Cloud(points), squares(queries, points)
    assert (cloud.nearest(queries) == all_squares.argmin(1)).all()
    np.testing.assert_allclose(cloud.squared_distance(queries), all_squares.min(1), rtol=1e-14)
    found, distances = cloud.nearest_some(queries, 17)
    assert (found == np.argsort(all_squares, 1, kind="stable")[:, :17]).all()
    np.testing.assert_allclose(distances, np.sqrt(np.sort(all_squares, 1)[:, :17]), rtol=1e-14)
    indices, offsets = cloud.within(queries, 1.5)
    rows, columns = np.nonzero(all_squares <= 2.25)
    assert (indices == columns).all() and (offsets == np.searchsorted(rows, np.arange(len(queries) + 1))).all()


def test_distances_of_clouds_are_those_of_all_pairs():
    other = geograd.Cloud(QUERIES)
    all_squares = squares(POINTS, QUERIES)
    np.testing.assert_allclose(CLOUD.chamfer(other), all_squares.min(1).mean() + all_squares.min(0).mean())
    roots = np.sqrt(all_squares)
    np.testing.assert_allclose(CLOUD.chamfer(other, squared=False), roots.min(1).mean() + roots.min(0).mean())
    distance, own, second = CLOUD.hausdorff(other)
    np.testing.assert_allclose(distance, max(roots.min(1).max(), roots.min(0).max()))
    assert roots[own, second] == pytest.approx(distance)
    p, q = (roots.min(1) <= 0.4).mean(), (roots.min(0) <= 0.4).mean()
    np.testing.assert_allclose(CLOUD.f_score(other, 0.4), 2 * p * q / (p + q))
    assert CLOUD.f_score(geograd.Cloud(POINTS + 100), 0.1) == 0


def test_shapes_pickles_and_faults():
    assert CLOUD.distance(QUERIES.reshape(10, 20, 3)).shape == (10, 20)
    assert CLOUD.nearest_some(QUERIES[0], 999)[0].shape == (500,)
    assert len(pickle.loads(pickle.dumps(CLOUD))) == 500 and repr(CLOUD) == "<geograd.Cloud of 500 points>"
    with pytest.raises(ValueError, match="the cloud has no points"):
        geograd.Cloud(np.zeros((0, 3)))
    with pytest.raises(ValueError, match="point 1 has a coordinate that is not a finite number"):
        geograd.Cloud([[0, 0, 0], [0, np.nan, 0]])
    with pytest.raises(ValueError, match="`queries` item 0: "):
        CLOUD.nearest([np.inf, 0, 0])
    with pytest.raises(ValueError, match="`threshold` item 0: value is negative or not finite"):
        CLOUD.f_score(CLOUD, -1.0)


def test_gradients_of_tensors_are_those_of_differences():
    torch = pytest.importorskip("torch")
    pytest.importorskip("geograd.torch")
    a = torch.tensor(POINTS[:20], requires_grad=True)
    b = torch.tensor(QUERIES[:15], requires_grad=True)
    clouds = geograd.torch.Cloud
    for query in (
        lambda a, b: clouds(a).distance(b),
        lambda a, b: clouds(a).squared_distance(b),
        lambda a, b: clouds(a).chamfer(clouds(b)),
        lambda a, b: clouds(a).chamfer(clouds(b), squared=False),
        lambda a, b: clouds(a).hausdorff(clouds(b)),
    ):
        assert torch.autograd.gradcheck(query, (a, b), eps=1e-7, atol=1e-6)
        assert torch.autograd.gradgradcheck(query, (a, b), eps=1e-7, atol=1e-5)
    single = a.detach().float().requires_grad_()
    clouds(single).chamfer(clouds(b.detach().float())).backward()
    assert single.grad.dtype == torch.float32 and single.grad.abs().sum() > 0

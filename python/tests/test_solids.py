"""Functions of one shape: bounds, supports, heights, corners and planes, by points of the shapes and by distances."""

import numpy as np
import pytest

import geograd


def boxes(count=40, seed=2):
    dice = np.random.default_rng(seed)
    turn = dice.normal(size=(count, 4))
    return np.c_[dice.normal(size=(count, 3)), dice.uniform(0.1, 3, (count, 3)), turn / np.linalg.norm(turn, axis=1)[:, None]]


def shapes(kind, count=40):
    """Rows of a kind with sizes of about one."""
    dice = np.random.default_rng(7)
    x = dice.normal(size=(count, len(getattr(geograd, kind)._fields)))
    if kind in ("Obb3", "Ellipsoid"):
        return boxes(count)
    if kind == "RoundBox3":
        return np.c_[boxes(count), dice.uniform(0, 1, count)]
    if kind == "YawBox3":
        x[:, 3:6] = abs(x[:, 3:6])
    if kind in ("Capsule2", "Capsule3", "Circle", "Cone", "Cylinder", "Disc", "Sphere"):
        x[:, -1] = abs(x[:, -1])
    if kind == "Obb2":
        x[:, 2:4] = abs(x[:, 2:4])
    return x


SOLIDS = ("Capsule3", "Cone", "Cylinder", "Disc", "Ellipsoid", "Obb3", "RoundBox3", "Segment3", "Sphere", "Tetrahedron", "Triangle3", "YawBox3")
FLAT = ("Capsule2", "Circle", "Obb2", "Segment2", "Triangle2")


def cornered(shape):
    """The corners of boxes, of shape (N, 8, 3)."""
    return geograd.corners(shape).array.reshape(-1, 8, 3)


def extent(kind, x, axis, side):
    """How far shapes reach along an axis, by their distance from a half-space or from a square far away."""
    far = 50.0
    if kind == "YawBox3":
        return side * (side * cornered(geograd.YawBox3(x))[:, :, axis]).max(1)
    if kind in SOLIDS:
        half = np.zeros(4)
        half[axis], half[3] = -side, -far
        return side * (far - geograd.signed_distance(geograd.Plane3(half), getattr(geograd, kind)(x)))
    low, high = np.full(2, -far), np.full(2, far)
    low[axis], high[axis] = sorted([side * far, 2 * side * far])
    wall = geograd.Polygons.of(geograd.Aabb2(np.r_[low, high]))
    return side * (far - geograd.distance(getattr(geograd, kind)(x), wall))


@pytest.mark.parametrize("kind", [*SOLIDS, *FLAT])
def test_bounds_touch_the_shape_on_every_side(kind):
    x = shapes(kind)
    own = geograd.bounding(getattr(geograd, kind)(x))
    n = 3 if kind in SOLIDS else 2
    assert type(own).__name__ == f"Aabb{n}"
    for axis in range(n):
        for side, column in ((-1, axis), (1, n + axis)):
            np.testing.assert_allclose(own.array[:, column], extent(kind, x, axis, side), atol=1e-9)
    single = geograd.bounding(x.astype(np.float32), kind=kind)
    assert single.array.dtype == np.float32
    np.testing.assert_allclose(single.array, own.array, atol=1e-4)


def test_bounds_have_derivatives():
    for kind in ("Cone", "Obb3", "Ellipsoid"):
        x = shapes(kind, 3)
        of = lambda y: geograd.bounding(y, kind=kind).array
        found = geograd.bounding.jacobian(x, kind=kind)
        step = 1e-6
        for k in range(x.shape[1]):
            if kind != "Cone" and k >= 6:
                continue  # A turn keeps its length.
            moved = [x.copy(), x.copy()]
            moved[0][:, k] += step
            moved[1][:, k] -= step
            np.testing.assert_allclose(found[:, :, k], (of(moved[0]) - of(moved[1])) / (2 * step), atol=1e-7)


def test_torch_has_them():
    torch = pytest.importorskip("torch")
    import geograd.torch

    x = torch.tensor(shapes("Cylinder", 4), requires_grad=True)
    made = geograd.torch.bounding(x, kind="Cylinder")
    made.sum().backward()
    expected = geograd.bounding.vjp(geograd.Cylinder(x.detach().numpy()), np.ones((4, 6)))
    assert made.shape == (4, 6) and np.array_equal(x.grad, expected)


def test_a_function_of_ones_own_takes_them():
    @geograd.function
    def reach(shape: geograd.Cone):
        return geograd.bounding(shape).max.z - geograd.height(shape)

    x = shapes("Cone", 5)
    np.testing.assert_allclose(reach(x), geograd.bounding(geograd.Cone(x)).array[:, 5] - geograd.height(geograd.Cone(x)))


def test_supports_are_farthest_and_on_the_shape():
    x, dice = boxes(), np.random.default_rng(3)
    along = dice.normal(size=(len(x), 3))
    at = geograd.support(geograd.Ellipsoid(x), geograd.Vec3(along)).array
    axes = geograd.axes(geograd.Rotation3(x[:, 6:])).array.reshape(-1, 3, 3)
    seen = np.einsum("nij,nj->ni", axes, at - x[:, :3]) / x[:, 3:6]
    np.testing.assert_allclose((seen**2).sum(1), 1)
    for own in dice.normal(size=(200, 3)):
        other = geograd.support(geograd.Ellipsoid(x), geograd.Vec3(own)).array
        assert ((along * other).sum(1) <= (along * at).sum(1) + 1e-9).all()


def test_heights_and_slants():
    cone = geograd.Cone([[0, 0, 0, 0, 0, 4, 3], [1, 1, 1, 1, 1, 3, 0.0]])
    assert geograd.height(cone).tolist() == [4, 2] and geograd.slant(cone).tolist() == [5, 2]
    assert geograd.height(geograd.Cylinder([0, 0, 0, 3, 0, 4, 1.0])) == 5
    assert geograd.slant.jacobian(cone)[0].round(12).tolist() == [0, 0, -0.8, 0, 0, 0.8, 0.6]


def test_corners_and_planes_of_boxes():
    x = boxes()
    corners = cornered(geograd.Obb3(x))
    planes = geograd.planes(geograd.Obb3(x)).array.reshape(-1, 6, 4)
    # Every corner is on three planes, opposite ones have the size between them.
    on = np.abs((corners[:, :, None] * planes[:, None, :, :3]).sum(-1) - planes[:, None, :, 3]) < 1e-9
    assert (on.sum(2) == 3).all()
    np.testing.assert_allclose(planes[:, ::2, 3] + planes[:, 1::2, 3], x[:, 3:6])
    np.testing.assert_allclose(corners.mean(1), x[:, :3], atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(corners[:, 1] - corners[:, 0], axis=1), x[:, 3])
    np.testing.assert_allclose(np.linalg.norm(corners[:, 4] - corners[:, 0], axis=1), x[:, 5])
    upright = cornered(geograd.YawBox3([[1, 2, 3, 4, 2, 6, np.pi / 2]]))
    np.testing.assert_allclose(upright[0, [0, 1, 2, 4]], [[2, 0, 0], [2, 4, 0], [0, 0, 0], [2, 0, 6]], atol=1e-12)
    bar = np.random.default_rng(0).normal(size=(len(x), 24))
    step = np.zeros_like(x)
    step[:, 3] = 1e-6
    by_width = ((geograd.corners(geograd.Obb3(x + step)).array - geograd.corners(geograd.Obb3(x)).array) / 1e-6 * bar).sum(1)
    np.testing.assert_allclose(geograd.corners.vjp(geograd.Obb3(x), bar)[:, 3], by_width, atol=1e-5)


def test_refusals():
    with pytest.raises(TypeError, match=r"bounding of \(Line2\): no row takes these shapes"):
        geograd.bounding(geograd.Line2([0, 0, 1, 0.0]))
    with pytest.raises(ValueError, match="radius is negative"):
        geograd.bounding(geograd.Sphere([[0, 0, 0, -1.0]]))
    with pytest.raises(TypeError, match="support of"):
        geograd.support(geograd.Ellipsoid(boxes()))

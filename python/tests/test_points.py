"""Hulls, smallest shapes around points, alignments, suppression of known pairs, assignment of matrices, poses, encodings."""

import pickle

import numpy as np
import pytest

import geograd


def difference(f, x, step=1e-6):
    made = np.zeros_like(x)
    for place in np.ndindex(x.shape):
        low, high = x.copy(), x.copy()
        low[place] -= step
        high[place] += step
        made[place] = (f(high) - f(low)) / (2 * step)
    return made


def close(found, expected, tolerance=2e-6):
    assert np.abs(found - expected).max() <= tolerance * (1 + np.abs(expected).max())


@pytest.fixture
def sets():
    dice = np.random.default_rng(3)
    return [dice.normal(size=(n, 2)) * [2, 1] for n in (3, 4, 9, 30)]


def flat(sets):
    return np.concatenate(sets), np.concatenate([[0], np.cumsum([len(own) for own in sets])])


def test_shapes_around_points_are_those_of_shapely(sets):
    shapely = pytest.importorskip("shapely")
    points = geograd.Paths(*flat(sets))
    clouds = np.array([shapely.MultiPoint(own) for own in sets], object)
    hulls = geograd.convex_hull(sets)
    assert shapely.equals(shapely.normalize(hulls.to_shapely()), shapely.normalize(shapely.convex_hull(clouds))).all()
    assert (geograd.convex_hull(points) == hulls).all() and (geograd.convex_hull(geograd.Polygons.of(sets[:2])) == hulls[:2]).all()
    circles = geograd.minimum_circle(points)
    assert type(circles) is geograd.Circle
    assert circles.radius == pytest.approx(shapely.minimum_bounding_radius(clouds))
    boxes = geograd.minimum_rectangle(points)
    least = shapely.area(np.array([shapely.oriented_envelope(own) for own in clouds], object))
    # Of a triangle all three rectangles along a side have one area.
    assert geograd.area(boxes) == pytest.approx(least)
    corners = geograd.corners(boxes).array.reshape(-1, 4, 2)
    around = shapely.buffer(shapely.polygons(corners), 1e-9)
    assert shapely.covers(around, clouds).all()
    farthest = [np.hypot(*(own[:, None] - own[None]).transpose(2, 0, 1)).max() for own in sets]
    assert geograd.diameter(points) == pytest.approx(farthest)
    assert (geograd.width(points) <= geograd.diameter(points)).all() and (geograd.width(points) > 0).all()


def test_shapes_around_points_have_gradients(sets):
    # Without triangles, of which three rectangles tie.
    vertices, offsets = flat(sets[2:])
    at = lambda x: geograd.Paths(x, offsets)
    for verb, width in ((geograd.minimum_rectangle, (2, 5)), (geograd.minimum_circle, (2, 3))):
        bars = np.random.default_rng(0).normal(size=width)
        gradient = verb.vjp(at(vertices), bars)
        close(gradient, difference(lambda x: (verb(at(x)).array * bars).sum(), vertices))
    for verb in (geograd.diameter, geograd.width):
        value, gradient = verb.value_grad(at(vertices))
        assert (value == verb(at(vertices))).all()
        close(gradient, difference(lambda x: verb(at(x)).sum(), vertices))
    hull = geograd.convex_hull(at(vertices))
    gradient = geograd.convex_hull.vjp(at(vertices), geograd.area.value_grad(hull)[1])
    close(gradient, difference(lambda x: geograd.area(geograd.convex_hull(at(x))).sum(), vertices))


def test_points_without_extent_have_no_shape_around():
    none = geograd.Paths(np.zeros((3, 2)), [0, 0, 1, 3])
    assert np.isnan(geograd.minimum_rectangle(none).array).all()
    assert np.isnan(geograd.minimum_circle(none).array).any(1).tolist() == [True, False, False]
    assert np.isnan(geograd.diameter(none)).tolist() == [True, False, False]
    assert geograd.area(geograd.convex_hull(none)).tolist() == [0, 0, 0]
    assert np.isfinite(geograd.minimum_circle.vjp(none, np.ones((3, 3)))).all()
    with pytest.raises(ValueError, match="not finite"):
        geograd.diameter(geograd.Paths([[np.nan, 0.0]], [0, 1]))
    with pytest.raises(ValueError, match=r"\(P, 2\)"):
        geograd.convex_hull([np.zeros(3)])
    with pytest.raises(TypeError, match="value, vjp"):
        geograd.minimum_circle.value_grad(none)
    assert pickle.loads(pickle.dumps(geograd.convex_hull)) is geograd.convex_hull
    single = geograd.Paths(np.eye(3, 2, dtype=np.float32), [0, 3])
    assert geograd.diameter(single).dtype == np.float32 and geograd.convex_hull(single).vertices.dtype == np.float32


def test_an_alignment_finds_the_pose_that_made_the_targets():
    dice = np.random.default_rng(5)
    points = dice.normal(size=(7, 3))
    pose = geograd.Pose3([0.5, 0.1, -0.3, 0.2, 5.0, -1.0, 2.0])
    targets = geograd.move(pose, geograd.Vec3(points * 2)).array
    found, scale = geograd.procrustes(points, targets)
    assert scale == pytest.approx(2)
    assert geograd.move(found, geograd.Vec3(points * scale)).array == pytest.approx(targets)
    targets = targets + dice.normal(size=targets.shape) * 0.3
    weights, bar = dice.uniform(0.5, 2, 7), dice.normal(size=8)

    def reach(points, targets, weights, rigid):
        made, scale = geograd.procrustes(points, targets, weights, rigid=rigid)
        return made.array @ bar[:7] + scale * bar[7]

    for rigid in (False, True):
        by = geograd.procrustes.vjp(points, targets, weights, bar[:7], bar[7], rigid=rigid)
        close(by[0], difference(lambda x: reach(x, targets, weights, rigid), points), 1e-5)
        close(by[1], difference(lambda x: reach(points, x, weights, rigid), targets), 1e-5)
        close(by[2], difference(lambda x: reach(points, targets, x, rigid), weights), 1e-5)
    assert geograd.procrustes(points, targets, rigid=True)[1] == 1
    with pytest.raises(ValueError):
        geograd.procrustes(points, targets[:-1])


def boxes():
    dice = np.random.default_rng(6)
    low = dice.uniform(0, 3, (25, 2))
    return np.concatenate([low, low + dice.uniform(1, 2, (25, 2))], 1), dice.uniform(0, 1, 25)


def naive_soft(scores, overlaps, threshold, sigma, least):
    left, scores, kept = list(range(len(scores))), scores.copy(), []
    while left:
        best = max(left, key=lambda k: scores[k])
        if scores[best] < least:
            break
        left.remove(best)
        kept.append((best, scores[best]))
        for other in left:
            o = overlaps[best, other]
            scores[other] *= np.exp(-o * o / sigma) if sigma else (1 - o if o > threshold else 1)
    return kept


def test_soft_suppression_is_that_of_its_paper():
    shapes, scores = boxes()
    overlaps = geograd.iou.all_pairs(geograd.Aabb2(shapes), geograd.Aabb2(shapes))
    pairs = geograd.iou.above(geograd.Aabb2(shapes), geograd.Aabb2(shapes), 0.0)
    for sigma in (None, 0.5):
        places, lowered = geograd.suppression.soft(scores, pairs, threshold=0.3, sigma=sigma, score=0.05)
        expected = naive_soft(scores, overlaps, 0.3, sigma, 0.05)
        assert places.tolist() == [k for k, _ in expected] and lowered == pytest.approx([x for _, x in expected])
        # Each pair once, in any order, gives the same.
        upper = [x[pairs[0] < pairs[1]] for x in pairs]
        again = geograd.suppression.soft(scores, (upper[1], upper[0], upper[2]), threshold=0.3, sigma=sigma, score=0.05)
        assert all((x == y).all() for x, y in zip(again, (places, lowered)))
        bars = np.arange(1.0, len(places) + 1)
        options = {"threshold": 0.3, "sigma": sigma, "score": 0.05}
        by_scores, by_pairs = geograd.suppression.soft_vjp(scores, upper, bars, **options)
        close(by_scores, difference(lambda x: geograd.suppression.soft(x, upper, **options)[1] @ bars, scores))
        of = lambda x: geograd.suppression.soft(scores, (*upper[:2], x), **options)[1] @ bars
        close(by_pairs, difference(of, upper[2]))


def test_clusters_keep_what_suppression_keeps():
    shapes, scores = boxes()
    shapes = geograd.Aabb2(shapes)
    pairs = geograd.iou.above(shapes, shapes, 0.0)
    kept = geograd.iou.suppress(shapes, scores, 0.3)
    assert geograd.suppression.cluster(scores, pairs, threshold=0.3).tolist() == kept.tolist()
    classes = np.arange(25) % 2
    kept = geograd.iou.suppress(shapes, scores, 0.3, classes=classes)
    assert geograd.suppression.cluster(scores, pairs, threshold=0.3, classes=classes).tolist() == kept.tolist()
    places, lowered = geograd.suppression.matrix(scores, pairs)
    assert sorted(places.tolist()) == list(range(25)) and (lowered <= scores[places]).all()
    assert lowered[0] == scores.max() and (np.diff(lowered) <= 0).all()
    with pytest.raises(ValueError):
        geograd.suppression.soft(scores, pairs, sigma=-1.0)
    with pytest.raises(ValueError, match="cotangents of"):
        geograd.suppression.soft_vjp(scores, pairs, [1.0])


def test_matrices_are_assigned_as_by_scipy():
    optimize = pytest.importorskip("scipy.optimize")
    dice = np.random.default_rng(8)
    for shape in ((5, 5), (4, 9), (9, 4), (1, 1), (0, 3)):
        gains = dice.normal(size=shape)
        rows, columns = geograd.assignment.optimal(gains)
        expected = optimize.linear_sum_assignment(gains, maximize=True)
        assert gains[rows, columns].sum() == pytest.approx(gains[expected].sum())
        rows, columns = geograd.assignment.cheapest(gains)
        expected = optimize.linear_sum_assignment(gains)
        assert gains[rows, columns].sum() == pytest.approx(gains[expected].sum())
    costs = np.array([[1.0, 9.0], [2.0, np.inf], [7.0, 3.0]])
    assert [x.tolist() for x in geograd.assignment.cheapest(costs, most=5)] == [[0, 2], [0, 1]]
    assert geograd.assignment.cheapest(costs, most=0.5)[0].tolist() == []
    with pytest.raises(ValueError, match="not finite|finite"):
        geograd.assignment.optimal([[np.nan]])


# Rows of Python's own


def test_areas_and_volumes_of_all_shapes():
    assert geograd.area(geograd.Obb2([1, 2, 3, 4, 0.5])) == 12
    assert geograd.area(geograd.Aabb2([0, 0, 2, 5])) == 10
    assert geograd.area(geograd.Circle([0, 0, 2])) == pytest.approx(4 * np.pi)
    assert geograd.perimeter(geograd.Circle([0, 0, 2])) == pytest.approx(4 * np.pi)
    assert geograd.area(geograd.Capsule2([0, 0, 3, 0, 1])) == pytest.approx(6 + np.pi)
    assert geograd.perimeter(geograd.Capsule2([0, 0, 3, 0, 1])) == pytest.approx(6 + 2 * np.pi)
    assert geograd.area(geograd.Triangle3([0, 0, 0, 2, 0, 0, 0, 0, 3])) == 3
    assert geograd.volume(geograd.Aabb3([0, 0, 0, 1, 2, 3])) == 6 and geograd.surface(geograd.Aabb3([0, 0, 0, 1, 2, 3])) == 22
    assert geograd.volume(geograd.Sphere([0, 0, 0, 3])) == pytest.approx(36 * np.pi)
    rings = geograd.Rings.of([[(0, 0), (0, 2), (2, 2), (2, 0)], [(0, 0), (1, 0), (0, 1)]])
    value, gradient = geograd.area.value_grad(rings)
    assert value.tolist() == [4, 0.5] and (geograd.signed_area(rings) == [-4, 0.5]).all()
    at = lambda x: geograd.area(geograd.Rings(x, rings.offsets)).sum()
    close(gradient, difference(at, np.array(rings.vertices, float)))


def test_poses_move_every_shape():
    pose = geograd.Pose2([2 * np.cos(0.5), 2 * np.sin(0.5), 3.0, -1.0])
    point = geograd.move(pose, geograd.Vec2(1.0, 2.0)).array
    turned = [np.cos(0.5) - 2 * np.sin(0.5) + 3, np.sin(0.5) + 2 * np.cos(0.5) - 1]
    assert point == pytest.approx(turned)
    box = geograd.move(pose, geograd.Obb2([1.0, 2.0, 4.0, 2.0, 0.1])).array
    assert box == pytest.approx([*turned, 4, 2, 0.6])
    assert geograd.move(pose, geograd.Circle([1.0, 2.0, 7.0])).array == pytest.approx([*turned, 7])
    back = geograd.move(geograd.inverse(pose), geograd.Vec2(point)).array
    assert back == pytest.approx([1, 2])
    both = geograd.move(pose, geograd.move(pose, geograd.Vec2(1.0, 2.0)))
    assert geograd.move(geograd.move(pose, pose), geograd.Vec2(1.0, 2.0)).array == pytest.approx(both.array)
    space = geograd.Pose3([0.5, 0.1, -0.3, 0.2, 5.0, -1.0, 2.0])
    for shape in (geograd.Obb3([1, 2, 3, 1, 2, 3, 1, 0, 0, 0]), geograd.Sphere([1, 2, 3, 2]), geograd.Segment3([0, 0, 0, 1, 2, 3])):
        assert type(geograd.move(space, shape)) is type(shape)


def test_rotations_and_twists():
    dice = np.random.default_rng(9)
    v = dice.normal(size=(20, 3))
    v *= np.minimum(1, 3 / np.linalg.norm(v, axis=1))[:, None]
    vectors = geograd.Vec3(v)
    rotations = geograd.from_rotation_vector(vectors)
    assert geograd.rotation_vector(rotations).array == pytest.approx(v)
    # The right Jacobian is the derivative of the exponential, seen from the body.
    step = dice.normal(size=(20, 3)) * 1e-6
    turn = geograd.tangent_to(rotations, geograd.from_rotation_vector(geograd.Vec3(v + step))).array
    columns = geograd.right_jacobian(vectors).array.reshape(20, 3, 3)
    assert turn == pytest.approx(np.einsum("nci,nc->ni", columns, step), abs=1e-11)
    inverse = geograd.right_jacobian_inverse(vectors).array.reshape(20, 3, 3)
    assert np.einsum("nki,nck->nci", inverse, columns) == pytest.approx(np.broadcast_to(np.eye(3), (20, 3, 3)), abs=1e-9)
    left = geograd.left_jacobian(vectors).array.reshape(20, 3, 3)
    assert left == pytest.approx(columns.transpose(0, 2, 1))
    six = geograd.to_6d(rotations)
    assert geograd.angle(geograd.from_6d(six), rotations) == pytest.approx(0, abs=1e-7)
    matrix = geograd.axes(rotations)
    assert geograd.squared_angle(geograd.nearest_rotation(matrix), rotations) == pytest.approx(0, abs=1e-12)
    shifts = geograd.Vec3(dice.normal(size=(20, 3)))
    poses = geograd.from_twist(vectors, shifts)
    turns, moves = geograd.twist(poses)
    assert turns.array == pytest.approx(v) and moves.array == pytest.approx(shifts.array)
    moved = geograd.retract(poses, vectors, shifts)
    turns, moves = geograd.tangent_to(poses, moved)
    assert turns.array == pytest.approx(v) and moves.array == pytest.approx(shifts.array)
    unit = geograd.move(poses, geograd.inverse(poses))
    assert np.abs(unit.array) == pytest.approx(np.tile([1.0, 0, 0, 0, 0, 0, 0], (20, 1)), abs=1e-12)


def test_encodings_go_both_ways():
    box = geograd.Aabb2([[1.0, 2.0, 4.0, 8.0]])
    assert geograd.convert(box, to="Xywh").array.tolist() == [[1, 2, 3, 6]]
    assert geograd.convert(box, to="Cxcywh").array.tolist() == [[2.5, 5, 3, 6]]
    for name in ("Xywh", "Cxcywh"):
        assert geograd.convert(geograd.convert(box, to=name)).array.tolist() == box.array.tolist()
    image = geograd.ImageBox([[50.0, 40.0, 20.0, 10.0, 0.3]])
    for name in ("Le90", "Le135", "OpenCvBox", "Detectron2Box"):
        back = geograd.convert(geograd.convert(image, to=name), to="ImageBox")
        upright = geograd.flip_y(back, 100.0), geograd.flip_y(image, 100.0)
        assert geograd.iou(*upright) == pytest.approx(1)
    assert geograd.flip_y(geograd.flip_y(image, 100.0), 100.0).array == pytest.approx(image.array)
    yaw = geograd.YawBox3([[1, 2, 3, 4, 5, 6, 0.4]])
    lidar = geograd.convert(yaw, to="LidarBox")
    assert geograd.convert(lidar).array.tolist() == yaw.array.tolist()


def test_boxes_of_torchvision_are_those_of_detectron2():
    torch = pytest.importorskip("torch")
    convert = pytest.importorskip("torchvision.ops").box_convert
    numbers = np.array([[50.0, 40.0, 20.0, 10.0, 30.0], [0.0, 0.0, 4.0, 2.0, -100.0]])
    try:
        corners = convert(torch.tensor(numbers), "cxcywhr", "xyxyxyxy").numpy()
    except ValueError:
        pytest.skip("this torchvision has no rotated boxes")
    image = geograd.convert(geograd.Detectron2Box(numbers), to="ImageBox")
    # The numbers of an image's box, read where y points up, have the same corners.
    own = geograd.corners(geograd.Obb2(np.asarray(image))).array
    assert own.reshape(2, -1) == pytest.approx(corners.reshape(2, -1))
    assert geograd.convert(image, to="Detectron2Box").array == pytest.approx(numbers)

"""Contacts of bodies, bodies in motion, and boxes of space with a constant weight: values by other verbs, slopes by differences."""

import numpy as np
import pytest

import geograd

COUNT = 40


def boxes(draw, at, size=(0.3, 1.5)):
    count = len(at)
    return geograd.Obb3(np.c_[at, draw.uniform(*size, (count, 3)), draw.normal(size=(count, 4))])


def drawn(draw):
    """Bodies a few sizes apart, and motions that lead most of them towards each other."""
    at = draw.normal(size=(COUNT, 3))
    away = at + 4 * draw.normal(size=(COUNT, 3))
    motion = geograd.Motion3(np.c_[at, (away - at) * draw.uniform(0.5, 1.5, (COUNT, 1)), draw.normal(size=(COUNT, 3))])
    other = geograd.Motion3(np.c_[away, 0.3 * draw.normal(size=(COUNT, 3)), draw.normal(size=(COUNT, 3))])
    return at, motion, away, other


def apart(bodies, time):
    a, of_a, b, of_b = bodies
    times = np.broadcast_to(time, len(a)).copy()
    moved = [geograd.move(geograd.pose_at(motion, times), body) for body, motion in ((a, of_a), (b, of_b))]
    return geograd.signed_distance(*moved)


@pytest.mark.parametrize("kinds", ["boxes", "capsules"])
def test_bodies_touch_at_the_time_of_impact_and_not_before(kinds):
    draw = np.random.default_rng(1)
    at, motion, away, other = drawn(draw)
    if kinds == "boxes":
        a, b = boxes(draw, at), boxes(draw, away)
    else:
        ends = [np.c_[x, x + draw.normal(size=x.shape), draw.uniform(0.1, 0.4, COUNT)] for x in (at, away)]
        a, b = map(geograd.Capsule3, ends)
    bodies = (a, motion, b, other)
    found = geograd.time_of_impact(*bodies).array
    time, kind = found[:, 0], found[:, 7]
    hit = kind == 1
    assert 5 < hit.sum() < COUNT
    assert np.abs(apart(bodies, np.where(hit, time, 0))[hit]).max() < 1e-10
    end = np.where(hit, time, 1.0)
    for share in np.linspace(0, 0.999, 50):
        assert (apart(bodies, share * end)[kind != 2] > -1e-12).all()
    # The least distance is no larger than any, and is one of them; bodies that miss each other have a positive one.
    least = geograd.clearance(*bodies)
    sampled = np.min([apart(bodies, t) for t in np.linspace(0, 1, 400)], axis=0)
    assert (least <= sampled + 1e-9).all() and (sampled - least < 0.05).all()
    assert ((least > 0) == (kind == 0)).all()


def test_gradients_of_time_and_clearance_are_differences():
    draw = np.random.default_rng(2)
    at, motion, away, other = drawn(draw)
    a, b = boxes(draw, at), boxes(draw, away)
    found = geograd.time_of_impact(a, motion, b, other).array
    hit = np.flatnonzero(found[:, 7] == 1)
    upstream = np.zeros((COUNT, 8))
    upstream[:, 0] = 1
    _, by_motion, _, by_other = geograd.time_of_impact.vjp(a, motion, b, other, geograd.Impact3(upstream))
    value, (_, by_least, by_box, _) = geograd.clearance.value_grad(a, motion, b, other)
    judged = 0
    for k in range(3, 9):
        for step in (1e-6,):
            both = [motion.array.copy(), motion.array.copy()]
            both[0][:, k] += step
            both[1][:, k] -= step
            ahead, behind = (geograd.Motion3(x) for x in both)
            times = [geograd.time_of_impact(a, m, b, other).array[:, 0] for m in (ahead, behind)]
            slope = ((times[0] - times[1]) / (2 * step))[hit]
            # A slope of thousands is an approach that all but misses.
            plain = np.abs(slope) < 100
            np.testing.assert_allclose(by_motion[hit, k][plain], slope[plain], rtol=1e-3, atol=1e-4)
            judged += plain.sum()
            least = [geograd.clearance(a, m, b, other) for m in (ahead, behind)]
            np.testing.assert_allclose(by_least[:, k], (least[0] - least[1]) / (2 * step), rtol=1e-3, atol=1e-4)
    assert judged > 40
    assert by_other.shape == (COUNT, 9) and by_box.shape == (COUNT, 10)


def test_motions_lead_from_pose_to_pose():
    draw = np.random.default_rng(3)
    start, end = (geograd.Pose3(np.c_[draw.normal(size=(COUNT, 4)), draw.normal(size=(COUNT, 3))]) for _ in range(2))
    points = geograd.Vec3(draw.normal(size=(COUNT, 3)))
    begun, ended = geograd.move(start, points).array, geograd.move(end, points).array
    for motion in (geograd.between(start, end), geograd.screw(start, end)):
        for time, there in ((0.0, begun), (1.0, ended)):
            pose = geograd.pose_at(motion, np.full(COUNT, time))
            np.testing.assert_allclose(geograd.move(pose, geograd.Vec3(begun)).array, there, atol=1e-12)
    # A screw shifts along its axis.
    screw = geograd.screw(start, end).array
    assert np.abs(np.cross(screw[:, 3:6], screw[:, 6:9])).max() < 1e-9


def test_contacts_lie_on_both_bodies_and_have_the_least_gap():
    draw = np.random.default_rng(4)
    a = boxes(draw, draw.normal(size=(COUNT, 3)) * 0.3)
    b = boxes(draw, draw.normal(size=(COUNT, 3)) * 0.6)
    found = geograd.contacts(a, b, np.full(COUNT, 0.05)).array
    normal, count, points = found[:, :3], found[:, 3].astype(int), found[:, 4:].reshape(COUNT, 8, 7)
    near = geograd.signed_distance(a, b)
    assert ((count > 0) == (near <= 0.05)).all() and (count > 1).any() and (count == 0).any()
    for k in np.flatnonzero(count):
        own = points[k, : count[k]]
        np.testing.assert_allclose(own[:, 6].min(), near[k], atol=1e-12)
        np.testing.assert_allclose(own[:, 3:6] - own[:, :3], own[:, 6:] * normal[k], atol=1e-9)
        on_a = geograd.Vec3(np.ascontiguousarray(own[:, :3]))
        same = geograd.Obb3(np.repeat(a.array[k : k + 1], count[k], 0))
        assert (geograd.signed_distance(on_a, same) < 1e-9).all()
        assert not points[k, count[k] :].any()


def test_a_book_on_a_table():
    table = geograd.Obb3([[0, 0, 0, 4, 4, 1, 1, 0, 0, 0]])
    book = geograd.Obb3([[2, 0, 0.75, 2, 1, 0.5, 1, 0, 0, 0]])
    found = geograd.contacts(table, book, np.array([0.01])).array[0]
    assert found[:4].tolist() == [0, 0, 1, 4]
    # The upstream cotangent of the first gap: it grows with the book's height.
    upstream = np.zeros((1, 60))
    upstream[0, 10] = 1
    by_table, by_book, by_within = geograd.contacts.vjp(table, book, np.array([0.01]), geograd.Contacts3(upstream))
    assert by_book[0, 2] == 1 and by_table[0, 2] == -1 and by_book[0, 5] == -0.5 and by_within[0] == 0


@pytest.mark.parametrize("shape", ["Aabb3", "YawBox3", "Obb3"])
def test_complete_iou_with_a_constant_weight(shape):
    draw = np.random.default_rng(5)

    def some():
        at = 0.3 * draw.normal(size=(COUNT, 3))
        size = draw.uniform(0.5, 2, (COUNT, 3))
        if shape == "Aabb3":
            return geograd.Aabb3(np.c_[at - size / 2, at + size / 2])
        turn = draw.normal(size=(COUNT, 1 if shape == "YawBox3" else 4))
        return getattr(geograd, shape)(np.c_[at, size, turn])

    def aspect(a, b):
        sizes = [x.array[:, 3:6] - (x.array[:, :3] if shape == "Aabb3" else 0) for x in (a, b)]
        turns = [np.arctan2(size, np.roll(size, -1, 1)) for size in sizes]
        return 4 / np.pi**2 * np.mean((turns[0] - turns[1]) ** 2, axis=1)

    a, b = some(), some()
    value, (by_a, _) = geograd.ciou_fixed_weight.value_grad(a, b)
    np.testing.assert_allclose(value, geograd.ciou(a, b), rtol=1e-12, atol=1e-14)
    v = aspect(a, b)
    weight = v / (1 - geograd.iou(a, b) + v)
    # DIoU less the constant weight times the difference of the aspects.
    _, (by_diou, _) = geograd.diou.value_grad(a, b)
    for k in range(3, 6):
        both = [a.array.copy(), a.array.copy()]
        both[0][:, k] += 1e-6
        both[1][:, k] -= 1e-6
        ahead, behind = (type(a)(x) for x in both)
        slope = (aspect(ahead, b) - aspect(behind, b)) / 2e-6
        np.testing.assert_allclose(by_a[:, k], by_diou[:, k] - weight * slope, atol=1e-7)

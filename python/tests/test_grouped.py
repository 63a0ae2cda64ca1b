"""Groups in one call give what a call per group gives; matching and metrics over all frames."""

import numpy as np
import pytest

import geograd
import geograd.assignment
import geograd.metric

RNG = np.random.default_rng(29)


def boxes(count, dtype=np.float64):
    made = RNG.uniform(1, 6, (count, 5))
    made[:, 4] -= 3
    return made.astype(dtype)


def offsets(sizes):
    return np.concatenate([[0], np.cumsum(sizes)])


SIZES = np.array([[3, 4], [0, 5], [6, 0], [1, 1], [40, 700], [0, 0], [30, 20], [300, 90]])
GROUPS = offsets(SIZES[:, 0]), offsets(SIZES[:, 1])


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_groups_are_a_loop_of_calls(dtype):
    a, b = boxes(GROUPS[0][-1], dtype), boxes(GROUPS[1][-1], dtype)
    i, j, iou = geograd.iou.above(a, b, 0.2, groups=GROUPS, kind="Obb2")
    best, at = geograd.iou.row_max(a, b, groups=GROUPS, kind="Obb2")
    most, of = geograd.iou.column_max(geograd.Obb2(a), geograd.Obb2(b), groups=[list(x) for x in GROUPS])
    assert iou.dtype == best.dtype == dtype
    expected = []
    for g in range(len(SIZES)):
        rows, columns = (slice(x[g], x[g + 1]) for x in GROUPS)
        own = geograd.iou.above(a[rows], b[columns], 0.2, kind="Obb2")
        expected.append([own[0] + rows.start, own[1] + columns.start, own[2]])
        if len(a[rows]) and len(b[columns]):
            values, places = geograd.iou.row_max(a[rows], b[columns], kind="Obb2")
            np.testing.assert_array_equal(best[rows], values)
            np.testing.assert_array_equal(at[rows], places + columns.start)
            values, places = geograd.iou.column_max(a[rows], b[columns], kind="Obb2")
            np.testing.assert_array_equal(most[columns], values)
            np.testing.assert_array_equal(of[columns], places + rows.start)
        else:
            assert (at[rows] == -1).all() and (best[rows] == -np.inf).all()
            assert (of[columns] == -1).all() and (most[columns] == -np.inf).all()
    for own, wanted in zip((i, j, iou), map(np.concatenate, zip(*expected))):
        np.testing.assert_array_equal(own, wanted)
    assert len(i) > 100


def test_suppression_by_groups():
    a = boxes(GROUPS[1][-1], np.float32)
    scores = RNG.integers(0, 30, len(a)).astype(np.float32)
    classes = RNG.integers(0, 2, len(a))
    kept = geograd.iou.suppress(a, scores, 0.3, groups=GROUPS[1], classes=classes, score=3, most=40, kind="Obb2")
    expected = []
    for start, end in zip(GROUPS[1], GROUPS[1][1:]):
        own = geograd.iou.suppress(
            a[start:end], scores[start:end], 0.3, classes=classes[start:end], score=3, most=40, kind="Obb2"
        )
        expected.append(own + start)
    np.testing.assert_array_equal(kept, np.concatenate(expected))
    alone = geograd.iou.suppress(geograd.Obb2(a[:7]), np.arange(7.0), 1.0)
    np.testing.assert_array_equal(alone, [6, 5, 4, 3, 2, 1, 0])


def test_wrong_groups_are_named():
    a, b = geograd.Obb2(boxes(4)), geograd.Obb2(boxes(3))
    for groups, why in [
        (([0, 4], [0, 2]), "groups of `b`: offset 1"),
        (([0, 3, 2, 4], [0, 1, 2, 3]), "groups of `a`: offset 2"),
        (([0, 4], [0, 1, 3]), "groups"),
        (([0, -1, 4], [0, 1, 3]), "offset 1 is negative"),
    ]:
        with pytest.raises(ValueError, match=why):
            geograd.iou.above(a, b, 0.5, groups=groups)
    with pytest.raises(TypeError, match="whole numbers"):
        geograd.iou.above(a, b, 0.5, groups=([0.0, 4.0], [0, 3]))
    with pytest.raises(TypeError, match="offsets of both lists"):
        geograd.iou.row_max(a, b, groups=[0, 4, 3])
    with pytest.raises(ValueError, match="groups of `a`"):
        geograd.iou.suppress(a, np.ones(4), 0.5, groups=[0, 3])
    with pytest.raises(ValueError, match="`a` item 2: width is negative"):
        wrong = boxes(4)
        wrong[2, 2] = -1
        geograd.iou.above(geograd.Obb2(wrong), b, 0.5, groups=([0, 4], [0, 3]))


def most(matrix):
    """The largest sum of one-to-one entries, by trying everything."""
    if not len(matrix):
        return 0.0
    taken = [matrix[0, k] + most(np.delete(matrix[1:], k, axis=1)) for k in range(matrix.shape[1])]
    return max([most(matrix[1:]), *taken])


def test_assignment_of_all_frames_is_that_of_each():
    groups = offsets(RNG.integers(0, 6, 50)), offsets(RNG.integers(0, 6, 50))
    a, b = boxes(groups[0][-1]), boxes(groups[1][-1])
    pairs = geograd.iou.above(a, b, 0.05, groups=groups, kind="Obb2")
    first, second, overlap = geograd.assignment.largest(pairs)
    assert len(set(first)) == len(first) and len(set(second)) == len(second) and (np.diff(first) > 0).all()
    best = 0.0
    for g in range(50):
        matrix = np.zeros((len(a), len(b)))
        matrix[pairs[0], pairs[1]] = pairs[2]
        own = matrix[groups[0][g] : groups[0][g + 1], groups[1][g] : groups[1][g + 1]]
        best += most(own)
    assert overlap.sum() == pytest.approx(best, abs=1e-12)
    assert geograd.assignment.greedy(pairs)[2].sum() <= best
    with pytest.raises(TypeError, match="pairs"):
        geograd.assignment.greedy(3)


@geograd.function
def overlap(a: geograd.Obb2, b: geograd.Obb2):
    return geograd.iou(a, b)


def test_own_functions_have_groups_and_suppression():
    a, b = boxes(GROUPS[0][-1]), boxes(GROUPS[1][-1])
    scores = RNG.random(len(b))
    for mine, verbs in [
        (overlap.above(a, b, 0.2, groups=GROUPS), geograd.iou.above(a, b, 0.2, groups=GROUPS, kind="Obb2")),
        (overlap.row_max(a, b, groups=GROUPS), geograd.iou.row_max(a, b, groups=GROUPS, kind="Obb2")),
        (overlap.column_max(a, b, groups=GROUPS), geograd.iou.column_max(a, b, groups=GROUPS, kind="Obb2")),
    ]:
        for own, wanted in zip(mine, verbs):
            np.testing.assert_allclose(own, wanted, rtol=1e-12)
    kept = overlap.suppress(b, scores, 0.3, groups=GROUPS[1])
    np.testing.assert_array_equal(kept, geograd.iou.suppress(b, scores, 0.3, groups=GROUPS[1], kind="Obb2"))
    assert 0 < len(kept) < len(b)
    for refused in (overlap.row_max, overlap.sum, overlap.value_grad, overlap.aligned):
        with pytest.raises(TypeError, match="kind= and to= choose a row of a verb"):
            refused(a, a, kind="Obb2")


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_across_groups_change_nothing(threads):
    groups = offsets(RNG.integers(0, 20, 900)), offsets(RNG.integers(0, 20, 900))
    a, b = boxes(groups[0][-1]), boxes(groups[1][-1])
    pairs = geograd.iou.above(a, b, 0.05, groups=groups, kind="Obb2")
    assert len(pairs[0]) > 20_000
    scores = RNG.integers(0, 50, len(a)) / 50
    ignored = {"ignored_truths": RNG.random(len(b)) < 0.1, "ignored_detections": RNG.random(len(a)) < 0.1}
    before = geograd.get_num_threads()
    try:
        geograd.set_num_threads(threads)
        own = [
            geograd.assignment.greedy(pairs, groups), geograd.assignment.largest(pairs, groups),
            geograd.metric.outcomes(scores, len(b), pairs, 0.3, groups=groups, **ignored),
        ]
    finally:
        geograd.set_num_threads(before)
    # Greedy pairs come group by group, in each the largest overlap first.
    greedy = np.array(geograd.assignment.greedy(pairs))
    group = np.searchsorted(groups[0], greedy[0], side="right")
    np.testing.assert_array_equal(own[0], greedy[:, np.argsort(group, kind="stable")])
    np.testing.assert_array_equal(own[1], geograd.assignment.largest(pairs))
    np.testing.assert_array_equal(own[2], geograd.metric.outcomes(scores, len(b), pairs, 0.3, **ignored))
    crossing = [np.append(x, y) for x, y in zip(pairs, (0, len(b) - 1, 0.5))]
    with pytest.raises(ValueError, match="is in another group"):
        geograd.assignment.greedy(crossing, groups)


def test_metrics_of_all_frames():
    # Two frames: a hit, a hit with a second detection of it, a miss.
    scores, pairs = [0.9, 0.8, 0.7], ([0, 1, 2], [0, 1, 1], [0.8, 0.7, 0.9])
    found = geograd.metric.outcomes(scores, 3, pairs, 0.5)
    np.testing.assert_array_equal(found, [0, 1, -1])
    ignored = geograd.metric.outcomes(scores, 3, pairs, 0.5, ignored_truths=[True, False, False])
    np.testing.assert_array_equal(ignored, [-2, 1, -1])
    curve = geograd.metric.curve(scores, found, 3)
    np.testing.assert_allclose(curve[1], [1, 1, 2 / 3])
    assert geograd.metric.average_precision(curve) == pytest.approx(2 / 3)
    judged = geograd.metric.kitti(scores, pairs, 0.5, truths=[0, 0, 1], angles=([0.0, 0.0, 0.0], [0.0, np.pi / 2, 0.0]))
    assert judged["truths"] == 2 and judged["aos"] < judged["ap"]
    assert geograd.metric.kitti(scores, pairs, 0.5, truths=[0, 0, 1])["aos"] is None
    with pytest.raises(ValueError, match="`truths` item 1"):
        geograd.metric.kitti(scores, pairs, 0.5, truths=[0, 7, 1])


def test_nuscenes_of_all_frames():
    box = np.array([[0.0, 0, 2, 4, 1.5, 0.1], [9.0, 0, 2, 4, 1.5, 0.2]])
    moved = box + [0.5, 0, 0, 0, 0, 0.1]
    groups = [0, 1, 2], [0, 1, 2]
    same = geograd.metric.nuscenes({"box": moved}, [0.9, 0.8], {"box": box}, groups)
    assert same["aps"][0] == 0 and same["aps"][1:] == pytest.approx([1, 1, 1])  # half a metre is not closer than half a metre
    assert same["errors"]["translation"] == pytest.approx(0.5) and same["errors"]["orientation"] == pytest.approx(0.1)
    assert same["errors"]["velocity"] == 1 and same["errors"]["scale"] == 0
    score = geograd.metric.nuscenes_score({"traffic_cone": same})
    assert score == pytest.approx((5 * 0.75 + 0.5 + 1.0) / 10)
    with pytest.raises(ValueError, match="`truths` item 1: size is not positive"):
        geograd.metric.nuscenes({"box": moved}, [0.9, 0.8], {"box": box * [[1] * 6, [1, 1, 0, 1, 1, 1]]}, groups)


def by_voc(scores, truths, pairs, threshold, ignored_truths, ignored_detections):
    """The rule of PASCAL VOC, one detection after the other."""
    taken, found = set(), {}
    for i in sorted(range(len(scores)), key=lambda i: (-scores[i], i)):
        near = [(-value, truth) for row, truth, value in zip(*pairs) if row == i and value >= threshold]
        truth = min(near)[1] if near else None
        if ignored_detections[i] or (truth is not None and ignored_truths[truth]):
            found[i] = -2
        elif truth is None or truth in taken:
            found[i] = -1
        else:
            taken.add(truth)
            found[i] = truth
    return [found[i] for i in range(len(scores))]


def test_outcomes_by_the_rule_of_voc():
    from geograd import metric

    # Both find truth 0 best; the second one has another that is free.
    pairs = ([0, 1, 1], [0, 0, 1], [0.9, 0.8, 0.7])
    assert metric.outcomes([0.9, 0.8], 2, pairs, 0.5).tolist() == [0, 1]
    assert metric.outcomes_voc([0.9, 0.8], 2, pairs, 0.5).tolist() == [0, -1]
    dice = np.random.default_rng(8)
    seen = set()
    for _ in range(60):
        n, m = dice.integers(1, 9, 2)
        every = np.stack(np.meshgrid(np.arange(n), np.arange(m)), -1).reshape(-1, 2)
        some = every[dice.random(len(every)) < 0.6]
        # Few values, so that scores and overlaps tie.
        pairs = some[:, 0], some[:, 1], dice.integers(1, 6, len(some)) / 5
        scores, ignored = dice.integers(0, 4, n) / 4, (dice.random(m) < 0.2, dice.random(n) < 0.2)
        found = metric.outcomes_voc(scores, m, pairs, 0.4, ignored_truths=ignored[0], ignored_detections=ignored[1])
        assert found.tolist() == by_voc(scores, m, pairs, 0.4, *ignored)
        seen |= set(np.minimum(found, 0).tolist())
    assert seen == {0, -1, -2}
    assert metric.outcomes_voc([], 0, ([], [], []), 0.5).tolist() == []
    with pytest.raises((ValueError, IndexError)):
        metric.outcomes_voc([0.9], 1, ([3], [0], [0.9]), 0.5)

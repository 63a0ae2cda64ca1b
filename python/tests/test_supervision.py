"""Stand-ins for supervision: against the original, and against shapely."""

import doctest
import pickle
import subprocess
import sys

import numpy as np
import pytest

import geograd
import geograd.supervision as ours


@pytest.fixture(scope="module")
def sv():
    reason = "supervision is not installed: the original is not compared"
    pytest.importorskip("supervision.metrics", reason=reason)
    return pytest.importorskip("supervision", reason=reason)


def upright(count, seed, dtype=np.float64):
    draw = np.random.default_rng(seed)
    at = draw.uniform(0, 60, (count, 2))
    return np.c_[at, at + draw.uniform(3, 30, (count, 2))].astype(dtype)


def oriented(count, seed, dtype=np.float64):
    draw = np.random.default_rng(seed)
    boxes = np.c_[draw.uniform(0, 60, (count, 2)), draw.uniform(3, 30, (count, 2)), draw.uniform(-4, 4, count)]
    corners = geograd.corners(geograd.Obb2(boxes)).array.reshape(count, 4, 2)
    # Both senses.
    corners[::2] = corners[::2, ::-1]
    return corners.astype(dtype)


def detections(sv, count, seed, labelled=False):
    draw = np.random.default_rng(seed)
    corners = oriented(count, seed)
    xyxy = np.concatenate([corners.min(1), corners.max(1)], 1)
    return sv.Detections(
        xyxy=xyxy, class_id=draw.integers(0, 3, count),
        confidence=None if labelled else draw.integers(1, 30, count) / 30,
        data={"xyxyxyxy": corners},
    )


def test_the_example_of_the_module():
    found = doctest.testmod(ours)
    assert found.failed == 0 and found.attempted > 4


def test_neither_torch_nor_supervision_is_imported():
    code = "import sys, geograd.supervision; print([x for x in ('torch', 'supervision', 'cv2') if x in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"


@pytest.mark.parametrize("metric", ["IOU", "IOS"])
@pytest.mark.parametrize("dtype", [np.float64, np.float32, np.int64, np.int32])
def test_matrices_are_supervisions(sv, metric, dtype):
    a, b = upright(40, 1, dtype), upright(30, 2, dtype)
    expected = sv.box_iou_batch(a, b, metric)
    for own in (metric, metric.lower(), sv.OverlapMetric(metric)):
        found = ours.box_iou_batch(a, b, own)
        assert found.dtype == expected.dtype == np.float32 and abs(found - expected).max() < 1e-7
    a, b = oriented(40, 1), oriented(30, 2)
    if dtype in (np.int64, np.int32):
        # Convex for sure.
        corners = [0, 1, 2, 1, 2, 3, 0, 3]
        a, b = [upright(n, seed, dtype)[:, corners].reshape(-1, 4, 2) for n, seed in ((40, 1), (30, 2))]
    a, b = a.astype(dtype), b.astype(dtype)
    expected = sv.detection.utils.iou_and_nms.oriented_box_iou_batch(a, b, sv.OverlapMetric(metric))
    for own in ((a, b), (a.reshape(-1, 8), b)):
        found = ours.oriented_box_iou_batch(*own, metric)
        assert found.dtype == expected.dtype == np.float64 and abs(found - expected).max() < 1e-5


def test_oriented_overlaps_are_those_of_polygons():
    shapely = pytest.importorskip("shapely", reason="shapely is not installed: oriented IoU is not compared")
    a, b = oriented(40, 1), oriented(30, 2)
    # Convex, and no rectangles.
    a[:, 0] += 0.2 * (a[:, 0] - a[:, 2])
    p, q = shapely.polygons(a)[:, None], shapely.polygons(b)[None]
    shared = shapely.area(shapely.intersection(p, q))
    assert abs(ours.oriented_box_iou_batch(a, b) - shared / (shapely.area(p) + shapely.area(q) - shared)).max() < 1e-13
    smaller = np.minimum(shapely.area(p), shapely.area(q))
    assert abs(ours.oriented_box_iou_batch(a, b, "ios") - shared / smaller).max() < 1e-13


@pytest.mark.parametrize("metric", ["IOU", "IOS"])
@pytest.mark.parametrize("threshold", [0.0, 0.3, 0.7, 1.0])
def test_suppression_is_supervisions(sv, metric, threshold):
    draw = np.random.default_rng(4)
    both = sv.detection.utils.iou_and_nms
    for count, columns in ((0, 5), (1, 6), (120, 5), (120, 6), (300, 6)):
        rows = np.c_[upright(count, 3), draw.integers(0, 30, count) / 30, draw.integers(0, 4, count)][:, :columns]
        expected = sv.box_non_max_suppression(rows, threshold, sv.OverlapMetric(metric))
        found = ours.box_non_max_suppression(rows, threshold, metric)
        assert found.dtype == bool and found.tolist() == expected.tolist()
        corners = oriented(count, 3)
        expected = both.oriented_box_non_max_suppression(rows, corners, threshold, sv.OverlapMetric(metric))
        assert ours.oriented_box_non_max_suppression(rows, corners, threshold, metric).tolist() == expected.tolist()
        if count == 120 and threshold == 0.3:
            assert 10 < expected.sum() < 110


def test_detections(sv):
    some = detections(sv, 80, 5)
    for agnostic in (False, True):
        expected, found = some.with_nms(0.1, agnostic), ours.with_nms(some, 0.1, agnostic)
        assert np.array_equal(found.xyxy, expected.xyxy) and 5 < len(found) < 75
    plain = sv.Detections(xyxy=some.xyxy, class_id=some.class_id, confidence=some.confidence)
    assert np.array_equal(ours.with_nms(plain, 0.4).xyxy, plain.with_nms(0.4).xyxy)
    expected = plain.with_nms(0.4, overlap_metric=sv.OverlapMetric.IOS)
    assert np.array_equal(ours.with_nms(plain, 0.4, overlap_metric="IOS").xyxy, expected.xyxy)


@pytest.mark.parametrize("target", ["BOXES", "ORIENTED_BOUNDING_BOXES"])
def test_mean_average_precision(sv, target, monkeypatch):
    asked = []

    def spied(*arguments):
        asked.append(len(arguments[0]))
        return ours.oriented_box_iou_batch(*arguments)

    monkeypatch.setitem(ours._STANDS_IN, "oriented_box_iou_batch", spied)
    metrics = sys.modules["supervision.metrics"]
    target = metrics.MetricTarget[target]
    results = []
    for cls in (metrics.MeanAveragePrecision, ours.MeanAveragePrecision):
        made = cls(metric_target=target)
        for seed in range(6):
            truths = detections(sv, 30, seed, labelled=True)
            guesses = detections(sv, 30, seed)
            draw = np.random.default_rng(seed)
            move = draw.normal(0, 1.0, (30, 1, 2))
            guesses.data["xyxyxyxy"] = guesses.data["xyxyxyxy"] + move
            guesses.xyxy = guesses.xyxy + np.concatenate([move, move], -1)[:, 0]
            made.update(guesses, truths)
        made.update(sv.Detections.empty(), sv.Detections.empty())
        assert not asked
        results.append(made.compute())
    assert bool(asked) == (target.name != "BOXES")
    expected, found = results
    np.testing.assert_allclose(found.mAP_scores, expected.mAP_scores, atol=1e-6)
    np.testing.assert_allclose(found.ap_per_class, expected.ap_per_class, atol=1e-6)
    assert 0.3 < found.map50_95 < 0.95 and found.map50 > found.map75
    cls = ours.MeanAveragePrecision
    assert issubclass(cls, metrics.MeanAveragePrecision) and pickle.loads(pickle.dumps(cls)) is cls


def test_everything_of_supervision_takes_the_overlaps_and_gives_them_back(sv):
    both = sys.modules["supervision.detection.utils.iou_and_nms"]
    metric = sys.modules["supervision.metrics.mean_average_precision"]
    kept = both.oriented_box_iou_batch, metric.oriented_box_iou_batch, sv.box_iou_batch
    assert len({id(x) for x in kept[:2]}) == 1
    some = detections(sv, 40, 6)
    expected = some.with_nmm(0.4)
    with pytest.raises(KeyError), ours.exact():
        for module in (both, metric):
            assert module.oriented_box_iou_batch is ours.oriented_box_iou_batch
        assert sv.box_iou_batch is ours.box_iou_batch
        assert len(some.with_nmm(0.4)) == len(expected) < 40
        raise KeyError
    assert (both.oriented_box_iou_batch, metric.oriented_box_iou_batch, sv.box_iou_batch) == kept


def test_no_boxes_and_boxes_without_an_area():
    for a, b in ((0, 3), (3, 0), (0, 0)):
        assert ours.box_iou_batch(upright(a, 1), upright(b, 1)).shape == (a, b)
        assert ours.oriented_box_iou_batch(oriented(a, 1), oriented(b, 1)).shape == (a, b)
    flat = np.array([[1.0, 1, 1, 5], [0, 0, 4, 4]])
    assert ours.box_iou_batch(flat, flat).tolist() == [[0, 0], [0, 1]]
    # A box of no width that rounding has turned inside out.
    thin = oriented(1, 1)[0] + 1e5
    thin[1:3] = thin[0] + (thin[1:3] - thin[1]) * 1e-9
    quads = np.stack([thin, oriented(1, 1)[0] + 1e5])
    found = ours.oriented_box_iou_batch(quads, quads)
    assert found[0].tolist() == [0, 0] and found[1, 1] == 1


def test_errors(sv):
    with pytest.raises(ValueError, match="overlap_metric is 'IOU' or 'IOS', not 'GIOU'"):
        ours.box_iou_batch(upright(2, 1), upright(2, 1), "GIOU")
    with pytest.raises(ValueError, match=r"`boxes_detection` has shape \(2, 3\); expected \(N, 4\)"):
        ours.box_iou_batch(upright(2, 1), np.ones((2, 3)))
    both = sv.detection.utils.iou_and_nms
    for bad in (np.ones((2, 4)), np.ones((2, 3, 2)), np.ones(8)):
        for call in (both.oriented_box_iou_batch, ours.oriented_box_iou_batch):
            with pytest.raises(ValueError, match="boxes_true"):
                call(bad, oriented(2, 1))
    for threshold in (-0.1, 1.1):
        for call in (sv.box_non_max_suppression, ours.box_non_max_suppression):
            with pytest.raises(ValueError):
                call(np.ones((2, 5)), threshold)
    with pytest.raises(ValueError, match="3 `predictions` and 2 `oriented_boxes`"):
        ours.oriented_box_non_max_suppression(np.ones((3, 5)), oriented(2, 1))
    crossed = np.array([[[0, 0], [4, 4], [4, 0], [0, 4.5]]])
    with pytest.raises(ValueError, match="item 0.*not convex"):
        ours.oriented_box_iou_batch(crossed, crossed)

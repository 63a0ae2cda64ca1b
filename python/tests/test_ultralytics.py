"""Stand-ins for Ultralytics: scores against the original, exact IoU against shapely, the validator."""

import doctest
import pickle
import types

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="torch is not installed: geograd.ultralytics is not tested")

import geograd.ultralytics as ours


@pytest.fixture(scope="module")
def metrics():
    reason = "ultralytics is not installed: the original is not compared"
    pytest.importorskip("ultralytics", reason=reason)
    return pytest.importorskip("ultralytics.utils.metrics", reason=reason)


def boxes(count, seed, dtype=torch.float64):
    draw = np.random.default_rng(seed)
    rows = np.c_[draw.uniform(0, 40, (count, 2)), draw.uniform(3, 30, (count, 2)), draw.uniform(-4, 4, count)]
    return torch.tensor(rows, dtype=dtype)


def exact(a, b):
    shapely = pytest.importorskip("shapely", reason="shapely is not installed: exact IoU is not compared")
    corners = pytest.importorskip("ultralytics.utils.ops").xywhr2xyxyxyxy
    a, b = shapely.polygons(corners(a.double().numpy()))[:, None], shapely.polygons(corners(b.double().numpy()))[None]
    shared = shapely.area(shapely.intersection(a, b))
    return shared / (shapely.area(a) + shapely.area(b) - shared)


def test_the_example_of_the_module():
    found = doctest.testmod(ours)
    assert found.failed == 0 and found.attempted > 4


def test_exact_iou_is_that_of_polygons():
    for dtype, near in ((torch.float64, 1e-13), (torch.float32, 1e-5), (torch.float16, 1e-3)):
        a, b = boxes(30, 1, dtype), boxes(20, 2, dtype)
        found = ours.batch_iou(a, b)
        assert found.dtype == dtype and abs(found.double().numpy() - exact(a, b)).max() < near
        aligned = ours.iou(a[:20], b)
        assert aligned.shape == (20, 1) and aligned.dtype == dtype
        torch.testing.assert_close(aligned[:, 0], found[:20].diagonal(), rtol=0, atol=near)
    arrays = ours.batch_iou(a.float().numpy(), b.float().numpy())
    torch.testing.assert_close(arrays, ours.batch_iou(a.float(), b.float()))


@pytest.mark.parametrize("dtype, near", [(torch.float64, 1e-12), (torch.float32, 1e-4)], ids=str)
def test_probabilistic_iou_is_ultralytics(metrics, dtype, near):
    a, b = boxes(40, 1, dtype).requires_grad_(), boxes(40, 2, dtype).requires_grad_()
    for more in ({}, {"CIoU": True}, {"eps": 0.01}, {"floor": 2.5}, {"CIoU": True, "floor": 0.5}):
        expected, found = metrics.probiou(a, b, **more), ours.probiou(a, b, **more)
        assert found.shape == expected.shape == (40, 1) and found.dtype == expected.dtype
        torch.testing.assert_close(found, expected, rtol=0, atol=near)
        expected, found = [torch.autograd.grad(x.sum(), (a, b)) for x in (expected, found)]
        torch.testing.assert_close(found, expected, rtol=near, atol=near)
    for more in ({}, {"eps": 0.01}):
        expected, found = metrics.batch_probiou(a, b[:30], **more), ours.batch_probiou(a, b[:30], **more)
        torch.testing.assert_close(found, expected, rtol=0, atol=near)
        up = torch.rand_like(expected)
        expected, found = [torch.autograd.grad(x, (a, b), up) for x in (expected, found)]
        torch.testing.assert_close(found, expected, rtol=near, atol=near * 10)
    arrays = [x.detach().numpy() for x in (a, b)]
    torch.testing.assert_close(ours.batch_probiou(*arrays), metrics.batch_probiou(*arrays), rtol=0, atol=near)


def test_thin_boxes_keep_their_determinants(metrics):
    a, b = torch.tensor([[500.0, 500.0, 500.0, 0.1, 0.7]]), torch.tensor([[500.0, 500.05, 500.0, 0.1, 0.7]])
    truth = metrics.probiou(a.double(), b.double()).item()
    assert abs(ours.probiou(a, b).item() - truth) < 1e-4 and abs(ours.batch_probiou(a, b).item() - truth) < 1e-4
    assert 0.5 < truth < 0.6 and abs(metrics.probiou(a, b).item() - truth) > 0.05


def test_gradients():
    a, b = boxes(3, 5).requires_grad_(), (boxes(3, 5) + torch.tensor([1.0, 2, 0.5, 0.3, 0.2])).requires_grad_()
    floored = lambda a, b: ours.probiou(a, b, floor=1.5)
    for call in (ours.iou, ours.batch_iou, ours.probiou, ours.batch_probiou, floored):
        assert torch.autograd.gradcheck(call, (a, b), atol=1e-6)


def test_no_boxes():
    none, some = torch.zeros((0, 5), requires_grad=True), torch.ones(3, 5)
    for call in (ours.batch_iou, ours.batch_probiou):
        assert call(none, some).shape == (0, 3) and call(some, none).shape == (3, 0)
        assert call(none, none).shape == (0, 0)
        call(none, some).sum().backward()
    for call in (ours.iou, ours.probiou):
        assert call(none, none).shape == (0, 1)
        call(none, none).sum().backward()
    assert none.grad.shape == (0, 5)
    assert ours.nms(none, torch.zeros(0), 0.5).tolist() == []


def test_suppression():
    a, scores = boxes(120, 3, torch.float32), torch.rand(120, generator=torch.Generator().manual_seed(1))
    overlaps, kept = exact(a, a), []
    for i in scores.argsort(descending=True).tolist():
        if all(overlaps[i, k] <= 0.4 for k in kept):
            kept.append(i)
    assert ours.nms(a, scores, 0.4).tolist() == kept and 5 < len(kept) < 115
    classes = torch.arange(120) % 5
    parts = [torch.nonzero(classes == c).squeeze(1) for c in range(5)]
    parts = sorted(i for part in parts for i in part[ours.nms(a[part], scores[part], 0.4)].tolist())
    assert sorted(ours.nms(a, scores, 0.4, classes).tolist()) == parts


def test_fast_nms_takes_exact_iou(metrics):
    fast_nms = pytest.importorskip("ultralytics.utils.nms").TorchNMS.fast_nms
    a, scores = boxes(60, 3, torch.float32), torch.rand(60, generator=torch.Generator().manual_seed(1))
    order = scores.argsort(descending=True)
    overlaps = np.triu(exact(a[order], a[order]), 1)
    expected = order[torch.from_numpy((overlaps > 0.4).sum(0) == 0)]
    assert fast_nms(a, scores, 0.4, iou_func=ours.batch_iou).tolist() == expected.tolist()


#: A thin box, and ones turned away from it: probabilistic IoU 0.68, 0.52, 0.46, exact IoU 0.601, 0.41, 0.34.
TRUTH = torch.tensor([[50.0, 50.0, 40.0, 4.0, 0.0]])
FOUND = torch.tensor([[50.0, 50.0, 40.0, 4.0, 0.1], [50.0, 50.0, 40.0, 4.0, 0.17], [50.0, 50.0, 40.0, 4.0, 0.2]])


def validator(cls, tmp_path, plots=False):
    made = cls(save_dir=tmp_path, args={"plots": plots, "conf": 0.001, "task": "obb"})
    made.device, made.data = torch.device("cpu"), {"val": "", "names": {0: "ship"}}
    made.init_metrics(types.SimpleNamespace(names={0: "ship"}, end2end=False))
    return made


def seen(cls, tmp_path, found, plots=False):
    """A validator that has seen an image with the truth and a detection."""
    made = validator(cls, tmp_path, plots)
    batch = {
        "batch_idx": torch.zeros(1), "cls": torch.zeros(1, 1),
        "bboxes": TRUTH / torch.tensor([100.0, 100, 100, 100, 1]),
        "ori_shape": [(100, 100)], "img": torch.zeros(1, 3, 100, 100), "ratio_pad": [None], "im_file": ["one.jpg"],
    }
    made.update_metrics([{"bboxes": found, "conf": torch.tensor([0.9]), "cls": torch.zeros(1)}], batch)
    return made


def test_the_validator_scores_by_exact_iou(metrics, tmp_path):
    original = pytest.importorskip("ultralytics.models.yolo.obb").OBBValidator
    cls = ours.OBBValidator
    assert issubclass(cls, original) and pickle.loads(pickle.dumps(cls)) is cls is ours.OBBValidator
    for row, (by_gaussians, by_area) in enumerate([(4, 3), (1, 0), (0, 0)]):
        for own, count in ((original, by_gaussians), (cls, by_area)):
            stats = seen(own, tmp_path, FOUND[row : row + 1]).metrics.stats
            assert np.asarray(stats["tp"]).sum() == count, (row, own)
    # The same scores for the original while the context is open, and its own after it.
    made = validator(original, tmp_path)
    preds, truth = {"cls": torch.zeros(1), "bboxes": FOUND[:1]}, {"cls": torch.zeros(1), "bboxes": TRUTH}
    with ours.exact():
        assert made._process_batch(preds, truth)["tp"].sum() == 3
    assert made._process_batch(preds, truth)["tp"].sum() == 4
    assert validator(cls, tmp_path)._process_batch(preds, truth)["tp"].sum() == 3
    none = {"cls": torch.zeros(0), "bboxes": torch.zeros(0, 5)}
    assert validator(cls, tmp_path)._process_batch(none, truth)["tp"].shape == (0, 10)


def test_the_confusion_matrix_is_by_exact_iou(metrics, tmp_path):
    original = pytest.importorskip("ultralytics.models.yolo.obb").OBBValidator
    # A match is above 0.45.
    for own, hits in ((original, 1), (ours.OBBValidator, 0)):
        matrix = seen(own, tmp_path, FOUND[1:2], plots=True).confusion_matrix.matrix
        assert matrix[0, 0] == hits and matrix.sum() == (1 if hits else 2)


def test_suppression_of_the_original_changes_where_it_is_asked_for(metrics):
    nms = pytest.importorskip("ultralytics.utils.nms")
    kept = nms.batch_probiou, metrics.batch_probiou
    with ours.exact():
        assert nms.batch_probiou is kept[0] and metrics.batch_probiou is ours.batch_iou
    with pytest.raises(KeyError), ours.exact(nms=True):
        assert nms.batch_probiou is ours.batch_iou
        # Rows of centre, size, one class, angle.
        rows = torch.cat([torch.cat([TRUTH, FOUND[1:2]])[:, :4], torch.tensor([[0.9], [0.8]])], 1)
        rows = torch.cat([rows, torch.tensor([[0.0], [0.17]])], 1).T[None]
        assert len(nms.non_max_suppression(rows, 0.1, 0.5, nc=1, rotated=True)[0]) == 2
        raise KeyError
    assert (nms.batch_probiou, metrics.batch_probiou) == kept
    assert len(nms.non_max_suppression(rows, 0.1, 0.5, nc=1, rotated=True)[0]) == 1


def test_errors():
    with pytest.raises(ValueError, match=r"`obb2`: a tensor of shape \(..., 5\) is needed, not \(3, 4\)"):
        ours.batch_iou(torch.ones(2, 5), torch.ones(3, 4))
    bad = torch.tensor([[0.0, 0, 1, 1, 0], [0, 0, 1, -1, 0]])
    with pytest.raises(ValueError, match="item 1: height is negative"):
        ours.batch_iou(bad, bad)
    with pytest.raises(ValueError, match=r"`scores`: a tensor of shape \(2,\)"):
        ours.nms(torch.ones(2, 5), torch.ones(3), 0.5)
    with pytest.raises(AttributeError, match="no attribute 'iuo'"):
        ours.iuo

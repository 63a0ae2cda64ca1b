"""How good detections are, over all frames at once: outcomes, curves, average precision; KITTI's and nuScenes' rules.

Detections and truths of all frames lie one after another. Pairs join places in these lists, as
``geograd.iou.above(detections, truths, threshold, groups=(offsets, offsets))`` gives them.
"""

from __future__ import annotations

import math
from typing import Any, Literal, Mapping, Optional, Sequence, Tuple

import numpy as np

from . import _core
from .assignment import Groups, Pairs, _pairs

#: Scores, precisions and recalls.
Curve = Tuple[Any, Any, Any]
Recalls = Literal["all", "eleven", "forty"]

#: Errors of true positives in the order of nuScenes: ATE, ASE, AOE, AVE, AAE.
ERRORS = ("translation", "scale", "orientation", "velocity", "attribute")


def _numbers(x: Any) -> Any:
    return np.ascontiguousarray(x, np.float64)


def _flags(x: Any) -> list[bool]:
    return [] if x is None else [bool(flag) for flag in np.asarray(x, bool).tolist()]


def outcomes(
    scores: Any,
    truths: int,
    pairs: Pairs,
    threshold: float,
    *,
    ignored_truths: Any = None,
    ignored_detections: Any = None,
    groups: Groups = None,
) -> Any:
    """The truth that every detection found; -1 for a wrong detection, -2 for one that does not count.

    By descending score a detection takes the truth that it overlaps most, if by at least the threshold. ``truths`` is the
    number of truths. ``groups``, the offsets of both lists, change no result: groups run on all threads.
    """
    ignored = _flags(ignored_truths), _flags(ignored_detections)
    return _core.outcomes(_numbers(scores), truths, *_pairs(pairs), float(threshold), *ignored, groups)


def curve(scores: Any, outcomes: Any, truths: int) -> Curve:
    """Scores, precisions and recalls, the highest score first. ``truths`` is the number of truths that count."""
    found: Curve = _core.curve(_numbers(scores), np.ascontiguousarray(outcomes, np.int64), truths)
    return found


def average_precision(curve: Curve, recalls: Recalls = "all") -> float:
    """The mean over recalls (``"eleven"``, ``"forty"``, ``"all"``) of the best precision at that recall or a higher one."""
    _, precision, recall = curve
    return float(_core.average_precision(_numbers(precision), _numbers(recall), recalls))


def kitti(
    scores: Any,
    pairs: Pairs,
    threshold: float,
    *,
    truths: Any,
    detections: Any = None,
    unlabelled: Any = None,
    angles: Optional[tuple[Any, Any]] = None,
    recalls: Recalls = "forty",
) -> dict[str, Any]:
    """Average precision and average orientation similarity by KITTI's rules, of one class and difficulty.

    ``truths`` and ``detections`` say how each counts: 0 fully, 1 ignored, 2 not at all. ``angles`` are the observation angles
    of truths and of detections. The result is a dict: ``ap``, ``aos`` (None without angles), ``curve``, ``truths``.
    """
    scores = _numbers(scores)
    detections = np.zeros(len(scores), np.int64) if detections is None else np.ascontiguousarray(detections, np.int64)
    unlabelled = np.zeros(0) if unlabelled is None else _numbers(unlabelled)
    turns = None if angles is None else (_numbers(angles[0]), _numbers(angles[1]))
    ap, aos, points, counted = _core.judge_kitti(
        np.ascontiguousarray(truths, np.int64), scores, detections, *_pairs(pairs), unlabelled, turns, float(threshold), recalls
    )
    return {"ap": ap, "aos": None if angles is None else aos, "curve": points, "truths": counted}


def _objects(objects: Mapping[str, Any], name: str) -> tuple[Any, Any]:
    boxes, velocity, attribute = objects["box"], objects.get("velocity"), objects.get("attribute")
    boxes = _numbers(boxes).reshape(-1, 6)
    velocity = np.full((len(boxes), 2), np.nan) if velocity is None else _numbers(velocity).reshape(-1, 2)
    attribute = np.full(len(boxes), -1) if attribute is None else attribute
    if len(velocity) != len(boxes) or len(attribute) != len(boxes):
        raise ValueError(f"{name}: {len(boxes)} boxes, {len(velocity)} velocities and {len(attribute)} attributes")
    return np.concatenate([boxes, velocity], axis=1), np.ascontiguousarray(attribute, np.int64)


def nuscenes(
    detections: Mapping[str, Any],
    scores: Any,
    truths: Mapping[str, Any],
    groups: Sequence[Any],
    *,
    thresholds: Sequence[float] = (0.5, 1.0, 2.0, 4.0),
    at: float = 2.0,
    period: float = math.tau,
) -> dict[str, Any]:
    """Average precision by distances of centres, and the errors of true positives, by nuScenes' rules, of one class.

    ``detections`` and ``truths`` are dicts: ``box`` with rows of x, y, width, length, height, yaw; optionally ``velocity``
    (NaN where unknown) and ``attribute`` (-1 for none). ``groups`` are the offsets of the frames in both lists. Barriers
    have a period of pi. The result has ``ap`` (the mean over the thresholds), ``aps`` and the five ``errors``.
    """
    offsets = tuple(np.asarray(x).tolist() for x in groups)
    found = _core.judge_nuscenes(
        _objects(detections, "detections"), _numbers(scores), _objects(truths, "truths"), offsets, [*thresholds, at], period
    )
    aps = [ap for ap, _ in found[:-1]]
    return {"ap": float(np.mean(aps)), "aps": aps, "errors": dict(zip(ERRORS, found[-1][1]))}


def nuscenes_score(
    classes: Mapping[str, Mapping[str, Any]], *, without: Optional[Mapping[str, Sequence[str]]] = None
) -> float:
    """The nuScenes detection score of the results of all classes, by name.

    ``without`` has by class the errors that do not count; by default those of the benchmark for traffic cones and barriers.
    """
    if without is None:
        cone = ("orientation", "velocity", "attribute")
        without = {"traffic_cone": cone, "barrier": ("velocity", "attribute")}
    mean = float(np.mean([own["ap"] for own in classes.values()]))
    scores = 5 * mean
    for error in ERRORS:
        own = [one["errors"][error] for name, one in classes.items() if error not in without.get(name, ())]
        scores += 1 - min(1.0, float(np.mean(own))) if own else 0.0
    return scores / 10

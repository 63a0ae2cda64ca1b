"""Average precision of oriented detections by probabilistic IoU, as Ultralytics scores them, and by exact IoU.

    python obb_ap.py --images 200

Truths and detections are generated: objects of four shapes in images of 1024 pixels, of which a detector finds nine
tenths, with errors of place, size and angle, and invents some. The table has AP at IoU 0.5 and 0.75, and the mean over
0.5 to 0.95.
"""

import argparse

import numpy as np

import geograd
from geograd import metric

#: Long and short side in pixels, and the error of the angle in degrees.
SHAPES = {"tank": (40, 40, 8.0), "car": (32, 16, 5.0), "ship": (120, 24, 3.0), "bridge": (300, 20, 2.0)}
THRESHOLDS = np.arange(0.5, 0.96, 0.05)


def truths(rng, sides, images):
    """Boxes of all images, and the offsets of the images."""
    counts = rng.integers(5, 15, images)
    boxes = np.zeros((counts.sum(), 5))
    boxes[:, :2] = rng.uniform(0, 1024, (len(boxes), 2))
    boxes[:, 2:4] = np.array(sides) * rng.uniform(0.8, 1.25, (len(boxes), 2))
    boxes[:, 4] = rng.uniform(-np.pi / 2, np.pi / 2, len(boxes))
    return boxes, np.concatenate([[0], np.cumsum(counts)])


def detections(rng, boxes, offsets, spread):
    """Boxes, scores and offsets: better boxes have higher scores, on the whole."""
    found, scores, ends = [], [], [0]
    for first, last in zip(offsets, offsets[1:]):
        own = boxes[first:last][rng.random(last - first) < 0.9].copy()
        error = rng.normal(0, 1, (len(own), 5))
        own[:, :2] += error[:, :2] * 0.08 * own[:, 3:4]
        own[:, 2:4] *= np.exp(error[:, 2:4] * 0.08)
        own[:, 4] += np.radians(spread) * error[:, 4]
        invented = boxes[rng.integers(0, len(boxes), rng.poisson(1.5))].copy()
        invented[:, :2] = rng.uniform(0, 1024, (len(invented), 2))
        found += [own, invented]
        quality = np.exp(-0.2 * np.abs(error).sum(1))
        scores += [quality * rng.uniform(0.6, 1, len(own)), rng.beta(2, 5, len(invented))]
        ends.append(ends[-1] + len(own) + len(invented))
    return np.concatenate(found), np.concatenate(scores), np.array(ends)


def precisions(verb, found, scores, boxes, offsets):
    """Average precision at every threshold."""
    pairs = verb.above(geograd.Obb2(found), geograd.Obb2(boxes), THRESHOLDS[0] - 1e-9, groups=offsets)
    made = []
    for threshold in THRESHOLDS:
        outcomes = metric.outcomes(scores, len(boxes), pairs, threshold)
        made.append(metric.average_precision(metric.curve(scores, outcomes, len(boxes))))
    return np.array(made)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--images", type=int, default=200, help="images of each shape (default 200)")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(arguments)
    rng = np.random.default_rng(options.seed)

    print(" " * 8 + "".join(f"{name:>18}" for name in ("AP50", "AP75", "AP50-95")))
    print(" " * 8 + f"{'probiou':>10}{'exact':>8}" * 3)
    for name, (long, short, spread) in SHAPES.items():
        boxes, ends = truths(rng, (long, short), options.images)
        found, scores, found_ends = detections(rng, boxes, ends, spread)
        by = [precisions(verb, found, scores, boxes, (found_ends, ends)) for verb in (geograd.probiou, geograd.iou)]
        cells = [(ap[0], ap[5], ap.mean()) for ap in by]
        print(f"{name:8}" + "".join(f"{p:10.3f}{e:8.3f}" for p, e in zip(*cells)))


if __name__ == "__main__":
    main()

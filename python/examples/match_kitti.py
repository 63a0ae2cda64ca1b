"""Matches detections to labels of a KITTI tracking sequence, frame by frame, by the overlap seen from above.

    python match_kitti.py                                        # a synthetic sequence
    python match_kitti.py --labels 0001.txt --detections det.txt

A line of a label file is: frame, track, class, truncation, occlusion, alpha, four numbers of the box in the image, height,
width, length, x, y, z, rotation, and for detections a score. Without --detections the labels are moved, dropped and
invented at random, which tests a matcher.
"""

import argparse
import pathlib
import tempfile

import numpy as np

import geograd

CLASSES = ("Car", "Van", "Truck", "Pedestrian", "Cyclist")


def read(path):
    """Frames, classes, boxes (height, width, length, x, y, z, rotation) and scores of a file."""
    frames, classes, boxes, scores = [], [], [], []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        words = line.split()
        if not words:
            continue
        if len(words) not in (17, 18):
            raise SystemExit(f"{path}:{number}: 17 or 18 columns are needed, not {len(words)}")
        if words[2] not in CLASSES:  # DontCare has no box in space
            continue
        try:
            frames.append(int(words[0]))
            boxes.append([float(word) for word in words[10:17]])
            scores.append(float(words[17]) if len(words) == 18 else 1.0)
        except ValueError as error:
            raise SystemExit(f"{path}:{number}: {error}") from None
        classes.append(words[2])
    boxes = np.array(boxes).reshape(-1, 7)
    return np.array(frames, int), np.array(classes, object), boxes, np.array(scores)


def write(path, frames, classes, boxes, scores=None):
    """Writes a file of labels, or of detections if there are scores."""
    lines = []
    for i, (frame, name, box) in enumerate(zip(frames, classes, boxes)):
        # Matching needs neither track nor image: unknown values as the benchmark writes them.
        words = [str(frame), "-1", name, "-1", "-1", "-10", "-1", "-1", "-1", "-1", *(f"{x:.4f}" for x in box)]
        lines.append(" ".join(words if scores is None else [*words, f"{scores[i]:.4f}"]))
    path.write_text("\n".join(lines) + "\n")


def synthetic(rng, count):
    """Labels of cars that drive away from the camera in three lanes."""
    frames, boxes = [], []
    for _ in range(max(count // 4, 4)):
        size = np.array([1.5, 1.7, 4.2]) * rng.uniform(0.9, 1.1, 3)
        lane, start, speed = rng.choice([-4.0, 0.0, 4.0]), rng.uniform(5, 60), rng.uniform(-0.4, 0.6)
        rotation = -np.pi / 2 + rng.normal(0, 0.05)
        first = rng.integers(0, count)
        for frame in range(first, min(first + count // 2 + 1, count)):
            z = start + speed * (frame - first)
            # Two cars never stand in one place.
            if any(f == frame and b[3] == lane and abs(b[5] - z) < 6 for f, b in zip(frames, boxes)):
                continue
            frames.append(frame)
            boxes.append([*size, lane, 1.7, z, rotation])
    order = np.argsort(frames, kind="stable")
    return np.array(frames)[order], np.full(len(frames), "Car", object), np.array(boxes)[order]


def disturbed(rng, frames, classes, boxes):
    """Detections: nine tenths of the labels with errors, and false ones."""
    found = rng.random(len(boxes)) < 0.9
    moved = boxes[found] + rng.normal(0, 1, (found.sum(), 7)) * [0.05, 0.06, 0.2, 0.12, 0.05, 0.3, 0.05]
    scores = rng.beta(6, 2, found.sum())
    false = max(len(boxes) // 10, 1)
    invented = boxes[rng.integers(0, len(boxes), false)] + rng.normal(0, 1, (false, 7)) * [0, 0, 0, 4, 0, 15, 1]
    frames = np.concatenate([frames[found], rng.choice(frames, false)])
    classes = np.concatenate([classes[found], np.full(false, "Car", object)])
    return frames, classes, np.concatenate([moved, invented]), np.concatenate([scores, rng.beta(2, 4, false)])


def matched(truths, detections, scores, threshold):
    """Rows of truths and of detections that belong together, and their IoU; the best scores choose first."""
    # Sparse: only pairs above the threshold come back.
    i, j, iou = geograd.iou_bev.above(truths, detections, threshold)
    order = np.lexsort((-iou, -scores[j]))
    free_truth, free_detection = np.ones(len(truths), bool), np.ones(len(detections), bool)
    pairs = []
    for k in order:
        if free_truth[i[k]] and free_detection[j[k]]:
            free_truth[i[k]] = free_detection[j[k]] = False
            pairs.append((i[k], j[k], iou[k]))
    return pairs


def draw(path, truths, detections, pairs, frame):
    """A frame seen from above."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.patches import Polygon

    figure, axes = plt.subplots(figsize=(9, 4.5))
    hits = {j: iou for _, j, iou in pairs}
    found = {i for i, _, _ in pairs}

    def outline(box, **style):
        x, y, _, dx, dy, _, heading = box
        corners = geograd.corners(geograd.Obb2(np.array([x, y, dx, dy, heading]))).array.reshape(4, 2)
        axes.add_patch(Polygon(corners, fill=False, **style))

    for i, box in enumerate(truths):
        outline(box, edgecolor="tab:blue" if i in found else "tab:orange", linewidth=2)
    for j, box in enumerate(detections):
        outline(box, edgecolor="tab:green" if j in hits else "tab:red", linewidth=1.5, linestyle="--")
        if j in hits:
            axes.annotate(f"{hits[j]:.2f}", box[:2], ha="center", va="center", fontsize=8)
    for label, color, style in [
        ("label, found", "tab:blue", "-"), ("label, missed", "tab:orange", "-"),
        ("detection, matched (IoU)", "tab:green", "--"), ("detection, false", "tab:red", "--"),
    ]:
        axes.plot([], [], color=color, linestyle=style, label=label)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.margins(0.05)
    axes.set(xlabel="forward (m)", ylabel="left (m)", title=f"Frame {frame} from above")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=4, frameon=False, fontsize=8)
    figure.savefig(path, dpi=110, bbox_inches="tight")


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--labels", type=pathlib.Path, help="a label file (default: a synthetic one)")
    parser.add_argument("--detections", type=pathlib.Path, help="a file of detections (default: disturbed labels)")
    parser.add_argument("--threshold", type=float, default=0.5, help="the least IoU of a match (default 0.5)")
    parser.add_argument("--frames", type=int, default=100, help="frames of the synthetic file (default 100)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, help="a folder for results (default: a temporary one)")
    options = parser.parse_args(arguments)
    out = options.out or pathlib.Path(tempfile.mkdtemp(prefix="match_kitti_"))
    out.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(options.seed)

    labels = options.labels
    if labels is None:
        labels = out / "labels.txt"
        write(labels, *synthetic(rng, options.frames))
    frames, classes, boxes, _ = read(labels)
    if not len(boxes):
        raise SystemExit(f"{labels}: no box of {', '.join(CLASSES)}")
    detections = options.detections
    if detections is None:
        detections = out / "detections.txt"
        write(detections, *disturbed(rng, frames, classes, boxes))
    detection_frames, detection_classes, detection_boxes, scores = read(detections)

    # Boxes of the camera's axes, as boxes with the vertical as z.
    truths = geograd.convert(geograd.KittiBox(boxes)).array
    guesses = geograd.convert(geograd.KittiBox(detection_boxes)).array

    rows, best = [], np.zeros(len(truths))
    pictured = None
    for frame in np.unique(np.concatenate([frames, detection_frames])):
        pairs_of_frame, ours, theirs = [], np.flatnonzero(frames == frame), np.flatnonzero(detection_frames == frame)
        for name in CLASSES:
            t = ours[classes[ours] == name]
            d = theirs[detection_classes[theirs] == name]
            if not len(t) or not len(d):
                continue
            a, b = geograd.YawBox3(truths[t]), geograd.YawBox3(guesses[d])
            # The best detection of every label, whether or not it is matched.
            best[t], _ = geograd.iou_bev.row_max(a, b)
            pairs_of_frame += [(t[i], d[j], iou) for i, j, iou in matched(a, b, scores[d], options.threshold)]
        rows += [(frame, i, j, iou) for i, j, iou in pairs_of_frame]
        if pictured is None or len(ours) + len(theirs) > len(pictured[2]) + len(pictured[3]):
            pictured = (frame, pairs_of_frame, ours, theirs)

    with open(out / "matches.csv", "w") as file:
        file.write("frame,label,detection,iou\n")
        file.writelines(f"{frame},{i},{j},{iou:.6f}\n" for frame, i, j, iou in rows)
    frame, pairs, ours, theirs = pictured
    local = [(np.searchsorted(ours, i), np.searchsorted(theirs, j), iou) for i, j, iou in pairs]
    draw(out / "frame.png", truths[ours], guesses[theirs], local, frame)

    overlaps = np.array([iou for *_, iou in rows])
    print(f"{len(boxes)} labels, {len(guesses)} detections, {len(np.unique(frames))} frames")
    recall, precision = len(rows) / len(boxes), len(rows) / max(len(guesses), 1)
    print(f"{len(rows)} matches at IoU {options.threshold}: recall {recall:.3f}, precision {precision:.3f}")
    if len(overlaps):
        print(f"IoU of matches: mean {overlaps.mean():.3f}, least {overlaps.min():.3f}")
    print(f"best IoU of a label: mean {best.mean():.3f}, {np.mean(best == 0):.1%} without any overlap")
    print(f"results in {out}")


if __name__ == "__main__":
    main()

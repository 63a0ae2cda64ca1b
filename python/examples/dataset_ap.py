"""Average precision of a data set: detections and truths as Parquet files, one of each per sequence.

    python dataset_ap.py                                            # a synthetic data set of 40 sequences
    python dataset_ap.py --make 1000 --data FOLDER                  # writes one of any size and judges it
    python dataset_ap.py --kitti LABELS DETECTIONS --data FOLDER    # writes one from files of KITTI tracking
    python dataset_ap.py --data FOLDER --ray 2                      # two processes of Ray, a task per sequence

FOLDER has detections/SEQUENCE.parquet and truths/SEQUENCE.parquet. Rows are in the order of their frames. Columns: frame
(int32), class (text), box (seven numbers: KittiBox), alpha, and image, the height in the image; detections have a score,
truths have occluded and truncated.

A task joins a sequence by one grouped call and writes the pairs and scores of every class and difficulty to
OUT/SEQUENCE.json, whole or not at all. A second run computes the sequences that are missing or whose files changed; a
sequence with one file of the two is an error, also after a run with both. The rest is KITTI's rules over all sequences
together: average precision and orientation similarity at forty recalls.
"""

import argparse
import json
import os
import pathlib
import sys
import tempfile
import time

import numpy as np

from jobs import each, peak, said, write_whole

import geograd
import geograd.metric

try:
    import pyarrow as pa
    import pyarrow.parquet as parquet
except ImportError as error:
    raise SystemExit(f"{error}: pip install pyarrow") from None

import geograd.arrow

# A class, the one that is no mistake for it, and the IoU in space from which a detection is right.
CLASSES = {"Car": ("Van", 0.7), "Pedestrian": ("Person_sitting", 0.5), "Cyclist": (None, 0.5)}
# Least height in the image, most occlusion and truncation that count.
DIFFICULTIES = {"easy": (40, 0, 0.15), "moderate": (25, 1, 0.3), "hard": (25, 2, 0.5)}
FULLY, IGNORED, NOT = 0, 1, 2


# Data sets.


def table(frames, classes, boxes, alpha, image, **more):
    order = np.argsort(frames, kind="stable")
    columns = {
        "frame": pa.array(np.asarray(frames, np.int32)[order]),
        "class": pa.array(np.asarray(classes, object)[order], pa.string()),
        "box": geograd.arrow.column(np.asarray(boxes, np.float32).reshape(-1, 7)[order]),
        "alpha": pa.array(np.asarray(alpha, np.float64)[order]),
        "image": pa.array(np.asarray(image, np.float64)[order]),
    }
    columns.update({name: pa.array(np.asarray(values)[order]) for name, values in more.items()})
    return pa.table(columns)


def store(folder, sequence, detections, truths):
    for name, own in (("detections", detections), ("truths", truths)):
        (folder / name).mkdir(parents=True, exist_ok=True)
        write_whole(folder / name / f"{sequence}.parquet", lambda part, own=own: parquet.write_table(own, part))


def synthetic(folder, sequences, frames, objects, seed):
    """Sequences of so many frames with about so many objects each: most are found, a little off, and some are invented."""
    for sequence in range(sequences):
        rng = np.random.default_rng([seed, sequence])
        counts = rng.poisson(objects, frames)
        frame = np.repeat(np.arange(frames), counts)
        count = len(frame)
        classes = rng.choice(["Car", "Van", "Pedestrian", "Cyclist"], count, p=[0.6, 0.1, 0.2, 0.1])
        is_car = np.isin(classes, ["Car", "Van"])
        size = np.where(is_car[:, None], [1.5, 1.7, 4.2], [1.7, 0.6, 0.8]) * rng.uniform(0.9, 1.1, (count, 3))
        place = np.stack([rng.uniform(-30, 30, count), np.full(count, 1.7), rng.uniform(5, 80, count)], axis=1)
        boxes = np.concatenate([size, place, rng.uniform(-np.pi, np.pi, (count, 1))], axis=1)
        image = 700 * size[:, 0] / place[:, 2]
        alpha = boxes[:, 6] - np.arctan2(place[:, 0], place[:, 2])
        truths = table(
            frame, classes, boxes, alpha, image,
            occluded=rng.choice(4, count, p=[0.6, 0.2, 0.15, 0.05]).astype(np.int8),
            truncated=np.where(rng.random(count) < 0.9, 0.0, rng.uniform(0, 1, count)),
        )
        found = rng.random(count) < 0.85
        error = rng.normal(0, 1, (count, 7)) * [0.03, 0.03, 0.08, 0.08, 0.03, 0.15, 0.05]
        moved = (boxes + error)[found]
        moved[rng.random(len(moved)) < 0.05, 6] += np.pi
        false = rng.integers(0, max(count, 1), count // 6)
        invented = boxes[false] + rng.normal(0, 1, (len(false), 7)) * [0, 0, 0, 3, 0, 8, 1]
        guesses = np.concatenate([moved, invented])
        labels = np.where(classes == "Van", "Car", classes)
        detections = table(
            np.concatenate([frame[found], frame[false]]), np.concatenate([labels[found], labels[false]]), guesses,
            guesses[:, 6] - np.arctan2(guesses[:, 3], guesses[:, 5]),
            700 * guesses[:, 0] / np.maximum(guesses[:, 5], 1),
            score=np.concatenate([rng.beta(6, 2, len(moved)), rng.beta(2, 4, len(invented))]),
        )
        store(folder, f"{sequence:05}", detections, truths)


def numbers(path, number, words, count, separator):
    if len(words) != count:
        raise SystemExit(f"{path}:{number}: {count} columns are needed, not {len(words)} ({separator})")
    return words


def from_kitti(folder, labels, detections):
    """Parquet from files of KITTI tracking: LABELS/SEQ.txt, and DETECTIONS/CLASS_SEQ.txt with fields after commas."""
    names = {"1": "Pedestrian", "2": "Car", "3": "Cyclist"}
    for path in sorted(labels.glob("*.txt")):
        rows = []
        for number, line in enumerate(path.read_text().splitlines(), 1):
            words = numbers(path, number, line.split(), 17, "spaces")
            if words[2] != "DontCare":  # It has no box in space.
                rows.append(words)
        column = lambda k, of=float: [of(words[k]) for words in rows]
        height = np.subtract(column(9), column(7))
        truths = table(
            column(0, int), column(2, str), [[float(x) for x in words[10:17]] for words in rows], column(5), height,
            occluded=np.array(column(4, int), np.int8), truncated=np.array(column(3)),
        )
        rows = []
        for own in sorted(detections.glob(f"*_{path.stem}.txt")):
            for number, line in enumerate(own.read_text().splitlines(), 1):
                rows.append(numbers(own, number, line.split(","), 15, "commas"))
        column = lambda k, of=float: [of(words[k]) for words in rows]
        found = table(
            column(0, int), [names[words[1]] for words in rows], [[float(x) for x in words[7:14]] for words in rows], column(14),
            np.subtract(column(5), column(3)), score=np.array(column(6)),
        )
        store(folder, path.stem, found, truths)


# A sequence.


def read(path, columns):
    try:
        own = parquet.read_table(path)
    except (OSError, pa.ArrowException) as error:
        raise ValueError(f"{path}: {str(error).splitlines()[0]}") from None
    missing = [name for name in columns if name not in own.column_names]
    if missing:
        raise ValueError(f"{path}: no column {', '.join(missing)}; there are {', '.join(own.column_names)}")
    for name in columns:
        if own[name].null_count:
            row = int(np.flatnonzero(own[name].is_null().to_numpy())[0])
            raise ValueError(f"{path}: row {row}: {name} is null")
    return own


def one_sequence(folder, sequence):
    """What a sequence adds to every class and difficulty: pairs by places within the sequence, scores, how each counts."""
    start = time.process_time()
    files = [folder / name / f"{sequence}.parquet" for name in ("detections", "truths")]
    detections = read(files[0], ["frame", "class", "box", "alpha", "image", "score"])
    truths = read(files[1], ["frame", "class", "box", "alpha", "image", "occluded", "truncated"])
    reading = time.process_time() - start
    start = time.process_time()
    result = {"sequence": sequence, "classes": {}, "boxes": [detections.num_rows, truths.num_rows]}
    shapes = []
    for path, own in zip(files, (detections, truths)):
        try:
            boxes = geograd.arrow.shapes(own["box"], "KittiBox", "box")
            # Boxes of the camera's axes, as boxes with the vertical as z.
            shapes.append(geograd.convert(boxes))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{path}: {error}") from None
    try:
        frames, *groups = geograd.arrow.groups(detections["frame"], truths["frame"], [f"{path}: frame" for path in files])
    except ValueError as error:
        raise ValueError(str(error)) from None
    result["frames"] = len(frames)
    least = min(threshold for _, threshold in CLASSES.values())
    # One call for all frames and classes.
    first, second, iou = geograd.iou.above(*shapes, least, groups=groups)
    label_of = np.asarray(truths["class"].to_pylist(), object)
    class_of = np.asarray(detections["class"].to_pylist(), object)
    scores = detections["score"].to_numpy()
    if not np.isfinite(scores).all():
        raise ValueError(f"{files[0]}: row {np.flatnonzero(~np.isfinite(scores))[0]}: score is not a finite number")
    image = detections["image"].to_numpy()
    alphas = detections["alpha"].to_numpy(), truths["alpha"].to_numpy()
    for name, (neighbour, threshold) in CLASSES.items():
        ours = np.flatnonzero(class_of == name)
        theirs = np.flatnonzero((label_of == name) | (label_of == neighbour))
        place, other = np.full(len(class_of), -1), np.full(len(label_of), -1)
        place[ours], other[theirs] = np.arange(len(ours)), np.arange(len(theirs))
        mine = (place[first] >= 0) & (other[second] >= 0) & (iou > threshold)
        own = {
            "scores": scores[ours].tolist(),
            "pairs": [place[first[mine]].tolist(), other[second[mine]].tolist(), iou[mine].astype(float).tolist()],
            "alphas": [alphas[0][ours].tolist(), alphas[1][theirs].tolist()],
        }
        for difficulty, (height, occluded, truncated) in DIFFICULTIES.items():
            counts = (truths["occluded"].to_numpy() <= occluded) & (truths["truncated"].to_numpy() <= truncated)
            counts &= (truths["image"].to_numpy() > height) & (label_of == name)
            own[difficulty] = [
                np.where(image[ours] < height, IGNORED, FULLY).tolist(), np.where(counts, FULLY, IGNORED)[theirs].tolist()
            ]
        result["classes"][name] = own
    result["seconds"] = [reading, time.process_time() - start]
    return result


def both(folder, sequence):
    """The files of a sequence; an error names the one that is missing."""
    files = [folder / name / f"{sequence}.parquet" for name in ("detections", "truths")]
    for file, other in zip(files, files[::-1]):
        if not file.exists():
            raise ValueError(f"{file}: there is no such file, and {other.parent.name}/{other.name} is of no use alone")
    return files


def made_of(path):
    """Times and sizes of the files that a result is of; None without a result that can be read."""
    try:
        return json.loads(path.read_text())["files"]
    except (FileNotFoundError, ValueError, KeyError, TypeError):
        return None


def task(folder, out, sequence, skip):
    """Computes a sequence unless its result is there and of these very files; says why where it cannot."""
    path = out / f"{sequence}.json"
    try:
        # An older file in place of a newer one is a change, too.
        stamps = [[file.stat().st_mtime_ns, file.stat().st_size] for file in both(folder, sequence)]
        result = None if made_of(path) == stamps else {**one_sequence(folder, sequence), "files": stamps}
    except ValueError as error:
        if not skip:
            raise
        return {"path": sequence, "why": str(error), "peak": 0}
    if result is not None:
        write_whole(path, lambda part: part.write_text(json.dumps(result)))
    return {"path": sequence, "why": "", "peak": peak()}


# All sequences.


def judged(out, sequences):
    """Average precision and orientation similarity by class and difficulty, over all sequences, and the seconds they took."""
    parts = [json.loads((out / f"{sequence}.json").read_text()) for sequence in sequences]
    table = {}
    for name, (_, threshold) in CLASSES.items():
        own = [part["classes"][name] for part in parts]
        ends = np.cumsum([0, *(len(x["scores"]) for x in own)]), np.cumsum([0, *(len(x["alphas"][1]) for x in own)])
        joined = lambda lists: np.concatenate([np.zeros(0), *map(np.asarray, lists)])
        pairs = [
            joined([np.add(x["pairs"][0], ends[0][k]) for k, x in enumerate(own)]),
            joined([np.add(x["pairs"][1], ends[1][k]) for k, x in enumerate(own)]),
            joined([x["pairs"][2] for x in own]),
        ]
        scores, angles = joined([x["scores"] for x in own]), [joined([x["alphas"][k] for x in own]) for k in (1, 0)]
        for difficulty in DIFFICULTIES:
            found = geograd.metric.kitti(
                scores, pairs, threshold, angles=angles, truths=joined([x[difficulty][1] for x in own]),
                detections=joined([x[difficulty][0] for x in own]),
            )
            table[f"{name} {difficulty}"] = [found["ap"], found["aos"], found["truths"]]
    totals = {
        "frames": sum(part["frames"] for part in parts),
        "boxes": np.sum([part["boxes"] for part in parts], axis=0).tolist() if parts else [0, 0],
        "seconds": np.sum([part["seconds"] for part in parts], axis=0).tolist() if parts else [0.0, 0.0],
    }
    return table, totals


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, help="the folder of the data set (default: a temporary one)")
    parser.add_argument("--make", type=int, metavar="N", help="write N synthetic sequences to it first (default 40 without --data)")
    parser.add_argument("--frames", type=int, default=50, help="frames of a synthetic sequence (default 50)")
    parser.add_argument("--objects", type=float, default=25, help="objects of a synthetic frame (default 25)")
    parser.add_argument("--kitti", type=pathlib.Path, nargs=2, metavar=("LABELS", "DETECTIONS"), help="folders to write it from")
    parser.add_argument("--ray", type=int, metavar="N", help="run N processes of Ray (default: this process alone)")
    parser.add_argument("--skip", action="store_true", help="leave out files that cannot be read, and name them")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, help="a folder for results (default: DATA/results)")
    options = parser.parse_args(arguments)
    data = (options.data or pathlib.Path(tempfile.mkdtemp(prefix="dataset_ap_"))).absolute()
    out = (options.out or data / "results").absolute()
    out.mkdir(parents=True, exist_ok=True)
    if options.kitti:
        from_kitti(data, *options.kitti)
    elif options.make or options.data is None:
        synthetic(data, options.make or 40, options.frames, options.objects, options.seed)
    sequences = sorted({path.stem for name in ("detections", "truths") for path in (data / name).glob("*.parquet")})
    if not sequences:
        raise SystemExit(f"{data}: no truths/*.parquet, no detections/*.parquet")

    start, before = time.perf_counter(), sum(os.times()[:4])
    try:
        done = each(lambda sequence: task(data, out, sequence, options.skip), sequences, options.ray)
    except (ValueError, OSError) as error:
        raise SystemExit(f"dataset_ap: {said(error)}") from None
    wall, cpu = time.perf_counter() - start, sum(os.times()[:4]) - before

    skipped = [row for row in done if row["why"]]
    left = [row["path"] for row in done if not row["why"]]
    table, totals = judged(out, left)
    report = {"judged": table, "sequences": len(left), "skipped": [row["why"] for row in skipped], **totals}
    write_whole(out / "report.txt", lambda part: part.write_text(json.dumps(report["judged"], indent=1)))
    print(f"{'':22}    AP     AOS  truths")
    for name, (ap, aos, count) in table.items():
        print(f"{name:22} {ap:.4f} {aos:7.4f} {count:7}")
    reading, joining = totals["seconds"]
    print(f"{len(left)} sequences, {totals['frames']} frames, {totals['boxes'][0]} detections, {totals['boxes'][1]} truths")
    print(f"processor time of all sequences: reading {reading:.2f} s, joining {joining:.2f} s")
    print(f"this run: {wall:.2f} s, {totals['frames'] / wall:.0f} frames a second, {cpu:.2f} s of processor time of this process")
    print(f"peak memory of a process: {max([row['peak'] for row in done], default=0) / 1024:.0f} MiB")
    print(f"results in {out}")
    for row in skipped:
        print(f"skipped: {row['why']}", file=sys.stderr)


if __name__ == "__main__":
    main()

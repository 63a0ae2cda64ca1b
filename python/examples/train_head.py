"""Trains a small PyTorch head to find rotated boxes in images, once with the GIoU loss and once with ProbIoU.

    python train_head.py
    python train_head.py --steps 1000

Images are synthetic: one noisy box each. Both runs begin with the same weights and see the same images.
"""

import argparse
import pathlib
import sys
import tempfile
import time

import numpy as np

import geograd

try:
    import torch
except ImportError:
    raise SystemExit("PyTorch is needed: pip install torch") from None
import geograd.torch

SIZE = 32  # pixels of a side


def scenes(rng, count):
    """Images (count, 1, SIZE, SIZE) and their boxes (count, 5): x, y, width, height in pixels, heading in radians."""
    width = rng.uniform(10, 22, count)
    boxes = np.stack(
        [rng.uniform(10, SIZE - 10, count), rng.uniform(10, SIZE - 10, count), width, width * rng.uniform(0.3, 0.7, count),
         rng.uniform(-np.pi / 2, np.pi / 2, count)], axis=-1,
    )
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    pixels = np.stack([x.ravel(), y.ravel()], axis=-1)
    # A pixel is as bright as its centre is deep in the box, which smooths the border.
    depth = -geograd.signed_distance.all_pairs(geograd.Vec2(pixels), geograd.Obb2(boxes)).T
    images = np.clip(depth + 0.5, 0, 1) * rng.uniform(0.5, 1, (count, 1)) + rng.normal(0, 0.1, depth.shape)
    return (
        torch.tensor(images.reshape(count, 1, SIZE, SIZE), dtype=torch.float32),
        torch.tensor(boxes, dtype=torch.float32),
    )


class Head(torch.nn.Module):
    """An image to a box."""

    def __init__(self):
        super().__init__()
        layers, before = [], 1
        for channels in (16, 32, 64):
            layers += [torch.nn.Conv2d(before, channels, 3, stride=2, padding=1), torch.nn.ReLU()]
            before = channels
        self.layers = torch.nn.Sequential(
            *layers, torch.nn.Flatten(), torch.nn.Linear(16 * before, 128), torch.nn.ReLU(), torch.nn.Linear(128, 6)
        )

    def forward(self, images):
        x, y, width, height, cos, sin = self.layers(images).unbind(-1)
        # A box turned by half a turn is the same: the head gives the double angle.
        heading = torch.atan2(sin, cos + 1e-6) / 2
        half = SIZE / 2
        return torch.stack([half + half * x, half + half * y, half * width.exp(), half / 2 * height.exp(), heading], dim=-1)


def bar(label, done, total, loss):
    """A progress bar on a terminal."""
    if sys.stderr.isatty():
        filled = 30 * done // total
        print(f"\r{label:8} [{'#' * filled}{'.' * (30 - filled)}] loss {loss:.3f}", end="\n" if done == total else "", file=sys.stderr)


def train(name, loss_of, options):
    """A trained head, its loss at every step, and its mean IoU on held-out images now and then."""
    torch.manual_seed(options.seed)
    rng = np.random.default_rng(options.seed)
    head = Head()
    optimiser = torch.optim.Adam(head.parameters(), lr=3e-3)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, options.steps)
    images, truth = scenes(np.random.default_rng(options.seed + 1), 256)
    losses, scores = [], []
    for step in range(options.steps):
        batch, boxes = scenes(rng, options.batch)
        loss = loss_of(head(batch), boxes)
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
        losses.append(loss.item())
        if step % 20 == 0 or step + 1 == options.steps:
            with torch.no_grad():
                scores.append((step, geograd.torch.iou(head(images), truth, kind="Obb2").mean().item()))
        bar(name, step + 1, options.steps, losses[-1])
    return head, losses, scores


def draw_curves(path, runs):
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6))
    for name, (_, losses, scores) in runs.items():
        window = min(10, len(losses))
        left.plot(np.convolve(losses, np.ones(window) / window, mode="valid"), label=f"1 - {name}")
        right.plot(*zip(*scores), label=f"trained with {name}")
    left.set(xlabel="step", ylabel="training loss", ylim=(0, None))
    right.set(xlabel="step", ylabel="mean IoU, held out", ylim=(0, 1))
    left.legend(frameon=False)
    right.legend(frameon=False, loc="lower right")
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def draw_boxes(path, runs, images, truth):
    import matplotlib.pyplot as plt
    from matplotlib.patches import Polygon

    figure, axes = plt.subplots(len(runs), len(images), figsize=(1.5 * len(images), 1.9 * len(runs)), squeeze=False, layout="constrained")
    for row, (name, (head, _, _)) in zip(axes, runs.items()):
        with torch.no_grad():
            guesses = head(images)
            overlaps = geograd.torch.iou(guesses, truth, kind="Obb2")
        for axis, image, box, guess, overlap in zip(row, images, truth, guesses, overlaps):
            axis.imshow(image[0], cmap="gray", extent=(0, SIZE, SIZE, 0), vmin=-0.2, vmax=1.1)
            for shape, color in [(box, "tab:blue"), (guess, "tab:orange")]:
                corners = geograd.corners(geograd.Obb2(shape.numpy())).array.reshape(4, 2)
                axis.add_patch(Polygon(corners, fill=False, edgecolor=color, linewidth=1.8))
            axis.set_title(f"IoU {overlap:.2f}", fontsize=8)
            axis.set(xticks=[], yticks=[])
        row[0].set_ylabel(name)
    figure.suptitle("Truth blue, prediction orange", fontsize=9)
    figure.savefig(path, dpi=110)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=250, help="steps of a run (default 250)")
    parser.add_argument("--batch", type=int, default=64, help="images of a step (default 64)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=pathlib.Path, help="a folder for pictures (default: a temporary one)")
    options = parser.parse_args(arguments)
    if options.steps < 1 or options.batch < 1:
        parser.error("--steps and --batch are at least 1")
    out = options.out or pathlib.Path(tempfile.mkdtemp(prefix="train_head_"))
    out.mkdir(parents=True, exist_ok=True)
    import matplotlib

    matplotlib.use("Agg")
    # Layers of this size gain nothing from threads, and lose much on a busy machine.
    torch.set_num_threads(1)

    losses = {"GIoU": geograd.torch.GIoULoss(), "ProbIoU": geograd.torch.ProbIoULoss()}
    images, truth = scenes(np.random.default_rng(options.seed + 2), 500)
    runs = {}
    for name, loss_of in losses.items():
        start = time.perf_counter()
        runs[name] = train(name, loss_of, options)
        seconds = time.perf_counter() - start
        with torch.no_grad():
            guesses = runs[name][0](images)
            overlaps = geograd.torch.iou(guesses, truth, kind="Obb2")
        first, last = (np.mean(part) for part in (runs[name][1][:10], runs[name][1][-10:]))
        print(
            f"{name:8} loss {first:.3f} to {last:.3f} in {options.steps} steps, {seconds:.1f} s; "
            f"500 new images: mean IoU {overlaps.mean():.3f}, above 0.7 {(overlaps > 0.7).float().mean():.0%}"
        )
    draw_curves(out / "curves.png", runs)
    draw_boxes(out / "boxes.png", runs, images[:8], truth[:8])
    print(f"pictures in {out}")


if __name__ == "__main__":
    main()

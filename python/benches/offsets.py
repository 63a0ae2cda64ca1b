"""Offsets of columns of small polygons beside shapely on one thread: medians of processor time, in turns.

    python python/benches/offsets.py

The last column is shapely's time over geograd's. Areas are compared before they are timed: chords lie elsewhere on arcs, so
they differ by what chords miss.
"""

import os

os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
import shapely

import geograd
from columns import stars, timed

COUNT = 1000


def line(name, theirs, ours, tolerance):
    np.testing.assert_allclose(geograd.area(ours()).sum(), shapely.area(theirs()).sum(), rtol=tolerance)
    a, b = (1e6 * own / COUNT for own in timed((theirs, ours)))
    print(f"| {name} | {a:.2f} | {b:.2f} | {a / b:.2f} |", flush=True)


def footprints(draw, count):
    """Ells of six vertices, turned: what most buildings of a map are."""
    size, notch = draw.uniform(5, 15, (2, count)), draw.uniform(0.3, 0.7, (2, count))
    (w, h), (u, v) = size, size * notch
    zero = np.zeros(count)
    corners = np.stack([np.stack(x, -1) for x in ((zero, zero), (w, zero), (w, v), (u, v), (u, h), (zero, h))], 1)
    turn = draw.uniform(0, 2 * np.pi, count)
    cos, sin = np.cos(turn)[:, None], np.sin(turn)[:, None]
    x, y = corners[..., 0], corners[..., 1]
    return list(np.stack([x * cos - y * sin, x * sin + y * cos], -1) + draw.uniform(0, 1000, (count, 1, 2)))


def main():
    geograd.set_num_threads(1)
    draw = np.random.default_rng(1)
    kinds = {
        "footprints of 6 vertices": (footprints(draw, COUNT), 0.5),
        "stars of 4 vertices": (list(10 * stars(draw, 4, COUNT)), 1.0),
        "stars of 12 vertices": (list(10 * stars(draw, 12, COUNT)), 0.5),
        "stars of 4 to 50 vertices": ([10 * stars(draw, 4 + k % 47, 1)[0] for k in range(COUNT)], 0.5),
        "stars of 50 vertices": (list(10 * stars(draw, 50, COUNT)), 0.5),
    }
    print("| what | shapely, µs | geograd, µs | ratio |\n| --- | ---: | ---: | ---: |")
    for name, (rings, size) in kinds.items():
        theirs, ours = shapely.make_valid([shapely.Polygon(ring) for ring in rings]), geograd.Polygons.of(rings)
        for d in (size, -size):
            for look, own, other in (
                ("round", dict(chords=16), dict(quad_segs=16)),
                ("mitre", dict(join="mitre"), dict(join_style="mitre", mitre_limit=5.0)),
            ):
                for valid in (False, True):
                    line(
                        f"{name}, {look}, {d:g}{', valid' if valid else ''}",
                        lambda: shapely.buffer(theirs, d, **other),
                        lambda: geograd.buffer(ours, d, valid=valid, **own),
                        1e-2 if look == "round" else 1e-9,
                    )
            exact = geograd.buffer_area.value_grad
            a, b = (1e6 * t / COUNT for t in timed((lambda: shapely.area(shapely.buffer(theirs, d, quad_segs=16)), lambda: exact(ours, d))))
            print(f"| {name}, area of {d:g}, exact with gradient | {a:.2f} | {b:.2f} | {a / b:.2f} |", flush=True)


if __name__ == "__main__":
    main()

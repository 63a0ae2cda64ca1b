"""Plants a fault in a gradient written by hand, and lets the harness of the library look for it.

    python planted_fault.py                  # every fault, and the right gradient
    python planted_fault.py --fault touch

The function is the distance of a point from a segment. The faults:
  end     beyond the second end the gradient is still that of the line
  sign    the gradient by the first end has the wrong sign where the point is on the left
  touch   a point on the segment divides zero by zero
Differences at random points are the usual test; the script runs them as well.
"""

import argparse
import math

import numpy as np

import geograd


def parts(point, segment):
    """The segment's vector, the place of the foot along it from 0 to 1, and the vector from the foot to the point."""
    (x, y), (from_x, from_y, to_x, to_y) = point.array.tolist(), segment.array.tolist()
    along_x, along_y, x, y = to_x - from_x, to_y - from_y, x - from_x, y - from_y
    square = along_x**2 + along_y**2
    place = min(max((x * along_x + y * along_y) / square, 0.0), 1.0) if square > 0 else 0.0
    return (along_x, along_y), place, (x - place * along_x, y - place * along_y)


def distance(point: geograd.Vec2, segment: geograd.Segment2):
    """The distance of a point from a segment. The shapes of the arguments tell the harness what to draw."""
    return math.hypot(*parts(point, segment)[-1])


def gradient(point, segment, fault="none"):
    """Its six derivatives, by hand. The foot may be held fast, as it is the nearest place."""
    along, place, apart = parts(point, segment)
    size = math.hypot(*apart)
    if fault == "touch":
        with np.errstate(invalid="ignore"):
            normal = np.divide(apart, size)
    else:
        normal = np.divide(apart, size) if size > 0 else np.zeros(2)
    left = along[0] * apart[1] - along[1] * apart[0]
    if fault == "end" and place == 1.0:
        # As if the line went on: away from it at a right angle.
        normal = np.divide([-along[1], along[0]], math.hypot(*along)) * np.sign(left)
    by_start, by_end = -(1 - place) * normal, -place * normal
    if fault == "sign" and left > 0:
        by_start = -by_start
    return np.concatenate([normal, by_start, by_end])


def differences_agree(fault, samples, rng):
    """True if central differences agree at random points."""
    for _ in range(samples):
        x = rng.normal(0, 1, 6)
        shapes = lambda x: (geograd.Vec2(x[:2]), geograd.Segment2(x[2:]))
        derivatives = [(distance(*shapes(x + h)) - distance(*shapes(x - h))) / 2e-6 for h in 1e-6 * np.eye(6)]
        if not np.allclose(derivatives, gradient(*shapes(x), fault), rtol=1e-3, atol=1e-5):
            return False
    return True


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fault", choices=["none", "end", "sign", "touch"], help="only this one")
    parser.add_argument("--samples", type=int, default=50, help="random inputs beside the hard ones (default 50)")
    options = parser.parse_args(arguments)
    wrong = []
    for fault in [options.fault] if options.fault else ["none", "end", "sign", "touch"]:
        print(f"--- fault: {fault}")
        agree = differences_agree(fault, options.samples, np.random.default_rng(1))
        print(f"differences at {options.samples} random points: {'no fault found' if agree else 'a fault found'}")
        by_hand = lambda point, segment: gradient(point, segment, fault)
        # Ends at 100,000 are known to rounding only, which decides where a tiny segment points.
        report = geograd.check(distance, by_hand, samples=options.samples, resolution=1e-10)
        if bool(report) != (fault == "none"):
            wrong.append(fault)
    if wrong:
        raise SystemExit(f"the harness erred on: {', '.join(wrong)}")
    print("the harness accepted the right gradient and refused the others" if not options.fault else "as it should be")


if __name__ == "__main__":
    main()

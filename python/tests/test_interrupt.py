"""Ctrl-C ends a call that computes for long, on one thread and on several."""

import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import geograd

CALLS = {
    "matrix": "geograd.iou.row_max(a, a)",
    "sum": "geograd.giou.sum_grad(a, a)",
    "items": "heavy(points, points)",
    "suppression": "geograd.iou.suppress(thin, scores, 0.9)",
    "function": "own.row_max(c, c)",
    "polygons": "geograd.contains(ring, points)",
    "groups": "geograd.iou.row_max(a, a, groups=(halves, halves))",
    "assignment of a matrix": "geograd.assignment.optimal(gains)",
    "assignment of groups": "geograd.assignment.largest(pairs, (frame, frame))",
    "check": "geograd.check(heavy, samples=n, quiet=True)",
}

#: The seconds from a key press to the exception on a busy machine.
LATEST = 6.0

PROGRAM = """
    import os, signal, sys, threading, time
    import numpy as np
    import geograd

    # A job in the background starts with this signal ignored.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    draw = np.random.default_rng(1)
    n = {count}
    a = geograd.Obb2(np.c_[draw.uniform(0, 1, (n, 2)), draw.uniform(1, 2, (n, 3))])
    # Crossing strips: every pair is compared, and none is suppressed.
    thin = geograd.Obb2(np.c_[np.zeros((n, 2)), np.full(n, 9.0), np.full(n, 1e-6), np.linspace(0, 3, n)])
    scores = np.linspace(1, 0, n)
    c = draw.uniform(0, 1, (n, 2))
    points = np.repeat(c, 20, axis=0)
    turn = np.linspace(0, 6, 20000)
    zigzag = np.c_[np.cos(turn), np.where(np.arange(len(turn)) % 2, 9.0, -9.0)]
    ring = geograd.Rings(zigzag, [0, len(zigzag)])
    halves = [0, n // 2, n]
    # All rows want the same column most, so that each path is long.
    side = {side}
    gains = np.outer(np.linspace(1, 2, side), np.linspace(1, 2, side))
    frame = [0, side]
    pairs = *np.divmod(np.arange(side * side), side), gains.reshape(-1)

    @geograd.function
    def own(p: 2, q: 2):
        return geograd.sin(p[0] * q[1]) + geograd.exp(p[1] - q[0])

    @geograd.function
    def heavy(p: 2, q: 2):
        return sum(geograd.sin(p[0] * float(k) + q[1]) for k in range(1, 300))

    own(c[:2], c[:2]), heavy(c[:2], c[:2])
    geograd.set_num_threads({threads})
    pressed = []

    def press():
        pressed.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.3, press).start()
    begun = time.perf_counter()
    try:
        {call}
    except KeyboardInterrupt:
        print("interrupted", time.perf_counter() - pressed[0])
    else:
        print("complete", time.perf_counter() - begun)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="os.kill ends the process there")
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", CALLS)
def test_calls_end_early(name, threads):
    # As many rows as a call takes more than a second for; a machine that is faster gets more.
    for count in (30_000, 120_000, 480_000):
        program = textwrap.dedent(PROGRAM).format(
            count=count, threads=threads, call=CALLS[name], side=min(count // 20, 6000) if "assignment" in name else 2
        )
        # A process of its own, in which no thread of a library takes the signal.
        run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=300)
        if "interrupted" in run.stdout:
            # Whatever cannot be interrupted raises the exception at its end.
            # Points of polygons end later than that in a build of development.
            assert name == "polygons" or float(run.stdout.split()[1]) < LATEST, run.stdout
            return
        assert "complete" in run.stdout, run.stderr
    pytest.fail(f"no call was interrupted: {run.stdout}")


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there are no such signals")
def test_handlers_run_while_a_call_computes_and_it_goes_on():
    a = geograd.Obb2(np.tile([0.0, 0.0, 2.0, 1.0, 0.5], (12_000, 1)))
    expected = geograd.iou.count_above(a, a, 0.5)
    seen = []
    box = geograd.Obb2([0.0, 0.0, 1.0, 1.0, 0.0])
    before = signal.signal(signal.SIGUSR1, lambda *_: seen.append(geograd.iou(box, box)))
    try:
        timer = threading.Timer(0.05, signal.raise_signal, [signal.SIGUSR1])
        timer.start()
        assert geograd.iou.count_above(a, a, 0.5) == expected
        timer.join()
    finally:
        signal.signal(signal.SIGUSR1, before)
    assert seen == [1.0]


def test_other_threads_finish():
    # Handlers run in the main thread alone: a call of another one is not interrupted.
    a = geograd.Obb2(np.tile([0.0, 0.0, 2.0, 1.0, 0.5], (8_000, 1)))
    expected, found = geograd.iou.row_max(a, a), []
    other = threading.Thread(target=lambda: found.append(geograd.iou.row_max(a, a)))
    other.start()
    other.join()
    np.testing.assert_array_equal(found[0][0], expected[0])

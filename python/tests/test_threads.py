"""Threads, and children that were forked from a process with threads."""

import os
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import geograd

ROWS = 200_000


@pytest.fixture
def many():
    draw = np.random.default_rng(2)
    a = draw.uniform(1, 3, (ROWS, 5))
    return geograd.Obb2(a), geograd.Obb2(a + 0.1)


@pytest.fixture
def threads():
    before = geograd.get_num_threads()
    yield
    geograd.set_num_threads(before)


def test_threads_change_no_bit(many, threads):
    made = []
    for count in (1, 2, 5):
        geograd.set_num_threads(count)
        assert geograd.get_num_threads() == count
        made.append(geograd.iou.value_grad(*many))
    for value, derivatives in made[1:]:
        np.testing.assert_array_equal(value, made[0][0])
        np.testing.assert_array_equal(derivatives[0], made[0][1][0])
    for wrong in (0, -1, 1025, 100_000):
        with pytest.raises(ValueError, match=f"threads: a whole number from 1 to 1024 is needed, not {wrong}"):
            geograd.set_num_threads(wrong)


def run(code, **environment):
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_threads_of_the_environment():
    code = "import geograd; print(geograd.get_num_threads())"
    assert run(code, GEOGRAD_THREADS="3") == ["3"]
    assert int(run(code, GEOGRAD_THREADS="")[0]) >= 1


@pytest.mark.parametrize("asked", ["nonsense", "-1", "3.5", "0", "1000000"])
def test_a_number_of_threads_of_the_environment_that_cannot_be_is_an_error(asked):
    code = f"""
        import geograd
        try:
            geograd.iou([0, 0, 1, 1, 0], [0, 0, 1, 1, 0], kind="Obb2")
        except ValueError as error:
            assert str(error) == "GEOGRAD_THREADS: a whole number from 1 to 1024 is needed, not {asked}", error
            geograd.set_num_threads(1)
            print(geograd.iou([0, 0, 1, 1, 0], [0, 0, 1, 1, 0], kind="Obb2"))
    """
    assert run(code, GEOGRAD_THREADS=asked) == ["1.0"]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")
@pytest.mark.parametrize("threads", ["1", "2", "4"])
def test_a_forked_child_computes(threads):
    # The parent has used its threads, and a child of a child does so, too.
    out = run(
        """
        import os, signal, sys
        import numpy as np
        import geograd
        draw = np.random.default_rng(2)
        a = draw.uniform(1, 3, (200_000, 5))
        a, b = geograd.Obb2(a), geograd.Obb2(a + 0.1)
        expected = geograd.iou(a, b)
        pairs = geograd.iou.sum(a[:3000], b[:3000])
        ring = geograd.Rings(a.array[:, :2], np.arange(0, 200_001, 4))
        area = geograd.signed_area(ring)

        def child(depth):
            signal.alarm(60)
            same = (geograd.iou(a, b) == expected).all() and geograd.iou.sum(a[:3000], b[:3000]) == pairs
            same = same and (geograd.signed_area(ring) == area).all()
            if depth:
                same = same and forked(depth - 1)
            os._exit(0 if same else 1)

        def forked(depth):
            number = os.fork()
            if number == 0:
                child(depth)
            return os.waitpid(number, 0)[1] == 0

        assert forked(1)
        assert (geograd.iou(a, b) == expected).all()
        print("same")
        """,
        GEOGRAD_THREADS=threads,
    )
    assert out == ["same"]


def test_other_threads_go_on(many):
    ticks, done = [0], threading.Event()

    def tick():
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0.0005)

    clock = threading.Thread(target=tick)
    clock.start()
    start = ticks[0]
    end = time.monotonic() + 0.5
    while time.monotonic() < end:
        geograd.iou.value_grad(*many)
    counted = ticks[0] - start
    done.set()
    clock.join()
    # With the lock held a tick comes once in a call at most.
    assert counted > 50


def test_calls_from_many_threads(many):
    expected = geograd.iou(*many)
    wrong = []

    def call():
        for _ in range(3):
            if not (geograd.iou(*many) == expected).all():
                wrong.append(1)

    all_threads = [threading.Thread(target=call) for _ in range(4)]
    for one in all_threads:
        one.start()
    for one in all_threads:
        one.join()
    assert not wrong

import os
import zlib
from collections import Counter

import numpy as np
import pytest

import geograd
from geograd import _core

# A test with more cases than this runs a share of them for a commit.
MANY = 24
# One case of so many is in a share.
TURN = 24
# Slow tests of one file of so many run for a commit.
SLOW = 4


def pytest_collection_modifyitems(config, items):
    """Selects a 24th of the cases of tests with many, and a fourth of the slow tests, by the variable GEOGRAD_SHARE, such as
    a commit's name; all without it."""
    share = os.environ.get("GEOGRAD_SHARE")
    if not share or os.environ.get("GEOGRAD_ALL_ROWS") == "1":
        return
    tests = [item.nodeid.partition("[")[0] for item in items]
    cases = Counter(tests)
    is_due = lambda name, turn: zlib.crc32(f"{share} {name}".encode()) % turn == 0
    is_slow = lambda item: item.get_closest_marker("slow") is not None
    others = [
        item
        for item, test in zip(items, tests)
        if (cases[test] > MANY and not is_due(item.nodeid, TURN)) or (is_slow(item) and not is_due(item.path.name, SLOW))
    ]
    config.hook.pytest_deselected(items=others)
    left = set(others)
    items[:] = [item for item in items if item not in left]


def rows():
    """All rows: their verb, and what the table says of them."""
    return [(verb, row) for verb in _core.verbs() for row in _core.rows(verb)]


def fixed_rows():
    """The rows of shapes of fixed size."""
    return [(verb, row) for verb, row in rows() if row["sort"] in ("straight", "search")]


def columns(row, numbers, dtype=np.float64):
    """The arguments of a row as arrays, of all their numbers."""
    made, start = [], 0
    for _, _, size in row["takes"]:
        part = numbers[:, start : start + max(size, 1)]
        made.append(np.ascontiguousarray(part if size else part[:, 0], dtype))
        start += max(size, 1)
    return made


def asked(row):
    """The keywords that choose a row for plain arrays."""
    (_, gives, _), *_ = row["gives"]
    return {"kind": tuple(row["kinds"]), "to": gives}


def samples(row, count=24, seed=3):
    """Random valid inputs of about unit size."""
    return _core.valid_samples(row["name"], count, seed)


@pytest.fixture
def boxes():
    draw = np.random.default_rng(7)
    a = draw.uniform(1, 3, (40, 5))
    return a, a + draw.normal(0, 0.3, a.shape)

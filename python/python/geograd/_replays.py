"""Searches by the decisions of one item, as functions of arrays."""

from __future__ import annotations

import inspect

import numpy as np

import geograd

from . import _core


def _row(verb, item, kind, to):
    """The row of a verb for an item: by the shapes of its arguments, or as `kind` and `to` say."""
    from . import _nodes

    if kind is None:
        kind = tuple(type(x).__name__ if isinstance(x, _core.Shape) else "number" for x in item)
    return _nodes.of_verb(verb, kind, len(item), to).base


def _whole(shape):
    """How many whole numbers, such as counts, end the numbers of a shape: programs do not take them."""
    return next((count for name, _, count in _core.shapes() if name == shape), 0)


def of_item(verb, item, kind, to):
    """The replay of a verb for one item, as a function."""
    row = _row(verb.__name__, item, kind, to)
    given = [np.array(x.array if isinstance(x, _core.Shape) else x) for x in item]
    program = lambda double: verb.replay(*(x.astype("f8" if double else "f4") for x in given), kind=row.kinds, to=row.to, double=double)
    hints = len(verb.hints(*(x.astype("f8") for x in given), kind=row.kinds, to=row.to))
    # Whatever is wrong with the item is known here, not at the first call.
    program(True)
    whole = [_whole(shape) for _, shape, _ in row.takes]
    [gives] = [own["gives"] for own in _core.rows(verb.__name__) if tuple(own["kinds"]) == row.kinds and _fits(own, row)]

    def replay(*lists):
        numbers = [_list(x) for x in lists]
        symbols = program(next(x for own in numbers for x in own).dtype == "float64").on_symbols(
            [own[: len(own) - count] for own, count in zip(numbers, [*whole, 0])]
        )
        parts, at = [], 0
        for _, shape, width in gives:
            own = symbols[at : at + max(width, 1)]
            at += max(width, 1)
            parts.append(own[0] if not width else getattr(geograd, shape)(*own) if shape in geograd._CLASSES else own)
        return parts[0] if len(parts) == 1 else tuple(parts)

    takes = [*((name, width) for name, _, width in row.takes), *([("hints", hints)] if hints else [])]
    kinds = {name: width or float for name, width in takes}
    replay.__name__ = replay.__qualname__ = f"{verb.__name__}_replayed"
    replay.__doc__ = f"The replay of `geograd.{verb.__name__}` for one item."
    replay.__signature__ = inspect.Signature(
        [inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, annotation=own) for name, own in kinds.items()]
    )
    replay.__annotations__ = kinds
    return geograd.function(replay)


def _fits(own, row):
    """Whether a row has the results of another one of the same arguments."""
    return [width for _, _, width in own["gives"]] == row.gives and (row.to is None or own["gives"][0][1] == row.to)


def _list(x):
    return list(x) if isinstance(x, (list, tuple, np.ndarray)) else [x]

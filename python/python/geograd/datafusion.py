"""User functions for DataFusion in Python, and the grouped join.

    context = datafusion.SessionContext()
    geograd.datafusion.register(context, "iou", "Obb2")
    context.sql("select frame, iou_obb2(a, b) as iou from boxes")

Columns are ``FixedSizeList`` whose numbers are called ``element``, as Parquet's are: DataFusion plans no call where the
names of the inner fields differ. Nor does it where their format differs: a function is of float32, or with
``precision="f64"`` of float64, which columns made of NumPy's arrays are by default.
"""

from __future__ import annotations

from typing import Any, Literal, Optional, Sequence, Union

import datafusion
import numpy as np
import pyarrow as pa

import geograd

from . import _core, arrow

_WIDTH = {name: len(fields) for name, fields, _ in _core.shapes()}


#: The shape of both arguments, or one for each.
Kinds = Union[str, Sequence[str]]
Precision = Literal["f32", "f64"]


def _type(kind: Optional[str], number: Any, element: str) -> Any:
    if kind in (None, "number"):
        return number
    if kind not in _WIDTH:
        raise ValueError(f"kind: no shape is called {kind!r}")
    return pa.list_(pa.field(element, number), _WIDTH[kind])


def udf(
    verb: str, kind: Kinds, *, precision: Precision = "f32", name: Optional[str] = None, element: str = "element"
) -> Any:
    """A verb as a scalar function: ``kind`` is the shape of both arguments, or a tuple with one for each.

    ``precision`` is ``"f32"`` or ``"f64"``, the format of all its columns; ``element`` is the name of their inner fields.
    """
    formats = {"f32": pa.float32(), "f64": pa.float64()}
    if precision not in formats:
        raise ValueError(f"precision is 'f32' or 'f64', not {precision!r}")
    number = formats[precision]
    rows = _core.rows(verb)
    if isinstance(kind, str):
        counts = {len(row["kinds"]) for row in rows if set(row["kinds"]) <= {kind, "number"} and kind in row["kinds"]}
        if not counts:
            raise ValueError(f"no row of {verb} takes {kind}")
        kind = (kind,) * max(counts)
    kinds = tuple(kind)
    gives = [row["gives"] for row in rows if tuple(row["kinds"]) == kinds]
    if not gives:
        raise ValueError(f"no row of {verb} takes ({', '.join(map(str, kinds))})")
    size = gives[0][0][2]
    result = pa.list_(pa.field(element, number), size) if size else number
    call = getattr(geograd, verb)

    def function(*columns: Any) -> Any:
        arguments = []
        for column, own in zip(columns, kinds):
            numbers = arrow.array(column, None if own == "number" else own, verb)
            arguments.append(numbers if own == "number" else getattr(geograd, own)(numbers))
        value = call(*arguments)
        return arrow.column(value, element=element).cast(result)

    name = name or _name(verb, kinds)
    takes = [_type(own, number, element) for own in kinds]
    return datafusion.udf(function, takes, result, "immutable", name)


def register(
    context: Any,
    verb: str,
    kind: Kinds,
    *,
    precision: Precision = "f32",
    name: Optional[str] = None,
    element: str = "element",
) -> str:
    """Adds a verb to a session and gives its name in SQL: ``iou_obb2``; further arguments are those of :func:`udf`.

    Columns of float64 need ``precision="f64"``: DataFusion says "Failed to coerce arguments" otherwise.
    """
    name = name or _name(verb, (kind,) if isinstance(kind, str) else kind)
    context.register_udf(udf(verb, kind, precision=precision, name=name, element=element))
    return name


def _name(verb: str, kinds: Sequence[Optional[str]]) -> str:
    """The name of a verb of shapes in SQL."""
    return "_".join([verb, *dict.fromkeys(own.lower() for own in kinds if own not in (None, "number"))])


def join(
    context: Any, verb: str, left: Any, right: Any, threshold: float, *, on: str, a: str, b: str, kind: Kinds
) -> Any:
    """The grouped join of two data frames: pairs of one group whose result is above a threshold, with all columns of both.

    The library's tree is the join: no cells, no condition on every pair. Columns of the right come with ``right_`` before
    their names; the result is ``value``.
    """
    tables = []
    for frame, name in ((left, "left"), (right, "right")):
        names = [field.name for field in frame.schema()]
        if on not in names:
            raise KeyError(f"{name}: no column {on}; there are {', '.join(names)}")
        tables.append(frame.sort(datafusion.col(on).sort()).to_arrow_table())
    pairs = arrow.join(verb, *tables, threshold, on=on, a=a, b=b, kind=kind)
    own = tables[0].take(pairs["left_row"])
    other = tables[1].take(pairs["right_row"])
    columns = {name: own[name] for name in own.column_names}
    columns.update({f"right_{name}": other[name] for name in other.column_names})
    columns["value"] = pairs["value"]
    return context.from_arrow(pa.table(columns))

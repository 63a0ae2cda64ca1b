"""Columns of Arrow in and out: shapes, groups, verbs on tables, the grouped join.

A column of ``FixedSizeList`` is lent without a copy, and so is a result. Shapes of a column of structs, or of columns of a table,
are lent field by field: calls read them where they lie. Fields of structs have the names of the shape's fields, in any order.
"""

from __future__ import annotations

from typing import Any, Iterable, Iterator, Literal, Optional, Sequence, Union

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

import geograd

from . import _core, _nodes

#: The shape of all columns, or one for each; None for lone numbers.
Kinds = Union[str, None, Sequence[Optional[str]]]

_FIELDS = {name: [field for field, *_ in fields] for name, fields, _ in _core.shapes()}


def _plain(column: Any) -> Any:
    """A column in one piece, of a plain type."""
    if hasattr(column, "to_arrow"):
        column = column.to_arrow()
    if not isinstance(column, (pa.Array, pa.ChunkedArray)) and hasattr(column, "__arrow_c_array__"):
        column = pa.array(column)
    if not isinstance(column, (pa.Array, pa.ChunkedArray)) and hasattr(column, "__arrow_c_stream__"):
        column = pa.chunked_array(column)
    if isinstance(column, pa.ChunkedArray):
        column = column.chunk(0) if column.num_chunks == 1 else column.combine_chunks()
    if isinstance(column, pa.ChunkedArray):  # no chunk at all
        column = pa.array([], column.type)
    return column.storage if isinstance(column, pa.ExtensionArray) else column


def _whole(column: Any, name: str) -> None:
    if column.null_count:
        item = int(np.flatnonzero(column.is_null().to_numpy(zero_copy_only=False))[0])
        raise ValueError(f"`{name}` item {item}: is null ({column.null_count} of {len(column)} are)")


def _lane(column: Any, name: str) -> Any:
    """Numbers of a column of floats, without a copy."""
    _whole(column, name)
    if not pa.types.is_floating(column.type) and not pa.types.is_integer(column.type):
        raise TypeError(f"`{name}`: a column of numbers is needed, not of {column.type}")
    numbers = column.to_numpy(zero_copy_only=False)
    return numbers if numbers.dtype in (np.float32, np.float64) else numbers.astype(np.float64)


def _struct(column: Any, wanted: Sequence[str], name: str) -> list[Any]:
    """The numbers of fields of a column of structs, each without a copy."""
    return [_lane(column.field(field), f"{name}.{field}") for field in wanted]


def _apart(kind: str, lanes: list[Any]) -> Any:
    """Shapes of numbers that lie apart: lent where they have one format."""
    made = getattr(geograd, kind)
    if len({lane.dtype for lane in lanes}) > 1 or len(lanes) == 1:
        return made(np.stack(lanes, axis=-1))
    return made(_core.Columns([np.ascontiguousarray(lane) for lane in lanes]))


def array(column: Any, kind: Optional[str] = None, name: str = "column") -> Any:
    """The numbers of a column as an array of shape (N, fields), or (N,) of lone numbers."""
    column = _plain(column)
    _whole(column, name)
    fields = _FIELDS.get(kind)
    if kind is not None and fields is None:
        raise ValueError(f"kind: no shape is called {kind!r}; {_nodes.alike(kind, _FIELDS)}")
    if pa.types.is_fixed_size_list(column.type):
        size = column.type.list_size
        if fields and size != len(fields):
            raise TypeError(f"`{name}`: lists of {len(fields)} numbers are needed for {kind} ({', '.join(fields)}), not of {size}")
        values = column.flatten()
        if values.null_count:
            row = int(np.flatnonzero(values.is_null().to_numpy(zero_copy_only=False))[0]) // size
            raise ValueError(f"`{name}` item {row}: a number is null")
        return _lane(values, name).reshape(-1, size)
    if pa.types.is_struct(column.type):
        own = [column.type.field(i).name for i in range(column.type.num_fields)]
        wanted = fields or own
        missing = [field for field in wanted if field not in own]
        if missing:
            raise TypeError(f"`{name}`: the struct has no field {', '.join(missing)}; it has {', '.join(own)}")
        return np.stack(_struct(column, wanted, name), axis=-1)
    if pa.types.is_list(column.type) or pa.types.is_large_list(column.type):
        raise TypeError(f"`{name}`: lists of any length; cast the column to a fixed_size_list")
    numbers = _lane(column, name)
    return numbers[:, None] if fields and len(fields) == 1 else numbers


def shapes(column: Any, kind: str, name: str = "column") -> Any:
    """Shapes of a kind from a column, lent without a copy."""
    column = _plain(column)
    fields = _FIELDS.get(kind)
    if fields and pa.types.is_struct(column.type) and set(fields) <= {field.name for field in column.type}:
        _whole(column, name)
        return _apart(kind, _struct(column, fields, name))
    return getattr(geograd, kind)(array(column, kind, name))


def fields(table: Any, kind: str, prefix: str = "") -> Any:
    """Shapes of a kind from the columns of a table that have the names of its fields, after a prefix."""
    wanted = [prefix + field for field in _FIELDS[kind]]
    missing = [field for field in wanted if field not in table.column_names]
    if missing:
        raise KeyError(f"no column {', '.join(missing)}; there are {', '.join(table.column_names)}")
    return _apart(kind, [_lane(_plain(table[field]), field) for field in wanted])


def column(x: Any, layout: Literal["list", "struct"] = "list", element: str = "element") -> Any:
    """Shapes or arrays as a column: ``"list"`` for FixedSizeList, without a copy, ``"struct"`` for structs.

    ``element`` names the numbers of a list: Parquet has ``element``, pyarrow by default ``item``.
    """
    kind = type(x).__name__ if isinstance(x, geograd.Shape) else None
    numbers = np.ascontiguousarray(x.array if isinstance(x, geograd.Shape) else x)
    if numbers.ndim == 1:
        return pa.array(numbers)
    if numbers.ndim != 2:
        raise ValueError(f"an array of shape (N, fields) is needed, not {numbers.shape}")
    if layout == "struct":
        names = _FIELDS.get(kind) or [str(i) for i in range(numbers.shape[1])]
        return pa.StructArray.from_arrays([pa.array(np.ascontiguousarray(lane)) for lane in numbers.T], names)
    flat = pa.array(numbers.reshape(-1))
    return pa.FixedSizeListArray.from_arrays(flat, type=pa.list_(pa.field(element, flat.type), numbers.shape[1]))


def _runs(column: Any, name: str) -> tuple[Any, Any]:
    """The first row of every run of equal keys, and the end."""
    column = _plain(column)
    _whole(column, name)
    if pa.types.is_floating(column.type):
        raise TypeError(f"`{name}`: groups are whole numbers, text or times, not {column.type}")
    if pa.types.is_dictionary(column.type):
        column = column.dictionary_decode()
    if len(column) == 0:
        return column, np.array([0])
    changed = np.ones(len(column), bool)
    if pa.types.is_integer(column.type):
        keys = column.to_numpy(zero_copy_only=False)
        changed[1:] = keys[1:] != keys[:-1]
    else:
        changed[1:] = pc.not_equal(column.slice(1), column.slice(0, len(column) - 1)).to_numpy(zero_copy_only=False)
    starts = np.flatnonzero(changed)
    return column.take(pa.array(starts)), np.append(starts, len(column))


def groups(a: Any, b: Any, names: tuple[str, str] = ("a", "b")) -> tuple[Any, Any, Any]:
    """Keys of all groups, and the offsets of each in both columns, for ``groups=``.

    Rows of a group have to follow one another; a group may be missing in one column. Groups come in the order of their
    keys, in which both columns have to be.
    """
    (keys_a, starts_a), (keys_b, starts_b) = _runs(a, names[0]), _runs(b, names[1])
    if keys_a.type != keys_b.type:
        keys_b = keys_b.cast(keys_a.type)
    for keys, starts, name in ((keys_a, starts_a, names[0]), (keys_b, starts_b, names[1])):
        own = keys.to_pylist()
        for k in range(1, len(own)):
            if own[k] <= own[k - 1]:
                raise ValueError(f"`{name}` item {starts[k]}: group {own[k]!r} comes after {own[k - 1]!r}: sort the table by its groups")
    keys = pa.concat_arrays([keys_a, keys_b]).unique()
    keys = keys.take(pc.sort_indices(keys)) if len(keys) else keys

    def offsets(own: Any, starts: Any) -> Any:
        # The first row of the first group that is not before the key.
        place = np.searchsorted(np.array(own.to_pylist(), object), np.array(keys.to_pylist(), object))
        return np.append(starts[place], starts[-1]).astype(np.int64)

    return keys, offsets(keys_a, starts_a), offsets(keys_b, starts_b)


def join(
    verb: Any, left: Any, right: Any, threshold: float, *, on: str, a: str, b: str, kind: Union[str, Sequence[str]]
) -> Any:
    """Pairs of rows of two tables, of one group, whose result is above a threshold: a table of left_row, right_row, value.

    Both tables are in the order of the column ``on``. ``a`` and ``b`` name the columns of shapes.
    """
    kinds = (kind, kind) if isinstance(kind, str) else tuple(kind)
    for table, name in ((left, a), (right, b), (left, on), (right, on)):
        if name not in table.column_names:
            raise KeyError(f"no column {name}; there are {', '.join(table.column_names)}")
    _, of_left, of_right = groups(left[on], right[on], (on, on))
    shapes_a, shapes_b = shapes(left[a], kinds[0], a), shapes(right[b], kinds[1], b)
    verb = getattr(geograd, verb) if isinstance(verb, str) else verb
    rows, columns, values = verb.above(shapes_a, shapes_b, threshold, groups=(of_left, of_right))
    return pa.table({"left_row": rows, "right_row": columns, "value": values})


class Apply:
    """A verb on columns of tables, as engines call it: takes a table or a batch, gives it with the result appended.

    ``columns`` name the arguments, ``kind`` their shapes. With ``grad`` the derivatives by every argument follow, in columns
    ``<out>_by_<column>``. Frames of Polars become such. It is plain data, so engines may send
    it to other processes.
    """

    def __init__(
        self,
        verb: str,
        columns: Sequence[str],
        kind: Kinds,
        *,
        out: str = "value",
        grad: bool = False,
        threads: Optional[int] = None,
    ) -> None:
        kinds = (kind,) * len(columns) if isinstance(kind, str) or kind is None else tuple(kind)
        if len(kinds) != len(columns):
            raise ValueError(f"kind: {len(columns)} shapes are needed, one for each column, not {len(kinds)}")
        if verb not in _core.verbs():
            raise ValueError(f"no verb is called {verb!r}; {_nodes.alike(verb, _core.verbs())}")
        self.verb, self.columns, self.kinds = verb, tuple(columns), kinds
        self.out, self.grad, self.threads = out, grad, threads

    def _argument(self, table: Any, name: str, kind: Optional[str]) -> Any:
        if name not in table.schema.names:
            raise KeyError(f"no column {name}; there are {', '.join(table.schema.names)}")
        if kind is None or kind == "number":
            return array(table.column(name), None, name)
        return shapes(table.column(name), kind, name)

    def __call__(self, table: Any) -> Any:
        is_polars = type(table).__module__.partition(".")[0] == "polars"
        if is_polars:
            import polars

            return polars.from_arrow(self(table.to_arrow()))
        if not hasattr(table, "schema"):
            raise TypeError(f"a table or a batch of Arrow or Polars is needed, not {type(table).__name__}")
        if self.threads is not None:
            geograd.set_num_threads(self.threads)
        arguments = [self._argument(table, name, kind) for name, kind in zip(self.columns, self.kinds)]
        verb = getattr(geograd, self.verb)
        if self.grad:
            value, by = verb.value_grad(*arguments)
            by = by if isinstance(by, tuple) else (by,)
            added = {self.out: value, **{f"{self.out}_by_{name}": x for name, x in zip(self.columns, by)}}
        else:
            added = {self.out: verb(*arguments)}
        names = [*table.schema.names, *added]
        arrays = [*table.columns, *(column(x) for x in added.values())]
        make = pa.Table.from_arrays if isinstance(table, pa.Table) else pa.RecordBatch.from_arrays
        return make(arrays, names=names)

    def batches(self, batches: Iterable[Any]) -> Iterator[Any]:
        """Batch after batch: what ``DataFrame.mapInArrow`` of Spark calls."""
        for batch in batches:
            yield self(batch)

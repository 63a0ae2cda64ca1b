"""Functions for Ray Data: ``dataset.map_batches(geograd.ray.apply("iou", ["a", "b"], "Obb2"), batch_format="pyarrow")``.

Batches have to be Arrow's (``batch_format="pyarrow"``): in ``"numpy"`` Ray makes objects of lists. Tasks of Ray share the
cores of a machine, so a call uses one thread unless told otherwise.
"""

from __future__ import annotations

import inspect
from typing import Any, Callable, Iterable, Sequence

from .arrow import Apply, Kinds, join

__all__ = ["apply", "map", "Files", "join"]


def apply(
    verb: str, columns: Sequence[str], kind: Kinds, *, out: str = "value", grad: bool = False, threads: int = 1
) -> Apply:
    """The verb on batches of Arrow; see :class:`geograd.arrow.Apply`."""
    return Apply(verb, columns, kind, out=out, grad=grad, threads=threads)


def map(
    dataset: Any,
    verb: str,
    columns: Sequence[str],
    kind: Kinds,
    *,
    out: str = "value",
    grad: bool = False,
    threads: int = 1,
    **options: Any,
) -> Any:
    """The dataset with the result of a verb appended."""
    function = apply(verb, columns, kind, out=out, grad=grad, threads=threads)
    return dataset.map_batches(function, batch_format="pyarrow", num_cpus=threads, **options)


class Files:
    """A function of one file, over batches of a column ``path``: a task a file, with a row of the result for each.

    The function takes a path and gives a dict of numbers and text.
    """

    def __init__(self, function: Callable[[str], dict[str, Any]], threads: int = 1) -> None:
        if not callable(function) or inspect.isclass(function):
            raise TypeError("a function of a path is needed")
        self.function, self.threads = function, threads

    def __call__(self, batch: Any) -> Any:
        import pyarrow as pa

        import geograd

        geograd.set_num_threads(self.threads)
        return pa.Table.from_pylist([self.function(path) for path in batch["path"].to_pylist()])

    def run(self, paths: Iterable[Any], **options: Any) -> list[dict[str, Any]]:
        """The results of all files, in the order of the paths."""
        import ray

        paths = [str(path) for path in paths]
        dataset = ray.data.from_items([{"path": path} for path in paths], override_num_blocks=max(len(paths), 1))
        done = dataset.map_batches(self, batch_format="pyarrow", batch_size=1, num_cpus=self.threads, **options).take_all()
        by_path = {row["path"]: row for row in done}
        return [by_path[path] for path in paths]

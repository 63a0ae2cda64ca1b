"""Functions for Ray Data: ``dataset.map_batches(geograd.ray.apply("iou", ["a", "b"], "Obb2"), batch_format="pyarrow")``.

Batches have to be Arrow's (``batch_format="pyarrow"``): in ``"numpy"`` Ray makes objects of lists. Tasks of Ray share the
cores of a machine, so a call uses one thread unless told otherwise.
"""

import inspect

from .arrow import Apply, join

__all__ = ["apply", "map", "Files", "join"]


def apply(verb, columns, kind, *, out="value", grad=False, threads=1):
    """The verb on batches of Arrow; see :class:`geograd.arrow.Apply`."""
    return Apply(verb, columns, kind, out=out, grad=grad, threads=threads)


def map(dataset, verb, columns, kind, *, out="value", grad=False, threads=1, **options):
    """The dataset with the result of a verb appended."""
    function = apply(verb, columns, kind, out=out, grad=grad, threads=threads)
    return dataset.map_batches(function, batch_format="pyarrow", num_cpus=threads, **options)


class Files:
    """A function of one file, over batches of a column ``path``: a task a file, with a row of the result for each.

    The function takes a path and gives a dict of numbers and text.
    """

    def __init__(self, function, threads=1):
        if not callable(function) or inspect.isclass(function):
            raise TypeError("a function of a path is needed")
        self.function, self.threads = function, threads

    def __call__(self, batch):
        import pyarrow as pa

        import geograd

        geograd.set_num_threads(self.threads)
        return pa.Table.from_pylist([self.function(path) for path in batch["path"].to_pylist()])

    def run(self, paths, **options):
        """The results of all files, in the order of the paths."""
        import ray

        paths = [str(path) for path in paths]
        dataset = ray.data.from_items([{"path": path} for path in paths], override_num_blocks=max(len(paths), 1))
        done = dataset.map_batches(self, batch_format="pyarrow", batch_size=1, num_cpus=self.threads, **options).take_all()
        by_path = {row["path"]: row for row in done}
        return [by_path[path] for path in paths]

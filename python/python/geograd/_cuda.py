"""Nodes on CUDA tensors: the library writes a kernel, NVRTC compiles it, and it runs on torch's current stream.

A kernel reads the rows of its arguments where they are, strided or broadcast, and writes new tensors on their device. It
checks no shape: invalid rows have results without a meaning, rows with NaN have NaN.
"""

from __future__ import annotations

import ctypes
import math
from typing import Any, Callable, Optional, Sequence

import torch

from ._cuda_kernels import Kernel, Unavailable, loaded, text_of
from ._cuda_pairs import List, Pairs, Ranges, ranges_of

__all__ = ["Unavailable", "above", "computed", "count_above", "is_there", "most", "pulled_back", "source_of", "total"]


class _Card:
    """What torch says of a card."""

    def is_there(self, x: torch.Tensor) -> bool:
        return x.is_cuda

    def entered(self, device: torch.device) -> Any:
        return torch.cuda.device(device)

    def architecture(self, device: torch.device) -> str:
        # The context of torch is the current one from here on.
        torch.cuda.current_stream(device).synchronize()
        major, minor = torch.cuda.get_device_capability(device)
        return f"sm_{major}{minor}"

    def stream(self, device: torch.device) -> int:
        return int(torch.cuda.current_stream(device).cuda_stream)

    def keep(self, x: torch.Tensor, device: torch.device) -> None:
        x.record_stream(torch.cuda.current_stream(device))


#: Tests put another one in its place.
card = _Card()


def is_there(x: torch.Tensor) -> bool:
    """Whether a tensor is on a card."""
    return card.is_there(x)


class _Tensors:
    """The space of tensors of one device and format."""

    _KINDS = {"double": torch.float64, "place": torch.int64}

    def __init__(self, like: torch.Tensor) -> None:
        self._device, self._dtype = like.device, like.dtype
        self.number = "double" if like.dtype == torch.float64 else "float"

    def new(self, size: Sequence[int], kind: str) -> torch.Tensor:
        return torch.empty(tuple(size), dtype=self._KINDS.get(kind, self._dtype), device=self._device)

    def address(self, x: torch.Tensor) -> int:
        return x.data_ptr()

    def kernel(self, node: Any, key: Any, text: Callable[[], str]) -> Kernel:
        key = ("cuda", self._dtype, self._device, key)
        kernel = node.kept.get(key)
        if kernel is None:
            with card.entered(self._device):
                kernel = loaded(text(), card.architecture(self._device))
            node.kept[key] = kernel
        found: Kernel = kernel
        return found

    def run(self, kernel: Kernel, threads: int, arguments: Sequence[tuple[Any, Any]]) -> None:
        with card.entered(self._device):
            kernel(threads, card.stream(self._device), arguments)

    def starts(self, counts: torch.Tensor) -> tuple[torch.Tensor, int]:
        if counts.numel() == 0:
            return counts, 0
        ends = counts.reshape(-1).cumsum(0)
        return ends - counts.reshape(-1), int(ends[-1])


def computed(node: Any, xs: Any, lead: Any) -> list[torch.Tensor]:
    """The results of a node, as new tensors on the device of its arguments."""
    space = _Tensors(xs[0])
    outs = [space.new((*lead, width) if width else tuple(lead), "number") for width in node.gives]
    count = math.prod(lead)
    if count:
        inner = lead[-1] if len(lead) > 1 else 1
        columns = [_rows(x, lead, inner, width) for (_, _, width), x in zip(node.takes, xs)]
        kernel = space.kernel(node, "rows", lambda: source_of(node, xs[0].dtype))
        arguments: list[tuple[Any, Any]] = [(count, ctypes.c_longlong), (inner, ctypes.c_longlong)]
        for column, step, within in columns:
            arguments += [(column.data_ptr(), ctypes.c_void_p), (step, ctypes.c_longlong), (within, ctypes.c_longlong)]
        arguments += [(out.data_ptr(), ctypes.c_void_p) for out in outs]
        space.run(kernel, count, arguments)
        _keep(column for column, _, _ in columns)
    return outs


def _keep(columns: Any) -> None:
    """Memory of a copied column is not given to others before the kernel has read it."""
    for column in columns:
        card.keep(column, column.device)


def _rows(x: torch.Tensor, lead: Any, inner: int, width: int) -> tuple[torch.Tensor, int, int]:
    """A tensor as rows of ``inner`` items, and the steps between rows and items in numbers; 0 repeats one."""
    x, numbers = x.detach(), max(width, 1)
    size = (*lead, width) if width else tuple(lead)
    x = (x if x.shape == size else x.expand(size)).reshape(-1, inner, numbers)
    if numbers > 1 and x.stride(2) != 1:
        x = x.contiguous()
    return x, x.stride(0), x.stride(1)


def source_of(node: Any, dtype: torch.dtype) -> str:
    """The text of the kernel of a node."""
    return text_of(node, node.form, dtype == torch.float64)


def _pairs(node: Any, a: torch.Tensor, b: torch.Tensor, own: int = 0, groups: Any = None) -> tuple[Pairs, list[torch.Tensor]]:
    """All pairs of two lists, and the tensors that kernels read."""
    lists = []
    for x, (_, _, width) in zip((a, b), node.takes):
        rows, step, _ = _rows(x, (x.shape[0],), 1, width)
        lists.append(List(rows, x.shape[0], step, max(width, 1)))
    ranges = _ranges(groups, own, [x.count for x in lists], a.device)
    return Pairs(_Tensors(a), node, lists, own, ranges), [*(x.array for x in lists), *(ranges or ())]


def _ranges(groups: Any, own: int, counts: Sequence[int], device: torch.device) -> Ranges:
    """The ranges of groups on the device of the lists."""
    if groups is None:
        return None
    low, high = ranges_of(groups, own, counts)
    return torch.from_numpy(low).to(device), torch.from_numpy(high).to(device)


def most(node: Any, a: torch.Tensor, b: torch.Tensor, own: int, sign: str, groups: Any) -> tuple[Any, Any]:
    """The extreme result of every row of the list ``own``, and its place in the other one."""
    pairs, read = _pairs(node, a, b, own, groups)
    found = pairs.extreme(sign)
    _keep(read)
    return found


def above(node: Any, a: torch.Tensor, b: torch.Tensor, sign: str, threshold: float, groups: Any) -> tuple[Any, Any, Any]:
    """Every pair beyond a threshold."""
    pairs, read = _pairs(node, a, b, 0, groups)
    found = pairs.found(sign, threshold)
    _keep(read)
    return found


def count_above(node: Any, a: torch.Tensor, b: torch.Tensor, sign: str, threshold: float) -> int:
    """How many pairs are beyond a threshold."""
    return _pairs(node, a, b)[0].count(sign, threshold)


def total(node: Any, a: torch.Tensor, b: torch.Tensor, factor: float, with_gradients: bool) -> tuple[Any, Optional[list[Any]]]:
    """The sum of all pairs times a factor, and its gradients by both lists."""
    pairs, read = _pairs(node, a, b)
    if not with_gradients:
        sum_, gradients = pairs.total(factor), None
    else:
        widths = [max(width, 1) for _, _, width in node.takes]
        gives = [1, *widths]
        by_a = pairs.sums("value_grad", gives, 1, widths[0], factor)
        by_b = _pairs(node, a, b, 1)[0].sums("value_grad", gives, 1 + widths[0], widths[1], factor)
        sum_, gradients = pairs.total(factor), [by_a.reshape(a.shape), by_b.reshape(b.shape)]
    _keep(read)
    return sum_.reshape(()), gradients


def pulled_back(node: Any, a: torch.Tensor, b: torch.Tensor, bar: torch.Tensor) -> list[Any]:
    """The cotangents of both lists, from a matrix of those of all pairs."""
    widths, results = [max(width, 1) for _, _, width in node.takes], []
    bar = bar.detach()
    for own, first in ((0, 0), (1, widths[0])):
        pairs, read = _pairs(node, a, b, own)
        steps = (bar.stride(0), bar.stride(1)) if own == 0 else (bar.stride(1), bar.stride(0))
        by = pairs.sums("vjp", widths, first, widths[own], weights=(bar, *steps))
        results.append(by.reshape((a, b)[own].shape))
        _keep([*read, bar])
    return results

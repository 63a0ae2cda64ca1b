"""Arrays of a card by its addresses: those of other libraries, read where they are, and new ones."""

from __future__ import annotations

import ctypes
import weakref
from typing import Any, Callable, Optional, Protocol, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _cuda_kernels as kernels
from ._cuda_kernels import Kernel, Unavailable, checked

#: Types of numbers in C by NumPy's.
_FORMATS = {np.dtype("f4"): "float", np.dtype("f8"): "double"}
#: Memory of CUDA in DLPack: of a card, and of both.
_CARDS = (2, 13)
#: The stream that all others wait for, as both protocols name it.
_LEGACY = 1


class ByInterface(Protocol):
    """An array that says where it is by ``__cuda_array_interface__``."""

    @property
    def __cuda_array_interface__(self) -> Any: ...


class ByDLPack(Protocol):
    """An array that says where it is by DLPack."""

    def __dlpack__(self, *, stream: Any = ...) -> Any: ...

    def __dlpack_device__(self) -> Any: ...


#: What functions take.
OnCard = Union[ByInterface, ByDLPack]


class View:
    """An array of floats on a card: where it is, its shape, and its strides in numbers."""

    def __init__(self, address: int, shape: Sequence[int], strides: Sequence[int], dtype: Any, owner: Any, is_fixed: bool = False) -> None:
        self.address, self.shape, self.strides, self.dtype = address, tuple(shape), tuple(strides), np.dtype(dtype)
        self.owner, self.is_fixed = owner, is_fixed

    def span(self) -> tuple[int, int]:
        """The bytes from the first number to the one after the last."""
        size, low, high = self.dtype.itemsize, 0, 0
        if 0 in self.shape:
            return self.address, self.address
        for count, stride in zip(self.shape, self.strides):
            low, high = low + min(0, (count - 1) * stride), high + max(0, (count - 1) * stride)
        return self.address + size * low, self.address + size * (high + 1)


class Out:
    """A caller's array that takes a result; ``waits`` says that its own stream may not wait for the kernel."""

    def __init__(self, view: View, waits: bool) -> None:
        self.address, self.span, self.waits = view.address, view.span(), waits


def viewed(x: Any, name: str) -> View:
    """The numbers of an argument where they are."""
    view, _ = _synced(x, f"`{name}`")
    if view.dtype not in _FORMATS:
        raise TypeError(f"`{name}`: float32 and float64 are computed, not {view.dtype}")
    return view


def _synced(x: Any, name: str) -> tuple[View, bool]:
    """An array after what its own stream has to do, and whether that stream may run beside the one of kernels."""
    if hasattr(x, "__cuda_array_interface__"):
        view, stream = _by_interface(x)
        is_beside = stream not in (None, _LEGACY)
        if is_beside:
            driver, _ = kernels.bindings()
            checked(driver.cuStreamSynchronize(stream))
        return view, is_beside
    if hasattr(x, "__dlpack__"):
        return _by_dlpack(x, name), True
    raise TypeError(f"{name}: an array on a card is needed, not {type(x).__name__}")


def given(places: Sequence[Any], names: Sequence[str], sizes: Sequence[Any], views: Sequence[View], space: Memory) -> list[Optional[Out]]:
    """The caller's arrays for results, none for those that are not wanted; all are checked before anything is written."""
    found: list[Optional[Out]] = []
    taken = [view.span() for view in views]
    for x, name, size in zip(places, names, sizes):
        if x is None:
            found.append(None)
            continue
        name = f"out ({name})"
        view, is_beside = _synced(x, name)
        if view.dtype != views[0].dtype:
            raise TypeError(f"{name}: an array of {views[0].dtype} is needed, like the arguments")
        if view.shape != tuple(size):
            raise ValueError(f"{name}: an array of shape {tuple(size)} is needed, not {view.shape}")
        if any(count > 1 and step != own for count, step, own in zip(view.shape, view.strides, _contiguous(view.shape))):
            raise ValueError(f"{name}: its numbers are not one after another; an array in C order is needed")
        if view.is_fixed:
            raise ValueError(f"{name}: it is read-only")
        if 0 not in view.shape and card_of(view) is not space.card:
            raise TypeError(f"{name}: it is on another card than the arguments")
        low, high = view.span()
        if any(low < end and start < high for start, end in taken):
            raise ValueError(f"{name}: it shares memory with an argument or another result")
        taken.append((low, high))
        found.append(Out(view, is_beside))
    return found


def host_of(x: Any, name: str) -> NDArray[Any]:
    """Whole numbers as an array of the processor, from wherever they are."""
    if isinstance(x, np.ndarray) or not hasattr(x, "__cuda_array_interface__"):
        return np.asarray(x)
    view, _ = _synced(x, name)
    if view.strides != _contiguous(view.shape):
        raise ValueError(f"{name}: offsets on a card must lie one after another; pass a contiguous copy")
    made: NDArray[Any] = np.empty(view.shape, view.dtype)
    if made.size:
        card_of(view).copied(view.address, made)
    return made


def _by_interface(x: Any) -> tuple[View, Optional[int]]:
    told = x.__cuda_array_interface__
    dtype, shape = np.dtype(told["typestr"]), tuple(told["shape"])
    strides = told.get("strides")
    if strides is None:
        steps = _contiguous(shape)
    else:
        steps = tuple(stride // dtype.itemsize for stride in strides)
    return View(int(told["data"][0]), shape, steps, dtype, x, bool(told["data"][1])), told.get("stream")


class _Tensor(ctypes.Structure):
    """The head of a capsule of DLPack."""

    _fields_ = [
        ("data", ctypes.c_void_p), ("device", ctypes.c_int32), ("number", ctypes.c_int32), ("ndim", ctypes.c_int32),
        ("code", ctypes.c_uint8), ("bits", ctypes.c_uint8), ("lanes", ctypes.c_uint16),
        ("shape", ctypes.POINTER(ctypes.c_int64)), ("strides", ctypes.POINTER(ctypes.c_int64)), ("offset", ctypes.c_uint64),
    ]


def _by_dlpack(x: Any, name: str) -> View:
    device, _ = x.__dlpack_device__()
    if int(device) not in _CARDS:
        raise TypeError(f"{name} is not on a card of CUDA, but on device {int(device)} of DLPack")
    capsule = x.__dlpack__(stream=_LEGACY)
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    told = _Tensor.from_address(pointer(capsule, b"dltensor"))
    shape = tuple(told.shape[k] for k in range(told.ndim))
    steps = tuple(told.strides[k] for k in range(told.ndim)) if told.strides else _contiguous(shape)
    # Floats have the code 2.
    dtype = np.dtype(f"f{told.bits // 8}") if told.code == 2 and told.bits in (16, 32, 64) else np.dtype("u1")
    # The capsule frees the numbers when nobody has it.
    return View((told.data or 0) + told.offset, shape, steps, dtype, (x, capsule))


def _contiguous(shape: Sequence[int]) -> tuple[int, ...]:
    steps, step = [], 1
    for size in reversed(shape):
        steps.append(step)
        step *= size
    return tuple(reversed(steps))


class Array:
    """A new array on a card, which other libraries read by ``__cuda_array_interface__``, without a copy."""

    def __init__(self, card: Card, shape: Sequence[int], dtype: Any) -> None:
        self.shape, self.dtype, self._card = tuple(shape), np.dtype(dtype), card
        self.size = int(np.prod(self.shape, dtype=np.int64))
        self.address = card.allocated(max(self.size, 1) * self.dtype.itemsize)
        weakref.finalize(self, card.free, self.address).atexit = False

    @property
    def __cuda_array_interface__(self) -> dict[str, Any]:
        return {
            "shape": self.shape, "typestr": self.dtype.str, "data": (self.address, False), "strides": None, "version": 3,
            "stream": _LEGACY,
        }

    def numpy(self) -> NDArray[Any]:
        """A copy in the memory of the processor."""
        made: NDArray[Any] = np.empty(self.shape, self.dtype)
        if self.size:
            self._card.copied(self.address, made)
        return made

    def __len__(self) -> int:
        return self.shape[0]

    def __repr__(self) -> str:
        return f"<geograd.cuda.Array of {self.dtype}, shape {self.shape}>"


class Card:
    """A card of CUDA, with the context that all libraries share."""

    def __init__(self, ordinal: int) -> None:
        self._driver, _ = kernels.bindings()
        (device,) = checked(self._driver.cuDeviceGet(ordinal))
        (self._context,) = checked(self._driver.cuDevicePrimaryCtxRetain(device))
        which = self._driver.CUdevice_attribute
        (major,) = checked(self._driver.cuDeviceGetAttribute(which.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR, device))
        (minor,) = checked(self._driver.cuDeviceGetAttribute(which.CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR, device))
        self.ordinal, self.architecture = ordinal, f"sm_{major}{minor}"

    def __enter__(self) -> Card:
        checked(self._driver.cuCtxPushCurrent(self._context))
        return self

    def __exit__(self, *_: Any) -> None:
        checked(self._driver.cuCtxPopCurrent())

    def allocated(self, size: int) -> int:
        with self:
            (address,) = checked(self._driver.cuMemAlloc(size))
        return int(address)

    def free(self, address: int) -> None:
        with self:
            checked(self._driver.cuMemFree(address))

    def copied(self, address: int, to: NDArray[Any]) -> None:
        with self:
            checked(self._driver.cuMemcpyDtoH(to.ctypes.data, address, to.nbytes))

    def uploaded(self, x: NDArray[Any]) -> Array:
        made = Array(self, x.shape, x.dtype)
        with self:
            if x.size:
                checked(self._driver.cuMemcpyHtoD(made.address, np.ascontiguousarray(x).ctypes.data, x.nbytes))
        return made


_KNOWN: dict[tuple[int, int], Card] = {}


def card_of(view: View) -> Card:
    """The card that has the memory of an array."""
    driver, _ = kernels.bindings()
    checked(driver.cuInit(0))
    attribute = driver.CUpointer_attribute.CU_POINTER_ATTRIBUTE_DEVICE_ORDINAL
    ordinal = int(checked(driver.cuPointerGetAttribute(attribute, view.address))[0]) if view.address else 0
    key = (id(driver), ordinal)
    if key not in _KNOWN:
        _KNOWN[key] = Card(ordinal)
    return _KNOWN[key]


class Memory:
    """The space of arrays of one card and format, on the stream that all others wait for."""

    def __init__(self, views: Sequence[View], names: Sequence[str]) -> None:
        for view, name in zip(views, names):
            if view.dtype != views[0].dtype:
                raise TypeError(f"`{names[0]}` is {views[0].dtype}, `{name}` {view.dtype}: one format is needed")
        self.card, self._dtype = card_of(views[0]), views[0].dtype
        if any(card_of(view) is not self.card for view in views):
            raise TypeError("the arrays are on several cards")
        self.number = _FORMATS[self._dtype]

    def new(self, size: Sequence[int], kind: str) -> Array:
        return Array(self.card, size, {"double": "f8", "place": "i8"}.get(kind, self._dtype))

    def address(self, x: Any) -> int:
        found: int = x.address
        return found

    def kernel(self, node: Any, key: Any, text: Callable[[], str]) -> Kernel:
        key = ("cuda", self._dtype, id(self.card), key)
        kernel = node.kept.get(key)
        if kernel is None:
            with self.card:
                kernel = node.kept[key] = kernels.loaded(text(), self.card.architecture)
        found: Kernel = kernel
        return found

    def run(self, kernel: Kernel, threads: int, arguments: Sequence[tuple[Any, Any]]) -> None:
        with self.card:
            kernel(threads, 0, arguments)

    def wait(self) -> None:
        """Ends when kernels have ended: for streams that do not wait for theirs."""
        driver, _ = kernels.bindings()
        with self.card:
            checked(driver.cuStreamSynchronize(0))

    def starts(self, counts: Array) -> tuple[Array, int]:
        host = counts.numpy().reshape(-1)
        ends = np.cumsum(host)
        return self.card.uploaded(ends - host), int(ends[-1]) if host.size else 0


__all__ = ["Array", "Memory", "OnCard", "Out", "Unavailable", "View", "given", "host_of", "viewed"]

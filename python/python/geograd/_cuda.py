"""Nodes on CUDA tensors: the library writes a kernel, NVRTC compiles it, and it runs on torch's current stream.

A kernel reads the rows of its arguments where they are, strided or broadcast, and writes new tensors on their device. It
checks no shape: invalid rows have results without a meaning, rows with NaN have NaN. Compiled kernels are kept on disk, by
text, options and architecture, in ``GEOGRAD_CACHE`` or the user's folder of caches.
"""

from __future__ import annotations

import ctypes
import hashlib
import math
import os
import pathlib
import tempfile
from typing import Any, Callable, Optional

import torch

_THREADS = 128
#: Contracted products and sums have other bits than the library's.
_OPTIONS = ("--fmad=false",)
_NAME = "geograd_rows"


class Unavailable(RuntimeError):
    """CUDA tensors need what is not there."""


def computed(node: Any, xs: Any, lead: Any) -> list[torch.Tensor]:
    """The results of a node, as new tensors on the device of its arguments."""
    device, dtype = xs[0].device, xs[0].dtype
    sizes = [(*lead, width) if width else tuple(lead) for width in node.gives]
    outs = [torch.empty(size, dtype=dtype, device=device) for size in sizes]
    count = math.prod(lead)
    if count:
        inner = lead[-1] if len(lead) > 1 else 1
        columns = [_rows(x, lead, inner, width) for (_, _, width), x in zip(node.takes, xs)]
        kernel = kernel_of(node, dtype, device)
        kernel(device, count, inner, columns, outs)
    return outs


def _rows(x: torch.Tensor, lead: Any, inner: int, width: int) -> tuple[torch.Tensor, int, int]:
    """A tensor as rows of ``inner`` items, and the steps between rows and items in numbers; 0 repeats one."""
    x, numbers = x.detach(), max(width, 1)
    size = (*lead, width) if width else tuple(lead)
    x = (x if x.shape == size else x.expand(size)).reshape(-1, inner, numbers)
    if numbers > 1 and x.stride(2) != 1:
        x = x.contiguous()
    return x, x.stride(0), x.stride(1)


def kernel_of(node: Any, dtype: torch.dtype, device: torch.device) -> Callable[..., None]:
    """The kernel of a node for a format and a device, compiled at the first call."""
    key = ("cuda", dtype, device)
    kernel = node.kept.get(key)
    if kernel is None:
        kernel = node.kept[key] = _made(source_of(node, dtype), _NAME, device)
    return kernel


def source_of(node: Any, dtype: torch.dtype) -> str:
    """The text of the kernel of a node."""
    try:
        program = node.base.program(node.form, dtype == torch.float64)
    except (TypeError, ValueError) as error:
        raise Unavailable(
            f"{node.name} has no kernel for CUDA: {error}. Move its tensors with .cpu(), and the result back; gradients follow"
        ) from error
    return str(program.cuda(_NAME))


class _Kernel:
    """A kernel that a driver has loaded."""

    def __init__(self, driver: Any, function: Any) -> None:
        self._driver, self._function = driver, function

    def __call__(self, device: torch.device, count: int, inner: int, columns: Any, outs: Any) -> None:
        values: list[Any] = [count, inner]
        types: list[Any] = [ctypes.c_longlong, ctypes.c_longlong]
        for column, step, within in columns:
            values += [column.data_ptr(), step, within]
            types += [ctypes.c_void_p, ctypes.c_longlong, ctypes.c_longlong]
        values += [out.data_ptr() for out in outs]
        types += [ctypes.c_void_p] * len(outs)
        blocks = -(-count // _THREADS)
        with torch.cuda.device(device):
            stream = torch.cuda.current_stream(device)
            _checked(
                self._driver.cuLaunchKernel(
                    self._function, blocks, 1, 1, _THREADS, 1, 1, 0, stream.cuda_stream, (tuple(values), tuple(types)), 0
                )
            )
        # Memory of a copied column is not given to others before the kernel has read it.
        for column, _, _ in columns:
            column.record_stream(stream)


def _made(source: str, name: str, device: torch.device) -> _Kernel:
    """Compiles and loads a kernel."""
    driver, nvrtc = _bindings()
    with torch.cuda.device(device):
        # The context of torch is the current one from here on.
        torch.cuda.current_stream(device).synchronize()
        major, minor = torch.cuda.get_device_capability(device)
        image = compiled(source, f"sm_{major}{minor}", nvrtc)
        (module,) = _checked(driver.cuModuleLoadData(image))
        (function,) = _checked(driver.cuModuleGetFunction(module, name.encode()))
    return _Kernel(driver, function)


def compiled(source: str, architecture: str, nvrtc: Optional[Any] = None) -> bytes:
    """The machine code of a kernel, from the disk or by NVRTC."""
    nvrtc = nvrtc or _bindings()[1]
    options = [f"--gpu-architecture={architecture}", *_OPTIONS]
    (major, minor) = _checked(nvrtc.nvrtcVersion())
    key = hashlib.sha256("\0".join([source, *options, f"{major}.{minor}"]).encode()).hexdigest()
    kept = _folder() / f"{key}.cubin"
    try:
        return kept.read_bytes()
    except OSError:
        pass
    (program,) = _checked(nvrtc.nvrtcCreateProgram(source.encode(), b"geograd.cu", 0, [], []))
    try:
        texts = [option.encode() for option in options]
        if int(nvrtc.nvrtcCompileProgram(program, len(texts), texts)[0]):
            (size,) = _checked(nvrtc.nvrtcGetProgramLogSize(program))
            log = b" " * size
            _checked(nvrtc.nvrtcGetProgramLog(program, log))
            raise Unavailable(f"NVRTC refuses a kernel: {log.decode(errors='replace')}")
        (size,) = _checked(nvrtc.nvrtcGetCUBINSize(program))
        image = b" " * size
        _checked(nvrtc.nvrtcGetCUBIN(program, image))
    finally:
        nvrtc.nvrtcDestroyProgram(program)
    _keep(kept, image)
    return image


def _folder() -> pathlib.Path:
    """The folder of compiled kernels."""
    own = os.environ.get("GEOGRAD_CACHE")
    if own:
        return pathlib.Path(own)
    base = os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA")
    return (pathlib.Path(base) if base else pathlib.Path.home() / ".cache") / "geograd"


def _keep(path: pathlib.Path, image: bytes) -> None:
    """Writes a file as a whole or not at all; a folder that cannot be written keeps nothing."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, delete=False) as file:
            file.write(image)
        os.replace(file.name, path)
    except OSError:
        pass


def _bindings() -> tuple[Any, Any]:
    """NVIDIA's driver and its compiler, by the package that comes with torch for CUDA."""
    try:
        from cuda.bindings import driver, nvrtc
    except ImportError as error:
        raise Unavailable("CUDA tensors need the package cuda-bindings, which torch for CUDA depends on") from error
    return driver, nvrtc


def _checked(results: Any) -> Any:
    """The results of a call but for its status, which must be a success."""
    status, *others = results
    if int(status):
        raise Unavailable(f"a call of CUDA failed: {status!r}")
    return others

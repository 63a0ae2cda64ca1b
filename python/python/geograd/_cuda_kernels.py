"""Kernels of CUDA: the library's text in templates, machine code by NVRTC, launches by NVIDIA's driver.

Machine code is kept on disk, by text, options and architecture, in ``GEOGRAD_CACHE`` or the user's folder of caches.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import pathlib
import tempfile
from typing import Any, Optional, Sequence

_THREADS = 128
#: Contracted products and sums have other bits than the library's.
_OPTIONS = ("--fmad=false",)
NAME = "geograd_rows"
#: The types of numbers in a text and in a call.
NUMBERS = {"float": ctypes.c_float, "double": ctypes.c_double}


class Unavailable(RuntimeError):
    """CUDA needs what is not there."""


def text_of(node: Any, form: str, double: bool) -> str:
    """The text of a form of a node, with its kernel item by item."""
    try:
        program = node.base.program(form, double)
    except (TypeError, ValueError) as error:
        other = ""
        if getattr(node.base, "is_search", False):
            other = f"; geograd.{node.name.partition('(')[0]}.replayed makes a function of one item's decisions, which a card runs"
        raise Unavailable(
            f"{node.name} has no kernel for CUDA: {error}. Move its arrays to the processor, and the result back{other}"
        ) from error
    return str(program.cuda(NAME))


def functions_of(text: str) -> str:
    """The functions of a text without its kernel: `program_of_row(x, out)` and what it calls."""
    return text.partition('extern "C" __global__')[0]


class Walk:
    """The kernel of a reduction: a thread walks the pairs of one row, or of a chunk of it, and writes what it takes.

    ``takes`` has the width of every argument of the program, and whether it goes with the row (``"own"``), with the others
    (``"other"``), or with the pair (``"both"``).
    """

    def __init__(self, number: str, takes: Sequence[tuple[int, str]], gives: int) -> None:
        self._number, self._takes, self._gives = number, takes, gives

    def text(self, functions: str, parameters: str, start: str, step: str, end: str) -> str:
        """The text around what a thread does at the start, at every pair (row ``i``, other ``j``, results ``y``), and then."""
        declared, once, each, at = [], [], [], 0
        for k, (width, place) in enumerate(self._takes):
            terms = {"own": f"i * step{k}", "other": f"j * step{k}", "both": f"i * step{k} + j * inner{k}"}
            more = f", long long inner{k}" if place == "both" else ""
            declared.append(f", const {self._number} *of{k}, long long step{k}{more}")
            copy = f"for (int k = 0; k < {width}; k += 1) {{\n{{0}}    x[{at} + k] = of{k}[{terms[place]} + k];\n{{0}}}}\n"
            (once if place == "own" else each).append(copy)
            at += width
        lines = lambda copies, indent: "".join(indent + copy.replace("{0}", indent) for copy in copies)
        return (
            f'{functions}extern "C" __global__ void {NAME}(long long rows, long long columns, long long chunks, '
            f"const long long *low, const long long *high{''.join(declared)}{parameters}) {{\n"
            "    const long long thread = (long long)blockIdx.x * blockDim.x + threadIdx.x;\n"
            "    if (thread >= rows * chunks) {\n        return;\n    }\n"
            "    const long long i = thread % rows, chunk = thread / rows, place = i * chunks + chunk;\n"
            "    const long long first = low == 0 ? 0 : low[i], count = (high == 0 ? columns : high[i]) - first;\n"
            "    const long long to = first + count * (chunk + 1) / chunks;\n"
            f"    {self._number} x[{max(at, 1)}], y[{max(self._gives, 1)}];\n"
            f"    {start}\n{lines(once, '    ')}"
            f"    for (long long j = first + count * chunk / chunks; j < to; j += 1) {{\n{lines(each, '        ')}"
            f"        program_of_row(x, y);\n        {step}\n    }}\n    {end}\n}}\n"
        )

    def extreme(self, functions: str, sign: str) -> str:
        """The first extreme result and its place; NaN if there is one."""
        return self.text(
            functions,
            f", {self._number} start, {self._number} *values, long long *places",
            f"{self._number} best = start;\n    long long at = -1;",
            f"if (y[0] {sign} best || (y[0] != y[0] && best == best)) {{\n            best = y[0];\n            at = j;\n        }}",
            "values[place] = best;\n    places[place] = at;",
        )

    def counts(self, functions: str, sign: str) -> str:
        """How many results are beyond a threshold."""
        return self.text(
            functions,
            f", {self._number} threshold, long long *counts",
            "long long found = 0;",
            f"found += y[0] {sign} threshold;",
            "counts[place] = found;",
        )

    def found(self, functions: str, sign: str) -> str:
        """The pairs beyond a threshold, from the places on that the counts before a chunk give."""
        return self.text(
            functions,
            f", {self._number} threshold, const long long *starts, long long *rows_of, long long *columns_of, {self._number} *values",
            "long long next = starts[place];",
            f"if (y[0] {sign} threshold) {{\n            rows_of[next] = i;\n            columns_of[next] = j;\n"
            "            values[next] = y[0];\n            next += 1;\n        }",
            "",
        )

    def sums(self, functions: str, first: int, width: int) -> str:
        """The sums of ``width`` results from ``first`` on, in 64 bits."""
        return self.text(
            functions,
            ", double *totals",
            f"double sums[{width}];\n    for (int k = 0; k < {width}; k += 1) {{\n        sums[k] = 0.0;\n    }}",
            f"for (int k = 0; k < {width}; k += 1) {{\n            sums[k] += (double)y[{first} + k];\n        }}",
            f"for (int k = 0; k < {width}; k += 1) {{\n        totals[place * {width} + k] = sums[k];\n    }}",
        )


def joined_extremes(number: str, sign: str) -> str:
    """The kernel that joins the extremes of chunks, the first one first."""
    return (
        f'extern "C" __global__ void {NAME}(long long rows, long long chunks, const {number} *values, const long long *places, '
        f"{number} *best, long long *at) {{\n"
        "    const long long i = (long long)blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (i >= rows) {\n        return;\n    }\n"
        "    values += i * chunks;\n    places += i * chunks;\n"
        f"    {number} found = values[0];\n    long long place = places[0];\n"
        "    for (long long k = 1; k < chunks; k += 1) {\n"
        f"        if (values[k] {sign} found || (values[k] != values[k] && found == found)) {{\n"
        "            found = values[k];\n            place = places[k];\n        }\n    }\n"
        "    best[i] = found;\n    at[i] = place;\n}\n"
    )


def joined_sums(number: str) -> str:
    """The kernel that adds the sums of chunks in order, of so many in all, and multiplies them."""
    return (
        f'extern "C" __global__ void {NAME}(long long rows, long long chunks, long long width, long long all, double factor, '
        f"const double *totals, {number} *out) {{\n"
        "    const long long thread = (long long)blockIdx.x * blockDim.x + threadIdx.x;\n"
        "    if (thread >= rows * width) {\n        return;\n    }\n"
        "    const long long i = thread / width, k = thread % width;\n"
        "    double sum = 0.0;\n"
        "    for (long long chunk = 0; chunk < chunks && i * chunks + chunk < all; chunk += 1) {\n"
        "        sum += totals[(i * chunks + chunk) * width + k];\n    }\n"
        f"    out[thread] = ({number})(factor * sum);\n}}\n"
    )


class Kernel:
    """A kernel that a driver has loaded."""

    def __init__(self, driver: Any, function: Any) -> None:
        self._driver, self._function = driver, function

    def __call__(self, threads: int, stream: int, arguments: Sequence[tuple[Any, Any]]) -> None:
        """Runs so many threads at least, on values with their types of C."""
        values, types = tuple(value for value, _ in arguments), tuple(kind for _, kind in arguments)
        blocks = -(-threads // _THREADS)
        checked(self._driver.cuLaunchKernel(self._function, blocks, 1, 1, _THREADS, 1, 1, 0, stream, (values, types), 0))


def loaded(source: str, architecture: str) -> Kernel:
    """Compiles and loads a kernel in the current context."""
    driver, nvrtc = bindings()
    image = compiled(source, architecture, nvrtc)
    (module,) = checked(driver.cuModuleLoadData(image))
    (function,) = checked(driver.cuModuleGetFunction(module, NAME.encode()))
    return Kernel(driver, function)


def compiled(source: str, architecture: str, nvrtc: Optional[Any] = None) -> bytes:
    """The machine code of a kernel, from the disk or by NVRTC."""
    nvrtc = nvrtc or bindings()[1]
    options = [f"--gpu-architecture={architecture}", *_OPTIONS]
    (major, minor) = checked(nvrtc.nvrtcVersion())
    key = hashlib.sha256("\0".join([source, *options, f"{major}.{minor}"]).encode()).hexdigest()
    kept = _folder() / f"{key}.cubin"
    try:
        return kept.read_bytes()
    except OSError:
        pass
    image, _ = built(source, options, nvrtc)
    _keep(kept, image)
    return image


def built(source: str, options: Sequence[str], nvrtc: Any) -> tuple[bytes, str]:
    """The machine code of a text and what the compiler says of it."""
    (program,) = checked(nvrtc.nvrtcCreateProgram(source.encode(), b"geograd.cu", 0, [], []))
    try:
        texts = [option.encode() for option in options]
        failed = int(nvrtc.nvrtcCompileProgram(program, len(texts), texts)[0])
        (size,) = checked(nvrtc.nvrtcGetProgramLogSize(program))
        # Longer than one byte: Python has one object for all such, and the compiler writes into it.
        log = bytes(size + 1)
        checked(nvrtc.nvrtcGetProgramLog(program, log))
        said = log.decode(errors="replace").rstrip("\0")
        if failed:
            raise Unavailable(f"NVRTC refuses a kernel: {said}")
        (size,) = checked(nvrtc.nvrtcGetCUBINSize(program))
        image = bytes(size)
        checked(nvrtc.nvrtcGetCUBIN(program, image))
    finally:
        nvrtc.nvrtcDestroyProgram(program)
    return image, said


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


def bindings() -> tuple[Any, Any]:
    """NVIDIA's driver and its compiler, by the package that comes with torch for CUDA."""
    try:
        from cuda.bindings import driver, nvrtc
    except ImportError as error:
        raise Unavailable("CUDA needs the package cuda-bindings, which torch for CUDA depends on") from error
    return driver, nvrtc


def checked(results: Any) -> Any:
    """The results of a call but for its status, which must be a success."""
    status, *others = results
    if int(status):
        raise Unavailable(f"a call of CUDA failed: {status!r}")
    return others

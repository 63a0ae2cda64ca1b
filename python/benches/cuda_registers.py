"""Registers, spills and size of kernels of CUDA, by NVRTC, which needs no card: every straight line in float32, its value and its
adjoint. `python python/benches/cuda_registers.py` writes python/benches/cuda_registers.txt; `--only WORD` takes verbs by
their name and writes nothing, `--longest COUNT` the longest texts alone.

It needs `pip install cuda-bindings nvidia-cuda-nvrtc`.
"""

import argparse
import pathlib
import re
import time

import geograd
from geograd import _core, _cuda_kernels as kernels, _nodes

ARCHITECTURES = ("sm_80", "sm_90")
#: Rows of the table.
LARGEST = 40
FILE = pathlib.Path(__file__).with_suffix(".txt")


def built(source, architecture, nvrtc):
    """Registers, bytes of spills, bytes of machine code and seconds of the compiler."""
    start = time.process_time()
    options = [f"--gpu-architecture={architecture}", "--fmad=false", "--ptxas-options=-v"]
    image, said = kernels.built(source, options, nvrtc)
    seconds = time.process_time() - start
    # The kernel's own lines follow its name; functions that it calls have others.
    registers = int(re.search(r"Used (\d+) registers", said)[1])
    entry = said[said.index(f"Function properties for {kernels.NAME}") :]
    spills = int(re.search(r"(\d+) bytes spill stores", entry)[1])
    return registers, spills, len(image), seconds


def rows(only):
    """The straight lines: a name, and its node."""
    for verb in _core.verbs():
        if only not in verb:
            continue
        for row in _core.rows(verb):
            if row["sort"] != "straight":
                continue
            to = row["gives"][0][1] if row["gives"][0][2] else "number"
            try:
                yield row["name"], _nodes.of_verb(verb, tuple(row["kinds"]), None, to)
            except TypeError:
                yield row["name"], _nodes.of_verb(verb, tuple(row["kinds"]), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="")
    parser.add_argument("--longest", type=int, help="the so many longest texts alone")
    options = parser.parse_args()
    _, nvrtc = kernels.bindings()
    version = ".".join(map(str, kernels.checked(nvrtc.nvrtcVersion())))
    texts, without = [], []
    for name, node in rows(options.only):
        for form in ("value", "vjp"):
            try:
                texts.append((name, form, kernels.text_of(node, form, False)))
            except kernels.Unavailable:
                without.append(f"{name} {form}")
    texts.sort(key=lambda row: len(row[2]), reverse=True)
    found = []
    for name, form, text in texts[: options.longest]:
        sizes = [built(text, architecture, nvrtc) for architecture in ARCHITECTURES]
        found.append((name, form, sizes))
        print(name, form, *sizes, flush=True)
        table = written(found, version, len(texts), without)
        if not options.only:
            FILE.write_text(table, encoding="utf-8")
    print(table)


def written(found, version, texts, without):
    """The table of what was compiled."""
    found = sorted(found, key=lambda row: max((registers, spills) for registers, spills, _, _ in row[2]), reverse=True)
    lines = [
        f"Kernels of float32 by NVRTC {version} with --fmad=false: the {len(found)} longest of {texts}.",
        f"{sum(any(size[1] for size in row[2]) for row in found)} of them spill registers. Without a kernel: {', '.join(without) or 'none'}.",
        "Registers are those of a thread, spills bytes that a thread stores, code bytes of the whole image, seconds of one core.",
        "",
        f"{'row':<44} {'form':<6}" + "".join(f" | {x:>9} {'spills':>6} {'code':>8} {'s':>6}" for x in ARCHITECTURES),
    ]
    for name, form, sizes in found[:LARGEST]:
        cells = "".join(f" | {r:>9} {s:>6} {c:>8} {t:>6.2f}" for r, s, c, t in sizes)
        lines.append(f"{name:<44} {form:<6}{cells}")
    lines += ["", "Kernels by registers on sm_90:"]
    low = 0
    for limit in (32, 64, 96, 128, 168, 255):
        count = sum(low < row[2][1][0] <= limit for row in found)
        lines.append(f"    {low + 1:>3} to {limit:>3}: {count}")
        low = limit
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()

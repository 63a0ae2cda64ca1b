"""Registers, spills and size of kernels of CUDA, by NVRTC, which needs no card: every straight line in float32, its value and its
adjoint. `python python/benches/cuda_registers.py` writes python/benches/cuda_registers.txt.

    --jobs 16               so many processes at once; one by itself
    --architectures sm_90   these alone; sm_80,sm_90 by itself
    --kept FILE             one line for every compiled kernel: another run goes on where this one ended
    --output FILE           another file for the table
    --only WORD             verbs by their name; writes no table without --output
    --longest COUNT         the longest texts alone

It needs `pip install cuda-bindings nvidia-cuda-nvrtc`.
"""

import argparse
import hashlib
import json
import multiprocessing
import pathlib
import re
import time

from geograd import _core, _cuda_kernels as kernels, _nodes

ARCHITECTURES = ("sm_80", "sm_90")
#: Rows of the table.
LARGEST = 40
FILE = pathlib.Path(__file__).with_suffix(".txt")


def built(source, architecture):
    """Registers, bytes of spills, bytes of machine code and seconds of the compiler."""
    start = time.process_time()
    options = [f"--gpu-architecture={architecture}", "--fmad=false", "--ptxas-options=-v"]
    image, said = kernels.built(source, options, kernels.bindings()[1])
    seconds = time.process_time() - start
    # The kernel's own lines follow its name; functions that it calls have others.
    registers = int(re.search(r"Used (\d+) registers", said)[1])
    entry = said[said.index(f"Function properties for {kernels.NAME}") :]
    spills = int(re.search(r"(\d+) bytes spill stores", entry)[1])
    return registers, spills, len(image), seconds


def rows(only):
    """The straight lines: a name, and the name of its node."""
    for verb in _core.verbs():
        if only not in verb:
            continue
        for row in _core.rows(verb):
            if row["sort"] != "straight":
                continue
            to = row["gives"][0][1] if row["gives"][0][2] else "number"
            try:
                yield row["name"], _nodes.of_verb(verb, tuple(row["kinds"]), None, to).name
            except TypeError:
                yield row["name"], _nodes.of_verb(verb, tuple(row["kinds"]), None).name


def printed(task):
    """A row, a form, and the text of its kernel; no text where there is none."""
    name, node, form = task
    try:
        return name, form, kernels.text_of(_nodes.named(node), form, False)
    except kernels.Unavailable:
        return name, form, None


def compiled(task):
    """The key of a kernel, its sizes, and what the compiler says where it refuses the text."""
    key, text = task
    try:
        return key, built(text, key[2]), None
    except kernels.Unavailable as error:
        return key, None, str(error)


def read(path):
    """The sizes of kernels that a run has kept, by their keys."""
    found = {}
    if path is None or not path.exists():
        return found
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            key, sizes = json.loads(line)
        except ValueError:
            # An empty line, or a run that ended within one.
            continue
        found[tuple(key)] = tuple(sizes)
    return found


def compiled_all(pool, texts, architectures, version, kept, without):
    """The sizes of the kernels, by row, form and architecture; the longest texts are compiled first. Names of
    kernels that the compiler refuses join `without`."""
    known, found, tasks = read(kept), {}, []
    for name, form, text in texts:
        digest = hashlib.sha256(text.encode()).hexdigest()[:16]
        for architecture in architectures:
            key = (name, form, architecture, version, digest)
            if key in known:
                found[key[:3]] = known[key]
            else:
                tasks.append((key, text))
    start, total = time.time(), len(tasks) + len(found)
    print(f"{len(texts)} texts, {total} kernels, {len(found)} of them kept from before", flush=True)
    for key, sizes, refused in pool.imap_unordered(compiled, tasks):
        if refused is not None:
            without.append(f"{key[0]} {key[1]}")
            print(f"{' '.join(key[:3])}: {refused}", flush=True)
            continue
        found[key[:3]] = sizes
        if kept is not None:
            with kept.open("a", encoding="utf-8") as file:
                file.write("\n" + json.dumps([key, sizes]))
        registers, spills, code, seconds = sizes
        print(
            f"{len(found)}/{total} after {time.time() - start:.0f} s: {' '.join(key[:3])}: {registers} registers, "
            f"{spills} spilled, {code} bytes, {seconds:.1f} s",
            flush=True,
        )
        yield found
    yield found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--architectures", default=",".join(ARCHITECTURES))
    parser.add_argument("--kept", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--only", default="")
    parser.add_argument("--longest", type=int)
    options = parser.parse_args()
    architectures = options.architectures.split(",")
    output = options.output or (None if options.only else FILE)
    version = ".".join(map(str, kernels.checked(kernels.bindings()[1].nvrtcVersion())))
    # A new process has no threads of this one.
    with multiprocessing.get_context("spawn").Pool(options.jobs) as pool:
        tasks = [(name, node, form) for name, node in rows(options.only) for form in ("value", "vjp")]
        found = list(pool.imap(printed, tasks, chunksize=4))
        without = [f"{name} {form}" for name, form, text in found if text is None]
        texts = [row for row in found if row[2] is not None]
        texts.sort(key=lambda row: len(row[2]), reverse=True)
        chosen, last = texts[: options.longest], 0.0
        for sizes in compiled_all(pool, chosen, architectures, version, options.kept, without):
            # A run that is ended early has a table, too.
            if output is not None and time.time() - last > 5.0:
                output.write_text(written(sizes, architectures, version, len(texts), without), encoding="utf-8")
                last = time.time()
    table = written(sizes, architectures, version, len(texts), without)
    if output is not None:
        output.write_text(table, encoding="utf-8")
    print(table)


def written(sizes, architectures, version, texts, without):
    """The table of the rows that were compiled for all architectures."""
    names = dict.fromkeys((name, form) for name, form, _ in sizes)
    found = [(name, form, [sizes.get((name, form, x)) for x in architectures]) for name, form in names]
    found = [row for row in found if None not in row[2]]
    # Kernels end in any order; the table has one.
    found.sort(key=lambda row: (*(-x for x in max(size[:2] for size in row[2])), row[0], row[1]))
    last = architectures[-1]
    lines = [
        f"Kernels of float32 by NVRTC {version} with --fmad=false: {len(found)} of {texts}; the {min(len(found), LARGEST)} with the most registers.",
        f"{sum(any(size[1] for size in row[2]) for row in found)} of all spill registers. Without a kernel: {', '.join(without) or 'none'}.",
        "Registers are those of a thread, spills bytes that a thread stores, code bytes of the whole image, seconds of one core.",
        "",
        f"{'row':<44} {'form':<6}" + "".join(f" | {x:>9} {'spills':>6} {'code':>8} {'s':>6}" for x in architectures),
    ]
    for name, form, own in found[:LARGEST]:
        cells = "".join(f" | {r:>9} {s:>6} {c:>8} {t:>6.2f}" for r, s, c, t in own)
        lines.append(f"{name:<44} {form:<6}{cells}")
    lines += ["", f"Kernels by registers on {last}:"]
    low = 0
    for limit in (32, 64, 96, 128, 168, 255):
        count = sum(low < row[2][-1][0] <= limit for row in found)
        lines.append(f"    {low + 1:>3} to {limit:>3}: {count}")
        low = limit
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()

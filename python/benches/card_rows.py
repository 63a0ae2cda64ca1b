"""Runs every straight line on a card of CUDA and compares it with the library on the CPU, bit by bit.

    python python/benches/card_rows.py                  # on a card: the results in python/benches/card_rows.txt
    python python/benches/card_rows.py --only iou       # verbs whose names contain a word; nothing is written
    python python/benches/card_rows.py --processor      # without a card: on the processor, nothing is written

A row is run in three forms: its value and its adjoint in float32, its value in float64, of ordinary and of hard inputs. All
processes of the machine compile; then one runs. Registers and local memory are those that the driver tells of the kernels.
"""

import argparse
import concurrent.futures
import multiprocessing
import os
import pathlib
import sys
import time

import numpy as np
import torch

import geograd
from geograd import _core, _cuda, _cuda_kernels as kernels, _nodes

HERE = pathlib.Path(__file__).parent
FILE = pathlib.Path(__file__).with_suffix(".txt")
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]

import samples

FORMS = (("value", torch.float32), ("vjp", torch.float32), ("value", torch.float64))
#: Inputs of a row of either sort.
ITEMS = 40
#: Rows of the table.
LARGEST = 30


def node_of(row, form):
    """The node of a form of a row."""
    given = _core.rows(row.verb)[row.place]["gives"][0]
    try:
        node = _nodes.of_verb(row.verb, row.kinds, None, given[1] if given[2] else "number")
    except TypeError:
        node = _nodes.of_verb(row.verb, row.kinds, None)
    return node if form == "value" else node.vjp()


def named(place, form, dtype):
    return f"{samples.ROWS[place]} {form} {str(dtype)[6:]}"


def compiled(task):
    """Compiles a kernel into the cache: its seconds, why it has none, and what the library computes."""
    place, form, dtype, architecture = task
    start = time.perf_counter()
    try:
        kernels.compiled(kernels.text_of(node_of(samples.ROWS[place], form), form, dtype == torch.float64), architecture)
    except kernels.Unavailable as error:
        return task, time.perf_counter() - start, str(error), None
    return task, time.perf_counter() - start, "", expected(place, form, dtype)


def inputs(row):
    """Ordinary and hard inputs of a row, as arrays in float32, all of them valid there."""
    lists = [x for x in (samples.ordinary(row, ITEMS), samples.hard(row, ITEMS)) if x is not None]
    arrays = [np.concatenate(parts).astype(np.float32) for parts in zip(*lists)]
    try:
        row.value(arrays)
    except ValueError:
        good = [k for k in range(len(arrays[0])) if is_valid(row, [x[k : k + 1] for x in arrays])]
        arrays = [x[good] for x in arrays]
    return arrays


def is_valid(row, arrays):
    try:
        row.value(arrays)
    except ValueError:
        return False
    return True


def expected(place, form, dtype):
    """Arrays for a kernel, cotangents among them, and the results of the library."""
    row = samples.ROWS[place]
    arrays = [x.astype(str(dtype)[6:]) for x in inputs(row)]
    if form == "value":
        return arrays, row.value(arrays)
    rng = np.random.default_rng(5)
    size = lambda width: (len(arrays[0]), width) if width else (len(arrays[0]),)
    bars = [rng.uniform(-1, 1, size(width)).astype(arrays[0].dtype) for width in node_of(row, "value").gives]
    return [*arrays, *bars], row.gradient(arrays, bars)


def resources(kernel):
    """Registers of a thread and bytes of its local memory."""
    driver, attribute = kernel._driver, kernel._driver.CUfunction_attribute
    told = (attribute.CU_FUNC_ATTRIBUTE_NUM_REGS, attribute.CU_FUNC_ATTRIBUTE_LOCAL_SIZE_BYTES)
    return [kernels.checked(driver.cuFuncGetAttribute(x, kernel._function))[0] for x in told]


def ran(place, form, device, arrays, known):
    """Numbers compared, numbers with other bits, the largest difference, registers and local memory."""
    node = node_of(samples.ROWS[place], form)
    xs = [torch.from_numpy(x).to(device) for x in arrays]
    outs = _cuda.computed(node, xs, (len(arrays[0]),))
    found = np.concatenate([x.cpu().numpy().astype(np.float64).reshape(len(arrays[0]), -1) for x in outs], -1)
    same = (found == known) | (np.isnan(found) & np.isnan(known))
    off = np.abs(found - known)[~same] / (1 + np.abs(known[~same]))
    off = np.where(np.isnan(off), np.inf, off)
    kernel = next((x for key, x in node.kept.items() if isinstance(key, tuple) and key[0] == "cuda"), None)
    sizes = resources(kernel) if kernel and device.type == "cuda" else (0, 0)
    for key in [key for key in node.kept if isinstance(key, tuple) and key[0] == "cuda"]:
        del node.kept[key]
    return known.size, int((~same).sum()), float(off.max(initial=0)), *sizes


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="")
    parser.add_argument("--processor", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=1e9, help="what is not compiled by then is left out")
    options = parser.parse_args()
    start = time.perf_counter()
    if options.processor:
        from card import without_a_card

        without_a_card()
        device, name, architecture = torch.device("cpu"), "no card: kernels on the processor", "sm_90"
    elif torch.cuda.is_available():
        device = torch.device("cuda")
        name, architecture = torch.cuda.get_device_name(device), "sm_" + "".join(map(str, torch.cuda.get_device_capability(device)))
    else:
        parser.error("torch finds no card; --processor runs kernels on the processor")
    places = [k for k, row in enumerate(samples.ROWS) if row.sort == "straight" and options.only in row.verb]
    tasks = [(k, form, dtype, architecture) for k in places for form, dtype in FORMS]
    # Adjoints of long inputs take longest, and come first.
    tasks.sort(key=lambda task: (task[1] == "vjp", sum(max(x[2], 1) for x in samples.ROWS[task[0]].takes)), reverse=True)
    ready, without, seconds, of_compiler = [], [], {}, 0.0
    if options.processor:
        ready = [(task, expected(*task[:3])) for task in tasks]
    else:
        # Every process has one thread.
        os.environ["GEOGRAD_THREADS"] = "1"
        context = multiprocessing.get_context("spawn")
        pool = concurrent.futures.ProcessPoolExecutor(options.jobs, context)
        waiting = [pool.submit(compiled, task) for task in tasks]
        try:
            for done in concurrent.futures.as_completed(waiting, timeout=options.seconds):
                task, took, why, known = done.result()
                of_compiler += took
                seconds[task] = took
                (without.append(f"{named(*task[:3])}: {why}") if why else ready.append((task, known)))
                if len(seconds) % 100 == 0:
                    print(f"{len(seconds)} of {len(tasks)} compiled, {time.perf_counter() - start:.0f} s", flush=True)
        except TimeoutError:
            print("the time of compilation is over", flush=True)
        for process in list(pool._processes.values()):
            process.terminate()
        pool.shutdown(wait=False, cancel_futures=True)
    compiled_in = time.perf_counter() - start
    found, failed = [], []
    for task, known in sorted(ready, key=lambda task: task[0][:2]):
        try:
            found.append((named(*task[:3]), seconds.get(task, 0.0), *ran(*task[:2], device, *known)))
        except Exception as error:
            failed.append(f"{named(*task[:3])}: {error!r}")
            print("FAILED", failed[-1], flush=True)
            if "CUDA" in repr(error) and "launch" in repr(error):
                break
    other = [x for x in found if x[3]]
    lines = [
        f"Straight lines on {name}, torch {torch.__version__}: {len(found)} of {len(tasks)} kernels ({len(without)} have none, "
        f"{len(tasks) - len(ready) - len(without)} were not compiled in time).",
        f"{sum(x[2] for x in found)} numbers compared with the CPU's; {sum(x[3] for x in found)} have other bits, in {len(other)} kernels.",
        f"Compilation: {of_compiler:.0f} s of processors, {compiled_in:.0f} s on {options.jobs} of them; runs and comparison: "
        f"{time.perf_counter() - start - compiled_in:.0f} s. Failed: {len(failed)}.",
        "",
        *failed,
        f"{'kernel':<70} {'s':>6} {'numbers':>8} {'other':>6} {'off by':>8} {'registers':>9} {'local':>6}",
    ]
    line = lambda x: f"{x[0]:<70} {x[1]:>6.2f} {x[2]:>8} {x[3]:>6} {x[4]:>8.1e} {x[5]:>9} {x[6]:>6}"
    lines += [line(x) for x in sorted(other, key=lambda x: x[4], reverse=True)]
    lines += ["", "Of the others, the largest by local memory and registers:"]
    lines += [line(x) for x in sorted(found, key=lambda x: (x[6], x[5]), reverse=True)[:LARGEST]]
    lines += ["", "Kernels by registers of a thread:"]
    low = 0
    for limit in (32, 64, 96, 128, 168, 255):
        lines.append(f"    {low + 1:>3} to {limit:>3}: {sum(low < x[5] <= limit for x in found)}")
        low = limit
    lines.append(f"{sum(x[6] > 0 for x in found)} have local memory.")
    text = "\n".join([*lines, "", *without]) + "\n"
    print(text)
    if not options.processor and not options.only:
        FILE.write_text(text, encoding="utf-8")
    if failed:
        sys.exit(f"{len(failed)} kernels failed")


if __name__ == "__main__":
    main()

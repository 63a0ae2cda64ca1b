"""C that geograd writes beside C of CasADi: size of machine code and time of a call, of values and gradients.

    pip install casadi
    python python/benches/c_code.py

Both texts are compiled by the system's compiler (`CC`, else cc) with -std=c99 -O2, which has no contraction, for the processor that
it takes by itself. The functions of geometry are rebuilt in CasADi's SX from the operations of geograd's program, so that both compute
the same; CasADi differentiates them itself. Sines are the C library's there. `own` is written in either language by hand.
"""

import os
import pathlib
import shutil
import statistics
import subprocess
import tempfile

import casadi
import numpy as np

import geograd

CC = os.environ.get("CC", "cc")
OPTIONS = ["-std=c99", "-O2"]
COUNT, RUNS = 1000, 31

TIMER = """
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
void ours(const double *x, double *out);
int theirs(const double **arg, double **res, long long *iw, double *w, int mem);
int theirs_work(long long *arg, long long *res, long long *iw, long long *w);
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}
int main(void) {
    static double x[COUNT * INPUTS], a[COUNT * OUTPUTS], b[COUNT * OUTPUTS];
    long long sizes[4];
    const double *arg[16];
    double *res[16], *w;
    FILE *file = fopen("inputs.bin", "rb");
    if (file == NULL || fread(x, sizeof x, 1, file) != 1) {
        return 1;
    }
    theirs_work(sizes, sizes + 1, sizes + 2, sizes + 3);
    w = (double *)malloc((size_t)(sizes[3] + 1) * sizeof *w);
    for (int run = 0; run < RUNS; run += 1) {
        double start = now(), ours_took, theirs_took;
        for (int i = 0; i < COUNT; i += 1) {
            ours(x + INPUTS * i, a + OUTPUTS * i);
        }
        ours_took = now() - start;
        start = now();
        for (int i = 0; i < COUNT; i += 1) {
            arg[0] = x + INPUTS * i;
            res[0] = b + OUTPUTS * i;
            theirs(arg, res, NULL, w, 0);
        }
        theirs_took = now() - start;
        printf("%.3f %.3f\\n", ours_took / COUNT, theirs_took / COUNT);
    }
    file = fopen("results.bin", "wb");
    fwrite(a, sizeof a, 1, file);
    fwrite(b, sizeof b, 1, file);
    fclose(file);
    return 0;
}
"""


def rebuilt(program, x):
    """The operations of a program in CasADi's expressions."""
    nodes, outputs = program.nodes()
    known = []
    sign = {
        "add": lambda a, b: a + b, "sub": lambda a, b: a - b, "mul": lambda a, b: a * b, "div": lambda a, b: a / b,
        "neg": lambda a: -a, "canonical": lambda a: a, "least": casadi.fmin, "most": casadi.fmax, "magnitude": casadi.fabs,
        "root": lambda a: casadi.sqrt(casadi.fmax(a, 0)), "sin": casadi.sin, "cos": casadi.cos,
        "sin_high": casadi.sin, "cos_high": casadi.cos, "sin_low": lambda a: casadi.SX(0), "cos_low": lambda a: casadi.SX(0),
        "high": lambda a: a, "atan2": casadi.atan2, "exp": casadi.exp, "ln": casadi.log,
        # A power of two that keeps numbers in the middle of the format.
        "binade": lambda a: casadi.SX(1), "lt": lambda a, b: a < b, "le": lambda a, b: a <= b, "eq": lambda a, b: a == b,
        "and": casadi.logic_and, "or": casadi.logic_or, "not": casadi.logic_not, "select": casadi.if_else,
        "split": lambda a, b, bar: casadi.if_else(a < b, bar, casadi.if_else(a == b, bar / 2, 0)),
        "rest": lambda a, b, bar: casadi.if_else(a < b, 0, casadi.if_else(a == b, bar / 2, bar)),
    }
    for name, operands, number in nodes:
        own = [known[place] for place in operands]
        if name in ("constant", "bool"):
            known.append(casadi.SX(number))
        elif name == "input":
            known.append(x[int(number)])
        else:
            known.append(sign[name](*own))
    return casadi.vertcat(*[known[place] for place in outputs])


@geograd.function
def own(p: geograd.Vec2, q: geograd.Vec2, reach: float):
    """The miss of two points that move, by hand: a sine, a root and a quotient."""
    dx, dy = p.x - q.x, p.y - q.y
    far = geograd.sqrt(dx * dx + dy * dy + 1.0)
    return geograd.sin(dx) * geograd.cos(dy) / far + geograd.exp(-far * reach)


def own_of_casadi(x):
    dx, dy = x[0] - x[2], x[1] - x[3]
    far = casadi.sqrt(dx * dx + dy * dy + 1.0)
    return casadi.sin(dx) * casadi.cos(dy) / far + casadi.exp(-far * x[4])


def boxes(rng):
    return np.concatenate([rng.uniform(-2, 2, (COUNT, 2)), rng.uniform(0.5, 3, (COUNT, 2)), rng.uniform(-3, 3, (COUNT, 1))], 1)


def cases():
    """Names, programs of value and gradient in geograd, the value in CasADi, and inputs."""
    rng = np.random.default_rng(1)
    two = np.concatenate([boxes(rng), boxes(rng)], 1)
    point = np.concatenate([rng.uniform(-3, 3, (COUNT, 2)), boxes(rng)], 1)
    for name, verb, kind, inputs in (
        ("clearance of a point and a box", geograd.signed_distance, ("Vec2", "Obb2"), point),
        ("clearance of two boxes", geograd.signed_distance, ("Obb2", "Obb2"), two),
        ("IoU of two boxes", geograd.iou, ("Obb2", "Obb2"), two),
    ):
        value = verb.program(kind=kind)
        yield name, verb.program(kind=kind, form="value_grad"), lambda x, value=value: rebuilt(value, x), inputs
    inputs = np.concatenate([rng.uniform(-3, 3, (COUNT, 4)), rng.uniform(0, 2, (COUNT, 1))], 1)
    yield "own function, by hand", own.program_of("value_grad"), own_of_casadi, inputs


def size(path):
    """Bytes of machine code and constants in an object."""
    lines = subprocess.run(["size", path], capture_output=True, text=True, check=True).stdout.splitlines()
    return int(lines[1].split()[0])


def compiled(folder, name, text, *options):
    (folder / f"{name}.c").write_text(text)
    subprocess.run([CC, *OPTIONS, *options, "-c", f"{name}.c", "-o", f"{name}.o"], cwd=folder, check=True)
    return size(folder / f"{name}.o")


def measured(name, program, value, inputs):
    x = casadi.SX.sym("x", inputs.shape[1])
    start = value(x)
    theirs = casadi.Function("theirs", [x], [casadi.densify(casadi.vertcat(start, casadi.gradient(start, x)))])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        home = os.getcwd()
        os.chdir(folder)
        try:
            theirs.generate("theirs.c")
        finally:
            os.chdir(home)
        sizes = compiled(folder, "ours", program.c("ours")), compiled(folder, "theirs", (folder / "theirs.c").read_text(), "-w")
        outputs = 1 + inputs.shape[1]
        defines = [f"-DCOUNT={COUNT}", f"-DRUNS={RUNS}", f"-DINPUTS={inputs.shape[1]}", f"-DOUTPUTS={outputs}"]
        compiled(folder, "timer", TIMER, *defines)
        subprocess.run([CC, "-o", "timer", "timer.o", "ours.o", "theirs.o", "-lm"], cwd=folder, check=True)
        (folder / "inputs.bin").write_bytes(np.ascontiguousarray(inputs).tobytes())
        ran = subprocess.run([folder / "timer"], cwd=folder, capture_output=True, text=True, check=True)
        times = [tuple(map(float, line.split())) for line in ran.stdout.splitlines()]
        results = np.fromfile(folder / "results.bin").reshape(2, COUNT, outputs)
    # CasADi has NaN where a root is zero; the bits of geograd are the library's.
    expected = np.array([program.eval(list(row)) for row in inputs[:50]])
    assert np.array_equal(results[0, :50], expected), f"{name}: the C of geograd differs from the library"
    with np.errstate(invalid="ignore"):
        off = np.abs(results[0] - results[1]).max(1)
    alike = float(np.mean(off < 1e-9))
    ours, theirs_ = (statistics.median(run[k] for run in times) for k in (0, 1))
    print(f"| {name} | {sizes[0]} | {sizes[1]} | {ours:.0f} | {theirs_:.0f} | {ours / theirs_:.2f} | {100 * alike:.1f} % |", flush=True)


def main():
    if shutil.which(CC) is None or shutil.which("size") is None:
        raise SystemExit("a compiler of C and `size` are needed")
    version = subprocess.run([CC, "--version"], capture_output=True, text=True).stdout.splitlines()[0]
    print(f"geograd {geograd.__version__}, CasADi {casadi.__version__}, {version}, {' '.join(OPTIONS)}, one thread\n")
    print("| value and gradient, float64 | bytes | CasADi's | ns a call | CasADi's | ratio | of inputs within 1e-9 |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for case in cases():
        measured(*case)


if __name__ == "__main__":
    main()

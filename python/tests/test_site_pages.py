"""The code of the site's pages prints what stands below it, and values beside other libraries are theirs."""

import contextlib
import importlib.util
import io
import pathlib
import re
import sys

import numpy as np
import pytest

import geograd

DOCS = pathlib.Path(__file__).parents[1] / "docs"
PAGES = DOCS / "pages"
sys.path.insert(0, str(DOCS))

from parts import collected, reference, sides  # noqa: E402

BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```)?", re.S)
RUN = ["index.md", "install.md", "five_minutes.md", "kinks.md"]


def is_there(code):
    return all(importlib.util.find_spec(name) for name in re.findall(r"^(?:import|from) (\w+)", code, re.M))


@pytest.mark.parametrize("page", RUN)
def test_blocks_print_what_the_page_shows(page):
    names, blocks, ran = {}, BLOCK.findall((PAGES / page).read_text(encoding="utf-8")), 0
    for code, shown in blocks:
        if not is_there(code):
            continue
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(code, page, "exec", dont_inherit=True), names)
        assert printed.getvalue() == shown
        ran += 1
    assert ran >= len(blocks) - 1 and ran >= 1


@pytest.mark.parametrize("page", ["index.md", "faults.md"])
def test_figures_of_pages_are_those_of_the_repository(page):
    text = (PAGES / page).read_text(encoding="utf-8")
    root = DOCS.parents[1]
    readme = (root / "README.md").read_text(encoding="utf-8")
    corpus = (root / "tests" / "corpus" / "README.md").read_text(encoding="utf-8")
    reports = (root / "tests" / "geometry" / "reports" / "README.md").read_text(encoding="utf-8")
    for count in re.findall(r"(\d+) public reports", text):
        assert f"\n{count} reports of wrong" in reports
    for figure in re.findall(r"\d+ million", text):
        assert figure in readme
    for figure in re.findall(r"all ([\d,]+) steady faults", text):
        assert f"({figure.replace(',', '')})" in corpus
    if page == "faults.md":
        assert "missed 10 %" in text and "| 10 % |" in corpus and "Sixty-nine" in corpus and "69 functions" in text


def test_the_page_of_installation_has_both_states():
    import build

    text = (PAGES / "install.md").read_text(encoding="utf-8")
    before, after = build.stated(text, released=False), build.stated(text, released=True)
    assert (
        "in no registry yet" in before
        and "pip install ./geograd/python" in before
        and "cargo add --path ../geograd" in before
    )
    assert "registry yet" not in after and "pip install geograd\n" in after and "cargo add geograd\n" in after
    assert "<!-- " not in before + after


def test_the_first_page_shows_three_lines():
    code, _ = BLOCK.search((PAGES / "index.md").read_text(encoding="utf-8")).groups()
    assert len(code.splitlines()) == 3


PAIRS = sorted(path.stem for path in sides.FOLDER.glob("*.md") if path.stem != "index")


@pytest.mark.parametrize("page", PAIRS)
def test_values_of_both_sides_agree(page):
    text = (sides.FOLDER / f"{page}.md").read_text(encoding="utf-8")
    if (
        not is_there("\n".join(re.sub(sides.PAIR, "", text).splitlines()))
        or "import geograd.torch" in text
        and not is_there("import torch")
    ):
        pytest.skip(f"{page}: a library that the page's own code needs is missing")
    found, compared = [pair for _, pair in sides.pairs(text)], 0
    assert len(found) == text.count("<!-- sides: ") >= 2
    for pair in found:
        assert np.isfinite(pair.ours).all()
        if pair.difference is not None:
            assert pair.difference <= pair.within, sides.said(pair)
            compared += 1
        # A recorded value is right where the library is there, too.
        if pair.theirs is not None and pair.recorded is not None:
            assert np.abs(pair.theirs - pair.recorded).max() <= max(pair.within, 1e-9), sides.said(pair)
    if not compared:
        pytest.skip(f"{page}: the library is missing, and nothing was compared")


def test_each_page_says_what_is_not_covered():
    for page in PAIRS:
        assert "\n## Not covered\n" in (sides.FOLDER / f"{page}.md").read_text(encoding="utf-8"), page


# The table of kinks.


def geograd_kink(f, *x):
    return [float(part) for part in np.atleast_1d(geograd.function(f).value_grad(*x)[1])]


def two(of):
    def f(x: float, y: float):
        return of(x, y)

    return f


def one(of):
    def f(x: float):
        return of(x)

    return f


def length(x, y):
    return geograd.Vec2(x, y).length()


#: For each case the input, and the function here, in PyTorch and in JAX.
CASES = {
    "max(x, y) at (1, 1)": ((1, 1), two(geograd.maximum), "torch.maximum", "jnp.maximum"),
    "min(x, y) at (1, 1)": ((1, 1), two(geograd.minimum), "torch.minimum", "jnp.minimum"),
    "max(x, 0) at 0": (
        (0,),
        one(lambda x: geograd.maximum(x, 0.0)),
        "lambda x: torch.maximum(x, torch.zeros_like(x))",
        "lambda x: jnp.maximum(x, 0.0)",
    ),
    "relu(x) at 0": ((0,), None, "torch.relu", "jax.nn.relu"),
    "\\|x\\| at 0": ((0,), one(abs), "torch.abs", "jnp.abs"),
    "√x at 0": ((0,), one(geograd.sqrt), "torch.sqrt", "jnp.sqrt"),
    "clamp(x, 0, 1) at 0": (
        (0,),
        one(lambda x: geograd.clip(x, 0.0, 1.0)),
        "lambda x: torch.clamp(x, 0, 1)",
        "lambda x: jnp.clip(x, 0, 1)",
    ),
    "clamp(x, 0, 1) at 1": (
        (1,),
        one(lambda x: geograd.clip(x, 0.0, 1.0)),
        "lambda x: torch.clamp(x, 0, 1)",
        "lambda x: jnp.clip(x, 0, 1)",
    ),
    "norm of (x, y) at (0, 0)": (
        (0, 0),
        two(length),
        "lambda *x: torch.linalg.vector_norm(torch.stack(x))",
        "lambda *x: jnp.linalg.norm(jnp.stack(x))",
    ),
    "hypot(x, y) at (0, 0)": ((0, 0), two(geograd.hypot), "torch.hypot", "jnp.hypot"),
    "√(x² + y²) at (0, 0)": (
        (0, 0),
        two(lambda x, y: geograd.sqrt(x * x + y * y)),
        "lambda x, y: torch.sqrt(x * x + y * y)",
        "lambda x, y: jnp.sqrt(x * x + y * y)",
    ),
    "atan2(y, x) at (0, 0)": ((0, 0), two(geograd.arctan2), "torch.atan2", "jnp.arctan2"),
}


def table():
    """The table of the page: a list of four columns for each case."""
    text = (PAGES / "kinks.md").read_text(encoding="utf-8")
    head, rows = re.search(r"(\| case .*?\|)\n\| --- .*?\n((?:\|.*\n)+)", text).groups()
    assert head == "| case | geograd | PyTorch | JAX | Enzyme |"
    cells = [re.split(r"(?<!\\)\|", line.strip()[1:-1]) for line in rows.splitlines()]
    return {own[0].strip(): [cell.strip() for cell in own[1:]] for own in cells}


def spelled(numbers):
    def text(x):
        return "NaN" if np.isnan(x) else "∞" if np.isinf(x) else f"{x + 0.0:g}"

    return ", ".join(map(text, numbers))


def version_on_the_page(name):
    return re.search(rf"{name} (\d+\.\d+)", (PAGES / "kinks.md").read_text(encoding="utf-8"))[1]


def test_the_table_of_kinks_has_these_cases():
    assert list(table()) == list(CASES)


def test_kinks_of_geograd():
    for case, (x, f, *_) in CASES.items():
        assert table()[case][0] == ("none" if f is None else spelled(geograd_kink(f, *map(float, x)))), case


def test_kinks_of_torch():
    torch = pytest.importorskip("torch")
    if not torch.__version__.startswith(version_on_the_page("PyTorch") + "."):
        pytest.skip(f"the page is about PyTorch {version_on_the_page('PyTorch')}, and {torch.__version__} is here")
    for case, (x, _, code, _) in CASES.items():
        arguments = [torch.tensor(float(number), dtype=torch.float64, requires_grad=True) for number in x]
        found = torch.autograd.grad(eval(code, {"torch": torch})(*arguments), arguments)
        assert table()[case][1] == spelled([float(number) for number in found]), case


def test_kinks_of_jax():
    jax = pytest.importorskip("jax")
    if not jax.__version__.startswith(version_on_the_page("JAX") + "."):
        pytest.skip(f"the page is about JAX {version_on_the_page('JAX')}, and {jax.__version__} is here")
    names = {"jax": jax, "jnp": jax.numpy}
    for case, (x, _, _, code) in CASES.items():
        found = jax.grad(eval(code, names), argnums=tuple(range(len(x))))(*map(float, x))
        assert table()[case][2] == spelled([float(number) for number in found]), case


# The reference.


def test_every_verb_and_shape_is_in_the_reference(tmp_path):
    reference.make(tmp_path)
    verbs = re.findall(r"^## `(\w+)`", (tmp_path / "reference" / "verbs.md").read_text(encoding="utf-8"), re.M)
    shapes = re.findall(r"^## `(\w+)`", (tmp_path / "reference" / "shapes.md").read_text(encoding="utf-8"), re.M)
    assert set(verbs) == set(geograd._VERBS) and set(shapes) == set(geograd._CLASSES)


def test_reference_of_check_names_its_arguments(tmp_path):
    reference.make(tmp_path)
    text = (tmp_path / "reference" / "geograd.md").read_text(encoding="utf-8")
    assert "samples=200" in text and "* `samples`: how many random inputs" in text


# Pages that the repository has already.


def test_reports_lead_to_their_inputs(tmp_path):
    collected.make(tmp_path)
    text = (tmp_path / "reports.md").read_text(encoding="utf-8")
    files = re.findall(r"\[The inputs as numbers\]\(\S+/(tests/geometry/reports/\w+\.rs)\)", text)
    assert len(files) == len(set(files)) == text.count("\n## ") >= 11
    assert all((DOCS.parents[1] / file).is_file() for file in files)
    # Right value and geograd's, side by side, differ in the last digit shown at most.
    rows = [line.split(" | ") for line in text.splitlines() if line.startswith("| [")]
    assert len(rows) == int(re.search(r"(\d+) reports of wrong", text)[1])
    for row in rows:
        right, found = (np.array([float(x) for x in cell.split(", ")]) for cell in row[3:5])
        assert np.allclose(right, found, rtol=2e-4, atol=2e-4), row


def test_links_of_collected_pages_are_of_the_site(tmp_path):
    assert collected.moved("python/README.md#arrays", "README.md") == collected.BLOB + "python/README.md#arrays"
    assert collected.moved("../BENCHMARKS.md", "python/DATASETS.md") == "benchmarks.md"
    assert collected.moved("checkers::Task", "tests/corpus/README.md") == collected.BLOB + "tests/corpus"
    assert collected.moved("#rates", "tests/corpus/README.md") == "#rates"


# The pictures.


def test_the_arm_of_the_gallery_keeps_clear():
    pytest.importorskip("matplotlib")
    sys.path.insert(0, str(DOCS / "gallery"))
    import arm

    start, angles = arm.planned()
    _, dense = arm.between(angles)
    assert arm.least(start).min() < -0.3 and arm.least(dense).min() > 0.1


def test_the_boxes_of_the_gallery_reach_their_places():
    pytest.importorskip("matplotlib")
    sys.path.insert(0, str(DOCS / "gallery"))
    import descent

    _, scores = descent.descend()
    assert scores[0].max() < 0.3 and scores[-1].min() > 0.97

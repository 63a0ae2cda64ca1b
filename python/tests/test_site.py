"""Builds the site and opens its pages in Chromium without a window: no error, nothing missing, nothing from outside.

`GEOGRAD_SITE` names a folder of a site that is built already; `GEOGRAD_SITE_SHOTS` one for screenshots.
"""

import functools
import http.server
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import threading

import pytest

PYTHON = pathlib.Path(__file__).parents[1]
sys.path.insert(0, str(PYTHON / "docs"))

from parts import gallery, links, notebooks, reference  # noqa: E402

PAGES = [
    "",
    "install/",
    "five_minutes/",
    "gallery/",
    "notebooks/",
    "notebooks/rotated_detection/",
    "notebooks/own_function/",
    "notebooks/robot_clearance/",
    "notebooks/city/",
    "notebooks/data_set/",
    "instead/",
    "instead/shapely/",
    "reference/verbs/",
    "reference/geograd/",
    "reference/torch/",
    "kinks/",
    "reports/",
    "faults/",
    "corpus/",
    "benchmarks/",
    "datasets/",
]
WIDTHS = {"desktop": (1280, 900), "mobile": (390, 800)}


def chromium():
    """The path of a browser, if there is one."""
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    return next((path for path in map(shutil.which, names) if path), None)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    if os.environ.get("GEOGRAD_SITE"):
        return pathlib.Path(os.environ["GEOGRAD_SITE"])
    for name in ("mkdocs", "material", "jupytext", "nbclient", "ipykernel", "matplotlib"):
        if importlib.util.find_spec(name) is None:
            pytest.skip(f"no site is built: {name} is missing; pip install -r python/docs/requirements.txt")
    out = tmp_path_factory.mktemp("site") / "site"
    command = [sys.executable, str(PYTHON / "docs" / "build.py"), "--out", str(out)]
    if not os.environ.get("GEOGRAD_SITE_NOTEBOOKS"):
        command.append("--fast")
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return out


@pytest.fixture(scope="module")
def address(site):
    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/"
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api", reason="no page is opened: pip install playwright")
    path = chromium()
    if path is None:
        pytest.skip("no page is opened: there is no Chromium")
    with playwright.sync_playwright() as own:
        opened = own.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield opened
        opened.close()


def test_links_lead_somewhere(site):
    assert len(list(site.rglob("*.html"))) >= 35
    assert links.broken(site) == []


def test_a_broken_link_is_found(tmp_path):
    (tmp_path / "index.html").write_text(
        '<a href="there.html#here">x</a><a href="no.html">y</a><img src="no.png">'
        '<a href="a::B">w</a><a href="https://x">z</a>'
    )
    (tmp_path / "there.html").write_text('<h1 id="elsewhere">x</h1>')
    assert [link for _, link in links.broken(tmp_path)] == ["there.html#here", "no.html", "no.png", "a::B"]


def test_pages_name_no_path_of_the_machine(site):
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        assert (
            str(pathlib.Path.home()) + "/" not in text and str(PYTHON.parent) not in text and "/tmp/" not in text
        ), path


def test_pictures_are_drawn(site):
    for name in gallery.ORDER:
        size = (site / "gallery" / f"{name}.svg").stat().st_size
        assert 10_000 < size < 500_000, (name, size)
    assert len(gallery.ORDER) >= 8


def test_pages_open_without_errors(browser, address):
    shots = os.environ.get("GEOGRAD_SITE_SHOTS")
    for kind, (width, height) in WIDTHS.items():
        page = browser.new_page(viewport={"width": width, "height": height})
        faults = []
        page.on(
            "console", lambda message: faults.append(message.text) if message.type in ("error", "warning") else None
        )
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.on("requestfailed", lambda request: faults.append(f"{request.url} failed"))
        page.on(
            "response",
            lambda answer: faults.append(f"{answer.url}: {answer.status}") if answer.status >= 400 else None,
        )
        page.on(
            "request",
            lambda asked: faults.append(f"{asked.url} is elsewhere") if is_elsewhere(asked.url, address) else None,
        )
        for name in PAGES:
            page.goto(address + name)
            page.wait_for_load_state("networkidle")
            assert faults == [], (name, kind, faults)
            assert page.locator("h1").count() == 1, name
            broken = page.evaluate(
                "[...document.images].filter(own => !own.complete || !own.naturalWidth).map(own => own.src)"
            )
            assert broken == [], (name, broken)
            # Wide tables and code scroll by themselves; the page does not.
            assert (
                page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") <= 0
            ), (name, kind)
            if shots:
                page.screenshot(
                    path=str(pathlib.Path(shots) / f"{kind}-{name.strip('/').replace('/', '-') or 'index'}.png"),
                    full_page=True,
                )
        page.close()


def is_elsewhere(url, address):
    return not url.startswith((address, "data:", "blob:"))


def test_a_missing_picture_is_seen(browser, address):
    page = browser.new_page()
    answers = []
    page.on("response", lambda answer: answers.append(answer.status))
    page.goto(address)
    page.evaluate("document.body.append(Object.assign(new Image(), {src: 'no/such.svg'}))")
    page.wait_for_load_state("networkidle")
    assert 404 in answers
    page.close()


def test_the_search_finds_a_verb(browser, address):
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.goto(address)
    page.wait_for_load_state("networkidle")
    page.click("input[name=query]")
    page.keyboard.type("giou", delay=30)
    page.wait_for_selector(".md-search-result__item a", timeout=60_000)
    assert page.locator(".md-search-result__item a").count() >= 1
    page.close()


def test_an_install_and_a_first_result_are_two_clicks_away(browser, address):
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.goto(address)
    page.click("text=Install it")
    assert "pip install" in page.inner_text("article")
    page.click("article >> text=Five minutes")
    assert "[0.657 0.096 0.   ]" in page.inner_text("article")
    page.close()


def test_the_live_page_is_linked_where_it_exists(site):
    front = (site / "index.html").read_text(encoding="utf-8")
    assert (
        ("live/" in front)
        == (PYTHON / "docs" / "live" / "index.html").exists()
        == (site / "live" / "index.html").exists()
    )


def test_notebooks_have_results(site):
    if not os.environ.get("GEOGRAD_SITE_NOTEBOOKS"):
        pytest.skip("notebooks were not executed; GEOGRAD_SITE_NOTEBOOKS=1 executes them")
    for name in notebooks.ORDER:
        text = (site / "notebooks" / name / "index.html").read_text(encoding="utf-8")
        assert "Traceback" not in text
        assert 'class="output"' in text, name
    for name in ("rotated_detection", "robot_clearance", "city"):
        assert (
            len(
                re.findall(
                    r"<img [^>]*Picture \d", (site / "notebooks" / name / "index.html").read_text(encoding="utf-8")
                )
            )
            >= 1
        ), name


def test_a_failing_cell_fails_the_build(tmp_path, monkeypatch):
    for name in ("jupytext", "nbclient", "ipykernel"):
        pytest.importorskip(name)
    (tmp_path / "wrong.py").write_text("# %%\nraise ValueError('as planned')\n")
    (tmp_path / "matplotlibrc").write_text("")
    monkeypatch.setattr(notebooks, "FOLDER", tmp_path)
    with pytest.raises(notebooks.Failed, match="as planned"):
        notebooks.executed("wrong")


def test_docstrings_become_markdown():
    text = "Runs it::\n\n    f(x)\n\nfirst: one of\n  two.\nsecond: more."
    assert (
        reference.markdown(text)
        == "Runs it:\n\n```python\nf(x)\n```\n\n* `first`: one of\n    two.\n* `second`: more."
    )

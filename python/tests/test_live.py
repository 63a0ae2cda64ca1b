"""The page that is alive, in headless Chromium: its numbers are geograd's, with and without WebGPU.

The variable GEOGRAD_SCREENSHOTS names a folder for pictures of the page.
"""

import functools
import http.server
import importlib.util
import os
import pathlib
import shutil
import threading

import numpy as np
import pytest

import geograd

LIVE = pathlib.Path(__file__).parents[1] / "docs" / "live"
SOFTWARE = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader"]
DESKTOP = {"width": 1280, "height": 900}
FAULTS = ("error", "warning")
# Chromium says so by itself where WebGPU has no adapter.
NO_ADAPTER = "No available adapters."
PHONE = {"width": 390, "height": 844}


def generator():
    spec = importlib.util.spec_from_file_location("generate_live", LIVE / "generate.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_generated_modules_are_current():
    written = generator().modules()
    found = {path.name: path.read_text(encoding="utf-8") for path in (LIVE / "generated").glob("*.js")}
    assert found.keys() == written.keys()
    for name, text in written.items():
        assert found[name] == text, f"{name} is not what python/docs/live/generate.py writes"


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def address():
    handler = functools.partial(Quiet, directory=str(LIVE))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_address[1]}/"
    server.shutdown()


@pytest.fixture(scope="module")
def launched():
    playwright = pytest.importorskip("playwright.sync_api", reason="SKIPPED: playwright is not installed")
    chromium = os.environ.get("GEOGRAD_CHROMIUM") or shutil.which("chromium") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("SKIPPED: no Chromium is installed, so the page was not opened")
    with playwright.sync_playwright() as driver:

        def launch(with_gpu):
            more = SOFTWARE if with_gpu else ["--disable-features=WebGPU", "--disable-gpu"]
            return driver.chromium.launch(executable_path=chromium, args=["--no-sandbox", *more])

        browsers = {}
        yield lambda with_gpu: browsers.get(with_gpu) or browsers.setdefault(with_gpu, launch(with_gpu))
        for browser in browsers.values():
            browser.close()


@pytest.fixture
def opened(launched, address):
    """Opens the page; at the end no error was logged, and nothing but files of the page was asked for."""
    closed, errors = [], []

    def open_page(with_gpu=False, **options):
        options.setdefault("viewport", DESKTOP)
        browser = launched(with_gpu)
        context = browser.new_context(reduced_motion="reduce", **options)
        closed.append(context)
        page = context.new_page()
        is_fault = lambda message: message.type in FAULTS and message.text != NO_ADAPTER
        page.on("console", lambda message: errors.append(message.text) if is_fault(message) else None)
        page.on("pageerror", lambda error: errors.append(str(error)))
        is_own = lambda url: url.startswith((address, "data:"))
        page.on("request", lambda request: None if is_own(request.url) else errors.append(request.url))
        page.on("requestfailed", lambda request: errors.append(f"{request.url} failed"))
        page.goto(address)
        page.wait_for_function("window.live !== undefined")
        page.evaluate("live.field.ready.then(() => live.field.painted())")
        return page

    yield open_page
    for one in closed:
        one.close()
    assert errors == []


def picture(page, name):
    folder = os.environ.get("GEOGRAD_SCREENSHOTS")
    if folder:
        page.wait_for_timeout(1500)
        page.screenshot(path=pathlib.Path(folder) / f"{name}.png", full_page=True)


def boxes(page):
    state = page.evaluate("live.boxes.state")
    return geograd.Obb2(np.array([state["a"]])), geograd.Obb2(np.array([state["b"]]))


def numbers(page, part, name):
    text = page.locator(f'#{part} [data-of="{name}"]').get_attribute("data-value")
    return [float(x) for x in text.split()]


def assert_numbers_are_those_of_geograd(page):
    a, b = boxes(page)
    score = page.locator('#boxes [name="score"]:checked').get_attribute("value")
    for verb in (geograd.iou, geograd.giou, geograd.signed_distance):
        value, gradients = verb.value_grad(a, b)
        assert numbers(page, "boxes", verb.__name__) == list(value)
        if verb.__name__ != score:
            continue
        for box, gradient in zip("ab", gradients):
            for name, x in zip(("x", "y", "width", "height", "heading"), gradient[0]):
                (found,) = numbers(page, "boxes", f"by_{box}_{name}")
                assert found == x, (box, name)
    points = geograd.closest_points(a, b)
    assert numbers(page, "boxes", "closest_points") == list(points.array[0])


def place(page, selector, index=0):
    found = page.locator(selector).nth(index)
    found.scroll_into_view_if_needed()
    box = found.bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


@pytest.mark.parametrize("with_gpu", [False, True])
@pytest.mark.parametrize("size", ["desktop", "phone"])
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_page_opens_without_an_error(opened, with_gpu, size, scheme):
    viewport = DESKTOP if size == "desktop" else PHONE
    page = opened(with_gpu, viewport=viewport, color_scheme=scheme, device_scale_factor=1 if size == "desktop" else 2)
    assert_numbers_are_those_of_geograd(page)
    wide = page.evaluate("document.documentElement.scrollWidth")
    assert wide <= viewport["width"], "the page is wider than the screen"
    picture(page, f"{size}-{scheme}-{'webgpu' if with_gpu else 'javascript'}")


@pytest.mark.parametrize("score", ["iou", "giou", "signed_distance"])
def test_a_drag_changes_the_numbers_to_those_of_geograd(opened, score):
    page = opened()
    page.locator(f'[name="score"][value="{score}"]').check()
    before = numbers(page, "boxes", "iou")
    # Handles of box A: place, width, height, heading.
    for handle, (dx, dy) in enumerate([(90, -30), (25, 10), (-8, -35), (20, 70)]):
        x, y = place(page, "#boxes-stage .of-a .handle", handle)
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + dx / 2, y + dy / 3)
        page.mouse.move(x + dx, y + dy)
        page.mouse.up()
        assert_numbers_are_those_of_geograd(page)
    assert numbers(page, "boxes", "iou") != before
    assert numbers(page, "boxes", "iou")[0] > 0


def test_keys_move_turn_and_resize(opened):
    page = opened()
    start = page.evaluate("live.boxes.state.a")
    for handle, key, number, by in [
        (0, "ArrowRight", 0, 0.05), (0, "Shift+ArrowUp", 1, 0.5), (1, "ArrowUp", 2, 0.05), (2, "ArrowLeft", 3, -0.05),
        (3, "ArrowUp", 4, 0.05),
    ]:
        page.locator("#boxes-stage .of-a .handle").nth(handle).focus()
        page.keyboard.press(key)
        start[number] += by
        assert page.evaluate("live.boxes.state.a") == pytest.approx(start, abs=1e-12)
        assert_numbers_are_those_of_geograd(page)
    page.locator("#boxes-b-x").fill("-0.25")
    page.locator("#boxes-b-x").press("Enter")
    assert page.evaluate("live.boxes.state.b[0]") == -0.25
    assert_numbers_are_those_of_geograd(page)
    x = page.evaluate("live.field.state.point[0]")
    page.locator("#field-stage .handle").focus()
    page.keyboard.press("ArrowLeft")
    assert page.evaluate("live.field.state.point[0]") == pytest.approx(x - 0.05)


def test_a_finger_drags_a_box(opened):
    page = opened(viewport=PHONE, has_touch=True, is_mobile=True)
    page.locator("#boxes-stage").scroll_into_view_if_needed()
    x, y = place(page, "#boxes-stage .of-a .handle")
    before = page.evaluate("live.boxes.state.a")
    session = page.context.new_cdp_session(page)
    for kind, points in [
        ("touchStart", [{"x": x, "y": y}]), ("touchMove", [{"x": x + 30, "y": y}]),
        ("touchMove", [{"x": x + 60, "y": y - 10}]), ("touchEnd", []),
    ]:
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    after = page.evaluate("live.boxes.state.a")
    assert after[0] > before[0] + 0.5 and after[1] > before[1]
    assert_numbers_are_those_of_geograd(page)


def test_descent_reaches_the_other_box(opened):
    page = opened()
    page.locator('[name="score"][value="giou"]').check()
    page.locator("#boxes-step").click()
    assert len(page.evaluate("live.boxes.state.history")) == 2
    page.locator("#boxes-descend").click()
    assert numbers(page, "boxes", "giou")[0] > 0.99
    losses = page.evaluate("live.boxes.state.history")
    assert all(later < earlier for earlier, later in zip(losses, losses[1:]))
    assert_numbers_are_those_of_geograd(page)
    picture(page, "descended")
    page.locator("#boxes-reset").click()
    page.locator('[name="score"][value="signed_distance"]').check()
    page.locator("#boxes-descend").click()
    assert abs(numbers(page, "boxes", "signed_distance")[0]) < 1e-9
    # Apart, the IoU has no gradient, and no step is made.
    page.evaluate("live.boxes.set('a', [-2.8, -1.8, 1, 1, 0.3])")
    page.locator('[name="score"][value="iou"]').check()
    page.locator("#boxes-step").click()
    assert numbers(page, "boxes", "iou") == [0.0]
    assert "do not touch" in page.locator("#boxes-note").text_content()


@pytest.mark.parametrize("index", range(4))
def test_fields_have_the_values_of_geograd(opened, index):
    page = opened()
    function = generator().FIELDS[index][0]
    page.locator(f'[name="field"][value="{function.__name__}"]').check()
    point, number = page.evaluate("[live.field.state.point, live.field.state.number]")
    value, (by_point, by_number) = function.value_grad(np.array([point]), np.array([number]))
    assert numbers(page, "field", "distance") == list(value)
    assert numbers(page, "field", "by_point") == list(by_point[0])
    assert numbers(page, "field", "by_number") == list(by_number)
    # The mouse is where the gradient is shown; a click puts the point there.
    x, y = place(page, "#field-stage")
    page.mouse.move(x + 40, y + 30)
    assert "Under the pointer" in page.locator("#field-pointer").text_content()
    page.mouse.click(x + 40, y + 30)
    assert page.evaluate("live.field.state.point") != point
    page.locator("#field-descend").click()
    assert abs(numbers(page, "field", "distance")[0]) < 1e-9
    picture(page, f"field-{function.__name__}")


# Keeps the pixels of the field by a name, and counts their colours.
KEPT = """async (name) => {
    await live.field.painted();
    const { width, height } = document.getElementById("field-canvas");
    const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    context.drawImage(document.getElementById("field-canvas"), 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    window.kept = { ...window.kept, [name]: data };
    return new Set(new Uint32Array(data.buffer)).size;
}"""
DIFFERENCES = """() => {
    const { gpu, javascript } = window.kept;
    const differences = gpu.map((x, i) => Math.abs(x - javascript[i]));
    return [differences.filter((x) => x > 8).length, differences.reduce((sum, x) => sum + x, 0), gpu.length];
}"""


def test_without_webgpu_javascript_draws_the_field(opened):
    page = opened()
    assert page.locator('[name="painter"][value="gpu"]').is_disabled()
    assert page.evaluate(KEPT, "javascript") > 100


def test_webgpu_and_javascript_agree(opened):
    page = opened(with_gpu=True)
    if page.locator('[name="painter"][value="gpu"]').is_disabled():
        pytest.skip("SKIPPED: this Chromium has no WebGPU, so its pixels were not compared")
    for index in range(4):
        for share in (0.1, 0.9):
            found, expected = page.evaluate("""async ([index, share]) => {
                const { fields, values } = live.field;
                const field = fields[index];
                const number = field.limits[0] + share * (field.limits[1] - field.limits[0]);
                const places = [];
                for (let x = -4; x <= 4; x += 0.1) {
                    for (let y = -2.75; y <= 2.75; y += 0.1) {
                        places.push(Math.fround(x), Math.fround(y));
                    }
                }
                const expected = [];
                for (let i = 0; i < places.length; i += 2) {
                    expected.push(field.of([places[i], places[i + 1], Math.fround(number)])[0]);
                }
                return [await values(field, places, number), expected];
            }""", [index, share])
            assert len(found) == len(expected) > 4000
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-4)
    for index in range(4):
        page.locator('[name="field"]').nth(index).check()
        for painter in ("gpu", "javascript"):
            page.locator(f'[name="painter"][value="{painter}"]').check()
            assert page.evaluate(KEPT, painter) > 100
            assert page.evaluate("live.field.state.painter") == painter
        far, total, count = page.evaluate(DIFFERENCES)
        # A rounding may move the edge of a line, of few pixels.
        assert far / count < 1e-3 and total / count < 0.5

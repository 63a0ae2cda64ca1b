// A signed distance field: its pixels, its value and gradient at a point, and the way of the point to the border.
import { add, animate, arrow, handle, pixel, placeOf, set, show, shown } from "./stage.js";
import { palette } from "./colours.js";
import { FIELDS } from "./generated/fields.js";
import { gpu } from "./gpu.js";
import { painter } from "./paint.js";

const START = [-2.9, 1.9];
/** A point this near to the border is on it. */
const NEAR = 1e-9;

export function field() {
    const svg = document.getElementById("field-stage");
    const state = {
        field: FIELDS[0],
        number: FIELDS[0].first,
        point: [...START],
        path: [],
        running: false,
        painter: "javascript",
    };
    const slider = document.getElementById("field-number");
    const pixels = surface();
    let drawn = Promise.resolve();
    let waiting = false;

    // The picture: what is under the point, and the pixels.
    const area = add(svg, "rect", { x: -4, y: -2.75, width: 8, height: 5.5, fill: "transparent" });
    const path = add(svg, "polyline", { class: "path" });
    const over = add(svg, "g", { class: "of-point" });
    const uphill = arrow(over);
    const put = (point) => {
        state.point = point;
        state.running = false;
        state.path = [];
        draw();
    };
    area.addEventListener("click", (event) => put(placeOf(svg, event)));
    // A mouse shows the gradient where it is.
    const under = arrow(add(svg, "g", { class: "of-pointer" }));
    const hovered = (place) => {
        const [distance, dx, dy] = place === null ? [0, 0, 0] : evaluated(place);
        const [x, y] = place ?? [0, 0];
        under.draw(Math.hypot(dx, dy) > 0.04 ? [[x, y], [x + 0.5 * dx, y + 0.5 * dy]] : [], pixel(svg));
        document.getElementById("field-pointer").textContent = place === null ? ""
            : `Under the pointer: ${shown(distance, 3)}, gradient (${shown(dx, 3)}, ${shown(dy, 3)}).`;
    };
    area.addEventListener("pointermove", (event) => event.pointerType === "mouse" && hovered(placeOf(svg, event)));
    area.addEventListener("pointerleave", () => hovered(null));
    const nudge = (dx, dy) => put([state.point[0] + dx, state.point[1] + dy]);
    const dot = handle(svg, over, "Point of the field", put, nudge);

    const evaluated = (point) => state.field.of([...point, state.number]);

    function draw() {
        const unit = pixel(svg);
        const [distance, dx, dy, by] = evaluated(state.point);
        const [x, y] = state.point;
        dot.draw(state.point, unit, distance.toFixed(3), `x ${x.toFixed(2)}, y ${y.toFixed(2)}`);
        uphill.draw(Math.hypot(dx, dy) > 0.04 ? [[x, y], [x + 0.8 * dx, y + 0.8 * dy]] : [], unit);
        set(path, { points: state.path.map(([u, v]) => `${u},${-v}`).join(" ") });
        const output = (name) => document.querySelector(`#field [data-of="${name}"]`);
        show(output("point"), state.point, 3);
        show(output("distance"), distance);
        show(output("by_point"), [dx, dy], 4);
        show(output("by_number"), by, 4);
        document.getElementById("field-descend").textContent = state.running ? "Stop" : "Descend to zero";
        const steps = Math.max(state.path.length - 1, 0);
        document.getElementById("field-note").textContent = steps > 0
            ? `After ${steps} ${steps === 1 ? "step" : "steps"} the distance is ${shown(distance, 9)}.`
            : "The arrow is the gradient: the way in which the distance grows.";
    }

    /** Draws all pixels again, after the picture that is being made. */
    function paint() {
        if (!waiting) {
            waiting = true;
            drawn = drawn.then(() => {
                waiting = false;
                return pixels.paint(state);
            });
        }
        return drawn;
    }

    /** Moves the point against the gradient, by as much as the distance says. */
    function step() {
        const [distance, dx, dy] = evaluated(state.point);
        const steep = dx * dx + dy * dy;
        if (state.path.length === 0) {
            state.path.push(state.point);
        }
        if (Math.abs(distance) < NEAR || steep < 1e-6) {
            return false;
        }
        // Half of the way, so that the way can be seen; the whole of it at last.
        const share = Math.abs(distance) > 0.02 ? 0.5 : 1;
        const by = (share * distance) / steep;
        state.point = [state.point[0] - by * dx, state.point[1] - by * dy];
        state.path.push(state.point);
        return true;
    }

    function choose(field) {
        Object.assign(state, { field, number: field.first });
        document.getElementById("field-number-name").textContent = field.number;
        document.getElementById("field-by-number").textContent = `\u2202/\u2202${field.number}`;
        [slider.min, slider.max] = field.limits;
        slider.value = field.first;
        document.getElementById("field-number-value").textContent = shown(state.number, 2);
        document.getElementById("field-python").textContent = field.python;
        document.getElementById("field-wgsl").textContent = field.wgsl;
        document.getElementById("field-module").href = `generated/${field.name}.js`;
        put(state.point);
        return paint();
    }

    const names = document.getElementById("field-names");
    FIELDS.forEach((field, i) => {
        const label = document.createElement("label");
        const input = document.createElement("input");
        Object.assign(input, { type: "radio", name: "field", value: field.name, checked: i === 0 });
        input.addEventListener("change", () => choose(field));
        label.title = `${field.about} ${field.operations} operations.`;
        label.append(input, ` ${field.title}`);
        names.append(label);
    });
    slider.addEventListener("input", () => {
        state.number = slider.valueAsNumber;
        document.getElementById("field-number-value").textContent = shown(state.number, 2);
        put(state.point);
        paint();
    });
    document.getElementById("field-step").addEventListener("click", () => {
        state.running = false;
        step();
        draw();
    });
    document.getElementById("field-descend").addEventListener("click", () => {
        state.running = !state.running;
        if (state.running) {
            animate(() => {
                state.running = state.running && state.path.length < 200 && step();
                draw();
                return state.running;
            });
        }
        draw();
    });
    document.getElementById("field-reset").addEventListener("click", () => put([...START]));
    for (const input of document.querySelectorAll('#field [name="painter"]')) {
        input.addEventListener("change", () => {
            state.painter = input.value;
            paint();
        });
    }
    // A browser keeps what was chosen when a page is loaded again.
    const kept = FIELDS.find((field) => names.querySelector(":checked")?.value === field.name) ?? FIELDS[0];
    const first = choose(kept);
    const offered = (has) => {
        const [by_gpu, by_javascript] = document.querySelectorAll('#field [name="painter"]');
        by_gpu.disabled = !has;
        by_gpu.checked = has;
        by_javascript.checked = !has;
        state.painter = has ? "gpu" : "javascript";
        return first.then(paint);
    };
    const ready = pixels.start(() => offered(false)).then(offered);
    new ResizeObserver(() => {
        draw();
        paint();
    }).observe(svg);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", paint);
    /** Waits for the last picture. */
    const painted = () => drawn.then(pixels.finished);
    return { state, ready, put, choose, painted, fields: FIELDS, values: pixels.values };
}

/** What draws the pixels: WebGPU where it is there, or JavaScript. */
function surface() {
    const canvas = document.getElementById("field-canvas");
    const context = canvas.getContext("2d");
    const by_javascript = painter(canvas);
    let by_gpu = null;
    let failed = () => {};
    let finished = Promise.resolve(true);

    /** Asks for WebGPU; true if it is there. A device that is lost or fails is not asked again. */
    async function start(lost) {
        failed = () => {
            by_gpu = null;
            lost();
        };
        by_gpu = await gpu();
        by_gpu?.lost.then(failed);
        return by_gpu !== null;
    }

    async function paint({ field, number, painter: wanted }) {
        const is_gpu = wanted === "gpu" && by_gpu !== null;
        const wide = canvas.parentElement.getBoundingClientRect().width;
        const width = Math.max(Math.round(wide * (is_gpu ? Math.min(devicePixelRatio, 2) : 1)), 1);
        const unit = 8 / width;
        const height = Math.max(Math.round(5.5 / unit), 1);
        const all = [field, palette(), [-4, 2.75], unit, number];
        const pixels = is_gpu && (await by_gpu.pixels(...all, width, height).catch((error) => {
            console.error(error);
            failed();
        }));
        if (canvas.width !== width || canvas.height !== height) {
            Object.assign(canvas, { width, height });
        }
        if (pixels) {
            by_javascript.stop();
            context.putImageData(new ImageData(new Uint8ClampedArray(pixels), width, height), 0, 0);
        } else {
            // Large blocks are there at once; the next picture ends this one.
            finished = by_javascript.draw(...all);
        }
    }

    return { start, paint, finished: () => finished, values: (...all) => by_gpu?.values(...all) ?? null };
}

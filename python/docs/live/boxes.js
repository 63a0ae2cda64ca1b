// Two rotated boxes: scores with gradients, and descent of box A. All numbers are of geograd's functions.
import { add, animate, arrow, drag, grid, handle, pixel, set, show, shown } from "./stage.js";
import { closest_points } from "./generated/closest_points.js";
import { giou } from "./generated/giou.js";
import { iou } from "./generated/iou.js";
import { signed_distance } from "./generated/signed_distance.js";

const START = { a: [-1.1, -0.6, 2.6, 1.4, 0.45], b: [0.9, 0.4, 2.8, 1.6, -0.2] };
const NAMES = ["x", "y", "width", "height", "heading"];
const LEAST = 0.1;

/** The scores: the function, what descent makes small and until when, and which way that is from the score. */
const SCORES = {
    iou: { of: iou, title: "1 \u2212 IoU", loss: (x) => 1 - x, enough: 1e-4, sign: () => 1 },
    giou: { of: giou, title: "1 \u2212 GIoU", loss: (x) => 1 - x, enough: 1e-4, sign: () => 1 },
    signed_distance: {
        of: signed_distance,
        title: "|signed distance|",
        loss: Math.abs,
        enough: 1e-12,
        sign: (x) => (x > 0 ? -1 : 1),
    },
};

const CHANGES = { place: [0, 1], size: [2, 3], heading: [4] };

export function boxes() {
    const svg = document.getElementById("boxes-stage");
    const state = { a: [...START.a], b: [...START.b], score: "iou", history: [], running: false };
    const chosen = () => SCORES[state.score];
    const evaluated = (a) => chosen().of([...a, ...state.b]);

    // Everything that moves a box goes through here; a move by hand begins a new descent.
    const change = (box, numbers) => {
        state[box] = numbers.map((x, i) => (i === 2 || i === 3 ? Math.max(x, LEAST) : x));
        state.running = false;
        state.history = [];
        draw();
    };
    const picture = drawing(svg, state, change);
    const table = numbers(state, change);

    function draw() {
        const input = [...state.a, ...state.b];
        for (const [name, score] of Object.entries(SCORES)) {
            show(document.querySelector(`#boxes [data-of="${name}"]`), score.of(input)[0]);
        }
        const points = closest_points(input);
        const closest = document.querySelector('#boxes [data-of="closest_points"]');
        show(closest, points);
        const [ax, ay, bx, by] = points.map((x) => shown(x, 3));
        closest.textContent = `(${ax}, ${ay}) and (${bx}, ${by})`;
        const [value, ...gradient] = chosen().of(input);
        picture(points, gradient, SCORES.signed_distance.of(input)[0] > 0);
        table(gradient);
        const loss = chosen().loss(value);
        plot(state.history.length > 0 ? state.history : [loss], chosen().title);
        document.getElementById("boxes-descend").textContent = state.running ? "Stop" : "Descend";
        const flat = gradient.every((x) => x === 0);
        document.getElementById("boxes-note").textContent = note(state, value, flat);
    }

    // Moves box A against the gradient of the loss, less far if that does not make it smaller; true if more is to do.
    function step() {
        const [value, ...gradient] = evaluated(state.a);
        const { loss, enough, sign } = chosen();
        if (state.history.length === 0) {
            state.history.push(loss(value));
        }
        const boxes = [...document.querySelectorAll('#boxes [name="changes"]:checked')];
        const free = boxes.flatMap((box) => CHANGES[box.value]);
        for (let rate = 0.5; rate > 1e-12; rate /= 2) {
            const next = [...state.a];
            for (const i of free) {
                next[i] += rate * sign(value) * gradient[i];
            }
            next[2] = Math.max(next[2], LEAST);
            next[3] = Math.max(next[3], LEAST);
            const found = loss(evaluated(next)[0]);
            if (found < loss(value)) {
                state.a = next;
                state.history.push(found);
                return found > enough;
            }
        }
        return false;
    }

    document.getElementById("boxes-step").addEventListener("click", () => {
        state.running = false;
        step();
        draw();
    });
    document.getElementById("boxes-descend").addEventListener("click", () => {
        state.running = !state.running;
        let left = 1500;
        if (state.running) {
            animate(() => {
                left -= 1;
                state.running = state.running && left > 0 && step();
                draw();
                return state.running;
            });
        }
        draw();
    });
    document.getElementById("boxes-reset").addEventListener("click", () => {
        change("a", [...START.a]);
        change("b", [...START.b]);
    });
    for (const input of document.querySelectorAll('#boxes [name="score"]')) {
        input.addEventListener("change", () => {
            state.score = input.value;
            change("a", state.a);
        });
    }
    state.score = document.querySelector('#boxes [name="score"]:checked').value;
    new ResizeObserver(draw).observe(svg);
    draw();
    return { state, set: change };
}

/** What there is to say about a score. */
function note(state, value, flat) {
    if (state.score === "iou" && value === 0 && flat) {
        return "The boxes do not touch: the IoU is 0, and so is its gradient. GIoU still shows the way.";
    }
    const steps = Math.max(state.history.length - 1, 0);
    const name = { iou: "IoU", giou: "GIoU", signed_distance: "Signed distance" }[state.score];
    const after = steps > 0 ? ` after ${steps} ${steps === 1 ? "step" : "steps"}` : "";
    return `${name} ${shown(value, 6)}${after}. Its gradient points the way in which it grows.`;
}

/** The corners of a box, counter-clockwise. */
function corners([x, y, width, height, heading]) {
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const at = ([u, v]) => [x + (u * width * cos - v * height * sin) / 2, y + (u * width * sin + v * height * cos) / 2];
    return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(at);
}

/** Makes the picture; returns the function that draws it. */
function drawing(svg, state, change) {
    grid(svg);
    const defs = add(svg, "defs");
    const clip = add(add(defs, "clipPath", { id: "boxes-a" }), "polygon");
    const layers = { a: add(svg, "g", { class: "of-a" }), b: add(svg, "g", { class: "of-b" }) };
    const common = add(svg, "polygon", { class: "common", "clip-path": "url(#boxes-a)" });
    const between = add(svg, "g");
    const line = add(between, "line", { class: "closest-line" });
    const dots = [0, 1].map(() => add(between, "circle", { class: "closest-dot" }));
    const parts = {};
    for (const box of ["b", "a"]) {
        const turn = (by) => change(box, state[box].map((x, i) => x + by[i]));
        const own = layers[box];
        const shape = add(own, "polygon", { class: "box" });
        const letter = add(own, "text", { class: "letter" });
        letter.textContent = box.toUpperCase();
        const stem = add(own, "line", { class: "stem" });
        const over = add(svg, "g", { class: `of-${box}` });
        const arrows = [0, 1, 2, 3].map(() => arrow(over));
        const move = (place, from) => turn([place[0] - from[0], place[1] - from[1], 0, 0, 0]);
        drag(svg, shape, move);
        // The place in the box's own axes.
        const local = (place) => {
            const [x, y, , , heading] = state[box];
            const [dx, dy] = [place[0] - x, place[1] - y];
            const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
            return [cos * dx + sin * dy, cos * dy - sin * dx];
        };
        const put = (i, number) => change(box, state[box].map((x, j) => (i === j ? number : x)));
        const name = `Box ${box.toUpperCase()}`;
        const at = handle(svg, over, `${name}, place`, move, (dx, dy) => turn([dx, dy, 0, 0, 0]));
        const wide = handle(svg, over, `${name}, width`, (place) => put(2, 2 * Math.abs(local(place)[0])),
            (dx, dy) => turn([0, 0, dx + dy, 0, 0]));
        const high = handle(svg, over, `${name}, height`, (place) => put(3, 2 * Math.abs(local(place)[1])),
            (dx, dy) => turn([0, 0, 0, dx + dy, 0]));
        const round = handle(svg, over, `${name}, heading`,
            (place) => put(4, Math.atan2(place[1] - state[box][1], place[0] - state[box][0])),
            (dx, dy) => turn([0, 0, 0, 0, dy - dx]));
        parts[box] = { shape, letter, stem, arrows, at, wide, high, round };
    }

    return (points, gradient, are_apart) => {
        const unit = pixel(svg);
        const largest = Math.max(...gradient.map(Math.abs));
        for (const [box, from] of [["a", 0], ["b", 5]]) {
            const scale = (i) => (largest > 0 ? gradient[from + i] / largest : 0);
            drawBox(parts[box], state[box], scale, unit);
        }
        const list = (box) => corners(state[box]).map(([x, y]) => `${x},${-y}`).join(" ");
        set(clip, { points: list("a") });
        set(common, { points: list("b") });
        // Boxes that overlap have no gap to show.
        set(between, { visibility: are_apart ? "visible" : "hidden" });
        const [x1, y1, x2, y2] = points;
        set(line, { x1, y1: -y1, x2, y2: -y2 });
        set(dots[0], { cx: x1, cy: -y1, r: 3.5 * unit });
        set(dots[1], { cx: x2, cy: -y2, r: 3.5 * unit });
    };
}

/** Draws a box with its handles and arrows; an arrow of the largest derivative is one unit long. */
function drawBox(parts, box, scale, unit) {
    const [x, y, width, height, heading] = box;
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    const out = (along, across) => [x + along * cos - across * sin, y + along * sin + across * cos];
    set(parts.shape, { points: corners(box).map(([u, v]) => `${u},${-v}`).join(" ") });
    const [lx, ly] = out(-width / 2 + 18 * unit, height / 2 - 18 * unit);
    set(parts.letter, { x: lx, y: -ly + 5 * unit, "font-size": 16 * unit });
    const reach = width / 2 + 40 * unit;
    const [sx, sy] = out(width / 2, 0);
    const [tx, ty] = out(reach, 0);
    set(parts.stem, { x1: sx, y1: -sy, x2: tx, y2: -ty });
    parts.at.draw([x, y], unit, x.toFixed(3), `x ${x.toFixed(2)}, y ${y.toFixed(2)}`);
    parts.wide.draw([sx, sy], unit, width.toFixed(3), width.toFixed(2));
    parts.high.draw(out(0, height / 2), unit, height.toFixed(3), height.toFixed(2));
    parts.round.draw([tx, ty], unit, heading.toFixed(3), `${heading.toFixed(2)} radians`);
    // No arrow is drawn that its head would cover.
    const seen = (share) => Math.abs(share) > 0.1;
    const [place, wide, high, round] = parts.arrows;
    const [gx, gy] = [scale(0), scale(1)];
    place.draw(seen(Math.hypot(gx, gy)) ? [[x, y], [x + gx, y + gy]] : [], unit);
    const side = (from, by, at) => (seen(by) ? [at(from), at(from - by)] : []);
    wide.draw(side(-width / 2, scale(2), (along) => out(along, 0)), unit);
    high.draw(side(-height / 2, scale(3), (across) => out(0, across)), unit);
    const sweep = scale(4) / reach;
    const arc = Array.from({ length: 17 }, (_, i) => heading + (sweep * i) / 16);
    round.draw(seen(scale(4)) ? arc.map((t) => [x + reach * Math.cos(t), y + reach * Math.sin(t)]) : [], unit);
}

/** Makes the table of numbers; returns the function that fills it. */
function numbers(state, change) {
    const body = document.getElementById("boxes-numbers");
    const rows = NAMES.map((name, i) => {
        const row = body.insertRow();
        const head = document.createElement("th");
        head.scope = "row";
        head.textContent = name;
        row.append(head);
        const cells = {};
        for (const box of ["a", "b"]) {
            const input = document.createElement("input");
            Object.assign(input, { type: "number", step: "0.05", id: `boxes-${box}-${name}` });
            input.setAttribute("aria-label", `Box ${box.toUpperCase()}, ${name}`);
            input.addEventListener("change", () => {
                const number = input.valueAsNumber;
                if (Number.isFinite(number)) {
                    change(box, state[box].map((x, j) => (i === j ? number : x)));
                }
            });
            row.insertCell().append(input);
            const derivative = document.createElement("output");
            derivative.dataset.of = `by_${box}_${name}`;
            row.insertCell().append(derivative);
            cells[box] = { input, derivative };
        }
        return cells;
    });
    return (gradient) => {
        rows.forEach((cells, i) => {
            for (const [box, from] of [["a", 0], ["b", 5]]) {
                if (document.activeElement !== cells[box].input || cells[box].input.valueAsNumber !== state[box][i]) {
                    cells[box].input.value = String(Number(state[box][i].toFixed(4)));
                }
                show(cells[box].derivative, gradient[from + i], 4);
            }
        });
    };
}

/** Draws the loss by step. */
function plot(history, title) {
    const svg = document.getElementById("boxes-plot");
    svg.replaceChildren();
    const { width, height } = svg.viewBox.baseVal;
    const top = Math.max(...history, 1e-12);
    const last = Math.max(history.length - 1, 1);
    const at = (loss, i) => [6 + ((width - 12) * i) / last, height - 4 - ((height - 14) * loss) / top];
    const places = history.map(at);
    const path = places.map((place) => place.join(" ")).join("L");
    if (history.length > 1) {
        const end = places[places.length - 1][0];
        add(svg, "path", { class: "curve-area", d: `M6 ${height}L${path}L${end} ${height}Z` });
        add(svg, "path", { class: "curve", d: `M${path}` });
    } else {
        const text = add(svg, "text", { class: "curve-empty", x: width / 2, y: height / 2 });
        text.textContent = "the loss, step by step";
    }
    const [cx, cy] = places[places.length - 1];
    add(svg, "circle", { class: "curve-end", cx, cy, r: 4 });
    const steps = history.length - 1;
    document.getElementById("boxes-loss").textContent =
        `Loss ${title}: ${shown(history[steps], 6)} at step ${steps}, from 0 to ${shown(top, 3)}`;
}

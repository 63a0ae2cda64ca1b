// Drawing areas: SVG with the y axis up, and handles that follow a pointer or keys.

const SVG = "http://www.w3.org/2000/svg";

/** Adds an element of SVG. */
export function add(parent, name, attributes = {}) {
    const element = document.createElementNS(SVG, name);
    set(element, attributes);
    parent.append(element);
    return element;
}

/** Sets attributes of an element. */
export function set(element, attributes) {
    for (const [name, value] of Object.entries(attributes)) {
        element.setAttribute(name, value);
    }
}

/** The place of an event in the coordinates of a drawing, y up. */
export function placeOf(svg, event) {
    const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [place.x, -place.y];
}

/** The length of a pixel of the screen in a drawing. */
export function pixel(svg) {
    return svg.viewBox.baseVal.width / Math.max(svg.clientWidth || svg.getBoundingClientRect().width, 1);
}

/** Calls `moved(place, from)` while an element is dragged; `from` is the place before. */
export function drag(svg, element, moved) {
    let from = null;
    // A touch of a part of a drawing would scroll the page, whatever `touch-action` says.
    element.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
    element.addEventListener("pointerdown", (event) => {
        if (event.button !== 0) {
            return;
        }
        event.preventDefault();
        element.setPointerCapture(event.pointerId);
        from = placeOf(svg, event);
    });
    element.addEventListener("pointermove", (event) => {
        if (from !== null && element.hasPointerCapture(event.pointerId)) {
            const place = placeOf(svg, event);
            moved(place, from);
            from = place;
        }
    });
    for (const name of ["pointerup", "pointercancel"]) {
        element.addEventListener(name, () => {
            from = null;
        });
    }
}

const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };

/** Calls `nudged(dx, dy)` for the arrow keys: a step of 0.05, with Shift one of 0.5, with Alt one of 0.005. */
export function keys(element, nudged) {
    element.addEventListener("keydown", (event) => {
        const way = KEYS[event.key];
        if (way) {
            event.preventDefault();
            const step = event.shiftKey ? 0.5 : event.altKey ? 0.005 : 0.05;
            nudged(way[0] * step, way[1] * step);
        }
    });
}

/** Adds a handle with a name for those who do not see it. */
export function handle(svg, parent, label, moved, nudged) {
    const element = add(parent, "g", { class: "handle", tabindex: 0, role: "slider", "aria-label": label });
    const reach = add(element, "circle", { class: "reach" });
    const dot = add(element, "circle", { class: "dot" });
    drag(svg, element, moved);
    keys(element, nudged);
    return {
        element,
        /** Draws it at a place, with its number and its text. */
        draw([x, y], unit, number, text) {
            set(reach, { cx: x, cy: -y, r: 20 * unit });
            set(dot, { cx: x, cy: -y, r: 7 * unit });
            set(element, { "aria-valuenow": number, "aria-valuetext": text });
        },
    };
}

/** Adds an arrow: a line, straight or bent, with a head. */
export function arrow(parent) {
    const line = add(parent, "path", { class: "arrow" });
    const head = add(parent, "path", { class: "head" });
    return {
        /** Draws it through places; with fewer than two it is not there. */
        draw(places, unit) {
            if (places.length < 2) {
                set(line, { d: "" });
                set(head, { d: "" });
                return;
            }
            const [x, y] = places[places.length - 1];
            const [u, v] = places[places.length - 2];
            const length = Math.hypot(x - u, y - v) || 1;
            const [dx, dy] = [(x - u) / length, (y - v) / length];
            const size = 9 * unit;
            const at = (along, across) => `${x + dx * along - dy * across} ${-(y + dy * along + dx * across)}`;
            const path = places.map(([px, py]) => `${px} ${-py}`).join("L");
            set(line, { d: `M${path}` });
            set(head, { d: `M${at(size, 0)}L${at(-size * 0.35, size * 0.62)}L${at(-size * 0.35, -size * 0.62)}Z` });
        },
    };
}

/** Adds lines of a grid, one for every unit. */
export function grid(svg) {
    const { x, y, width, height } = svg.viewBox.baseVal;
    const lines = add(svg, "g", { class: "grid", "aria-hidden": "true" });
    for (let i = Math.ceil(x); i <= x + width; i += 1) {
        add(lines, "line", { x1: i, x2: i, y1: y, y2: y + height });
    }
    for (let i = Math.ceil(y); i <= y + height; i += 1) {
        add(lines, "line", { x1: x, x2: x + width, y1: i, y2: i });
    }
}

/** A number with so many digits after the point, and a true minus sign. */
export function shown(x, digits = 4) {
    return Number.isFinite(x) ? x.toFixed(digits).replace(/^-(?=0\.?0*$)/, "").replace("-", "\u2212") : "\u2013";
}

/** Shows a number; the whole of it is in `data-value`. */
export function show(output, numbers, digits = 6) {
    const all = [numbers].flat();
    output.textContent = all.map((x) => shown(x, digits)).join(", ");
    output.dataset.value = all.join(" ");
}

/** Calls a function at every frame until it returns false; at once, without frames, where motion is unwanted. */
export function animate(step) {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
        while (step()) {
            // All is in the step.
        }
        return;
    }
    const frame = () => {
        if (step()) {
            requestAnimationFrame(frame);
        }
    };
    requestAnimationFrame(frame);
}

// Colours of a signed distance: the same formula for pixels of WebGPU and of JavaScript.

/** Reads a colour of the style sheet as red, green and blue from 0 to 1. */
function named(name) {
    const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    return [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
}

const mix = (a, b, t) => a.map((x, i) => x + (b[i] - x) * t);

/** The colours of a field: inside and outside, at the border and far from it, and of lines. */
export function palette() {
    const [paper, a, b, ink] = ["--raised", "--a", "--b", "--ink"].map(named);
    return { inside: [mix(paper, a, 0.35), mix(paper, a, 0.8)], outside: [mix(paper, b, 0.3), paper], line: ink };
}

/** Contour lines are this far apart. */
export const APART = 0.25;

/** The colour of a distance with its derivatives by a point, where a pixel is `unit` long. */
export function colour([distance, dx, dy], unit, { inside, outside, line }) {
    // So much the distance changes from a pixel to the next.
    const change = unit * Math.max(Math.sqrt(dx * dx + dy * dy), 0.05);
    const size = Math.abs(distance);
    const pair = distance < 0 ? inside : outside;
    const base = mix(pair[0], pair[1], 1 - Math.exp(-0.9 * size));
    const from = Math.abs(distance - APART * Math.floor(distance / APART + 0.5)) / change;
    const thin = 0.22 * Math.min(Math.max(1.2 - from, 0), 1);
    const border = Math.min(Math.max(2.2 - size / change, 0), 1);
    return mix(mix(base, line, thin), line, border);
}

/** The same formula in WGSL. `view` has the colours and the length of a pixel. */
export const COLOUR = `
fn colour(distance: f32, slope: vec2f) -> vec3f {
    let change = view.unit * max(length(slope), 0.05);
    let size = abs(distance);
    let near = select(view.outside_near, view.inside_near, distance < 0.0).xyz;
    let far = select(view.outside_far, view.inside_far, distance < 0.0).xyz;
    let base = mix(near, far, 1.0 - exp(-0.9 * size));
    let from_line = abs(distance - ${APART} * floor(distance / ${APART} + 0.5)) / change;
    let thin = 0.22 * clamp(1.2 - from_line, 0.0, 1.0);
    let border = clamp(2.2 - size / change, 0.0, 1.0);
    return mix(mix(base, view.line.xyz, thin), view.line.xyz, border);
}
`;

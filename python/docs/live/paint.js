// Pixels of a field by JavaScript: large blocks at once, the rest piece by piece.
import { colour } from "./colours.js";

/** Blocks of the first picture, in pixels; a piece of the second one takes at most so many milliseconds. */
const BLOCK = 6;
const PIECE = 12;

/** Returns what draws fields on a canvas. */
export function painter(canvas) {
    const context = canvas.getContext("2d");
    let turn = 0;

    /** Draws a field from the corner that is up and left; a pixel is `unit` long. A later call ends an earlier one. */
    function draw(field, palette, corner, unit, number) {
        turn += 1;
        const own = turn;
        const { width, height } = canvas;
        const image = context.createImageData(width, height);
        const pixels = new Uint32Array(image.data.buffer);
        const input = [0, 0, number];
        // The bytes of a pixel are red, green, blue and alpha, the lowest first.
        const at = (x, y, size) => {
            input[0] = corner[0] + (x + size / 2) * unit;
            input[1] = corner[1] - (y + size / 2) * unit;
            const [r, g, b] = colour(field.of(input), unit, palette);
            return (0xff000000 | (Math.round(b * 255) << 16) | (Math.round(g * 255) << 8) | Math.round(r * 255)) >>> 0;
        };
        for (let y = 0; y < height; y += BLOCK) {
            for (let x = 0; x < width; x += BLOCK) {
                const value = at(x, y, BLOCK);
                for (let row = y; row < Math.min(y + BLOCK, height); row += 1) {
                    pixels.fill(value, row * width + x, row * width + Math.min(x + BLOCK, width));
                }
            }
        }
        context.putImageData(image, 0, 0);
        return new Promise((done) => {
            let y = 0;
            const piece = () => {
                if (own !== turn) {
                    done(false);
                    return;
                }
                const end = performance.now() + PIECE;
                const from = y;
                while (y < height && performance.now() < end) {
                    for (let x = 0; x < width; x += 1) {
                        pixels[y * width + x] = at(x, y, 1);
                    }
                    y += 1;
                }
                context.putImageData(image, 0, 0, 0, from, width, y - from);
                if (y < height) {
                    requestAnimationFrame(piece);
                } else {
                    done(true);
                }
            };
            requestAnimationFrame(piece);
        });
    }

    /** Ends the picture that is being drawn. */
    function stop() {
        turn += 1;
    }

    return { draw, stop };
}

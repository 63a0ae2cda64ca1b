// Runs modules that geograd wrote and compares their results with the library's, bit for bit.
// The argument is a folder with cases.json: a list of { name, inputs, outputs, count }. For each there is NAME.mjs,
// which exports `of`, and NAME.bin: the numbers of every input, and then those of every expected result.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const folder = process.argv[2];
const cases = JSON.parse(readFileSync(join(folder, "cases.json"), "utf8"));
let wrong = 0;
let results = 0;
for (const { name, inputs, outputs, count } of cases) {
    const { of } = await import(pathToFileURL(join(folder, `${name}.mjs`)));
    const file = readFileSync(join(folder, `${name}.bin`));
    const numbers = new Float64Array(file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
    for (let i = 0; i < count; i += 1) {
        const x = numbers.subarray(i * inputs, (i + 1) * inputs);
        const from = count * inputs + i * outputs;
        const expected = numbers.subarray(from, from + outputs);
        const found = of(x);
        results += outputs;
        for (let j = 0; j < Math.max(outputs, found.length); j += 1) {
            if (!Object.is(found[j], expected[j])) {
                wrong += 1;
                if (wrong <= 20) {
                    console.error(`${name}(${[...x].join(", ")})[${j}] is ${found[j]} in place of ${expected[j]}`);
                }
            }
        }
    }
}
console.log(`${cases.length} functions, ${results} numbers, ${wrong} wrong`);
process.exitCode = wrong === 0 ? 0 : 1;

// Pixels and values of a field by WebGPU, with the WGSL that geograd wrote. Pixels come back as numbers: a software
// adapter has no surface that a canvas could show.
import { COLOUR } from "./colours.js";
import { WGSL } from "./generated/fields.js";

const SHADER = `
struct View {
    inside_near: vec4f, inside_far: vec4f, outside_near: vec4f, outside_far: vec4f, line: vec4f,
    corner: vec2f, unit: f32, number: f32, width: u32, height: u32,
}
@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var<storage, read_write> results: array<u32>;
@group(0) @binding(2) var<storage, read> points: array<vec2f>;

fn at(point: vec2f) -> array<f32, 4> {
    return field(array<f32, 3>(point.x, point.y, view.number));
}

@compute @workgroup_size(8, 8)
fn pixels(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < view.width && id.y < view.height) {
        let place = vec2f(id.xy) + 0.5;
        let found = at(view.corner + view.unit * vec2f(place.x, -place.y));
        let rgb = colour(found[0], vec2f(found[1], found[2]));
        results[id.y * view.width + id.x] = pack4x8unorm(vec4f(rgb, 1.0));
    }
}

@compute @workgroup_size(64)
fn values(@builtin(global_invocation_id) id: vec3u) {
    if (id.x < arrayLength(&points)) {
        results[id.x] = bitcast<u32>(at(points[id.x])[0]);
    }
}
`;

/** Returns what computes fields on the graphics processor, or null where there is no WebGPU. */
export async function gpu() {
    const adapter = await navigator.gpu?.requestAdapter().catch(() => null);
    const device = await adapter?.requestDevice().catch(() => null);
    if (!device) {
        return null;
    }
    const view = device.createBuffer({ size: 112, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
    const made = new Map();

    /** Returns the two pipelines of a field, which are made once. */
    function pipelines(field) {
        if (!made.has(field.name)) {
            const module = device.createShaderModule({ code: WGSL + field.wgsl + COLOUR + SHADER });
            const pipeline = (entryPoint) =>
                device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint } });
            made.set(field.name, Promise.all(["pixels", "values"].map(pipeline)));
        }
        return made.get(field.name);
    }

    /** Runs a pipeline in so many groups, and returns its results, `count` words. */
    async function run(pipeline, groups, count, ...more) {
        const size = 4 * count;
        const results = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
        const read = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
        const entries = [view, results, ...more].map((buffer, binding) => ({ binding, resource: { buffer } }));
        const commands = device.createCommandEncoder();
        const pass = commands.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
        pass.dispatchWorkgroups(...groups);
        pass.end();
        commands.copyBufferToBuffer(results, 0, read, 0, size);
        device.queue.submit([commands.finish()]);
        await read.mapAsync(GPUMapMode.READ);
        const found = read.getMappedRange().slice(0);
        results.destroy();
        read.destroy();
        return found;
    }

    /** Returns the pixels of a field from the corner that is up and left: four bytes each. A pixel is `unit` long. */
    async function pixels(field, palette, corner, unit, number, width, height) {
        const [pipeline] = await pipelines(field);
        const colours = [...palette.inside, ...palette.outside, palette.line].flatMap((rgb) => [...rgb, 1]);
        device.queue.writeBuffer(view, 0, new Float32Array([...colours, ...corner, unit, number]));
        device.queue.writeBuffer(view, 96, new Uint32Array([width, height]));
        return run(pipeline, [Math.ceil(width / 8), Math.ceil(height / 8)], width * height);
    }

    /** Returns the values at points, a flat list of x and y. */
    async function values(field, places, number) {
        const [, pipeline] = await pipelines(field);
        device.queue.writeBuffer(view, 92, new Float32Array([number]));
        const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
        const points = device.createBuffer({ size: places.length * 4, usage });
        device.queue.writeBuffer(points, 0, new Float32Array(places));
        const count = places.length / 2;
        const found = await run(pipeline, [Math.ceil(count / 64)], count, points);
        points.destroy();
        return [...new Float32Array(found)];
    }

    return { pixels, values, lost: device.lost };
}

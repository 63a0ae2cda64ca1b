// Replays of what was decided on the processor: one thread per item, which carries out the instructions of
// its program. Neighbouring items have the same one, as far as there are enough of them.

@group(0) @binding(0) var<uniform> params: array<vec4u, 1>;
// Of every item which program it needs.
@group(0) @binding(1) var<storage, read> codes: array<u32>;
// Of every program its first instruction and the end.
@group(0) @binding(2) var<storage, read> programs: array<vec2u>;
// What is done and the slot of the result; two operands; two more; the slot of a second result.
@group(0) @binding(3) var<storage, read> instructions: array<vec4u>;
@group(0) @binding(4) var<storage, read> inputs: array<f32>;
@group(0) @binding(5) var<storage, read_write> slots: array<f32>;
@group(0) @binding(6) var<storage, read_write> outputs: array<f32>;

// A truth in a slot.
fn word(truth: bool) -> f32 {
    return select(0.0, 1.0, truth);
}

@compute @workgroup_size(64)
fn replay_main(@builtin(global_invocation_id) thread: vec3u) {
    let item = thread.x;
    let items = params[0].x;
    if item >= items {
        return;
    }
    let program = programs[codes[item]];
    for (var at = program.x; at < program.y; at++) {
        let code = instructions[at];
        let to = (code.x >> 16u) * items + item;
        let op = code.x & 0xffffu;
        if op == Take {
            slots[to] = inputs[code.y * items + item];
            continue;
        }
        if op == Give {
            outputs[code.z * items + item] = slots[code.y * items + item];
            continue;
        }
        if op == Constant {
            slots[to] = bitcast<f32>(code.y);
            continue;
        }
        let x = slots[(code.y & 0xffffu) * items + item];
        if op == Parts || op == SinCos {
            let second = (code.y >> 16u) * items + item;
            let sine = program_sin(x);
            let cosine = program_cos(x);
            if op == SinCos {
                slots[to] = sine;
                slots[second] = cosine;
                continue;
            }
            slots[to] = program_high(sine);
            slots[second] = sine - program_high(sine);
            slots[(code.z & 0xffffu) * items + item] = program_high(cosine);
            slots[(code.z >> 16u) * items + item] = cosine - program_high(cosine);
            continue;
        }
        let y = slots[(code.y >> 16u) * items + item];
        let z = slots[(code.z & 0xffffu) * items + item];
        let w = slots[(code.z >> 16u) * items + item];
        var found = 0.0;
        if op == Turn || op == SumSub {
            let second = code.w * items + item;
            slots[to] = select(x + y, x * z + y * w, op == Turn);
            slots[second] = select(x - y, y * z - x * w, op == Turn);
            continue;
        }
        switch op {
            case Copy: { found = x; }
            case Canonical: { found = x + 0.0; }
            case Neg: { found = -x; }
            case Magnitude: { found = abs(x); }
            case Root: { found = program_root(x); }
            case Binade: { found = program_binade(x); }
            case High: { found = program_high(x); }
            case Exp: { found = program_exp(x); }
            case Ln: { found = program_ln(x); }
            case Not: { found = 1.0 - x; }
            case Always: { found = 1.0; }
            case Never: { found = 0.0; }
            case Add: { found = x + y; }
            case Sub: { found = x - y; }
            case Mul: { found = x * y; }
            case Div: { found = x / y; }
            case Min: { found = min(x, y); }
            case Max: { found = max(x, y); }
            case Atan2: { found = program_atan2(x, y); }
            case Lt: { found = word(x < y); }
            case Le: { found = word(x <= y); }
            case Eq: { found = word(x == y); }
            case And: { found = x * y; }
            case Or: { found = max(x, y); }
            case Select: { found = select(z, y, x != 0.0); }
            case Split: { found = program_split(x, y, z); }
            case Rest: { found = program_rest(x, y, z); }
            case AddAdd: { found = (x + y) + z; }
            case SubAdd: { found = (x - y) + z; }
            case MulAdd: { found = x * y + z; }
            case AddSub: { found = (x + y) - z; }
            case SubSub: { found = (x - y) - z; }
            case MulSub: { found = x * y - z; }
            case FromAdd: { found = z - (x + y); }
            case FromSub: { found = z - (x - y); }
            case FromMul: { found = z - x * y; }
            case AddMul: { found = (x + y) * z; }
            case SubMul: { found = (x - y) * z; }
            case MulMul: { found = (x * y) * z; }
            case MaxMin: { found = min(max(x, y), z); }
            case MinMax: { found = max(min(x, y), z); }
            case MinFrom: { found = min(z, max(x, y)); }
            case MaxFrom: { found = max(z, min(x, y)); }
            case MaxFromMul: { found = max(w, min(z, x * y)); }
            case MaxFromNeg: { found = max(z, min(y, -x)); }
            case MaxMulAdd: { found = max(w, x * y + z); }
            case SubByAdd: { found = (x - y) * (z + w); }
            case SubAndSub: { found = (x - y) + (z - w); }
            case SelectNegLt: { found = select(w, -z, x < y); }
            case Dot: { found = x * y + z * w; }
            case Cross: { found = x * y - z * w; }
            case SelectNeg: { found = select(z, -y, x != 0.0); }
            case SelectLt: { found = select(w, z, x < y); }
            case SelectLe: { found = select(w, z, x <= y); }
            case SelectEq: { found = select(w, z, x == y); }
            case LtAnd: { found = word(x < y) * z; }
            case LeAnd: { found = word(x <= y) * z; }
            case EqAnd: { found = word(x == y) * z; }
            case LtOr: { found = max(word(x < y), z); }
            case LeOr: { found = max(word(x <= y), z); }
            case EqOr: { found = max(word(x == y), z); }
            case SelectMul: { found = select(w, y * z, x != 0.0); }
            case ElseMul: { found = select(z * w, y, x != 0.0); }
            case SelectAdd: { found = select(z, y, x != 0.0) + w; }
            case MagnitudeMax: { found = max(abs(x), y); }
            case MaxMagnitude: { found = max(x, abs(y)); }
            case AndNot: { found = x * (1.0 - y); }
            default: {}
        }
        slots[to] = found;
    }
}

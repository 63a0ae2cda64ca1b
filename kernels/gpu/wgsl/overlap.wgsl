// How much two boxes overlap: scores and their slopes.

fn ratio_of_union(inter: f32, area_a: f32, area_b: f32) -> f32 {
    let total = area_a + area_b - inter;
    let empty = total <= EMPTY;
    return choose(empty, 0.0, inter / choose(empty, 1.0, total));
}

fn ratio_of_first(inter: f32, area_a: f32) -> f32 {
    let empty = area_a <= EMPTY;
    return choose(empty, 0.0, inter / choose(empty, 1.0, area_a));
}

fn area_from_half(half: vec2f) -> f32 {
    return (2.0 * half.x) * (2.0 * half.y);
}

fn measure(inter: f32, area_a: f32, area_b: f32) -> f32 {
    if DENOMINATOR == UNION {
        return ratio_of_union(inter, area_a, area_b);
    }
    if DENOMINATOR == FIRST {
        return ratio_of_first(inter, area_a);
    }
    return inter;
}

fn in_outer_unit(value: f32, scale: f32) -> f32 {
    if IS_RATIO {
        return value;
    }
    return saturated((value / scale) / scale);
}

fn score_framed(a: Framed, b: Framed) -> f32 {
    var scale = 1.0;
    if EXTREME {
        scale = size_scale(a.half, b.half);
    }
    let pair = relate(a, b, scale);
    if pair.apart {
        return 0.0;
    }
    let inter = related_area(pair, clipped_area(clip(pair)));
    let area_a = area_from_half(pair.half_a);
    let area_b = area_from_half(pair.half_b);
    let value = measure(inter, area_a, area_b);
    if EXTREME {
        return in_outer_unit(value, scale);
    }
    return value;
}

struct Part {
    half: vec2f,
    half_a: vec2f,
    half_b: vec2f,
    apart: bool,
    scale: f32,
}

fn half_of(box: Aabb2) -> vec2f {
    return box.max * 0.5 - box.min * 0.5;
}

fn meet(a: Aabb2, b: Aabb2) -> Aabb2 {
    return Aabb2(
        vec2f(most(a.min.x, b.min.x), most(a.min.y, b.min.y)),
        vec2f(least(a.max.x, b.max.x), least(a.max.y, b.max.y)),
    );
}

fn share(a: Aabb2, b: Aabb2) -> Part {
    let half_a = half_of(a);
    let half_b = half_of(b);
    let half = half_of(meet(a, b));
    let scale = size_scale(half_a, half_b);
    let apart = a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y;
    return Part(half * scale, half_a * scale, half_b * scale, apart, scale);
}

fn area_of_shared(part: Part) -> f32 {
    return choose(part.apart, 0.0, area_from_half(part.half));
}

fn score_aabb2(a: Aabb2, b: Aabb2) -> f32 {
    let part = share(a, b);
    let area_a = area_from_half(part.half_a);
    let area_b = area_from_half(part.half_b);
    let value = measure(area_of_shared(part), area_a, area_b);
    return in_outer_unit(value, part.scale);
}

fn reciprocal_or_zero(x: f32) -> f32 {
    let empty = x <= EMPTY;
    return choose(empty, 0.0, 1.0 / choose(empty, 1.0, x));
}

// Slopes with respect to the shared area and to those of a and b.
fn measure_slopes(value: f32, inter: f32, area_a: f32, area_b: f32) -> vec3f {
    if DENOMINATOR == UNION {
        let per_area = reciprocal_or_zero(area_a + area_b - inter);
        let area_bar = -(value * per_area);
        return vec3f(per_area - area_bar, area_bar, area_bar);
    }
    if DENOMINATOR == FIRST {
        let per_area = reciprocal_or_zero(area_a);
        return vec3f(per_area, -(value * per_area), 0.0);
    }
    return vec3f(1.0, 0.0, 0.0);
}

struct Obb2 {
    center: vec2f,
    size: vec2f,
    heading: f32,
}

struct Obb2Grad {
    value: f32,
    a_bar: Obb2,
    b_bar: Obb2,
}

fn score_framed_grad(a: Framed, b: Framed) -> Obb2Grad {
    var scale = 1.0;
    if EXTREME {
        scale = size_scale(a.half, b.half);
    }
    let pair = relate(a, b, scale);
    if pair.apart {
        return Obb2Grad();
    }
    let clip = clip(pair);
    let area = clipped_area(clip);
    let inter = related_area(pair, area);
    let nothing = nothing_shared(pair, area);
    let slopes = clipped_area_slopes(pair, clip);

    var heading_unit = 1.0;
    var length_unit = scale;
    if EXTREME && !IS_RATIO {
        length_unit = 1.0 / scale;
        heading_unit = length_unit;
    }
    let half_b = b.half * scale;
    let area_a = area_from_half(pair.half_a);
    let area_b = area_from_half(half_b);
    var value = measure(inter, area_a, area_b);
    let bars = measure_slopes(value, inter, area_a, area_b);
    if EXTREME {
        value = in_outer_unit(value, scale);
    }
    let inter_bar = choose(nothing, 0.0, bars.x);
    let area_a_bar = bars.y;
    let area_b_bar = bars.z;
    let u_bar = slopes.u * inter_bar;
    let v_bar = slopes.v * inter_bar;
    let heading_bar = slopes.heading * inter_bar;
    let turn_bar = heading_bar + (pair.u * v_bar - pair.v * u_bar);
    let center_bar = vec2f(a.cos * u_bar - a.sin * v_bar, a.sin * u_bar + a.cos * v_bar)
        * length_unit;
    let a_bar = Obb2(
        -center_bar,
        size_slopes(pair.half_a, slopes.half_a * inter_bar, area_a_bar) * length_unit,
        -(turn_bar * heading_unit * heading_unit),
    );
    let b_bar = Obb2(
        center_bar,
        size_slopes(half_b, slopes.half_b * inter_bar, area_b_bar) * length_unit,
        heading_bar * heading_unit * heading_unit,
    );
    if EXTREME {
        return Obb2Grad(value, saturated_obb2(a_bar), saturated_obb2(b_bar));
    }
    return Obb2Grad(value, a_bar, b_bar);
}

fn size_slopes(half: vec2f, inter_slope: vec2f, area_bar: f32) -> vec2f {
    let twice = area_bar + area_bar;
    return vec2f(halved(inter_slope.x) + twice * half.y, halved(inter_slope.y) + twice * half.x);
}

fn saturated_vec2(x: vec2f) -> vec2f {
    return vec2f(saturated(x.x), saturated(x.y));
}

fn saturated_obb2(x: Obb2) -> Obb2 {
    return Obb2(saturated_vec2(x.center), saturated_vec2(x.size), saturated(x.heading));
}

struct Aabb2 {
    min: vec2f,
    max: vec2f,
}

struct Aabb2Grad {
    value: f32,
    a_bar: Aabb2,
    b_bar: Aabb2,
}

fn part_of(mine: f32, other: f32) -> f32 {
    return choose(mine == other, 0.5, choose(mine < other, 1.0, 0.0));
}

fn score_aabb2_grad(a: Aabb2, b: Aabb2) -> Aabb2Grad {
    let part = share(a, b);
    let half = part.half;
    let inter = area_of_shared(part);
    let area_a = area_from_half(part.half_a);
    let area_b = area_from_half(part.half_b);
    let score = measure(inter, area_a, area_b);
    let bars = measure_slopes(score, inter, area_a, area_b);
    let value = in_outer_unit(score, part.scale);
    var unit = 1.0 / part.scale;
    if IS_RATIO {
        unit = part.scale;
    }
    let inter_bar = choose(part.apart, 0.0, bars.x);
    let two = 2.0 * unit;
    let bound_bar = vec2f(half.y * inter_bar, half.x * inter_bar) * two;
    let own_a = part.half_a.yx * (bars.y * two);
    let own_b = part.half_b.yx * (bars.z * two);
    let max = vec2f(part_of(a.max.x, b.max.x), part_of(a.max.y, b.max.y));
    let min = vec2f(part_of(b.min.x, a.min.x), part_of(b.min.y, a.min.y));
    return Aabb2Grad(
        value,
        Aabb2(
            saturated_vec2(-(bound_bar * min + own_a)),
            saturated_vec2(bound_bar * max + own_a),
        ),
        Aabb2(
            saturated_vec2(-(bound_bar * (1.0 - min) + own_b)),
            saturated_vec2(bound_bar * (1.0 - max) + own_b),
        ),
    );
}

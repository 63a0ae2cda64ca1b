// The border of one box clipped to another, and the slopes of the area inside it.

struct Framed {
    center: vec2f,
    half: vec2f,
    cos: f32,
    sin: f32,
    cos_high: f32,
    cos_low: f32,
    sin_high: f32,
    sin_low: f32,
}

fn size_scale(half_a: vec2f, half_b: vec2f) -> f32 {
    let size_a = most(half_a.x, half_a.y);
    let size_b = most(half_b.x, half_b.y);
    let smaller = least(size_a, size_b);
    let larger = most(size_a, size_b);
    let bounded = most(smaller, larger * LARGEST_INVERSE);
    let size = choose(smaller <= 0.0, larger, bounded);
    let zero = size <= 0.0;
    return choose(zero, 1.0, binade(choose(zero, 1.0, size)));
}

struct Relative {
    u: f32,
    v: f32,
    cos: f32,
    sin: f32,
    half_a: vec2f,
    half_b: vec2f,
    swapped: bool,
    parallel: bool,
    apart: bool,
}

// `b − a` in units of `1 / scale`, no farther than it matters, and what rounding took away.
fn difference(a: f32, b: f32, scale: f32) -> vec2f {
    let rounded = kept(b - a);
    let taken = kept(rounded - b);
    let lost = kept(b - kept(rounded - taken)) - kept(a + taken);
    let x = rounded * scale;
    let near = abs(x) <= FAR;
    // Near the largest number what rounding took may be beyond it.
    let told = near && abs(rounded) <= 0.5 * LARGEST;
    return vec2f(choose(near, x, choose(x < 0.0, -FAR, FAR)), choose(told, lost * scale, 0.0));
}

fn relate(a: Framed, b: Framed, scale: f32) -> Relative {
    let x = difference(a.center.x, b.center.x, scale);
    let y = difference(a.center.y, b.center.y, scale);
    let dx = x[0];
    let dy = y[0];
    let dx_high = high_half(dx);
    let dx_low = (dx - dx_high) + x[1];
    let dy_high = high_half(dy);
    let dy_low = (dy - dy_high) + y[1];
    // Products of two high parts are exact, and so are their sums where they cancel.
    let u = kept(a.cos_high * dx_high + a.sin_high * dy_high)
        + ((a.cos_high * dx_low + a.sin_high * dy_low) + (a.cos_low * dx + a.sin_low * dy));
    let v = kept(a.cos_high * dy_high - a.sin_high * dx_high)
        + ((a.cos_high * dy_low - a.sin_high * dx_low) + (a.cos_low * dy - a.sin_low * dx));
    var cos = kept(a.cos_high * b.cos_high + a.sin_high * b.sin_high)
        + ((a.cos_low * b.cos_high + a.sin_low * b.sin_high)
            + (a.cos * b.cos_low + a.sin * b.sin_low));
    var sin = kept(a.cos_high * b.sin_high - a.sin_high * b.cos_high)
        + ((a.cos_low * b.sin_high - a.sin_low * b.cos_high)
            + (a.cos * b.sin_low - a.sin * b.cos_low));

    let swapped = abs(cos) < abs(sin);
    let turned_cos = choose(swapped, sin, cos);
    let turned_sin = choose(swapped, -cos, sin);
    let turned = turned_cos < 0.0;
    cos = choose(turned, -turned_cos, turned_cos);
    sin = choose(turned, -turned_sin, turned_sin);
    let half_a = a.half * scale;
    let scaled_b = b.half * scale;
    let half_b = select(scaled_b, scaled_b.yx, swapped);
    let parallel = abs(sin) < PARALLEL;
    cos = choose(parallel, 1.0, cos);
    sin = choose(parallel, 0.0, sin);

    let steep = abs(sin);
    let apart_in_a = abs(u) >= half_a.x + (half_b.x * cos + half_b.y * steep)
        || abs(v) >= half_a.y + (half_b.y * cos + half_b.x * steep);
    let apart_in_b = abs(u * cos + v * sin) >= half_b.x + (half_a.x * cos + half_a.y * steep)
        || abs(v * cos - u * sin) >= half_b.y + (half_a.y * cos + half_a.x * steep);
    let apart = apart_in_a || apart_in_b;
    return Relative(u, v, cos, sin, half_a, half_b, swapped, parallel, apart);
}

struct End {
    x: f32,
    beyond: f32,
}

fn end_at(x: f32, low: f32, high: f32) -> End {
    let held = clamped(x, low, high);
    return End(held, x - held);
}

struct Clip {
    u: f32,
    v: f32,
    arms: vec4f,
    low: vec2f,
    high: vec2f,
    y: vec4f,
    above: vec4f,
    bottom_from: End,
    bottom_to: End,
    right_from: End,
    right_to: End,
    top_from: End,
    top_to: End,
    left_from: End,
    left_to: End,
    slope: f32,
    steepness: f32,
}

fn nearest_inside(x: f32, half: f32) -> f32 {
    return clamped(x, -half, half);
}

fn clip(pair: Relative) -> Clip {
    let cos = pair.cos;
    let sin = pair.sin;
    let half_b = pair.half_b;
    let origin = vec2f(nearest_inside(pair.u, pair.half_a.x), nearest_inside(pair.v, pair.half_a.y));
    let u = pair.u - origin.x;
    let v = pair.v - origin.y;
    let low = -pair.half_a - origin;
    let high = pair.half_a - origin;

    let slope = sin / cos;
    let steepness = choose(pair.parallel, 0.0, cos / choose(pair.parallel, 1.0, sin));

    let pc = half_b.x * cos;
    let ps = half_b.x * sin;
    let qc = half_b.y * cos;
    let qs = half_b.y * sin;
    let mx = pc - qs;
    let my = ps + qc;
    let nx = pc + qs;
    let ny = ps - qc;
    let corner_x = vec4f(u - mx, u + nx, u + mx, u - nx);
    let corner_y = vec4f(v - my, v + ny, v + my, v - ny);
    let y = vec4f(
        clamped(corner_y.x, low.y, high.y),
        clamped(corner_y.y, low.y, high.y),
        clamped(corner_y.z, low.y, high.y),
        clamped(corner_y.w, low.y, high.y),
    );
    let above = corner_y - y;
    return Clip(
        u,
        v,
        vec4f(pc, ps, qc, qs),
        low,
        high,
        y,
        above,
        end_at(corner_x.x - above.x * steepness, low.x, high.x),
        end_at(corner_x.y - above.y * steepness, low.x, high.x),
        end_at(corner_x.y + above.y * slope, low.x, high.x),
        end_at(corner_x.z + above.z * slope, low.x, high.x),
        end_at(corner_x.z - above.z * steepness, low.x, high.x),
        end_at(corner_x.w - above.w * steepness, low.x, high.x),
        end_at(corner_x.w + above.w * slope, low.x, high.x),
        end_at(corner_x.x + above.x * slope, low.x, high.x),
        slope,
        steepness,
    );
}

fn bend(start: End, end: End) -> f32 {
    return (end.x - start.x) * (start.beyond + end.beyond);
}

fn clipped_area(clip: Clip) -> f32 {
    let y = clip.y;
    let straight = ((y.y - y.x) * (clip.bottom_from.x + clip.bottom_to.x)
        + (y.w - y.z) * (clip.top_from.x + clip.top_to.x))
        + ((y.z - y.y) * (clip.right_from.x + clip.right_to.x)
            + (y.x - y.w) * (clip.left_from.x + clip.left_to.x));
    // Slopes shared at a tie differ from plain ones in their derivatives only.
    let flat = bend(clip.bottom_from, clip.bottom_to) * clip.slope
        + bend(clip.top_from, clip.top_to) * clip.slope;
    let upright = (bend(clip.right_from, clip.right_to) + bend(clip.left_from, clip.left_to))
        * clip.steepness;
    return halved(straight + (flat - upright));
}

fn related_area(pair: Relative, area: f32) -> f32 {
    let area_a = (2.0 * pair.half_a.x) * (2.0 * pair.half_a.y);
    let area_b = (2.0 * pair.half_b.x) * (2.0 * pair.half_b.y);
    let limit = least(area_a, area_b);
    return choose(nothing_shared(pair, area), 0.0, choose(area > limit, limit, area));
}

fn nothing_shared(pair: Relative, area: f32) -> bool {
    return pair.apart || area < 0.0;
}

struct Slopes {
    u: f32,
    v: f32,
    heading: f32,
    half_a: vec2f,
    half_b: vec2f,
}

struct Crossings {
    enter: f32,
    leave: f32,
}

fn crossings(low: f32, high: f32, lower: End, upper: End, steepness: f32) -> Crossings {
    let out = lower.beyond * upper.beyond > 0.0;
    let enter = crossing(low, low, high, lower.beyond * steepness, out);
    let leave = crossing(high, low, high, upper.beyond * steepness, out);
    return Crossings(
        choose(lower.beyond == 0.0, low, enter),
        choose(upper.beyond == 0.0, high, leave),
    );
}

fn crossing(start: f32, low: f32, high: f32, rise: f32, out: bool) -> f32 {
    let at = start + rise;
    let held = choose(at < low, low, at);
    return choose(out || held > high, high, held);
}

fn beside(out: bool, first: End, last: End, rise: f32, slope: f32) -> f32 {
    let covered = choose(
        first.beyond * last.beyond > 0.0,
        signed_as(rise, last.beyond),
        (abs(last.beyond) - abs(first.beyond)) * slope,
    );
    return choose(out, 0.0, covered);
}

fn between(out: bool, start_above: f32, start: End, end_above: f32, end: End) -> f32 {
    return choose(out, 0.0, signed_as(end.x, end_above) - signed_as(start.x, start_above));
}

fn half_along(parallel: bool, at: f32, beyond: f32, low: f32, high: f32, whole: f32) -> f32 {
    let along = beyond == 0.0 && (at == low || at == high);
    return choose(parallel && along, halved(whole), 0.0);
}

fn clipped_area_slopes(pair: Relative, clip: Clip) -> Slopes {
    let ps = clip.arms.y;
    let qs = clip.arms.w;
    let y = clip.y;
    let above = clip.above;
    let steepness = clip.steepness;
    let slope = clip.slope;
    let per_cos = 1.0 / pair.cos;

    let bottom_out = above.x * above.y > 0.0;
    let top_out = above.z * above.w > 0.0;
    var width_bottom = choose(bottom_out, 0.0, clip.bottom_to.x - clip.bottom_from.x);
    var width_top = choose(top_out, 0.0, clip.top_from.x - clip.top_to.x);

    let right = crossings(y.y, y.z, clip.right_from, clip.right_to, steepness);
    let left = crossings(y.x, y.w, clip.left_to, clip.left_from, steepness);
    var height_right = right.leave - right.enter;
    var height_left = left.leave - left.enter;

    // a's right and left side inside b.
    let flat = beside(bottom_out, clip.bottom_from, clip.bottom_to, y.y - y.x, slope)
        + beside(top_out, clip.top_from, clip.top_to, y.w - y.z, slope);
    let upright = (signed_as(right.enter - y.y, clip.right_from.beyond)
        + signed_as(y.z - right.leave, clip.right_to.beyond))
        - (signed_as(left.enter - y.x, clip.left_to.beyond)
            + signed_as(y.w - left.leave, clip.left_from.beyond));
    var side_x = flat + upright;

    // a's top and bottom side inside b.
    let right_out = above.y * above.z > 0.0;
    let left_out = above.w * above.x > 0.0;
    var side_y = (between(bottom_out, above.x, clip.bottom_from, above.y, clip.bottom_to)
        + between(top_out, above.z, clip.top_from, above.w, clip.top_to))
        + (between(right_out, above.y, clip.right_from, above.z, clip.right_to)
            + between(left_out, above.w, clip.left_from, above.x, clip.left_to));

    if pair.parallel {
        let low = clip.low;
        let high = clip.high;
        let half_bottom = half_along(pair.parallel, y.x, above.x, low.y, high.y, width_bottom);
        let half_top = half_along(pair.parallel, y.z, above.z, low.y, high.y, width_top);
        let half_right = half_along(
            pair.parallel, clip.right_from.x, clip.right_from.beyond, low.x, high.x, height_right,
        );
        let half_left = half_along(
            pair.parallel, clip.left_from.x, clip.left_from.beyond, low.x, high.x, height_left,
        );
        width_bottom -= half_bottom;
        width_top -= half_top;
        height_right -= half_right;
        height_left -= half_left;
        side_y += half_bottom + half_top;
        side_x += half_right + half_left;
    }

    // Middles of the parts inside, along each edge from its own middle.
    let middle_bottom = halved(clip.bottom_from.x + clip.bottom_to.x) - (clip.u + qs);
    let middle_top = halved(clip.top_from.x + clip.top_to.x) - (clip.u - qs);
    let middle_right = halved(right.enter + right.leave) - (clip.v + ps);
    let middle_left = halved(left.enter + left.leave) - (clip.v - ps);
    let moment = (width_top * middle_top - width_bottom * middle_bottom)
        + (height_left * middle_left - height_right * middle_right);

    let wide = width_top - width_bottom;
    let high = height_right - height_left;
    let half_b = vec2f(
        (height_right + height_left) * per_cos,
        (width_top + width_bottom) * per_cos,
    );
    return Slopes(
        high - slope * wide,
        wide + slope * high,
        moment * (per_cos * per_cos),
        vec2f(side_x, side_y),
        select(half_b, half_b.yx, pair.swapped),
    );
}

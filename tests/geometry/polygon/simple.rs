//! The oracle: whether polygons are valid by the OGC's rules (Simple Features, OGC 06-103r4, section 6.1.11), in whole
//! numbers; shares no code with the library.
use geograd::{Polygon, Vec2};

/// A place in whole steps.
type Point = [i64; 2];

/// Coordinates in steps of which the largest one has 2⁵² at least. Panics where one is no whole number of these.
fn whole(parts: &[Polygon<f64>]) -> Vec<Vec<Vec<Point>>> {
    let vertices = parts.iter().flat_map(|part| part.vertices());
    let largest = vertices.fold(0.0_f64, |most, v| most.max(v.x.abs()).max(v.y.abs()));
    let mut steps = 1.0;
    while largest > 0.0 && largest * steps < 2f64.powi(52) {
        steps *= 2.0;
    }
    while largest * steps >= 2f64.powi(53) {
        steps *= 0.5;
    }
    let number = |x: f64| {
        assert_eq!((x * steps).fract(), 0.0, "{x} is on no grid");
        (x * steps) as i64
    };
    let place = |v: &Vec2<f64>| [number(v.x), number(v.y)];
    let part = |part: &Polygon<f64>| {
        let rings = part.rings();
        rings
            .iter()
            .map(|ring| ring.iter().map(place).collect())
            .collect()
    };
    parts.iter().map(part).collect()
}

fn cross(a: Point, b: Point, c: Point) -> i128 {
    let [ux, uy, vx, vy] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]].map(i128::from);
    (ux * vy - uy * vx).signum()
}

/// `true` if a place in line with both ends of a segment is on it.
fn between(p: Point, [a, b]: [Point; 2]) -> bool {
    (0..2).all(|k| a[k].min(b[k]) <= p[k] && p[k] <= a[k].max(b[k]))
}

/// The shared points of two segments.
enum Shared {
    Nothing,
    Place(Point),
    More,
}

fn shared(s: [Point; 2], t: [Point; 2]) -> Shared {
    let sides = [cross(s[0], s[1], t[0]), cross(s[0], s[1], t[1])];
    let others = [cross(t[0], t[1], s[0]), cross(t[0], t[1], s[1])];
    if sides[0] * sides[1] < 0 && others[0] * others[1] < 0 {
        return Shared::More;
    }
    let mut places = Vec::new();
    for k in 0..2 {
        places.extend((sides[k] == 0 && between(t[k], s)).then_some(t[k]));
        places.extend((others[k] == 0 && between(s[k], t)).then_some(s[k]));
    }
    places.sort_unstable();
    places.dedup();
    match places[..] {
        [] => Shared::Nothing,
        [place] => Shared::Place(place),
        _ => Shared::More,
    }
}

fn segments(ring: &[Point]) -> Vec<[Point; 2]> {
    (0..ring.len())
        .map(|k| [ring[k], ring[(k + 1) % ring.len()]])
        .collect()
}

/// 1 inside a ring, 0 on it, −1 outside; all of it in half steps.
fn place_in(p: Point, ring: &[Point]) -> i32 {
    let mut is_inside = false;
    for [a, b] in segments(ring) {
        let [a, b] = [a, b].map(|p| p.map(|x| 2 * x));
        let side = cross(a, b, p);
        if side == 0 && between(p, [a, b]) {
            return 0;
        }
        if (a[1] > p[1]) != (b[1] > p[1]) && (side > 0) == (b[1] > a[1]) {
            is_inside = !is_inside;
        }
    }
    if is_inside { 1 } else { -1 }
}

/// The vertices of a ring and the middles of its edges, in half steps.
fn places(ring: &[Point]) -> Vec<Point> {
    let both = |[a, b]: [Point; 2]| [[2 * a[0], 2 * a[1]], [a[0] + b[0], a[1] + b[1]]];
    segments(ring).into_iter().flat_map(both).collect()
}

/// The places at which two rings touch; an error if they share more than places.
fn touches(p: &[Point], q: &[Point]) -> Result<Vec<Point>, &'static str> {
    let mut all = Vec::new();
    for s in segments(p) {
        for t in segments(q) {
            match shared(s, t) {
                Shared::Nothing => {}
                Shared::Place(place) => all.push(place),
                Shared::More => return Err("rings cross, or share a piece"),
            }
        }
    }
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// `true` if a ring meets itself only at the ends of neighbouring edges.
fn is_simple(ring: &[Point]) -> bool {
    let (edges, count) = (segments(ring), ring.len());
    count >= 3
        && (0..count).all(|i| {
            (0..i).all(|j| match shared(edges[i], edges[j]) {
                Shared::Nothing => true,
                Shared::Place(_) => i - j == 1 || i - j == count - 1,
                Shared::More => false,
            })
        })
}

/// A chain of rings that touch in a closed round would cut the inside in two: places and rings as nodes of a graph.
fn is_connected(part: &[Vec<Point>]) -> Result<bool, &'static str> {
    let mut meetings: Vec<(Point, usize)> = Vec::new();
    for i in 0..part.len() {
        for j in 0..i {
            let at = touches(&part[i], &part[j])?;
            meetings.extend(at.into_iter().flat_map(|place| [(place, i), (place, j)]));
        }
    }
    meetings.sort_unstable();
    meetings.dedup();
    let mut places: Vec<Point> = meetings.iter().map(|meeting| meeting.0).collect();
    places.dedup();
    let mut group: Vec<usize> = (0..part.len() + places.len()).collect();
    for (place, ring) in meetings {
        let node = part.len() + places.binary_search(&place).unwrap();
        let (from, to) = (group[node], group[ring]);
        if from == to {
            return Ok(false);
        }
        group
            .iter_mut()
            .filter(|x| **x == from)
            .for_each(|x| *x = to);
    }
    Ok(true)
}

/// Checks polygons, each an outer ring and its holes; the error names the flaw.
pub fn flaw(parts: &[Polygon<f64>]) -> Result<(), &'static str> {
    let parts = whole(parts);
    for part in &parts {
        if !part.iter().all(|ring| is_simple(ring)) {
            return Err("a ring meets itself");
        }
        for (k, hole) in part.iter().enumerate().skip(1) {
            if places(hole).iter().any(|&p| place_in(p, &part[0]) < 0) {
                return Err("a hole is not inside");
            }
            for (_, other) in part.iter().enumerate().skip(1).filter(|(j, _)| *j != k) {
                if places(hole).iter().any(|&p| place_in(p, other) > 0) {
                    return Err("a hole is in another one");
                }
            }
        }
        if !is_connected(part)? {
            return Err("the inside is not connected");
        }
    }
    for (k, part) in parts.iter().enumerate() {
        for other in &parts[..k] {
            for (p, q) in part.iter().flat_map(|p| other.iter().map(move |q| (p, q))) {
                touches(p, q)?;
            }
            for (inner, outer) in [(part, other), (other, part)] {
                let is_in = |&p: &Point| {
                    place_in(p, &outer[0]) > 0
                        && outer[1..].iter().all(|hole| place_in(p, hole) < 0)
                };
                if places(&inner[0]).iter().any(is_in) {
                    return Err("parts overlap");
                }
            }
        }
    }
    Ok(())
}

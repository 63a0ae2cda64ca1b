//! Distances and depths of hulls with vertices of whole numbers, by fractions in 128 bits.
//!
//! The oracle reads vertices alone, not faces. The nearest points of two polytopes that are apart are those of a vertex
//! and a triangle of any three vertices, or of two segments between any vertices. A depth is the least width along a
//! direction across two edges, of one hull or of both: facets of the difference of both hulls have no other normals.
use super::draw::Random;
use super::exact::{Whole, cross, dot, draw, minus, place};
use geograd::prelude::*;
use geograd::{Scalar, distance3};

/// A square of a length as a fraction; the divisor is positive.
#[derive(Clone, Copy)]
struct Square(i128, i128);

impl Square {
    fn least(self, other: Square) -> Square {
        match self.0 * other.1 <= other.0 * self.1 {
            true => self,
            false => other,
        }
    }
    fn root(self) -> f64 {
        (self.0 as f64 / self.1 as f64).sqrt()
    }
}

/// The square of the distance of a point from a segment, which may be a point.
fn to_segment(p: Whole, [a, b]: [Whole; 2]) -> Square {
    let (along, arm) = (minus(b, a), minus(p, a));
    let (share, whole) = (dot(along, arm), dot(along, along));
    if share <= 0 {
        return Square(dot(arm, arm), 1);
    }
    if share >= whole {
        return Square(dot(minus(p, b), minus(p, b)), 1);
    }
    let aside = cross(along, arm);
    Square(dot(aside, aside), whole)
}

/// The square of the distance of a point from a triangle over which it is; nothing elsewhere and for flat ones.
fn over_triangle(p: Whole, [a, b, c]: [Whole; 3]) -> Option<Square> {
    let normal = cross(minus(b, a), minus(c, a));
    let inside = |q: Whole, r: Whole| dot(normal, cross(minus(r, q), minus(p, q))) >= 0;
    let height = dot(normal, minus(p, a));
    (normal != [0; 3] && inside(a, b) && inside(b, c) && inside(c, a))
        .then(|| Square(height * height, dot(normal, normal)))
}

/// The square of the distance of two segments whose nearest points are between their ends; nothing elsewhere and for
/// parallel ones, whose distance is that of an end.
fn between_segments([a, b]: [Whole; 2], [c, d]: [Whole; 2]) -> Option<Square> {
    let (u, v, w) = (minus(b, a), minus(d, c), minus(c, a));
    let normal = cross(u, v);
    let square = dot(normal, normal);
    let (s, t) = (dot(cross(w, v), normal), dot(cross(w, u), normal));
    let height = dot(w, normal);
    (square > 0 && (0..=square).contains(&s) && (0..=square).contains(&t))
        .then(|| Square(height * height, square))
}

fn pairs(all: &[Whole]) -> impl Iterator<Item = [Whole; 2]> {
    (0..all.len()).flat_map(move |i| (0..i).map(move |j| [all[i], all[j]]))
}
fn triples(all: &[Whole]) -> impl Iterator<Item = [Whole; 3]> {
    pairs(all).flat_map(move |[a, b]| all.iter().map(move |&c| [a, b, c]))
}

/// The square of the distance of two hulls that are apart.
fn apart(a: &[Whole], b: &[Whole]) -> Square {
    let mut least = Square(i128::MAX >> 64, 1);
    for (points, others) in [(a, b), (b, a)] {
        for &p in points {
            let ends = others
                .iter()
                .map(|&q| Square(dot(minus(p, q), minus(p, q)), 1));
            let sides = pairs(others).map(|side| to_segment(p, side));
            let faces = triples(others).filter_map(|face| over_triangle(p, face));
            least = ends.chain(sides).chain(faces).fold(least, Square::least);
        }
    }
    let crossed = pairs(a).flat_map(|first| pairs(b).map(move |second| (first, second)));
    crossed
        .filter_map(|(first, second)| between_segments(first, second))
        .fold(least, Square::least)
}

/// The signed distance of two hulls, in the nearest number.
fn signed(a: &[Whole], b: &[Whole]) -> f64 {
    let edges: Vec<Whole> = pairs(a).chain(pairs(b)).map(|[p, q]| minus(q, p)).collect();
    let mut depth: Option<Square> = None;
    for [u, v] in pairs(&edges) {
        let way = cross(u, v);
        if way == [0; 3] {
            continue;
        }
        for way in [way, way.map(|x| -x)] {
            let top = a.iter().map(|&p| dot(way, p)).max().unwrap();
            let bottom = b.iter().map(|&p| dot(way, p)).min().unwrap();
            if bottom > top {
                return apart(a, b).root();
            }
            let width = Square((top - bottom).pow(2), dot(way, way));
            depth = Some(depth.map_or(width, |least| least.least(width)));
        }
    }
    match depth {
        Some(depth) if depth.0 > 0 => -depth.root(),
        // They touch, or both are on one plane or one line, on which they may be apart.
        _ => apart(a, b).root(),
    }
}

/// Vertices of a hull: any, on one plane, on one line, repeated, all in one place.
fn vertices(random: &mut Random, size: usize) -> Vec<Whole> {
    let count = 1 + random.below(8);
    let mut all: Vec<Whole> = (0..count).map(|_| draw(random, size)).collect();
    match random.below(6) {
        0 => all.iter_mut().for_each(|p| p[2] = 1),
        1 => all.iter_mut().for_each(|p| *p = [p[0], 1 - p[0], 2 * p[0]]),
        2 => all.push(all[0]),
        _ => {}
    }
    all.truncate(8);
    all
}

fn hull<S: Scalar>(all: &[Whole]) -> Hull3<S, 8> {
    let vertices: Vec<Vec3<S>> = all.iter().map(|&p| place(p)).collect();
    Hull3::from_vertices(&vertices)
}

/// The directions of axes, by which hulls are moved apart.
const AXES: [Whole; 3] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

#[test]
fn hulls_of_whole_numbers_are_as_far_apart_as_fractions_say() {
    let mut random = Random(43);
    let (mut met, mut clear, mut deep) = (0, 0, 0);
    for round in 0..if cfg!(debug_assertions) { 400 } else { 20_000 } {
        let size = 1 + random.below(4);
        let a = vertices(&mut random, size);
        let mut b = vertices(&mut random, size);
        let away = AXES[round % 3].map(|x| x * random.below(2 * size + 2) as i128);
        b.iter_mut()
            .for_each(|p| *p = [0, 1, 2].map(|k| p[k] + away[k]));
        let expected = signed(&a, &b);
        let (first, second) = (hull::<f64>(&a), hull::<f64>(&b));
        let found = first.signed_distance(second);
        let bound = 1e-14 * (3 * size) as f64;
        assert!(
            (found - expected).abs() <= bound,
            "{found} for {expected}: {a:?} {b:?}"
        );
        assert!((first.distance(second) - expected.max(0.0)).abs() <= bound);
        let pair = distance3::closest_points(first, second);
        if expected > 0.0 {
            let way = (pair.on_b - pair.on_a).length();
            assert!(
                (way - expected).abs() <= bound,
                "{way} for {expected}: {a:?} {b:?}"
            );
        }
        let single = hull::<f32>(&a).signed_distance(hull::<f32>(&b));
        assert!((f64::from(single) - expected).abs() <= 2e-6 * (3 * size) as f64);
        met += usize::from(expected == 0.0);
        clear += usize::from(expected > 0.0);
        deep += usize::from(expected < 0.0);
    }
    assert!(met.min(clear).min(deep) > 20, "{met} {clear} {deep}");
}

//! Polygons to test with: random ones and hard ones.
use geograd::{ConvexPolygon, Vec2};
use geograd_tests::Dice;

pub type Polygon = ConvexPolygon<f64, 12>;

pub fn at(x: f64, y: f64) -> Vec2<f64> {
    Vec2::new(x, y)
}
pub fn ring(all: &[(f64, f64)]) -> Vec<Vec2<f64>> {
    all.iter().map(|&(x, y)| at(x, y)).collect()
}
pub fn polygon(all: &[(f64, f64)]) -> Polygon {
    Polygon::from_vertices(&ring(all))
}
/// A random convex polygon: corners of an ellipse, so of any width, turned and moved.
pub fn convex(dice: &mut Dice) -> Polygon {
    loop {
        let n = 3 + dice.below(9);
        let mut angles: Vec<f64> = (0..n)
            .map(|_| dice.within(0.0, std::f64::consts::TAU))
            .collect();
        angles.sort_by(|x, y| x.partial_cmp(y).unwrap());
        let flat = if dice.below(3) == 0 {
            0.02
        } else {
            dice.within(0.3, 1.0)
        };
        let (sin, cos) = dice.within(0.0, std::f64::consts::TAU).sin_cos();
        let (size, x, y) = (
            dice.within(0.5, 3.0),
            dice.within(-2.0, 2.0),
            dice.within(-2.0, 2.0),
        );
        let vertices: Vec<_> = angles
            .iter()
            .map(|t| {
                let (u, v) = (size * t.cos(), size * flat * t.sin());
                at(x + cos * u - sin * v, y + sin * u + cos * v)
            })
            .collect();
        if let Ok((made, _)) = Polygon::cleaned(&vertices) {
            return made;
        }
    }
}
/// A random ring of any kind, on a grid half of the time, so that it touches itself.
pub fn any_ring(dice: &mut Dice, most: usize) -> Vec<Vec2<f64>> {
    let n = 3 + dice.below(most - 2);
    let grid = dice.below(2) == 0;
    let mut number = || {
        let x = dice.within(-3.0, 3.0);
        if grid { x.round() } else { x }
    };
    (0..n).map(|_| at(number(), number())).collect()
}
/// Pairs that are hard on purpose, of coordinates that are exact in `f32`.
pub fn hard() -> Vec<(Polygon, Polygon)> {
    let square = polygon(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]);
    let turned = polygon(&[(2., 2.), (0., 2.), (0., 0.), (2., 0.)]);
    let shifted = |x: f64, y: f64| polygon(&[(x, y), (x + 2., y), (x + 2., y + 2.), (x, y + 2.)]);
    let diamond = polygon(&[(1., -1.), (3., 1.), (1., 3.), (-1., 1.)]);
    let inner = polygon(&[(0.5, 0.5), (1.5, 0.5), (1.5, 1.5), (0.5, 1.5)]);
    let needle = polygon(&[(-8., 1.), (8., 1.), (8., 1.0078125)]);
    let triangle = polygon(&[(0., 0.), (2., 0.), (0., 2.)]);
    let wedge = polygon(&[(2., 2.), (5., 1.), (5., 3.)]);
    let on_edge = polygon(&[(0.5, 0.), (1.5, 0.), (1., 1.)]);
    let outside_edge = polygon(&[(0.5, 0.), (1., -1.), (1.5, 0.)]);
    let touching = polygon(&[(2., 0.5), (3., 0.), (3., 1.)]);
    let flat = polygon(&[(0., 1.), (2., 1.), (2., 1.), (0., 1.)]);
    let point = polygon(&[(1., 1.), (1., 1.), (1., 1.)]);
    let huge = polygon(&[(-1e6, -1e6), (1e6, -1e6), (1e6, 1e6), (-1e6, 1e6)]);
    let near = polygon(&[(0., 0.), (2., 0.0000001), (2., 2.), (0., 2.)]);
    let mut all = vec![];
    let shapes = [
        square,
        turned,
        shifted(1., 0.),
        shifted(1., 1.),
        shifted(2., 0.),
        shifted(2., 2.),
        shifted(5., 0.),
        diamond,
        inner,
        needle,
        triangle,
        wedge,
        on_edge,
        outside_edge,
        touching,
        flat,
        point,
        huge,
        near,
    ];
    for a in shapes {
        for b in shapes {
            all.push((a, b));
        }
    }
    all
}
/// A star around a place, counter-clockwise.
pub fn star(dice: &mut Dice, middle: Vec2<f64>, n: usize, low: f64, high: f64) -> Vec<Vec2<f64>> {
    let turn = dice.within(0.0, 1.0);
    let spoke = |k: usize| {
        let angle = std::f64::consts::TAU * (k as f64 + turn) / n as f64;
        let radius = dice.within(low, high);
        at(
            middle.x + radius * angle.cos(),
            middle.y + radius * angle.sin(),
        )
    };
    (0..n).map(spoke).collect()
}
/// Random stars, most with a hole, some of two parts; every ring of any orientation.
pub fn stars(dice: &mut Dice) -> Vec<Vec<Vec2<f64>>> {
    let mut all = Vec::new();
    for part in 0..1 + dice.below(2) {
        let middle = at(
            dice.within(-0.6, 0.6) + 4.0 * part as f64,
            dice.within(-0.6, 0.6),
        );
        let n = 5 + dice.below(12);
        all.push(star(dice, middle, n, 0.6, 1.6));
        if dice.below(3) > 0 {
            // Inside the circle in all outer stars, between their edges.
            let n = 3 + dice.below(6);
            all.push(star(dice, middle, n, 0.05, 0.17));
        }
    }
    for ring in &mut all {
        if dice.below(2) == 0 {
            ring.reverse();
        }
    }
    all
}
/// Polygons with holes that are hard on purpose, of coordinates that are exact in `f32`.
pub fn hard_rings() -> Vec<Vec<Vec<Vec2<f64>>>> {
    let square = |x: f64, y: f64, s: f64| ring(&[(x, y), (x + s, y), (x + s, y + s), (x, y + s)]);
    let turned = |mut ring: Vec<Vec2<f64>>| {
        ring.reverse();
        ring
    };
    vec![
        vec![square(0., 0., 4.)],
        vec![turned(square(0., 0., 4.))],
        // A frame, its hole as a polygon, and a frame in a frame.
        vec![square(0., 0., 4.), square(1., 1., 2.)],
        vec![square(1., 1., 2.)],
        vec![
            square(0., 0., 4.),
            turned(square(1., 1., 2.)),
            square(1.5, 1.5, 1.),
        ],
        // Beside, at an edge, at a part of it, at a corner, apart.
        vec![square(4., 0., 4.)],
        vec![square(4., 1., 2.)],
        vec![square(4., 4., 2.)],
        vec![square(9., 0., 2.)],
        vec![square(2., 0., 4.)],
        vec![square(2., 2., 4.)],
        // A hole that touches the border in a point, and one along a part of it.
        vec![square(0., 0., 4.), ring(&[(2., 0.), (3., 1.), (1., 1.)])],
        vec![
            ring(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.)]),
            ring(&[(2., 0.), (4., 2.), (2., 4.), (0., 2.)]),
        ],
        // Two parts that touch in a point.
        vec![square(0., 0., 2.), square(2., 2., 2.)],
        // Collinear vertices, repeated ones, a spike outwards and one inwards.
        vec![ring(&[
            (0., 0.),
            (1., 0.),
            (2., 0.),
            (4., 0.),
            (4., 4.),
            (2., 4.),
            (0., 4.),
        ])],
        vec![ring(&[
            (0., 0.),
            (4., 0.),
            (4., 0.),
            (4., 4.),
            (4., 4.),
            (4., 4.),
            (0., 4.),
        ])],
        vec![ring(&[
            (0., 0.),
            (4., 0.),
            (4., 2.),
            (6., 2.),
            (4., 2.),
            (4., 4.),
            (0., 4.),
        ])],
        vec![ring(&[
            (0., 0.),
            (4., 0.),
            (4., 2.),
            (2., 2.),
            (4., 2.),
            (4., 4.),
            (0., 4.),
        ])],
        // Thin ones.
        vec![ring(&[(-8., 1.), (8., 1.), (8., 1.0078125)])],
        vec![ring(&[
            (0., 0.),
            (4., 0.),
            (4., 0.0000001),
            (0., 0.0000002),
        ])],
        // An edge nearly along another one.
        vec![ring(&[(0., 0.), (4., 0.0000001), (4., 4.), (0., 4.)])],
        vec![ring(&[
            (0., 0.),
            (2., 1.),
            (4., 0.),
            (4., 4.),
            (2., 3.),
            (0., 4.),
        ])],
    ]
}

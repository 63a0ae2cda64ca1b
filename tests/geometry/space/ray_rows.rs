//! Batches of rays, lines and segments give the bits of single calls, with finite slopes, where corners and ends are
//! shared.
use super::draw::Random;
use super::exact::{self, place};
use geograd::intersection3::{
    first_hit, first_hit_of_segment, first_hit_triangle, length_inside, span,
};
use geograd::prelude::*;

const ITEMS: usize = 2000;

/// Results of a batch next to those of single calls. What is printed tells zeros of either sign apart.
macro_rules! same {
    ($($verb:ident, $ways:ident, $single:path: $($shapes:ident)*;)*) => { $($(
        let found = Cpu::new().aligned($verb, (&$ways, &$shapes)).unwrap();
        for k in 0..ITEMS {
            let (once, found) = (format!("{:?}", $single($ways[k], $shapes[k])), format!("{:?}", found[k]));
            assert_eq!(once, found, "{:?} {:?}", $ways[k], $shapes[k]);
            assert!(!once.contains("NaN") && !once.contains("inf") && !once.contains("-0.0,"), "{once}");
        }
    )*)* };
}

/// Slopes of a batch next to those of single calls.
macro_rules! slopes {
    ($float:ident, $ways:ident: $($shapes:ident)*) => { $(
        let columns = (&$ways, &$shapes);
        let (_, (by_wire, by_shape)) = Cpu::new().aligned(LengthInside.value_grad(), columns).unwrap();
        for k in 0..ITEMS {
            let told = format!("{:?} {:?} {:?} {:?}", $ways[k], $shapes[k], by_wire[k], by_shape[k]);
            let printed = format!("{:?} {:?}", by_wire[k], by_shape[k]);
            assert!(!printed.contains("NaN") && !printed.contains("inf"), "{told}");
            let inputs = ($ways[k], $shapes[k]);
            let (_, (once, _)) = geograd::gradient(|(wire, shape)| length_inside(wire, shape), inputs);
            let (start, end) = (once.start - by_wire[k].start, once.end - by_wire[k].end);
            let allowed = 256.0 * $float::EPSILON * (1.0 + once.start.length() + once.end.length());
            assert!(start.length().max(end.length()) <= allowed, "{told} {once:?}");
        }
    )* };
}

macro_rules! test {
    ($name:ident, $float:ident) => {
        #[test]
        fn $name() {
            if !geograd_tests::is_due(stringify!($name)) {
                return;
            }
            let mut random = Random(0x71);
            let mut rays = Vec::new();
            while rays.len() < ITEMS {
                let [from, way] = [0; 2].map(|_| exact::draw(&mut random, 2));
                if way != [0; 3] {
                    // A product of zero and a negative number is a negative zero.
                    let sign = [1.0, -1.0][random.below(2)];
                    let from = place::<$float>(from.map(|x| x * sign as i128)) * sign;
                    rays.push(Ray3::new(from, place(way)));
                }
            }
            let wires: Vec<_> = rays.iter().map(|x| Segment3::new(x.point, x.point + x.direction)).collect();
            let lines: Vec<_> = rays.iter().map(|x| x.line()).collect();
            let mut corners = Vec::new();
            for _ in 0..ITEMS {
                corners.push([0; 4].map(|_| place::<$float>(exact::draw(&mut random, 2))));
            }
            let end = |a: Vec3<$float>, b| if a == b { a + Vec3::new(1.0, 0.0, 0.0) } else { b };
            let radii = [0.0, 1.0, 2.0].map(|x: $float| x);
            let links: Vec<_> = (0..ITEMS).map(|k| Capsule3::new(corners[k][0], corners[k][1], radii[k % 3])).collect();
            let planes: Vec<_> =
                links.iter().map(|x| Plane3::new(end(x.start, x.end) - x.start, x.radius)).collect();
            let balls: Vec<_> = links.iter().map(|x| Sphere::new(x.start, x.radius)).collect();
            let cones: Vec<_> = links.iter().map(|x| Cone::new(x.start, end(x.start, x.end), x.radius)).collect();
            let cans: Vec<_> = links.iter().map(|x| Cylinder::new(x.start, end(x.start, x.end), x.radius)).collect();
            let solids: Vec<_> = corners.iter().map(|&[a, b, c, d]| Tetrahedron::new(a, b, c, d)).collect();
            let faces: Vec<_> = corners.iter().map(|&[a, b, c, _]| Triangle3::new(a, b, c)).collect();
            same! {
                FirstHit, rays, first_hit: planes balls links cans cones solids;
                FirstHit, rays, first_hit_triangle: faces;
                FirstHit, wires, first_hit_of_segment: faces;
                Span, lines, span: planes balls links cans cones solids;
                LengthInside, wires, length_inside: planes balls links cans cones solids;
            }
            slopes!($float, wires: balls links cans cones solids);
        }
    };
}
test!(batches_give_the_bits_of_single_calls, f64);
test!(
    batches_give_the_bits_of_single_calls_in_single_precision,
    f32
);

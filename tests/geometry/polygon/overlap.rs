//! Areas of intersection of polygons against an oracle, and their derivatives.
use super::cases::{any_ring, at, convex, hard, polygon};
use super::exact;
use geograd::ad::adjoint::overlap_polygon::{
    area_inside_vjp, intersection_area_polygons_vjp, iou_polygons_vjp,
};
use geograd::overlap_polygon::{
    area_inside, intersection_area_polygons, intersection_area_quads, iof_polygons, iou_polygons,
};
use geograd::{Aabb2, ConvexPolygon, Jet, Obb2, Vec2};
use geograd_tests::Dice;

type Derivatives = Jet<f64, 48>;

fn cast<R: Copy, T: Copy, const N: usize>(
    a: &ConvexPolygon<R, N>,
    f: impl Fn(R) -> T,
) -> ConvexPolygon<T, N> {
    ConvexPolygon {
        vertices: a.vertices.map(|v| Vec2::new(f(v.x), f(v.y))),
        count: a.count,
    }
}

/// A polygon of variables, starting with number `first`.
pub fn variables<const N: usize>(
    a: &ConvexPolygon<f64, N>,
    first: usize,
) -> ConvexPolygon<Derivatives, N> {
    let mut next = first;
    ConvexPolygon {
        vertices: a.vertices.map(|v| {
            next += 2;
            Vec2::new(Jet::variable(v.x, next - 2), Jet::variable(v.y, next - 1))
        }),
        count: a.count,
    }
}

fn exact_area(a: &[Vec2<f64>], b: &[Vec2<f64>]) -> f64 {
    if exact::ring_area(a) == 0.0 || exact::ring_area(b) == 0.0 {
        return 0.0;
    }
    exact::area_inside(a, b)
}

#[test]
fn areas_are_those_of_the_oracle() {
    let mut dice = Dice(1);
    let random = (0..400).map(|_| (convex(&mut dice), convex(&mut dice)));
    let all: Vec<_> = random.chain(hard()).collect();
    for (a, b) in all {
        let truth = exact_area(a.as_slice(), b.as_slice());
        let (area_a, area_b) = (
            exact::ring_area(a.as_slice()),
            exact::ring_area(b.as_slice()),
        );
        let smaller = area_a.min(area_b);
        let reach = |p: &[Vec2<f64>]| {
            let size = Aabb2::around(p).unwrap().size();
            size.x.max(size.y)
        };
        let (long, short) = (reach(a.as_slice()), reach(b.as_slice()));
        let rounding = smaller.max(long.min(short).powi(2) * 0.05)
            * (long.max(short) / long.min(short).max(1e-3));
        let rounding = rounding.min(long.max(short).powi(2));
        let found = intersection_area_polygons(&a, &b);
        assert!(
            (found - truth).abs() <= 1e-14 * rounding,
            "{a:?} {b:?} {found} {truth} {rounding}"
        );
        let back = intersection_area_polygons(&b, &a);
        assert!((back - truth).abs() <= 1e-14 * rounding, "{back} {truth}");
        let union = area_a + area_b - truth;
        let iou = if union > 0.0 { truth / union } else { 0.0 };
        assert!((iou_polygons(&a, &b) - iou).abs() < 1e-13);
        if area_a > 0.0 {
            assert!((iof_polygons(&a, &b) - truth / area_a).abs() <= 1e-14 * rounding / area_a);
        }
        if truth == 0.0 && smaller > 0.0 {
            assert!(found < 1e-15, "{found}");
        }
        // Single precision.
        let (single_a, single_b) = (cast(&a, |x| x as f32), cast(&b, |x| x as f32));
        let (a, b) = (cast(&single_a, f64::from), cast(&single_b, f64::from));
        let truth = exact_area(a.as_slice(), b.as_slice());
        let found = f64::from(intersection_area_polygons(&single_a, &single_b));
        let rounding = rounding.max(long.min(short).powi(2) * 0.2);
        assert!(
            (found - truth).abs() <= 2e-6 * rounding,
            "{found} {truth} {rounding}"
        );
    }
}

#[test]
fn the_same_polygon_twice_has_iou_one_and_no_derivative() {
    let mut dice = Dice(2);
    for _ in 0..80 {
        let a = convex(&mut dice);
        assert_eq!(iou_polygons(&a, &a), 1.0);
        let single = cast(&a, |x| x as f32);
        assert_eq!(iou_polygons(&single, &single), 1.0);
        let value = iou_polygons(&variables(&a, 0), &variables(&a, 24));
        let (by_a, by_b) = iou_polygons_vjp(&a, &a, 1.0);
        assert_eq!(value.derivative, [0.0; 48], "{value:?}");
        for v in by_a.vertices.iter().chain(&by_b.vertices) {
            assert_eq!(*v, Vec2::zero());
        }
    }
    // One of them turned about by a vertex is the same shape: to rounding.
    let [p, q, r] = [at(0.0, 0.0), at(3.0, 0.0), at(0.0, 1.0)];
    let [a, b] = [[p, q, r], [q, r, p]].map(ConvexPolygon::<f64, 3>::from);
    let (by_a, by_b) = iou_polygons_vjp(&a, &a, 1.0);
    assert_eq!(by_a.vertices, [Vec2::zero(); 3]);
    assert_eq!(by_b.vertices, [Vec2::zero(); 3]);
    let (by_a, _) = iou_polygons_vjp(&a, &b, 1.0);
    assert!(by_a.vertices.iter().all(|v| v.length() < 1e-14));
}

fn area_of(all: &[f64], a: &ConvexPolygon<f64, 12>, b: &ConvexPolygon<f64, 12>) -> f64 {
    let (mut a, mut b) = (*a, *b);
    for (k, v) in a.vertices.iter_mut().chain(&mut b.vertices).enumerate() {
        *v = at(all[2 * k], all[2 * k + 1]);
    }
    intersection_area_polygons(&a, &b)
}

#[test]
fn derivatives_are_those_of_differences_and_the_adjoint_has_them() {
    let mut dice = Dice(3);
    let mut seen = 0;
    for _ in 0..60 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        let value = intersection_area_polygons(&variables(&a, 0), &variables(&b, 24));
        let (by_a, by_b) = intersection_area_polygons_vjp(&a, &b, 1.0);
        let adjoint: Vec<f64> = by_a
            .vertices
            .iter()
            .chain(&by_b.vertices)
            .flat_map(|v| [v.x, v.y])
            .collect();
        let all: Vec<f64> = a
            .vertices
            .iter()
            .chain(&b.vertices)
            .flat_map(|v| [v.x, v.y])
            .collect();
        for k in 0..48 {
            let step = 1e-6;
            let mut moved = all.clone();
            moved[k] += step;
            let up = area_of(&moved, &a, &b);
            moved[k] = all[k] - step;
            let down = area_of(&moved, &a, &b);
            let difference = (up - down) / (2.0 * step);
            let kink = (up + down - 2.0 * value.value).abs() / step;
            assert!(
                (value.derivative[k] - difference).abs() < 1e-5 + 1.01 * kink,
                "{k} {} {difference} {kink}",
                value.derivative[k]
            );
            assert!(
                (value.derivative[k] - adjoint[k]).abs() < 1e-9,
                "{k} {} {}",
                value.derivative[k],
                adjoint[k]
            );
            seen += usize::from(difference != 0.0);
        }
    }
    assert!(seen > 300);
}

#[test]
fn hard_pairs_have_finite_derivatives_between_the_one_sided_ones() {
    for (a, b) in hard() {
        let value = intersection_area_polygons(&variables(&a, 0), &variables(&b, 24));
        let (by_a, by_b) = intersection_area_polygons_vjp(&a, &b, 1.0);
        let adjoint: Vec<f64> = by_a
            .vertices
            .iter()
            .chain(&by_b.vertices)
            .flat_map(|v| [v.x, v.y])
            .collect();
        let all: Vec<f64> = a
            .vertices
            .iter()
            .chain(&b.vertices)
            .flat_map(|v| [v.x, v.y])
            .collect();
        let flat = a.area() == 0.0 || b.area() == 0.0;
        let large = all.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        for k in 0..48 {
            assert!(
                value.derivative[k].is_finite() && adjoint[k].is_finite(),
                "{a:?} {b:?} {k} {} {}",
                value.derivative[k],
                adjoint[k]
            );
            if flat {
                continue;
            }
            let step = 1e-7 * large.min(3.0);
            let mut moved = all.clone();
            moved[k] += step;
            let up = (area_of(&moved, &a, &b) - value.value) / step;
            moved[k] = all[k] - step;
            let down = (value.value - area_of(&moved, &a, &b)) / step;
            let slack = 2e-6 * large.max(1.0);
            let (low, high) = (up.min(down) - slack, up.max(down) + slack);
            // The derivative at a touch is zero by convention.
            for derivative in [value.derivative[k], adjoint[k]] {
                let inside = derivative >= low && derivative <= high;
                assert!(
                    inside || value.value == 0.0 && derivative == 0.0,
                    "{a:?} {b:?} {k} {derivative} {low} {high}"
                );
            }
        }
    }
}

#[test]
fn second_derivatives_are_those_of_the_adjoint() {
    // Numbers of 81 parts each, in code that is not optimised.
    let thread = std::thread::Builder::new().stack_size(64 << 20);
    thread.spawn(second_derivatives).unwrap().join().unwrap();
}

fn second_derivatives() {
    let (a, b) = (
        polygon(&[(0., 0.), (2., 0.), (1.5, 2.), (0.2, 1.8)]),
        polygon(&[(1., 0.5), (3., 1.), (1.2, 2.6)]),
    );
    type Two = Jet<Jet<f64, 8>, 8>;
    let inner = |x: f64, k: usize| Jet::<f64, 8>::variable(x, k);
    let lift = |p: &ConvexPolygon<f64, 12>, vary: bool| ConvexPolygon::<Two, 4> {
        vertices: std::array::from_fn(|i| {
            let k = if vary { 2 * i } else { 99 };
            Vec2::new(
                Jet::variable(inner(p.vertices[i].x, k), k),
                Jet::variable(inner(p.vertices[i].y, k + 1), k + 1),
            )
        }),
        count: p.count,
    };
    let value = intersection_area_polygons(&lift(&a, true), &lift(&b, false));
    let derivatives = |a: &ConvexPolygon<f64, 12>| intersection_area_polygons_vjp(a, &b, 1.0).0;
    for k in 0..8 {
        let mut up = a;
        let mut down = a;
        let step = 1e-6;
        let (i, x) = (k / 2, k % 2 == 0);
        if x {
            up.vertices[i].x += step;
            down.vertices[i].x -= step;
        } else {
            up.vertices[i].y += step;
            down.vertices[i].y -= step;
        }
        let (up, down) = (derivatives(&up), derivatives(&down));
        for m in 0..8 {
            let of = |p: &ConvexPolygon<f64, 12>| {
                if m % 2 == 0 {
                    p.vertices[m / 2].x
                } else {
                    p.vertices[m / 2].y
                }
            };
            let difference = (of(&up) - of(&down)) / (2.0 * step);
            assert!(
                (value.derivative[m].derivative[k] - difference).abs() < 1e-6,
                "{m} {k}"
            );
        }
    }
}

#[test]
fn far_from_the_origin_and_at_any_size_the_score_is_the_same() {
    let mut dice = Dice(4);
    for _ in 0..60 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        // A grid, so that moving is exact.
        let grid = |p: &ConvexPolygon<f64, 12>| cast(p, |x| (x * 256.0).round() / 256.0);
        let (a, b) = (grid(&a), grid(&b));
        let truth = iou_polygons(&a, &b);
        let moved = |p: &ConvexPolygon<f64, 12>, x: f64| cast(p, |y| y + x);
        let far = iou_polygons(&moved(&a, 1e6), &moved(&b, 1e6));
        assert!((far - truth).abs() < 1e-12);
        for exponent in [-100, -60, -20, 20, 60, 96] {
            let scale = 2f32.powi(exponent);
            let (a, b) = (
                cast(&a, |x| x as f32 * scale),
                cast(&b, |x| x as f32 * scale),
            );
            let found = iou_polygons(&a, &b);
            assert!(
                (f64::from(found) - truth).abs() < 1e-4,
                "{exponent} {found} {truth}"
            );
        }
        for exponent in [-1000, -500, 500, 1000] {
            let scale = 2f64.powi(exponent);
            let found = iou_polygons(&cast(&a, |x| x * scale), &cast(&b, |x| x * scale));
            assert!((found - truth).abs() < 1e-12, "{exponent} {found} {truth}");
        }
    }
    // Nothing finite gives NaN.
    let sizes = [0.0_f32, 1e-30, 1e-10, 1.0, 1e10, 1e30, 3e38];
    for size_a in sizes {
        for size_b in sizes {
            for x in [0.0, 1e-30, 1.0, 1e30, 3e38, -3e38] {
                let corner = |s: f32, x: f32| {
                    ConvexPolygon::from([(x, 0.0), ((x + s).clamp(-3e38, 3e38), 0.0), (x, s)].map(
                        |(x, y)| Vec2::new(Jet::<f32, 1>::variable(x, 0), Jet::variable(y, 0)),
                    ))
                };
                let (a, b) = (corner(size_a, 0.0), corner(size_b, x));
                for found in [iou_polygons(&a, &b), intersection_area_polygons(&a, &b)] {
                    assert!(found.value.is_finite(), "{size_a} {size_b} {x} {found:?}");
                    assert!(
                        !found.derivative[0].is_nan(),
                        "{size_a} {size_b} {x} {found:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn rings_of_any_kind_are_measured_inside_a_polygon() {
    let mut dice = Dice(5);
    for _ in 0..60 {
        let (p, q, k) = (
            any_ring(&mut dice, 9),
            any_ring(&mut dice, 6),
            convex(&mut dice),
        );
        let truth = exact::area_inside(&p, k.as_slice()) + exact::area_inside(&q, k.as_slice());
        let found = area_inside(&[&p, &q], &k);
        assert!(
            (found - truth).abs() < 1e-13,
            "{p:?} {q:?} {k:?} {found} {truth}"
        );
    }
    assert_eq!(
        area_inside(&[], &polygon(&[(0., 0.), (1., 0.), (0., 1.)])),
        0.0
    );
}

#[test]
fn the_adjoint_of_rings_inside_a_polygon_has_the_derivatives() {
    let mut dice = Dice(6);
    for _ in 0..40 {
        let (p, k) = (any_ring(&mut dice, 9), convex(&mut dice));
        let mut next = 24;
        let variable: Vec<Vec2<Derivatives>> = p
            .iter()
            .map(|v| {
                next += 2;
                Vec2::new(Jet::variable(v.x, next - 2), Jet::variable(v.y, next - 1))
            })
            .collect();
        let value = area_inside(&[&variable], &variables(&k, 0));
        let mut bars = vec![at(9.0, 9.0); p.len()];
        let k_bar = area_inside_vjp(&[&p], &k, 1.0, &mut [&mut bars]);
        for (m, v) in k_bar.vertices.iter().chain(&bars).enumerate() {
            let (x, y) = (value.derivative[2 * m], value.derivative[2 * m + 1]);
            assert!(
                (v.x - x).abs() + (v.y - y).abs() < 1e-8,
                "{p:?} {k:?} {m} {v} {x} {y}"
            );
        }
    }
}

#[test]
fn boxes_agree_with_the_operations_for_boxes() {
    let mut dice = Dice(7);
    for _ in 0..500 {
        let (a, b): (Obb2<f64>, Obb2<f64>) = (dice.obb(), dice.obb());
        let found = iou_polygons(&ConvexPolygon::from(a), &ConvexPolygon::from(b));
        assert!((found - a.iou(b)).abs() < 1e-12, "{a} {b}");
    }
}

/// The seed's failures: same headings (B4, B6), far from the origin (B10), tiny (B11), nearly equal and
/// long (B12).
#[test]
fn pairs_on_which_the_paper_s_library_fails() {
    let quad = |x: f64, y: f64, w: f64, h: f64| ConvexPolygon::from(Obb2::new(x, y, w, h, 0.0));
    let iou = |a: &ConvexPolygon<f64, 4>, b: &ConvexPolygon<f64, 4>| iou_polygons(a, b);
    let turned = |x: f64| {
        ConvexPolygon::from(Obb2::new(
            x * 0.3_f64.cos(),
            x * 0.3_f64.sin(),
            4.0,
            2.0,
            0.3,
        ))
    };
    // B4: 0.25 and 1 there.
    assert_eq!(iou(&turned(0.0), &turned(10.0)), 0.0);
    assert!((iou(&turned(0.0), &turned(2.0)) - 1.0 / 3.0).abs() < 1e-14);
    // B6: 1, 0 and 0.04 there.
    assert!((iou(&quad(0.0, 0.0, 4.0, 2.0), &quad(2.0, 0.0, 4.0, 2.0)) - 1.0 / 3.0).abs() < 1e-14);
    assert!((iou(&quad(0.0, 0.0, 4.0, 2.0), &quad(0.0, 0.0, 2.0, 4.0)) - 1.0 / 3.0).abs() < 1e-14);
    assert_eq!(
        iou(&quad(0.0, 0.0, 100.0, 2.0), &quad(500.0, 0.0, 4.0, 2.0)),
        0.0
    );
    // B10: negative there at 1e5 in single precision.
    for far in [0.0_f32, 1e3, 3e3, 1e4, 1e5] {
        let a = ConvexPolygon::from(
            [(0., 0.), (4., 0.), (4., 2.), (0., 2.)].map(|(x, y)| Vec2::new(x + far, y + far)),
        );
        let b = ConvexPolygon::from(
            [(1., 0.5), (5., 0.5), (5., 2.5), (1., 2.5)].map(|(x, y)| Vec2::new(x + far, y + far)),
        );
        let found = iou_polygons(&a, &b);
        assert!((found - 4.5 / 11.5).abs() < 1e-6, "{far} {found}");
    }
    // B11: a crash, or areas of 1e30 times the true one, there.
    for small in [1e-4_f32, 1e-7, 1e-15, 1e-30] {
        let a = ConvexPolygon::from(
            [(0., 0.), (4., 0.), (4., 2.), (0., 2.)].map(|(x, y)| Vec2::new(x * small, y * small)),
        );
        let b = ConvexPolygon::from(
            [(1., 0.5), (5., 0.5), (5., 2.5), (1., 2.5)]
                .map(|(x, y)| Vec2::new(x * small, y * small)),
        );
        assert!((iou_polygons(&a, &b) - 4.5 / 11.5).abs() < 1e-6);
    }
    // B12: 1.232 there.
    let long = |t: f64| {
        ConvexPolygon::from(
            Obb2::new(0.0, 0.0, 60.0, 0.5, t)
                .corners()
                .map(|v| Vec2::new(v.x as f32, v.y as f32)),
        )
    };
    for turn in [0.0, 1e-7, 1e-6, 1e-5, 1e-4] {
        let found = iou_polygons(&long(0.7), &long(0.7 + turn));
        assert!(found <= 1.0 && found > 0.98, "{turn} {found}");
    }
    // B18: equal boxes pull on nothing.
    let (by_a, by_b) = iou_polygons_vjp(&quad(0.0, 0.0, 4.0, 2.0), &quad(0.0, 0.0, 4.0, 2.0), 1.0);
    assert!(
        by_a.vertices
            .iter()
            .chain(&by_b.vertices)
            .all(|v| v.length() < 1e-14)
    );
}

#[test]
fn sides_along_each_other_share_the_derivative() {
    let a = polygon(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]);
    let b = polygon(&[(1., 0.), (3., 0.), (3., 2.), (1., 2.)]);
    let (by_a, by_b) = intersection_area_polygons_vjp(&a, &b, 1.0);
    let value = intersection_area_polygons(&variables(&a, 0), &variables(&b, 24));
    let down: f64 = by_a.vertices[0].y + by_a.vertices[1].y;
    let other: f64 = by_b.vertices[0].y + by_b.vertices[1].y;
    assert!(
        (down + 0.5).abs() < 1e-14 && (other + 0.5).abs() < 1e-14,
        "{down} {other}"
    );
    assert!((value.derivative[1] + value.derivative[3] + 0.5).abs() < 1e-14);
}

/// A random convex quadrilateral, counter-clockwise: four points of an ellipse that is turned and moved.
fn quad(dice: &mut Dice) -> [Vec2<f64>; 4] {
    let mut angles = [(); 4].map(|()| dice.within(0.0, std::f64::consts::TAU));
    angles.sort_by(f64::total_cmp);
    let (wide, high) = (dice.within(0.5, 3.0), dice.within(0.5, 3.0));
    let (x, y) = (dice.within(-1.5, 1.5), dice.within(-1.5, 1.5));
    let (sin, cos) = dice.within(-3.0, 3.0).sin_cos();
    angles.map(|angle| {
        let (p, q) = (wide * angle.cos(), high * angle.sin());
        Vec2::new(x + p * cos - q * sin, y + p * sin + q * cos)
    })
}

fn as_polygon(vertices: [Vec2<f64>; 4]) -> ConvexPolygon<f64, 4> {
    ConvexPolygon { vertices, count: 4 }
}

#[test]
fn areas_of_quads_are_those_of_polygons() {
    let mut dice = Dice(41);
    let moved = |q: [Vec2<f64>; 4], x: f64, y: f64| q.map(|v| v + Vec2::new(x, y));
    let square = Aabb2::new(0.0, 0.0, 2.0, 1.0).corners();
    let diamond = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Vec2::new(x, y));
    let triangle = [square[0], square[1], square[2], square[2]];
    let mut all: Vec<_> = (0..3000)
        .map(|_| (quad(&mut dice), quad(&mut dice)))
        .collect();
    for x in [0.0, 0.5, 1.0, 2.0, 3.0, -2.0, 1e-9] {
        for y in [0.0, 1.0, -0.25, 1e-9] {
            for shape in [square, diamond, triangle] {
                all.extend([
                    (square, moved(shape, x, y)),
                    (moved(shape, x, y), square),
                    (diamond, moved(shape, x, y)),
                ]);
            }
        }
    }
    for _ in 0..200 {
        let a = quad(&mut dice);
        // Turned by next to nothing, inside, sharing a corner or a side, without an area.
        let turn = dice.within(-1e-9, 1e-9);
        let turned = a.map(|v| Vec2::new(v.x - turn * v.y, v.y + turn * v.x));
        let center = (a[0] + a[1] + a[2] + a[3]) * 0.25;
        let inside = a.map(|v| center + (v - center) * 0.5);
        let corner = a.map(|v| a[1] + (v - a[1]) * 0.7);
        let flat = [a[0], a[1], a[1], a[0]];
        all.extend([
            (a, turned),
            (a, inside),
            (inside, a),
            (a, corner),
            (corner, a),
            (a, flat),
            (flat, a),
            (a, a),
        ]);
    }
    for (a, b) in all {
        let truth = intersection_area_polygons(&as_polygon(a), &as_polygon(b));
        for unit in [1.0, 1e-150, 1e140] {
            let scaled = |q: [Vec2<f64>; 4]| q.map(|v| v * unit);
            let found = intersection_area_quads(scaled(a), scaled(b)) / unit / unit;
            assert!(
                (found - truth).abs() < 2e-14 * truth.max(1.0),
                "{a:?} {b:?} {found} {truth}"
            );
            assert!(truth > 0.0 || found < 1e-14, "{a:?} {b:?} {found}");
        }
        let narrow = |q: [Vec2<f64>; 4]| q.map(|v| Vec2::new(v.x as f32, v.y as f32));
        let found = f64::from(intersection_area_quads(narrow(a), narrow(b)));
        assert!((found - truth).abs() < 1e-5, "{a:?} {b:?} {found} {truth}");
    }
}

/// Which one is the first decides nothing: the smaller one is measured within the larger one.
#[test]
fn a_small_quad_in_a_large_one_keeps_its_digits() {
    let mut dice = Dice(44);
    for i in 0..400 {
        let ratio = 10_f64.powi(i % 7);
        let small = quad(&mut dice);
        let large = quad(&mut dice).map(|v| v * ratio);
        let exact = exact_area(&small, &large);
        for (a, b) in [(small, large), (large, small)] {
            let error = (intersection_area_quads(a, b) - exact).abs();
            assert!(error <= 1e-14 * ratio, "{a:?} {b:?}: {error} of {exact}");
        }
    }
}

#[test]
fn quads_that_are_apart_share_exactly_nothing() {
    let mut dice = Dice(43);
    let mut count = 0;
    for _ in 0..4000 {
        let (a, b) = (quad(&mut dice), quad(&mut dice));
        let way = Vec2::new(dice.within(-4.0, 4.0), dice.within(-4.0, 4.0));
        let b = b.map(|v| v + way);
        if exact_area(&a, &b) == 0.0 {
            assert_eq!(intersection_area_quads(a, b), 0.0, "{a:?} {b:?}");
            count += 1;
        }
    }
    assert!(count > 500, "{count}");
}

#[test]
fn derivatives_of_quads_are_those_of_polygons() {
    let mut dice = Dice(42);
    let cpu = geograd::kernels::Cpu::new();
    let (a, b): (Vec<_>, Vec<_>) = (0..500).map(|_| (quad(&mut dice), quad(&mut dice))).unzip();
    let op = geograd_tests::rows::IntersectionAreaQuads;
    let (values, (by_a, by_b)) = cpu
        .aligned(geograd::kernels::Op::value_grad(op), (&a, &b))
        .unwrap();
    for i in 0..a.len() {
        assert_eq!(values[i], intersection_area_quads(a[i], b[i]));
        let (p, q) = (as_polygon(a[i]), as_polygon(b[i]));
        let (p_bar, q_bar) = intersection_area_polygons_vjp(&p, &q, 1.0);
        let found = by_a[i].iter().chain(&by_b[i]);
        for (found, truth) in found.zip(p_bar.vertices.iter().chain(&q_bar.vertices)) {
            assert!(
                (*found - *truth).length() < 1e-11,
                "{:?} {:?} {found:?} {truth:?}",
                a[i],
                b[i]
            );
        }
    }
    // Identical ones: moving both changes nothing, and every derivative is half of that of the area.
    for a in a {
        let (_, (p, q)) = cpu
            .aligned(geograd::kernels::Op::value_grad(op), (&[a], &[a]))
            .unwrap();
        for (k, (p, q)) in p[0].iter().zip(&q[0]).enumerate() {
            let across = a[(k + 1) % 4] - a[(k + 3) % 4];
            let own = Vec2::new(across.y, -across.x) * 0.25;
            assert!(
                (*p - own).length() < 1e-11 && (*q - own).length() < 1e-11,
                "{p:?} {q:?} {own:?}"
            );
        }
    }
}

#[test]
fn a_speck_at_the_corner_of_a_continent_keeps_its_area_in_either_order() {
    // Seen from the larger one, what is shared is 10⁻²⁴ of its triangles.
    let speck = Aabb2::new(0.0, 0.0, 1e-6, 1e-6).corners();
    let speck = ConvexPolygon::<f64, 5>::try_new(&speck).unwrap();
    for shift in [-7e-7, -1.1e-8, 0.0, 1e-9, 2e-7] {
        let corners = [(0.0, shift), (2e6, 0.0), (1e6, 1e6)].map(|(x, y)| Vec2::new(x, y));
        let land = ConvexPolygon::<f64, 5>::try_new(&corners).unwrap();
        let known = exact_area(land.as_slice(), speck.as_slice());
        for found in [
            intersection_area_polygons(&speck, &land),
            intersection_area_polygons(&land, &speck),
        ] {
            assert!(
                (found - known).abs() < 1e-3 * 1e-12,
                "{shift} {found} {known}"
            );
        }
    }
}

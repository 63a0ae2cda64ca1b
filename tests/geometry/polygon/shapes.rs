//! Constructors, predicates, hulls, sums, measures and clips of polygons, against brute force.
use super::cases::{Polygon, any_ring, at, convex, hard, polygon, ring};
use super::exact;
use super::overlap::variables;
use geograd::ad::adjoint::clipping::clip_vjp;
use geograd::clipping::{
    ClipTrace, Corner, Side, clip, clip_replay, clip_search, half_plane_replay, half_plane_search,
};
use geograd::contain::{
    Location, contains, contains_even_odd, crossing, depth_search, locate, winding_number,
};
use geograd::hull::{
    hull, hull_area_search, hull_decided_in, hull_search, merge, merge_search, minkowski_sum,
    minkowski_sum_search,
};
use geograd::measure::circle::{Support, circle_replay, circle_search};
use geograd::measure::extent::{diameter_replay, diameter_search, width_replay, width_search};
use geograd::measure::moments::second_moments;
use geograd::measure::rectangle::{rectangle_replay, rectangle_search};
use geograd::measure::vertex_mean;
use geograd::predicate::{Turn, turn, turn_between};
use geograd::shape::edges;
use geograd::{Aabb2, ConvexPolygon, Flaw, Jet, Obb2, Validate, Vec2, VertexFault};
use geograd_tests::Dice;

fn fault(all: &[(f64, f64)]) -> (usize, VertexFault) {
    match Polygon::try_new(&ring(all)) {
        Err(Flaw::Vertex { index, fault }) => (index, fault),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_is_no_convex_polygon_is_refused_by_vertex() {
    let nan = f64::NAN;
    assert_eq!(
        fault(&[(0., 0.), (1., nan), (0., 1.)]),
        (1, VertexFault::NotFinite)
    );
    assert_eq!(fault(&[(0., 0.), (1., 0.)]), (2, VertexFault::Missing));
    assert_eq!(fault(&[]), (0, VertexFault::Missing));
    assert_eq!(
        fault(&[(0., 0.), (1., 0.), (1., 0.), (0., 1.)]),
        (1, VertexFault::Repeated)
    );
    assert_eq!(
        fault(&[(0., 0.), (1., 0.), (0., 1.), (0., 0.)]),
        (3, VertexFault::Repeated)
    );
    assert_eq!(
        fault(&[(0., 0.), (1., 0.), (2., 0.), (0., 1.)]),
        (1, VertexFault::Straight)
    );
    assert_eq!(
        fault(&[(0., 0.), (0., 1.), (1., 0.)]),
        (0, VertexFault::Clockwise)
    );
    assert_eq!(
        fault(&[(0., 0.), (2., 0.), (0.5, 0.5), (0., 2.)]),
        (2, VertexFault::Clockwise)
    );
    assert_eq!(fault(&[(0., 0.); 13]), (12, VertexFault::Surplus));
    // A pentagram turns left everywhere and runs around twice.
    let star: Vec<_> = (0..5)
        .map(|k| (k as f64 * 4.0 * std::f64::consts::PI / 5.0).sin_cos())
        .map(|(y, x)| (x, y))
        .collect();
    assert_eq!(fault(&star).1, VertexFault::SecondRound);
    // An ulp decides.
    let bent = |y: f64| Polygon::try_new(&ring(&[(0., 0.), (1e6, y), (2e6, 0.2), (1e6, 9.)]));
    assert!(bent(0.1).is_err());
    assert!(bent(0.1_f64.next_down()).is_ok());
    assert!(bent(0.1_f64.next_up()).is_err());
    let shape = ConvexPolygon {
        vertices: [at(0., 0.); 2],
        count: 5,
    };
    assert_eq!(
        shape.validate(),
        Err(Flaw::Vertex {
            index: 2,
            fault: VertexFault::Surplus
        })
    );
    assert_eq!(shape.as_slice().len(), 2);
    assert!(
        Flaw::Vertex {
            index: 2,
            fault: VertexFault::Clockwise
        }
        .to_string()
        .contains("vertex 2 turns")
    );
}

#[test]
fn cleaning_keeps_the_corners_of_either_orientation() {
    let mut dice = Dice(11);
    for _ in 0..500 {
        let shape = convex(&mut dice);
        // The same border with repeated vertices and middles that are exactly on it.
        let grid = |v: Vec2<f64>| at((v.x * 64.0).round(), (v.y * 64.0).round());
        let Ok((shape, _)) = Polygon::cleaned(
            &shape
                .as_slice()
                .iter()
                .map(|&v| grid(v) * 2.0)
                .collect::<Vec<_>>(),
        ) else {
            continue;
        };
        let mut full = vec![];
        for [start, end] in shape.edges() {
            for _ in 0..=dice.below(3) {
                full.push(start);
            }
            if dice.below(2) == 0 {
                full.push((start + end) * 0.5);
            }
        }
        let turned = dice.below(full.len());
        full.rotate_left(turned);
        if dice.below(2) == 0 {
            full.reverse();
        }
        let (cleaned, places) = Polygon::cleaned(&full).unwrap();
        assert!(cleaned.validate().is_ok());
        assert_eq!(cleaned.count, shape.count);
        for (vertex, place) in cleaned.as_slice().iter().zip(places) {
            assert_eq!(*vertex, full[place]);
            assert!(shape.as_slice().contains(vertex));
        }
        // No room for one more.
        assert!(ConvexPolygon::<f64, 2>::cleaned(&full).is_err());
    }
    assert!(Polygon::cleaned(&ring(&[(0., 0.), (1., 0.), (2., 0.)])).is_err());
    assert!(Polygon::cleaned(&ring(&[(0., 0.), (0., 0.), (0., 0.)])).is_err());
    assert!(Polygon::cleaned(&ring(&[(0., 0.), (2., 0.), (0.5, 0.5), (0., 2.)])).is_err());
    assert!(Polygon::cleaned(&[]).is_err());
    let tight = ring(&[
        (0., 0.),
        (1., 0.),
        (2., 0.),
        (2., 2.),
        (1., 2.),
        (0., 2.),
        (0., 1.),
    ]);
    assert_eq!(ConvexPolygon::<f64, 4>::cleaned(&tight).unwrap().0.count, 4);
}

#[test]
fn turns_are_exact() {
    let mut dice = Dice(12);
    for _ in 0..4000 {
        // Nearly collinear on purpose.
        let (a, b) = (
            at(dice.roll(), dice.roll()),
            at(dice.roll() * 40.0, dice.roll() * 40.0),
        );
        let t = dice.within(-2.0, 2.0);
        let mut c = a + (b - a) * t;
        if dice.below(2) == 0 {
            c.x = f64::from_bits(c.x.to_bits() + dice.below(3) as u64);
        }
        let scale: f64 = [1.0, 1e-90, 1e90][dice.below(3)];
        let big = exact::points(&[a, b, c]);
        let sign = exact::side(&big[0], &big[1], &big[2]).sign();
        let wanted = [Turn::Right, Turn::Straight, Turn::Left][(sign + 1) as usize];
        assert_eq!(turn(a, b, c), wanted);
        let scale = 2f64.powi(scale.log2() as i32);
        assert_eq!(turn(a * scale, b * scale, c * scale), wanted);
        assert_eq!(
            turn_between([a, b], [c, b]),
            turn_between([c, b], [a, b]).mirrored()
        );
    }
    for tiny in [1e-30_f32, 1e-20, 1e20, 1e30] {
        let p = |x: f32, y: f32| Vec2::new(x * tiny, y * tiny);
        assert_eq!(turn(p(0., 0.), p(1., 0.), p(1., 1.)), Turn::Left);
        assert_eq!(turn(p(0., 0.), p(1., 1.), p(3., 3.)), Turn::Straight);
    }
}

#[test]
fn hulls_are_those_of_brute_force() {
    let mut dice = Dice(13);
    for _ in 0..300 {
        let points = any_ring(&mut dice, 14);
        let truth = exact::hull(&points);
        let found: Vec<_> = hull_search(&points)
            .into_iter()
            .map(|k| points[k])
            .collect();
        assert_eq!(found, truth, "{points:?}");
        let (area, record) = hull_area_search(&points);
        assert!((area - exact::ring_area(&truth)).abs() < 1e-12);
        assert!(record.len() == truth.len());
        if truth.len() > 2 {
            assert!(ConvexPolygon::<f64, 14>::try_new(&found).is_ok());
            for &point in &points {
                assert!(contains(&[&truth], point));
            }
        }
    }
    assert!(hull_search::<f64>(&[]).is_empty());
    assert_eq!(hull_search(&[at(1., 1.); 4]).len(), 1);
    assert_eq!(
        hull_search(&ring(&[(2., 2.), (0., 0.), (1., 1.), (2., 2.)])).len(),
        2
    );
    assert!(hull_decided_in(&[at(0., 0.); 3], &mut [0; 2]).is_err());
    assert!(hull::<f64, 2>(&ring(&[(0., 0.), (1., 0.), (0., 1.)])).is_err());
}

#[test]
fn merged_hulls_have_all_vertices_of_both_inside() {
    let mut dice = Dice(14);
    let random = (0..150).map(|_| (convex(&mut dice), convex(&mut dice)));
    for (a, b) in random.collect::<Vec<_>>().into_iter().chain(hard()) {
        let both: ConvexPolygon<f64, 24> = merge(&a, &b).unwrap();
        let all: Vec<_> = a.as_slice().iter().chain(b.as_slice()).copied().collect();
        assert_eq!(both.as_slice(), exact::hull(&all));
        let trace = merge_search::<_, 12, 12, 24>(&a, &b).unwrap();
        assert!(
            trace.corners[..trace.count]
                .iter()
                .all(|c| !matches!(c, Corner::Cross { .. }))
        );
    }
    // B5: no vertices and an infinite score there.
    let quad = |x: f64| {
        ConvexPolygon::from(Obb2::new(
            x * 0.3_f64.cos(),
            x * 0.3_f64.sin(),
            4.0,
            2.0,
            0.3,
        ))
    };
    let both: ConvexPolygon<f64, 8> = merge(&quad(0.0), &quad(10.0)).unwrap();
    assert!((both.area() - 28.0).abs() < 1e-12);
    assert!(merge::<_, 4, 4, 7>(&quad(0.0), &quad(1.0)).is_err());
}

#[test]
fn minkowski_sums_are_hulls_of_all_sums() {
    let mut dice = Dice(15);
    let random = (0..60).map(|_| (convex(&mut dice), convex(&mut dice)));
    for (a, b) in random.collect::<Vec<_>>().into_iter().chain(hard()) {
        let sum: ConvexPolygon<f64, 24> = minkowski_sum(&a, &b).unwrap();
        let all: Vec<_> = a
            .as_slice()
            .iter()
            .flat_map(|&p| b.as_slice().iter().map(move |&q| p + q))
            .collect();
        let truth = exact::hull(&all);
        let area = exact::ring_area(&truth);
        assert!(
            (sum.area() - area).abs() <= 1e-12 * area.max(1.0),
            "{a:?} {b:?} {sum:?}"
        );
        let trace = minkowski_sum_search::<_, 12, 12, 24>(&a, &b).unwrap();
        assert!(trace.count <= a.count + b.count);
    }
    let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
    assert_eq!(
        minkowski_sum::<_, 4, 4, 4>(&square, &square)
            .unwrap()
            .area(),
        4.0
    );
    assert!(
        minkowski_sum::<f64, 4, 12, 4>(&square, &polygon(&[(0., 0.), (2., 1.), (0., 2.)])).is_err()
    );
}

#[test]
fn clips_are_those_of_the_oracle_with_provenance() {
    let mut dice = Dice(16);
    let random = (0..700).map(|_| {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        if dice.below(2) == 0 {
            return (a, b);
        }
        // On a coarse grid: touching, collinear and identical edges.
        let snap = |p: Polygon| {
            let all: Vec<_> = p
                .as_slice()
                .iter()
                .map(|v| at(v.x.round(), v.y.round()))
                .collect();
            Polygon::cleaned(&all).map_or(polygon(&[(0., 0.), (2., 0.), (0., 2.)]), |(p, _)| p)
        };
        (snap(a), snap(b))
    });
    let valid = hard()
        .into_iter()
        .filter(|(a, b)| a.validate().is_ok() && b.validate().is_ok());
    let mut kinds = [0; 4];
    for (a, b) in random.collect::<Vec<_>>().into_iter().chain(valid) {
        let truth = exact::clipped(a.as_slice(), b.as_slice());
        let trace: ClipTrace<24> = clip_search(&a, &b).unwrap();
        let found = clip_replay(&a, &b, &trace);
        let area = exact::area(&truth).to_f64();
        let size = a.bounding().size().x.max(1.0) + b.bounding().size().x;
        assert!(
            (found.area() - area).abs() <= 1e-13 * size * size.min(8.0),
            "{a:?} {b:?} {trace:?} {} {area}",
            found.area()
        );
        kinds[trace.count.min(3)] += 1;
        // Every vertex of the exact result is one of ours and the other way round.
        let truth: Vec<_> = truth
            .iter()
            .map(|p| at(p[0].to_f64(), p[1].to_f64()))
            .collect();
        let near = |p: Vec2<f64>, all: &[Vec2<f64>]| {
            all.iter().map(|&q| p.distance(q)).fold(9e9, f64::min)
        };
        let shaky = a.area().min(b.area()) < 0.5 || area < 1e-9;
        if found.count < 3 {
            let crossed = a.edges().any(|[p, q]| {
                b.edges().any(|[r, s]| {
                    turn(p, q, r) == turn(p, q, s).mirrored()
                        && turn(r, s, p) == turn(r, s, q).mirrored()
                        && turn(p, q, r) != Turn::Straight
                        && turn(r, s, p) != Turn::Straight
                })
            });
            let mut shared: Vec<_> = a.as_slice().iter().filter(|&&p| b.contains(p)).collect();
            shared.extend(
                b.as_slice()
                    .iter()
                    .filter(|&&p| a.contains(p) && !a.as_slice().contains(&p)),
            );
            assert!(
                !crossed && shared.len() == found.count,
                "{a:?} {b:?} {trace:?}"
            );
            assert!(found.as_slice().iter().all(|p| shared.contains(&p)));
        }
        for &p in found.as_slice() {
            assert!(shaky || near(p, &truth) < 1e-9 * size, "{a:?} {b:?} {p}");
        }
        for &p in &truth {
            assert!(
                shaky || near(p, found.as_slice()) < 1e-9 * size,
                "{a:?} {b:?} {trace:?} {p}"
            );
        }
        // No vertex twice; sides lie on the edges they name.
        for k in 0..trace.count {
            assert!(!trace.corners[..k].contains(&trace.corners[k]), "{trace:?}");
            if trace.count > 1 {
                let [start, end] = match trace.sides[k] {
                    Side::A(i) => [a.vertex(i), a.vertex(i + 1)],
                    Side::B(j) => [b.vertex(j), b.vertex(j + 1)],
                };
                let along = (end - start) * (1.0 / start.distance(end));
                for p in [found.vertex(k), found.vertex(k + 1)] {
                    let off = along.perp_dot(p - start).abs();
                    assert!(off < 1e-9 * size, "{a:?} {b:?} {trace:?} {k} {off}");
                }
            }
        }
        let other: ConvexPolygon<f64, 24> = clip(&b, &a).unwrap();
        assert_eq!(other.count, found.count);
        if found.count > 0 && found.count < 3 {
            assert_eq!(area, 0.0);
        }
    }
    assert!(kinds.iter().all(|&k| k > 10), "{kinds:?}");
    assert!(
        clip::<_, 12, 12, 3>(
            &polygon(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]),
            &polygon(&[(1., -1.), (3., 1.), (1., 3.), (-1., 1.)])
        )
        .is_err()
    );
}

#[test]
fn derivatives_of_a_clip_come_back_through_its_adjoint() {
    let mut dice = Dice(17);
    for _ in 0..60 {
        let (a, b) = (convex(&mut dice), convex(&mut dice));
        let trace: ClipTrace<24> = clip_search(&a, &b).unwrap();
        let bars: [Vec2<f64>; 24] =
            std::array::from_fn(|_| at(dice.within(-1., 1.), dice.within(-1., 1.)));
        let value = clip_replay(&variables(&a, 0), &variables(&b, 24), &trace);
        let (by_a, by_b) = clip_vjp(&a, &b, &trace, &bars);
        for (m, v) in by_a.vertices.iter().chain(&by_b.vertices).enumerate() {
            let (mut x, mut y) = (0.0, 0.0);
            for (p, bar) in value.as_slice().iter().zip(&bars) {
                x += p.x.derivative[2 * m] * bar.x + p.y.derivative[2 * m] * bar.y;
                y += p.x.derivative[2 * m + 1] * bar.x + p.y.derivative[2 * m + 1] * bar.y;
            }
            let slack = 1e-9 * (1.0 + x.abs() + y.abs());
            assert!(
                (v.x - x).abs() < slack && (v.y - y).abs() < slack,
                "{v} {x} {y}"
            );
        }
    }
}

#[test]
fn half_planes_cut_as_the_oracle_does() {
    let mut dice = Dice(18);
    for _ in 0..500 {
        let a = convex(&mut dice);
        let snap = dice.below(2) == 0;
        let snapped = |v: Vec2<f64>| {
            if snap {
                at(v.x.round(), v.y.round())
            } else {
                v
            }
        };
        let Ok((a, _)) =
            Polygon::cleaned(&a.as_slice().iter().map(|&v| snapped(v)).collect::<Vec<_>>())
        else {
            continue;
        };
        let line = [
            snapped(at(dice.within(-3., 3.), dice.within(-3., 3.))),
            snapped(at(dice.within(-3., 3.), dice.within(-3., 3.))),
        ];
        if line[0] == line[1] {
            continue;
        }
        let trace: ClipTrace<13> = half_plane_search(&a, line).unwrap();
        let found = half_plane_replay(&a, line, &trace);
        let big = exact::points(&line);
        let truth = exact::cut(&exact::points(a.as_slice()), &big[0], &big[1]);
        assert!((found.area() - exact::area(&truth).to_f64()).abs() < 1e-12);
        let back: ClipTrace<13> = half_plane_search(&a, [line[1], line[0]]).unwrap();
        let rest = half_plane_replay(&a, line, &back);
        assert!((found.area() + rest.area() - a.area()).abs() < 1e-12);
        for k in 0..trace.count {
            if let Side::B(_) = trace.sides[k] {
                let off = (line[1] - line[0]).perp_dot(found.vertex(k + 1) - line[0]);
                assert!(off.abs() < 1e-9);
            }
        }
    }
}

#[test]
fn points_are_where_the_rings_wind_around_them() {
    let mut dice = Dice(19);
    for _ in 0..600 {
        let (p, q) = (any_ring(&mut dice, 9), any_ring(&mut dice, 5));
        let mut point = at(dice.within(-3., 3.), dice.within(-3., 3.));
        if dice.below(2) == 0 {
            point = at(point.x.round(), point.y.round());
        }
        // The independent way: the sum of angles.
        let angles: f64 = edges(&p)
            .chain(edges(&q))
            .map(|[a, b]| (a - point).angle_to(b - point))
            .sum();
        let on_border = edges(&p).chain(edges(&q)).any(|[a, b]| {
            let big = exact::points(&[a, b, point]);
            exact::side(&big[0], &big[1], &big[2]).sign() == 0 && (a - point).dot(b - point) <= 0.0
        });
        let truth = (angles / (2.0 * std::f64::consts::PI)).round() as i32;
        let found = locate(&[&p, &q], point);
        if on_border {
            assert_eq!(found, Location::Border);
            assert!(contains_even_odd(&[&p, &q], point));
            continue;
        }
        assert_eq!(found, Location::Off(truth), "{p:?} {q:?} {point}");
        assert_eq!(contains(&[&p, &q], point), truth != 0);
        assert_eq!(contains_even_odd(&[&p, &q], point), truth % 2 != 0);
        let sum: f64 = edges(&p)
            .chain(edges(&q))
            .map(|[a, b]| crossing(a, b, point))
            .sum();
        assert_eq!(sum, f64::from(truth));
    }
    let square = Aabb2::new(0.0, 0.0, 1.0, 1.0).corners();
    assert_eq!(winding_number(&square, at(0.5, 1.0)), None);
    assert_eq!(winding_number(&square, at(0.5, 0.5)), Some(1));
    assert_eq!(locate::<f64>(&[], at(0.0, 0.0)), Location::Off(0));
}

#[test]
fn depth_is_the_least_distance_with_the_right_sign() {
    // B3: +1 there for the first.
    let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 1.0, 1.0));
    assert_eq!(square.depth(at(2.0, 0.0)), -1.0);
    assert_eq!(square.depth(at(2.0, 0.5)), -1.0);
    let mut dice = Dice(20);
    for _ in 0..200 {
        let (p, point) = (
            any_ring(&mut dice, 8),
            at(dice.within(-4., 4.), dice.within(-4., 4.)),
        );
        let mut least = f64::INFINITY;
        for [a, b] in edges(&p) {
            for k in 0..=1000 {
                least = least.min(point.distance(a + (b - a) * (k as f64 / 1000.0)));
            }
        }
        let (value, record) = depth_search(&[&p], point).unwrap();
        assert!((value.abs() - least).abs() < 1e-2 && value.abs() <= least + 1e-12);
        assert_eq!(value > 0.0, contains(&[&p], point));
        // The derivative is of length one.
        let lifted: Vec<_> = p
            .iter()
            .map(|v| Vec2::new(Jet::<f64, 2>::variable(v.x, 9), Jet::variable(v.y, 9)))
            .collect();
        let at_point = Vec2::new(Jet::variable(point.x, 0), Jet::variable(point.y, 1));
        let derivative = geograd::contain::depth_replay(&[&lifted], at_point, record).derivative;
        assert!((derivative[0].hypot(derivative[1]) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn moments_are_those_of_triangles_and_turn_with_the_shape() {
    let mut dice = Dice(21);
    for _ in 0..300 {
        let a = convex(&mut dice);
        let found = a.second_moments();
        // Independent: over a fan of triangles about the centroid, by the rule of the midpoints.
        let center = a.centroid();
        let (mut xx, mut yy, mut xy) = (0.0, 0.0, 0.0);
        for [p, q] in a.edges() {
            let (p, q) = (p - center, q - center);
            let area = p.perp_dot(q) / 2.0;
            for m in [p * 0.5, q * 0.5, (p + q) * 0.5] {
                xx += area / 3.0 * m.x * m.x;
                yy += area / 3.0 * m.y * m.y;
                xy += area / 3.0 * m.x * m.y;
            }
        }
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-12 * (1.0 + xx + yy), "{x} {y}");
        close(found.xx, xx);
        close(found.yy, yy);
        close(found.xy, xy);
        let axes = found.principal_axes();
        close(axes.major + axes.minor, xx + yy);
        close(axes.major * axes.minor, xx * yy - xy * xy);
        let (sin, cos) = axes.angle.sin_cos();
        close(
            xx * cos * cos + 2.0 * xy * sin * cos + yy * sin * sin,
            axes.major,
        );
        // Far away, and with a hole.
        let far: Vec<_> = a.as_slice().iter().map(|&v| v + at(1e6, -1e6)).collect();
        assert!((second_moments(&[&far]).xx - xx).abs() < 1e-6);
        let mut hole: Vec<_> = a
            .as_slice()
            .iter()
            .map(|&v| center + (v - center) * 0.5)
            .collect();
        hole.reverse();
        close(second_moments(&[a.as_slice(), &hole]).xx, xx * 15.0 / 16.0);
        let by = at(2.0, 3.0);
        close(found.displaced(a.area(), by).xy, xy + a.area() * 6.0);
    }
    let none = second_moments::<f64>(&[]);
    assert_eq!((none.xx, none.yy, none.xy), (0.0, 0.0, 0.0));
    let square = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 2.0, 2.0));
    let lifted = ConvexPolygon {
        vertices: square
            .vertices
            .map(|v| Vec2::new(Jet::<f64, 1>::variable(v.x, 0), Jet::variable(v.y, 0))),
        count: 4,
    };
    let axes = lifted.second_moments().principal_axes();
    assert!(axes.angle.derivative[0].is_finite() && axes.major.derivative[0].is_finite());
    assert_eq!(vertex_mean::<f64>(&[]), at(0.0, 0.0));
    // B9: the mean of the vertices is not the centroid.
    let tail = polygon(&[(0., 0.), (1., 0.), (1., 0.5), (0.5, 1.), (0., 1.)]);
    assert!(tail.centroid().distance(tail.vertex_mean()) > 0.05);
}

fn brute_extents(points: &[Vec2<f64>]) -> (f64, f64, f64, f64) {
    let n = points.len();
    let mut diameter = 0.0_f64;
    let (mut width, mut area) = (f64::INFINITY, f64::INFINITY);
    for i in 0..n {
        for j in 0..n {
            diameter = diameter.max(points[i].distance(points[j]));
            if points[i] == points[j] {
                continue;
            }
            let axis = (points[j] - points[i]) * (1.0 / points[i].distance(points[j]));
            let over = |f: &dyn Fn(Vec2<f64>) -> f64| {
                let all = points.iter().map(|&p| f(p));
                let (low, high) = all.fold((f64::INFINITY, -f64::INFINITY), |(l, h), x| {
                    (l.min(x), h.max(x))
                });
                high - low
            };
            let (along, across) = (
                over(&|p| axis.dot(p - points[0])),
                over(&|p| axis.perp_dot(p - points[0])),
            );
            // Only directions of hull edges are candidates.
            let hull_edge = points
                .iter()
                .all(|&p| axis.perp_dot(p - points[i]) >= -1e-12);
            if hull_edge {
                width = width.min(across);
                area = area.min(along * across);
            }
        }
    }
    // The circle: over all pairs and triples.
    let mut radius = f64::INFINITY;
    let fits = |c: Vec2<f64>, r: f64| {
        points
            .iter()
            .all(|&p| p.distance(c) <= r * (1.0 + 1e-9) + 1e-12)
    };
    for i in 0..n {
        for j in 0..n {
            let (c, r) = (
                (points[i] + points[j]) * 0.5,
                points[i].distance(points[j]) * 0.5,
            );
            if fits(c, r) {
                radius = radius.min(r);
            }
            for k in 0..j {
                let (q, r) = (points[j] - points[i], points[k] - points[i]);
                let d = 2.0 * q.perp_dot(r);
                if d != 0.0 {
                    let c = at(
                        r.y * q.dot(q) - q.y * r.dot(r),
                        q.x * r.dot(r) - r.x * q.dot(q),
                    ) * (1.0 / d);
                    if fits(points[i] + c, c.length()) {
                        radius = radius.min(c.length());
                    }
                }
            }
        }
    }
    (diameter, width, area, radius)
}

#[test]
fn extents_are_those_of_brute_force() {
    let mut dice = Dice(22);
    for _ in 0..150 {
        let points = any_ring(&mut dice, 11);
        let (diameter, width, area, radius) = brute_extents(&points);
        let close = |x: f64, y: f64| assert!((x - y).abs() < 1e-9, "{x} {y} {points:?}");
        close(diameter_search(&points).unwrap().0, diameter);
        let (circle, _) = circle_search(&points).unwrap();
        close(circle.radius, radius);
        for &p in &points {
            assert!(p.distance(circle.center) <= circle.radius * (1.0 + 1e-12) + 1e-12);
        }
        if hull_search(&points).len() < 3 {
            assert!(width_search(&points).is_none() && rectangle_search(&points).is_none());
            continue;
        }
        close(width_search(&points).unwrap().0, width);
        let (around, _) = rectangle_search(&points).unwrap();
        close(around.area(), area);
        let wider = Obb2 {
            size: around.size + at(1e-9, 1e-9),
            ..around
        };
        assert!(points.iter().all(|&p| wider.contains(p)));
    }
    // B8: no end there.
    let flat = ConvexPolygon::from(Aabb2::new(0.0, 0.0, 4.0, 0.0));
    assert_eq!(diameter_search(flat.as_slice()).unwrap().0, 4.0);
    assert!(diameter_search::<f64>(&[]).is_none() && circle_search::<f64>(&[]).is_none());
    assert_eq!(diameter_search(&[at(1., 1.)]).unwrap().0, 0.0);
    let (circle, support) = circle_search(&[at(1., 1.); 3]).unwrap();
    assert!(circle.radius == 0.0 && matches!(support, Support::One(_)));
}

#[test]
fn extents_have_the_derivatives_of_their_vertices() {
    let mut dice = Dice(23);
    for _ in 0..30 {
        let a = convex(&mut dice);
        let points = a.as_slice();
        let lifted = variables(&a, 0);
        let lifted = lifted.as_slice();
        let of = |values: [f64; 4],
                  derivatives: [Jet<f64, 48>; 4],
                  moved: &dyn Fn(&[Vec2<f64>]) -> [f64; 4]| {
            for k in 0..2 * points.len() {
                let step = 1e-6;
                let shifted = |by: f64| {
                    let mut all = points.to_vec();
                    match k % 2 {
                        0 => all[k / 2].x += by,
                        _ => all[k / 2].y += by,
                    }
                    moved(&all)
                };
                let (up, down) = (shifted(step), shifted(-step));
                for m in 0..4 {
                    let difference = (up[m] - down[m]) / (2.0 * step);
                    let kink = (up[m] + down[m] - 2.0 * values[m]).abs() / step;
                    let found = derivatives[m].derivative[k];
                    assert!(
                        (found - difference).abs() < 1e-4 * (1.0 + found.abs()) + 1.01 * kink,
                        "{m} {found} {difference} {kink}"
                    );
                }
            }
        };
        let (diameter, farthest) = diameter_search(points).unwrap();
        let (width, narrowest) = width_search(points).unwrap();
        let (rectangle, resting) = rectangle_search(points).unwrap();
        let (circle, support) = circle_search(points).unwrap();
        of(
            [diameter, width, rectangle.area(), circle.radius],
            [
                diameter_replay(lifted, farthest),
                width_replay(lifted, narrowest),
                rectangle_replay(lifted, resting).area(),
                circle_replay(lifted, support).radius,
            ],
            &|p| {
                [
                    diameter_search(p).unwrap().0,
                    width_search(p).unwrap().0,
                    rectangle_search(p).unwrap().0.area(),
                    circle_search(p).unwrap().0.radius,
                ]
            },
        );
    }
}

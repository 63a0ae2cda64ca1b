//! Boolean operations of polygons of any kind, against an oracle, and their derivatives.
use super::cases::{any_ring, at, hard_rings, ring, stars};
use super::rings::{differences, made, moved, zeros};
use super::scanline::{self, Ring};
use geograd::ad::adjoint::boolean::overlay_vjp;
use geograd::ad::adjoint::ring::signed_area_vjp;
use geograd::boolean::{
    BooleanOperation, EdgeId, Origin, Owner, VertexId, iou_replay, iou_search, overlay_replay,
    overlay_search,
};
use geograd::error::{Argument, Flaw, VertexFault};
use geograd::polygon::{self, Fill};
use geograd::{Error, Pack, Polygon, Scalar, Vec2};
use geograd_tests::Dice;

/// The operations, and which of the areas in a only, in both and in b only belong to the result.
pub const OPERATIONS: [(BooleanOperation, [bool; 3]); 4] = [
    (BooleanOperation::Union, [true, true, true]),
    (BooleanOperation::Intersection, [false, true, false]),
    (BooleanOperation::Difference, [true, false, false]),
    (BooleanOperation::SymmetricDifference, [true, false, true]),
];

fn any(dice: &mut Dice) -> Vec<Ring> {
    (0..1 + dice.below(2)).map(|_| any_ring(dice, 9)).collect()
}

/// Rings of fewer than three distinct vertices are refused.
fn valid(rings: &[Ring]) -> bool {
    geograd::Rings::from(rings).validate().is_ok()
}

pub fn cases(dice: &mut Dice) -> Vec<(Vec<Ring>, Vec<Ring>)> {
    let mut all: Vec<_> = (0..40).map(|_| (stars(dice), stars(dice))).collect();
    all.extend((0..60).map(|_| (any(dice), any(dice))));
    let hard = hard_rings();
    for a in &hard {
        all.extend(hard.iter().map(|b| (a.clone(), b.clone())));
    }
    all.retain(|(a, b)| valid(a) && valid(b));
    all
}

fn result(
    a: &Polygon<f64>,
    b: &Polygon<f64>,
    operation: BooleanOperation,
    fill: Fill,
) -> Polygon<f64> {
    overlay_replay(a, b, &overlay_search(a, b, operation, fill).unwrap())
}

#[test]
fn areas_are_those_of_the_oracle() {
    if !geograd_tests::is_due("areas_are_those_of_the_oracle") {
        return;
    }
    let mut dice = Dice(1);
    for (k, (a, b)) in cases(&mut dice).into_iter().enumerate() {
        let fill = [Fill::NonZero, Fill::EvenOdd][k % 2];
        let judge = |a: &[Ring], b: &[Ring], areas: [f64; 3], scale: f64, near: f64| {
            for (operation, kept) in OPERATIONS {
                let truth: f64 = (0..3).filter(|&i| kept[i]).map(|i| areas[i]).sum();
                let result = result(&made(a), &made(b), operation, fill);
                let found = polygon::signed_area(&result) / scale / scale;
                assert!(
                    (found - truth).abs() < near * (1.0 + truth),
                    "{k} {operation:?} {fill:?} {found} {truth} {a:?} {b:?}"
                );
            }
        };
        let truth = scanline::areas(&a, &b, fill);
        judge(&a, &b, truth, 1.0, 1e-12);
        // Tiny, huge and far away.
        let origin = at(0.0, 0.0);
        for (scale, near) in [
            (2f64.powi(-20), 1e-12),
            (2f64.powi(200), 1e-12),
            (1e-6, 1e-10),
        ] {
            let (a, b) = (moved(&a, origin, scale), moved(&b, origin, scale));
            judge(&a, &b, truth, scale, near);
        }
        if k % 8 == 0 {
            let (a, b) = (moved(&a, at(1e6, -1e6), 1.0), moved(&b, at(1e6, -1e6), 1.0));
            judge(&a, &b, scanline::areas(&a, &b, fill), 1.0, 1e-8);
        }
    }
}

/// Two squares, one turned by a little: nearly parallel edges cross in the middle of each other.
#[test]
fn nearly_parallel_edges_have_their_derivatives() {
    let square = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)];
    let a = made(&[ring(&square)]);
    for angle in [1e-3_f64, 1e-5, 1e-7, 1e-9, 1e-12, 1e-15, 1e-17] {
        let (sin, cos) = angle.sin_cos();
        let turned = square.map(|(x, y)| (cos * x - sin * y, sin * x + cos * y));
        let b = made(&[ring(&turned)]);
        for operation in [BooleanOperation::Union, BooleanOperation::Intersection] {
            let trace = overlay_search(&a, &b, operation, Fill::NonZero).unwrap();
            let found = by_duals(&a, &b, &trace, |p| polygon::signed_area(p));
            // By the motion of borders, in which no crossing is differentiated.
            let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
            let vjp = match operation {
                BooleanOperation::Union => geograd::ad::adjoint::overlap_rings::union_area_vjp,
                _ => geograd::ad::adjoint::overlap_rings::intersection_area_vjp,
            };
            vjp(&a, &b, 1.0, &mut a_bar, &mut b_bar);
            for (found, expected) in found.iter().zip((a_bar, b_bar).scalars()) {
                // Below that the vertices themselves are rounded by more than the edges turn.
                let near = match angle < 1e-13 {
                    true => 1.0,
                    false => 1e-9 + 1e-15 / angle,
                };
                assert!(
                    (found - expected).abs() < near.max(angle * 1e-6),
                    "{angle} {operation:?} {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn results_add_up_and_grow() {
    let mut dice = Dice(2);
    for _ in 0..60 {
        let [a, b, c] = [(); 3].map(|()| made(&stars(&mut dice)));
        let fill = Fill::EvenOdd;
        let area = |a: &_, b: &_, operation| polygon::area(&result(a, b, operation, fill));
        let shared = area(&a, &b, BooleanOperation::Intersection);
        let rest = area(&a, &b, BooleanOperation::Difference);
        assert!((shared + rest - polygon::area(&a)).abs() < 1e-12);
        let all = area(&a, &b, BooleanOperation::Union);
        assert!((all - shared - area(&a, &b, BooleanOperation::SymmetricDifference)).abs() < 1e-12);
        assert!((area(&b, &a, BooleanOperation::Union) - all).abs() < 1e-12);
        // A part shares less than the whole.
        let part = result(&a, &c, BooleanOperation::Intersection, fill);
        if part.rings().validate().is_ok() {
            assert!(area(&part, &b, BooleanOperation::Intersection) <= shared + 1e-12);
            assert!(area(&part, &a, BooleanOperation::Difference) < 1e-12);
        }
        // Parts run counter-clockwise, their holes clockwise.
        let trace = overlay_search(&a, &b, BooleanOperation::Union, fill).unwrap();
        let union = overlay_replay(&a, &b, &trace);
        let mut rings = 0;
        for part in trace.parts() {
            for k in part.clone() {
                let area = geograd::ring::signed_area(union.ring(k));
                assert!((area > 0.0) == (k == part.start), "{area}");
                rings += 1;
            }
        }
        assert_eq!(
            (rings, union.vertices().len()),
            (union.rings().count(), trace.vertex_count())
        );
        // Overlap without clipping has the same.
        let found = geograd::overlap_polygon::holed::intersection_area(&a, &b);
        assert!((found - shared).abs() < 1e-12);
    }
}

/// Derivatives of a function of the result by duals through the replay.
fn by_duals<
    S: Fn(&Polygon<geograd::ad::forward::First<f64>>) -> geograd::ad::forward::First<f64>,
>(
    a: &Polygon<f64>,
    b: &Polygon<f64>,
    trace: &geograd::boolean::OverlayTrace,
    f: S,
) -> Vec<f64> {
    let both = (a.clone(), b.clone());
    let of = |(a, b): (Polygon<_>, Polygon<_>)| f(&overlay_replay(&a, &b, trace));
    geograd::gradient(of, both).1.scalars()
}

fn centroid_x<S: Scalar<Mask = bool>>(p: &Polygon<S>) -> S {
    polygon::centroid(p).x
}

/// `true` if small moves of all vertices leave the number of vertices of the result.
fn is_safe(a: &Polygon<f64>, b: &Polygon<f64>, operation: BooleanOperation, fill: Fill) -> bool {
    let trace = |a: &_, b: &_| overlay_search(a, b, operation, fill).unwrap();
    let mut dice = Dice(9);
    let known = trace(a, b);
    (0..40).all(|_| {
        let near =
            |p: &Polygon<f64>, dice: &mut Dice| p.remake(&mut |x| x + dice.within(-1e-4, 1e-4));
        trace(&near(a, &mut dice), &near(b, &mut dice)).vertex_count() == known.vertex_count()
    })
}

#[test]
fn derivatives_are_differences_of_the_operation() {
    if !geograd_tests::is_due("derivatives_are_differences_of_the_operation") {
        return;
    }
    let (mut dice, mut tried) = (Dice(3), 0);
    while tried < 16 {
        let (a, b) = match tried % 2 {
            0 => (made(&stars(&mut dice)), made(&stars(&mut dice))),
            _ => (made(&any(&mut dice)), made(&any(&mut dice))),
        };
        let (operation, fill) = (OPERATIONS[tried % 4].0, Fill::EvenOdd);
        if !(a.rings().validate().is_ok() && b.rings().validate().is_ok()) {
            continue;
        }
        if !is_safe(&a, &b, operation, fill) {
            continue;
        }
        tried += 1;
        let trace = overlay_search(&a, &b, operation, fill).unwrap();
        let close = |found: &[f64], expected: &[f64], near: f64| {
            for (found, expected) in found.iter().zip(expected) {
                let near = near * (1.0 + expected.abs());
                assert!(
                    (found - expected).abs() < near,
                    "{operation:?} {found} {expected} {a:?} {b:?}"
                );
            }
        };
        let shape = overlay_replay(&a, &b, &trace);
        if polygon::signed_area(&shape) < 0.05 {
            continue;
        }
        type Measure = fn(&Polygon<f64>) -> f64;
        let measures: [Measure; 3] = [
            |p| polygon::signed_area(p),
            |p| polygon::perimeter(p),
            centroid_x,
        ];
        let duals = [
            by_duals(&a, &b, &trace, |p| polygon::signed_area(p)),
            by_duals(&a, &b, &trace, |p| polygon::perimeter(p)),
            by_duals(&a, &b, &trace, centroid_x),
        ];
        for (f, duals) in measures.into_iter().zip(&duals) {
            let again = |a: &_, b: &_| f(&result(a, b, operation, fill));
            close(duals, &differences(again, &a, &b, 1e-6), 1e-5);
        }
        // The adjoint, ring by ring.
        let mut bars = Vec::new();
        for ring in shape.rings().iter() {
            let mut ring_bar = vec![Vec2::zero(); ring.len()];
            signed_area_vjp(ring, 1.0, &mut ring_bar);
            bars.extend(ring_bar);
        }
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
        overlay_vjp(&a, &b, &trace, &bars, &mut a_bar, &mut b_bar);
        close(&(a_bar, b_bar).scalars(), &duals[0], 1e-11);
        let (value, record) = iou_search(&a, &b, fill).unwrap();
        let of = |(a, b): (Polygon<_>, Polygon<_>)| iou_replay(&a, &b, &record);
        let (same, derivatives) = geograd::gradient(of, (a.clone(), b.clone()));
        assert_eq!(value, same);
        let again = |a: &_, b: &_| iou_search(a, b, fill).unwrap().0;
        close(
            &derivatives.scalars(),
            &differences(again, &a, &b, 1e-6),
            1e-5,
        );
    }
}

/// Any function of the vertices of a result, by the adjoint and by duals, for every way in which a vertex
/// can come about.
#[test]
fn the_adjoint_is_that_of_the_replay() {
    if !geograd_tests::is_due("the_adjoint_is_that_of_the_replay") {
        return;
    }
    let mut dice = Dice(4);
    for (k, (a, b)) in cases(&mut dice).into_iter().enumerate() {
        let (a, b) = (made(&a), made(&b));
        let (operation, _) = OPERATIONS[k % 4];
        let trace = overlay_search(&a, &b, operation, Fill::EvenOdd).unwrap();
        let weights: Vec<_> = (0..trace.vertex_count())
            .map(|_| at(dice.within(-1.0, 1.0), dice.within(-1.0, 1.0)))
            .collect();
        let duals = by_duals(&a, &b, &trace, |p| {
            let terms = p.vertices().iter().zip(&weights);
            terms.fold(Scalar::zero(), |sum, (v, w)| {
                sum + v.x * Scalar::lit(w.x) + v.y * Scalar::lit(w.y)
            })
        });
        let (mut a_bar, mut b_bar) = (zeros(&a), zeros(&b));
        overlay_vjp(&a, &b, &trace, &weights, &mut a_bar, &mut b_bar);
        for (found, expected) in (a_bar, b_bar).scalars().iter().zip(duals) {
            assert!(found.is_finite() && expected.is_finite());
            assert!(
                (found - expected).abs() < 1e-9 * (1.0 + expected.abs()),
                "{k} {operation:?} {found} {expected}"
            );
        }
    }
}

/// At edges that lie along each other the derivative is the mean of both sides, as by central
/// differences.
#[test]
fn edges_along_each_other_share_their_derivatives() {
    let square = |x: f64, y: f64, w: f64, h: f64| {
        vec![ring(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])]
    };
    let a = made(&square(0., 0., 2., 2.));
    for b in [
        square(0., 0., 2., 2.),
        square(1., 0., 2., 2.),
        square(0., 0., 2., 1.),
        square(0.5, 0., 1., 1.),
        square(-1., 0., 4., 2.),
        // With vertices on the edges.
        vec![ring(&[(0., 0.), (1., 0.), (2., 0.), (2., 2.), (0., 2.)])],
        // With a hole.
        vec![
            square(0., 0., 2., 2.).remove(0),
            square(0.5, 0.5, 1., 1.).remove(0),
        ],
    ] {
        let b = made(&b);
        for (operation, _) in &OPERATIONS[..2] {
            let operation = *operation;
            let trace = overlay_search(&a, &b, operation, Fill::EvenOdd).unwrap();
            let area = |a: &_, b: &_| polygon::signed_area(&result(a, b, operation, Fill::EvenOdd));
            let expected = differences(area, &a, &b, 1e-6);
            let found = by_duals(&a, &b, &trace, |p| polygon::signed_area(p));
            for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
                assert!(
                    (found - expected).abs() < 1e-5,
                    "{operation:?} {k} {found} {expected} {b:?} {trace:?}"
                );
            }
        }
    }
}

#[test]
fn the_same_polygon_twice_has_iou_one_and_no_derivative() {
    let mut dice = Dice(5);
    let random = (0..30).map(|_| stars(&mut dice));
    for rings in random.chain(hard_rings()) {
        let a = made(&rings);
        let (value, trace) = iou_search(&a, &a, Fill::EvenOdd).unwrap();
        assert_eq!(value, 1.0, "{rings:?}");
        let of = |(a, b): (Polygon<_>, Polygon<_>)| iou_replay(&a, &b, &trace);
        let (_, derivatives) = geograd::gradient(of, (a.clone(), a.clone()));
        assert!(
            derivatives.scalars().iter().all(|x| x.abs() < 1e-12),
            "{rings:?}"
        );
    }
}

#[test]
fn every_vertex_says_where_it_is_from() {
    let a = ring(&[(0., 0.), (2., 0.), (2., 2.), (0., 2.)]);
    let b = ring(&[(1., 1.), (3., 1.), (3., 3.), (1., 3.)]);
    let trace = overlay_search(&a, &b, BooleanOperation::Intersection, Fill::NonZero).unwrap();
    let vertex = |owner, vertex| {
        Origin::Vertex(VertexId {
            owner,
            ring: 0,
            vertex,
        })
    };
    let cross = |edge, other| {
        let id = |owner, edge| EdgeId {
            owner,
            ring: 0,
            edge,
        };
        Origin::Cross(id(Owner::A, edge), id(Owner::B, other))
    };
    let mut found: Vec<_> = trace.origins().map(<[_]>::to_vec).collect();
    found.sort();
    let expected = [
        vertex(Owner::A, 2),
        vertex(Owner::B, 0),
        cross(1, 0),
        cross(2, 3),
    ];
    assert_eq!(found, expected.map(|origin| vec![origin]));
    assert!(trace.parts().eq(std::iter::once(0..1)));
    // Identical ones: both vertices at once.
    let trace = overlay_search(&a, &a, BooleanOperation::Union, Fill::NonZero).unwrap();
    assert!(
        trace
            .origins()
            .all(|of| of.len() == 2 && matches!(of[1], Origin::Vertex(_)))
    );
    // Nothing, and something that is nowhere near.
    let far = [at(9., 9.), at(10., 9.), at(9., 10.)];
    let trace = overlay_search(&a, &far, BooleanOperation::Intersection, Fill::NonZero).unwrap();
    assert_eq!((trace.vertex_count(), trace.parts().count()), (0, 0));
    let nothing: &[Ring] = &[];
    let trace = overlay_search(&a, nothing, BooleanOperation::Union, Fill::NonZero).unwrap();
    assert_eq!(trace.vertex_count(), 4);
    assert_eq!(
        iou_search::<f64>(nothing, nothing, Fill::NonZero)
            .unwrap()
            .0,
        0.0
    );
}

#[test]
fn records_serve_every_format() {
    let mut dice = Dice(6);
    for _ in 0..20 {
        let (a, b) = (made(&stars(&mut dice)), made(&stars(&mut dice)));
        let (narrow_a, narrow_b) = (a.cast::<f32>(), b.cast::<f32>());
        let fill = Fill::EvenOdd;
        let trace = overlay_search(&narrow_a, &narrow_b, BooleanOperation::Union, fill).unwrap();
        let (wide, narrow) = (
            overlay_replay(&a, &b, &trace),
            overlay_replay(&narrow_a, &narrow_b, &trace),
        );
        let found = f64::from(polygon::signed_area(&narrow));
        assert!((polygon::signed_area(&wide) - found).abs() < 1e-5);
    }
}

#[test]
fn flaws_name_polygon_ring_and_vertex() {
    let good = vec![ring(&[(0., 0.), (4., 0.), (0., 4.)])];
    let mut bad = good.clone();
    bad.push(ring(&[(0., 0.), (f64::INFINITY, 0.), (0., 4.)]));
    let found =
        overlay_search(&good[..], &bad[..], BooleanOperation::Union, Fill::NonZero).unwrap_err();
    let flaw = Flaw::Ring {
        ring: 1,
        index: 1,
        fault: VertexFault::NotFinite,
    };
    assert_eq!(
        found,
        Error::Invalid {
            argument: Argument::B,
            item: 0,
            flaw
        }
    );
    bad[1].truncate(1);
    bad[1][0] = at(0.0, 0.0);
    assert!(iou_search(&bad[..], &good[..], Fill::NonZero).is_err());
}

/// Small turned rings on a lattice, many of them along each other, beside a large one: their edges lie along each other
/// but for a step of the grid.
fn turned_beside_large(dice: &mut Dice) -> [Vec<Ring>; 2] {
    let (sin, cos) = dice.within(0.0, 6.3).sin_cos();
    let size = 2f64.powi(-(dice.below(40) as i32));
    let side = 3 + dice.below(4);
    let mut whole = |least: usize| -> Ring {
        let count = least + dice.below(7);
        (0..count)
            .map(|_| at(dice.below(side) as f64, dice.below(side) as f64))
            .collect()
    };
    let first = whole(4);
    let others: Vec<Ring> = (0..6).map(|_| whole(4)).collect();
    let mut found = [Vec::new(), Vec::new()];
    for other in others.into_iter().skip(dice.below(5)) {
        let by = at(dice.below(4) as f64 - 1.0, dice.below(3) as f64 - 1.0);
        let placed = match dice.below(3) {
            0 => other,
            _ => first.iter().map(|&v| v + by).collect(),
        };
        let place = |v: &Vec2<f64>| at(cos * v.x - sin * v.y, sin * v.x + cos * v.y) * size;
        found[dice.below(2)].push(placed.iter().map(place).collect());
    }
    found[0].push(ring(&[(3.0, 3.0), (4.0, 3.0), (4.0, 4.0), (3.0, 4.0)]));
    found
}

/// The result of a function; panics if it takes longer than a minute.
fn in_time<T: Send + 'static>(of: impl FnOnce() -> T + Send + 'static) -> T {
    let (sender, receiver) = std::sync::mpsc::channel();
    std::thread::spawn(move || sender.send(of()));
    let limit = std::time::Duration::from_secs(60);
    receiver.recv_timeout(limit).expect("a result in a minute")
}

/// Pieces of edges within a step of each other cross anew wherever they are rounded: without a bound there are more of
/// them in every round.
#[test]
fn edges_within_a_step_of_each_other_have_results() {
    let crossing = ring(&[
        (-0.0007632322275892014, -0.0012739106811149197),
        (-0.0009904402360832207, -0.0011845733112657228),
        (-0.0014448562530712597, -0.001005898571567329),
        (-0.0008602987651804522, -0.000186403907440448),
        (-0.0003088162106011624, -0.0014525854208133136),
        (-0.0014448562530712597, -0.001005898571567329),
    ]);
    let along = ring(&[
        (-0.0009904402360832207, -0.0011845733112657228),
        (-0.0005360242190951818, -0.0013632480509641167),
        (-0.0016720642615652792, -0.0009165612017181319),
    ]);
    let large = ring(&[(4.0, 3.0), (4.0, 4.0), (3.0, 4.0)]);
    // The last size needs the most pieces: four millions are not enough.
    let sized = |ring: &Ring, size: f64| ring.iter().map(|&v| v * size).collect::<Ring>();
    for exponent in [-10, -6, -1, 0, 4] {
        let size = 2f64.powi(exponent);
        let a = vec![sized(&crossing, size), large.clone()];
        judge_in_time(&a, &[sized(&along, size)]);
    }
}

/// All operations end, with areas of the oracle and finite derivatives.
fn judge_in_time(a: &[Ring], b: &[Ring]) {
    for fill in [Fill::NonZero, Fill::EvenOdd] {
        let truth = scanline::areas(a, b, fill);
        for (operation, kept) in OPERATIONS {
            let (p, q) = (made(a), made(b));
            let trace = in_time(move || overlay_search(&p, &q, operation, fill).unwrap());
            let expected: f64 = (0..3).filter(|&i| kept[i]).map(|i| truth[i]).sum();
            let (p, q) = (made(a), made(b));
            let of = |(p, q): (Polygon<_>, Polygon<_>)| {
                polygon::signed_area(&overlay_replay(&p, &q, &trace))
            };
            let (found, derivatives) = geograd::gradient(of, (p, q));
            assert!((found - expected).abs() < 1e-14, "{found} {expected}");
            assert!(derivatives.scalars().into_iter().all(f64::is_finite));
        }
    }
}

#[test]
fn hostile_pairs_have_results() {
    let mut dice = Dice(11);
    let mut vertices = 0;
    for k in 0..400 {
        let [a, b] = turned_beside_large(&mut dice);
        if !valid(&a) || !valid(&b) {
            continue;
        }
        let (operation, kept) = OPERATIONS[k % 4];
        let fill = [Fill::NonZero, Fill::EvenOdd][k / 4 % 2];
        let (p, q) = (made(&a), made(&b));
        let found = in_time(move || result(&p, &q, operation, fill));
        vertices += found.vertices().len();
        if k % 20 == 0 {
            let truth = scanline::areas(&a, &b, fill);
            let truth: f64 = (0..3).filter(|&i| kept[i]).map(|i| truth[i]).sum();
            let found = polygon::signed_area(&found);
            assert!(
                (found - truth).abs() < 1e-13 * (1.0 + truth),
                "{found} {truth}"
            );
        }
    }
    assert!(vertices > 4000, "{vertices}");
}

//! Rings of two ragged lists, in batches.
use geograd::ad::adjoint::overlap_rings::{intersection_area_vjp, iou_vjp};
use geograd::error::{Argument, Flaw, VertexFault};
use geograd::kernels::Cpu;
use geograd::kernels::cpu::polygons::{RingList, RingScore};
use geograd::overlap_polygon::holed::{intersection_area, iou};
use geograd::{Error, Vec2};
use geograd_tests::Dice;
use std::f64::consts::TAU;

/// Stars of zero to forty vertices of either orientation, scattered over a square.
fn stars(dice: &mut Dice, count: usize) -> (Vec<Vec2<f64>>, Vec<usize>) {
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for _ in 0..count {
        let corners = dice.below(41);
        let center = Vec2::new(dice.within(0.0, 12.0), dice.within(0.0, 12.0));
        let way = if dice.below(2) == 0 { 1.0 } else { -1.0 };
        for k in 0..corners {
            let (at, radius) = (way * TAU * k as f64 / corners as f64, dice.within(0.4, 1.6));
            vertices.push(center + Vec2::new(radius * at.cos(), radius * at.sin()));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

fn list<'a>((vertices, offsets): &'a (Vec<Vec2<f64>>, Vec<usize>)) -> RingList<'a, f64> {
    RingList { vertices, offsets }
}

fn ring(list: &(Vec<Vec2<f64>>, Vec<usize>), i: usize) -> &[Vec2<f64>] {
    &list.0[list.1[i]..list.1[i + 1]]
}

#[test]
fn rings_of_lists_have_the_bits_of_two_at_a_time() {
    let mut dice = Dice(61);
    let (a, b) = (stars(&mut dice, 90), stars(&mut dice, 70));
    let cpu = Cpu::new();
    let areas = cpu
        .all_rings(RingScore::IntersectionArea, list(&a), list(&b))
        .unwrap();
    let mut meeting = 0;
    for (k, area) in areas.iter().enumerate() {
        let known = intersection_area(ring(&a, k / 70), ring(&b, k % 70));
        assert_eq!(area.to_bits(), known.to_bits(), "{k}");
        meeting += usize::from(*area > 0.0);
    }
    assert!(meeting > 50, "{meeting}");
    let few = RingList {
        offsets: &a.1[..71],
        vertices: &a.0[..a.1[70]],
    };
    let ious = cpu.rings(RingScore::Iou, few, list(&b)).unwrap();
    for (i, found) in ious.iter().enumerate() {
        let known: f64 = iou(ring(&a, i), ring(&b, i));
        assert_eq!(found.to_bits(), known.to_bits(), "{i}");
    }
}

#[test]
fn derivatives_of_rings_add_up_in_order_on_any_number_of_threads() {
    let mut dice = Dice(62);
    let (a, b) = (stars(&mut dice, 70), stars(&mut dice, 50));
    let up: Vec<f64> = (0..70 * 50)
        .map(|k| {
            if k % 3 == 0 {
                0.0
            } else {
                dice.within(-1.0, 1.0)
            }
        })
        .collect();
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| {
            Cpu::new()
                .all_rings_vjp(RingScore::Iou, list(&a), list(&b), &up)
                .unwrap()
        })
    };
    let (values, [by_a, by_b]) = on(1);
    assert_eq!(on(5), (values.clone(), [by_a.clone(), by_b.clone()]));
    let (mut sum_a, mut sum_b) = (vec![Vec2::zero(); a.0.len()], vec![Vec2::zero(); b.0.len()]);
    for (k, &up) in up.iter().enumerate() {
        let (i, j) = (k / 50, k % 50);
        let (p, q) = (ring(&a, i), ring(&b, j));
        let (mut one, mut other) = (vec![Vec2::zero(); p.len()], vec![Vec2::zero(); q.len()]);
        let value = iou_vjp(p, q, up, &mut one, &mut other);
        assert_eq!(values[k], value);
        for (sum, one) in sum_a[a.1[i]..].iter_mut().zip(one) {
            *sum += one;
        }
        for (sum, one) in sum_b[b.1[j]..].iter_mut().zip(other) {
            *sum += one;
        }
    }
    assert!(by_a.iter().any(|bar| bar.length() > 0.1));
    for (found, known) in by_a.iter().chain(&by_b).zip(sum_a.iter().chain(&sum_b)) {
        assert!((*found - *known).length() < 1e-12, "{found:?} {known:?}");
    }
    // Aligned: of every row its own derivatives.
    let few = RingList {
        offsets: &a.1[..51],
        vertices: &a.0[..a.1[50]],
    };
    let found = Cpu::new().rings_vjp(RingScore::IntersectionArea, few, list(&b), &up[..50]);
    let (values, [by_a, by_b]) = found.unwrap();
    for i in 0..50 {
        let (p, q) = (ring(&a, i), ring(&b, i));
        let (mut one, mut other) = (vec![Vec2::zero(); p.len()], vec![Vec2::zero(); q.len()]);
        assert_eq!(
            values[i],
            intersection_area_vjp(p, q, up[i], &mut one, &mut other)
        );
        assert_eq!(by_a[a.1[i]..a.1[i + 1]], one);
        assert_eq!(by_b[b.1[i]..b.1[i + 1]], other);
    }
}

#[test]
fn bad_lists_of_rings_are_refused_with_ring_and_vertex() {
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y));
    let mut broken = [square, square].concat();
    broken[6].y = f64::NAN;
    let good = RingList {
        vertices: &square,
        offsets: &[0, 4],
    };
    let both = RingList {
        vertices: &broken,
        offsets: &[0, 4, 8],
    };
    let cpu = Cpu::new();
    let score = RingScore::Iou;
    let flaw = Flaw::Vertex {
        index: 2,
        fault: VertexFault::NotFinite,
    };
    let refused = Error::Invalid {
        argument: Argument::B,
        item: 1,
        flaw,
    };
    assert_eq!(cpu.all_rings(score, good, both), Err(refused));
    assert_eq!(
        refused.to_string(),
        "`b` item 1: vertex 2 has a coordinate that is not a finite number"
    );
    let short = RingList {
        vertices: &square,
        offsets: &[0, 3],
    };
    let refused = Error::OffsetsOf {
        argument: Argument::A,
        item: 1,
    };
    assert_eq!(cpu.rings(score, short, good), Err(refused));
    let none = RingList {
        vertices: &square[..0],
        offsets: &[0],
    };
    let refused = Error::Length {
        argument: Argument::B,
        expected: 1,
        found: 0,
    };
    assert_eq!(cpu.rings(score, good, none), Err(refused));
    assert_eq!(cpu.all_rings(score, good, none), Ok(vec![]));
    let refused = Error::Length {
        argument: Argument::Upstream,
        expected: 1,
        found: 2,
    };
    assert_eq!(cpu.rings_vjp(score, good, good, &[1.0, 1.0]), Err(refused));
    let refused = cpu
        .rings_vjp(score, good, good, &[f64::INFINITY])
        .unwrap_err();
    assert!(matches!(
        refused,
        Error::Invalid {
            argument: Argument::Upstream,
            item: 0,
            ..
        }
    ));
    assert_eq!(cpu.rings(score, good, good), Ok(vec![1.0]));
}

//! Kernels of paths: winding numbers of a shared ring, lengths of polylines; and batches that are interrupted.
use super::fold::long_rings;
use geograd::error::{Argument, Field, Flaw};
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::dynamic::{interruptible, on_this_thread};
use geograd::kernels::fold::fold;
use geograd::kernels::{Cpu, Iou, One};
use geograd::{Aabb2, Error, Vec2};
use geograd_tests::Dice;
use geograd_tests::rows::{LengthOfPolyline, WindingOfRing};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

#[test]
fn winding_numbers_of_a_shared_ring_are_those_of_one_point_at_a_time() {
    let mut dice = Dice(21);
    let (_, vertices, offsets) = long_rings(&mut dice);
    let cpu = Cpu::new();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        let mut inside = 0;
        for ends in offsets.windows(2).step_by(5) {
            let ring = &vertices[ends[0]..ends[1]];
            let unit = ring.iter().fold(0.0_f64, |m, v| m.max(v.x.abs()));
            let mut points: Vec<Vec2<f64>> = (0..60)
                .map(|_| Vec2::new(dice.within(-1.2, 1.2), dice.within(-1.2, 1.2)) * unit)
                .collect();
            // Vertices, middles of edges, and points level with vertices.
            for k in (0..ring.len() - 1).step_by(ring.len() / 9) {
                points.extend([ring[k], (ring[k] + ring[k + 1]) * 0.5]);
                points.push(Vec2::new(points[0].x, ring[k].y));
            }
            let found = cpu.fold_one(WindingOfRing, &points, ring).unwrap();
            for (i, (&point, found)) in points.iter().zip(found).enumerate() {
                let one = fold::<WindingOfRing, f64>(point, ring);
                assert_eq!(found.to_bits(), one.to_bits(), "{level:?} point {i}");
                inside += usize::from(one != 0.0);
            }
        }
        assert!(inside > 100, "{inside}");
    }
    Simd::limit(None).unwrap();
    // Without edges nothing winds around a point; a vertex that is not finite is refused.
    let points = [Vec2::new(0.5, 0.5); 40];
    assert_eq!(
        cpu.fold_one(WindingOfRing, &points, &[]).unwrap(),
        [0.0; 40]
    );
    let wild = [Vec2::new(0.0, 0.0), Vec2::new(1.0, f64::INFINITY)];
    let refused = Error::Invalid {
        argument: Argument::Vertices,
        item: 1,
        flaw: Flaw::NotFinite(Field::new("y")),
    };
    assert_eq!(cpu.fold_one(WindingOfRing, &points, &wild), Err(refused));
}

#[test]
fn lengths_have_the_bits_of_one_path_at_a_time() {
    let mut dice = Dice(22);
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for path in 0..600 {
        let count = match path % 100 {
            0..95 => dice.below(20),
            95..99 => dice.below(400),
            // Longer than a piece of work, and than its room.
            _ => 5000 + dice.below(50),
        };
        let unit = [1.0, 1e-30, 1e150, 1e-160, 1e307][path % 5];
        for _ in 0..count {
            let repeated = dice.below(8) == 0;
            let next = Vec2::new(dice.within(-1.0, 1.0), dice.within(-1.0, 1.0)) * unit;
            vertices.push(
                vertices
                    .last()
                    .copied()
                    .filter(|_| repeated)
                    .unwrap_or(next),
            );
        }
        offsets.push(vertices.len());
    }
    let narrow = |v: &Vec2<f64>| Vec2::new(v.x as f32, v.y as f32);
    let cut = offsets.iter().position(|&end| end > 3000).unwrap();
    let (few, narrow): (_, Vec<Vec2<f32>>) = (
        &offsets[..=cut],
        vertices[..offsets[cut]].iter().map(narrow).collect(),
    );
    let finite = narrow.iter().all(|v| v.x.is_finite() && v.y.is_finite());
    let cpu = Cpu::new();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        let found = cpu
            .fold(LengthOfPolyline, One([]), &vertices, &offsets)
            .unwrap();
        for (ends, found) in offsets.windows(2).zip(&found) {
            let path = &vertices[ends[0]..ends[1]];
            let one = fold::<LengthOfPolyline, f64>([], path);
            assert_eq!(found.to_bits(), one.to_bits(), "{level:?} {ends:?}");
        }
        assert!(found.iter().all(|x| x.is_finite()) && found.iter().any(|&x| x > 1e300));
        if finite {
            let found = cpu.fold(LengthOfPolyline, One([]), &narrow, few).unwrap();
            for (ends, found) in few.windows(2).zip(&found) {
                let one = fold::<LengthOfPolyline, f32>([], &narrow[ends[0]..ends[1]]);
                assert_eq!(found.to_bits(), one.to_bits(), "{level:?} {ends:?} in f32");
            }
        }
    }
    Simd::limit(None).unwrap();
    vertices[4321].x = f64::NAN;
    let refused = Error::Invalid {
        argument: Argument::Vertices,
        item: 4321,
        flaw: Flaw::NotFinite(Field::new("x")),
    };
    let found = cpu.fold(LengthOfPolyline, One([]), &vertices, &offsets);
    assert_eq!(found, Err(refused));
}

/// Runs `run` until it has asked so many times whether it shall end; returns `true` if it has ended then, without
/// another question.
fn ends_at_question(last: usize, run: impl FnOnce()) -> bool {
    let asked = Arc::new(AtomicUsize::new(0));
    let counted = asked.clone();
    let ask = move || counted.fetch_add(1, Ordering::Relaxed) + 1 == last;
    let ended = on_this_thread(|| interruptible(ask, run)).is_none();
    ended && asked.load(Ordering::Relaxed) == last
}

#[test]
fn interrupted_batches_end() {
    let mut dice = Dice(23);
    let boxes: Vec<Aabb2<f64>> = (0..3000)
        .map(|_| {
            let (x, y) = (dice.within(0.0, 9.0), dice.within(0.0, 9.0));
            Aabb2::new(x, y, x + 1.0, y + 1.0)
        })
        .collect();
    let many = boxes.repeat(20);
    let scores: Vec<f64> = boxes.iter().map(|_| dice.within(0.0, 1.0)).collect();
    let (cpu, path) = (Cpu::new(), [Vec2::new(0.0, 0.0); 9000]);
    let offsets: Vec<usize> = (0..=1000).map(|k| 9 * k).collect();
    for last in [1, 3] {
        assert!(ends_at_question(last, || drop(
            cpu.all_pairs(Iou, &boxes, &boxes)
        )));
        assert!(ends_at_question(last, || drop(
            cpu.row_max(Iou, &boxes, &boxes)
        )));
        assert!(ends_at_question(last, || drop(
            cpu.sum_grad(Iou, &boxes, &boxes)
        )));
        assert!(ends_at_question(last, || drop(
            cpu.aligned(Iou, (&many, &many))
        )));
        assert!(ends_at_question(last, || {
            drop(cpu.fold(LengthOfPolyline, One([]), &path, &offsets));
        }));
        assert!(ends_at_question(last, || {
            let rules = geograd::suppression::Rules::above(0.5);
            drop(cpu.suppress(Iou, &boxes, &scores, rules));
        }));
    }
    // A batch that is not interrupted is complete, and one after it asks no one.
    let whole = interruptible(|| false, || cpu.row_max(Iou, &boxes, &boxes));
    assert_eq!(whole.unwrap(), cpu.row_max(Iou, &boxes, &boxes));
}

//! Every compiled kernel on few items, for a checker of memory: `.ci/run memory` runs these tests under valgrind.
//!
//! Lists end where their allocation ends and start beside its alignment. Their lengths leave a tail of a tile. The tests
//! leave the level of instructions as it is, so that `GEOGRAD_SIMD` chooses it.
use super::bits::{Drawn, MILD, Turn, far_apart, list, results};
use geograd::kernels::cpu::polygons::{RingList, RingScore};
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::{Cpu, Op};
use geograd::{Obb2, Vec2};
use geograd_tests::calls::OfRings;
use geograd_tests::calls::{self, Number, Pair};
use geograd_tests::rows::ring::{Centroid, Perimeter, SignedArea};
use geograd_tests::rows::{
    DiouObb2, GiouObb2, IntersectionAreaQuads, IofObb2, IouAabb2, IouObb2, IouObb3, IouYaw,
    SignedDistancePointRing,
};
use geograd_tests::{Dice, with_threads};

/// Alone, at the level that the environment asks for.
fn alone() -> Turn {
    let turn = Turn::take();
    if let Ok(word) = std::env::var("GEOGRAD_SIMD") {
        let mut levels = Simd::available().into_iter();
        let level = levels.find(|level| level.name() == word);
        Simd::limit(Some(level.expect("the processor has this level"))).unwrap();
    }
    turn
}

/// All forms of batches of two shapes.
fn pairs<O, T>()
where
    O: Pair<T>,
    T: Number,
    O::A: Drawn,
    O::B: Drawn,
{
    // A filter of bounds, a tree of bounds, and no filter.
    for (rows, columns, filtered) in [(3, 38, true), (3, 521, true), (3, 19, false)] {
        calls::cull(filtered);
        let a = far_apart::<O::A>(list(rows + 1, MILD, 1));
        let b = far_apart::<O::B>(list(columns + 1, MILD, 2));
        let known = results::<O, T>(&a[1..], &b[1..]);
        calls::count_above::<O, T>(&a[1..], &b[1..], T::lit(0.1)).unwrap();
        // The same numbers elsewhere in memory.
        let moved = results::<O, T>(&a[1..], &b[1..]);
        assert!(
            known == moved,
            "{}, {rows} times {columns}",
            O::DECLARED.name
        );
        let _ = calls::all_pairs_grad::<O, T>(&a[1..], &b[1..]).unwrap();
        let (a, b) = (list::<O::A>(20, MILD, 3), list::<O::B>(20, MILD, 4));
        let (a, b) = (&a[1..], &b[1..]);
        let up: Vec<T> = a.iter().map(|_| T::lit(0.5)).collect();
        calls::aligned::<O, T>(a, b).unwrap();
        calls::aligned_grad::<O, T>(a, b).unwrap();
        calls::aligned_vjp::<O, T>(a, b, &up).unwrap();
    }
}

/// So many vertices in allocations of their length.
fn vertices<T: Number>(count: usize, seed: u64) -> Vec<Vec2<T>> {
    let mut dice = Dice(seed);
    let mut number = || T::lit(dice.within(-2.0, 2.0));
    (0..count).map(|_| Vec2::new(number(), number())).collect()
}

fn ring<O: OfRings<T>, T: Number>() {
    let ends = vec![0, 0, 1, 4, 21, 37, 108];
    let vertices = vertices::<T>(109, 3);
    let values = calls::ragged::<O, T>(&vertices[1..], &ends).unwrap();
    calls::ragged_vjp::<O, T>(&vertices[1..], &ends, &values).unwrap();
}

/// All other batches than those of two boxes.
fn others<T: Number>() {
    ring::<SignedArea, T>();
    ring::<Perimeter, T>();
    ring::<Centroid, T>();

    let cpu = Cpu::new();
    let quads = |seed| -> Vec<[Vec2<T>; 4]> {
        let boxes: Vec<Obb2<T>> = list(22, MILD, seed);
        boxes.iter().map(|x| x.corners()).collect()
    };
    let (a, b) = (quads(4), quads(5));
    let op = IntersectionAreaQuads;
    cpu.aligned(op, (&a[1..], &b[1..])).unwrap();
    cpu.aligned(op.value_grad(), (&a[1..], &b[1..])).unwrap();
    cpu.all_pairs(op, &a[1..4], &b[1..]).unwrap();
    cpu.all_pairs(op.value_grad(), &a[1..4], &b[1..]).unwrap();

    // Recorded programs.
    let boxes: Vec<Obb2<T>> = list(22, MILD, 6);
    let (a, b) = (&boxes[1..], &boxes[..21]);
    cpu.aligned(DiouObb2.value_grad(), (a, b)).unwrap();
    cpu.all_pairs(DiouObb2, &a[..3], b).unwrap();

    // Paths of which the nearest edges count.
    let (points, path, ends) = (vertices::<T>(3, 7), vertices::<T>(101, 8), [0, 33, 33, 100]);
    cpu.fold(SignedDistancePointRing, &points, &path[1..], &ends)
        .unwrap();

    let list = RingList {
        vertices: &path[1..],
        offsets: &ends,
    };
    cpu.all_rings(RingScore::Iou, list, list).unwrap();
}

macro_rules! boxes {
    ($($name:ident: $op:ty,)*) => { $(
        #[test]
        fn $name() {
            let _turn = alone();
            with_threads(1, || {
                pairs::<$op, f32>();
                pairs::<$op, f64>();
            });
        }
    )* };
}
boxes! {
    rotated_boxes: IouObb2,
    rotated_boxes_over_the_first: IofObb2,
    rotated_boxes_in_their_hull: GiouObb2,
    axis_aligned_boxes: IouAabb2,
    boxes_with_a_heading: IouYaw,
    boxes_in_space: IouObb3,
}

#[test]
fn all_else() {
    let _turn = alone();
    with_threads(1, || {
        others::<f32>();
        others::<f64>();
    });
}

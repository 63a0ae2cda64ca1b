//! Batches of every straight-line operation: the bits of the function and of its derivatives on plain
//! numbers, at every level of vector instructions and at every position of a batch.
use crate::bits::Turn;
use geograd::ad::check::sample::{Draw, Family, Sample, random};
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::op::{Op, Source, Straight};
use geograd::kernels::{Cpu, Item};
use geograd::scalar::float::Float;
use geograd::{Fixed, Jet, Pack};
use geograd_tests::calls::Number;
use std::fmt::Debug;

/// Lengths of batches: less than any vector, not a whole number of them, several pieces.
const LENGTHS: [usize; 3] = [1, 17, 300];

/// Results of a batch, item by item.
pub trait Items {
    fn item(&self, i: usize) -> Vec<u64>;
}
impl<A: Pack<Scalar: Number>> Items for Vec<A> {
    fn item(&self, i: usize) -> Vec<u64> {
        bits(&self[i])
    }
}
macro_rules! items {
    ($(($($part:ident.$place:tt),+))+) => { $(
        impl<$($part: Items),+> Items for ($($part,)+) {
            fn item(&self, i: usize) -> Vec<u64> {
                [$(self.$place.item(i)),+].concat()
            }
        }
    )+ };
}
items! { (A.0, B.1) (A.0, B.1, C.2) }

pub fn bits<A: Pack<Scalar: Number>>(shape: &A) -> Vec<u64> {
    let numbers = shape.scalars().into_iter();
    numbers.map(|x| x.widen().to_bits()).collect()
}

/// Hard inputs, then random ones, in a format.
pub fn inputs<O: Op, T: Number>(count: usize) -> Vec<O::In<T>>
where
    O::In<f64>: Sample,
{
    let mut draw = Draw::new(11);
    let hard = O::In::<f64>::hard().into_iter();
    let mut all: Vec<O::In<f64>> = hard.step_by(5).take(count / 2).collect();
    while all.len() < count {
        all.push(random(&mut draw));
    }
    let rounded = |x: &O::In<f64>| {
        let numbers: Vec<T> = x.scalars().iter().map(|&x| T::lit(x)).collect();
        O::In::<T>::load(&numbers)
    };
    all.iter().map(rounded).collect()
}

/// Values and derivatives of batches are those of the function.
fn same_bits<O: Op, T: Number>()
where
    O::In<f64>: Sample,
    O::In<T>: Item<Scalar = T, Many: Items> + Debug,
    O::Out<T>: Item<Scalar = T, Many: Items>,
{
    let all = inputs::<O, T>(LENGTHS[2]);
    let mut draw = Draw::new(12);
    let bars = (0..all.len()).map(|_| {
        let numbers = (0..O::Out::<T>::LEN).map(|_| T::lit(draw.within(-2.0, 2.0)));
        O::Out::load(&numbers.collect::<Vec<T>>())
    });
    let bars: Vec<O::Out<T>> = bars.collect();
    let expected: Vec<[Vec<u64>; 2]> = all
        .iter()
        .zip(&bars)
        .map(|(&x, &bar)| {
            let (value, derivatives) = (O::eval(x), Straight::<O>::vjp(&x, bar));
            let finite = |numbers: Vec<T>| numbers.iter().all(|x| x.widen().is_finite());
            assert!(
                finite(value.scalars()) && finite(derivatives.scalars()),
                "{}: {x:?}",
                O::NAME
            );
            [bits(&value), bits(&derivatives)]
        })
        .collect();
    let _turn = Turn::take();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        for count in LENGTHS {
            let (all, bars) = (&all[..count], &bars[..count]);
            let values = Cpu::new().aligned(O::default(), all).unwrap();
            let derivatives = Cpu::new().aligned(O::default().vjp(), (all, bars)).unwrap();
            for i in 0..count {
                let found = [values.item(i), derivatives.item(i)];
                assert_eq!(
                    found,
                    expected[i],
                    "{} {level:?} {count}: {:?}",
                    O::NAME,
                    all[i]
                );
            }
        }
    }
}

/// A batch of values with gradients: the value, and the derivatives of a cotangent of one.
fn same_gradient<O, T>()
where
    O: Op<Out<T> = T>,
    O::In<f64>: Sample,
    O::In<T>: Item<Scalar = T, Many: Items> + Debug,
    T: Number + Item<Many: Items>,
{
    let all = inputs::<O, T>(LENGTHS[2]);
    let _turn = Turn::take();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        for count in LENGTHS {
            let all = &all[..count];
            let found = Cpu::new().aligned(O::default().value_grad(), all).unwrap();
            for (i, x) in all.iter().enumerate() {
                let derivatives = Straight::<O>::vjp(x, T::lit(1.0));
                let expected = [bits(&O::eval(*x)), bits(&derivatives)].concat();
                assert_eq!(
                    found.item(i),
                    expected,
                    "{} {level:?} {count}: {x:?}",
                    O::NAME
                );
            }
        }
    }
}

#[test]
fn gradients() {
    macro_rules! each {
        ($($op:ident)*) => { $(
            same_gradient::<geograd_tests::rows::$op, f64>();
            same_gradient::<geograd_tests::rows::$op, f32>();
        )* };
    }
    each! {
        DistancePointSegment DistancePointCircle DistancePointTriangle DistanceSegments DistanceObb2
        SignedDistancePointObb2 SquaredDistancePointSegment GiouObb2 GiouAabb2 GiouHullAabb2
        GiouAabbObb2 DiouAabb2 DiouHullAabb2 DiouAabbObb2 EiouObb2 EiouAabb2 HullAreaObb2 HullAreaAabb2 AreaTriangle
        PerimeterTriangle SignedAreaQuad PerimeterQuad
    }
}

/// Derivatives are those of forward duals where no tie is near.
fn derivatives_of_duals<O: Op>()
where
    O::In<f64>: Sample,
{
    let mut draw = Draw::new(13);
    let ones = O::Out::<f64>::filled(1.0);
    for _ in 0..100 {
        let x: O::In<f64> = Family::Ordinary.draw(&mut draw);
        let derivatives = Straight::<O>::vjp(&x, ones).scalars();
        let numbers = x.scalars();
        let largest = derivatives.iter().fold(1.0_f64, |m, s| m.max(s.abs()));
        for (k, &derivative) in derivatives.iter().enumerate() {
            let jets = numbers.iter().enumerate().map(|(i, &x)| Jet {
                value: x,
                derivative: [if i == k { 1.0 } else { 0.0 }],
            });
            let jets: Vec<Jet<f64, 1>> = jets.collect();
            let out = O::eval(O::In::<Jet<f64, 1>>::load(&jets)).scalars();
            let dual: f64 = out.iter().map(|y| y.derivative[0]).sum();
            let gap = (dual - derivative).abs();
            assert!(
                gap <= 1e-12 * largest,
                "{} by {k}: {dual} {derivative} at {x:?}",
                O::NAME
            );
        }
    }
}

macro_rules! each {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($name:ident: $op:ty,)* } $($rest:tt)*) => { $(
        #[test]
        fn $name() {
            same_bits::<$op, f64>();
            same_bits::<$op, f32>();
            derivatives_of_duals::<$op>();
        }
    )* };
}
geograd::for_each_op!(each);

geograd::operation! {
    /// A difference, whose derivatives are its cotangent and the opposite.
    Difference = "difference": (a: S, b: S) -> S { a - b }
    invariances []
    jumps Never
    derivative Reverse
}

#[test]
fn cotangents_of_all_pairs_are_taken_as_they_are() {
    let (a, b, up) = (
        [1.0, 2.0],
        [5.0, 7.0, 9.0],
        [1.0, 2.0, 4.0, 8.0, 16.0, 32.0],
    );
    let (a_bar, b_bar) = Cpu::new().all_pairs_vjp(Difference, &a, &b, &up).unwrap();
    assert_eq!(
        (&a_bar[..], &b_bar[..]),
        (&[7.0, 56.0][..], &[-9.0, -18.0, -36.0][..])
    );
    let (sum, a_bar, b_bar) = Cpu::new().sum_grad(Difference, &a, &b).unwrap();
    assert_eq!(sum, 9.0 - 42.0);
    assert_eq!((&a_bar[..], &b_bar[..]), (&[3.0; 2][..], &[-2.0; 3][..]));
}

/// Boxes of two kinds: the same as boxes of one kind, whose derivatives are by other numbers.
#[test]
fn overlaps_of_boxes_of_two_kinds() {
    use geograd::overlap3::Overlaps;
    use geograd::{Aabb3, Obb3, Rotation3, Vec3, YawBox3};
    use geograd_tests::rows::{IouAabb3Obb3, IouYawObb3};
    let aligned = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 1.5_f64));
    let upright = YawBox3::new(aligned.center(), aligned.size(), 0.0);
    let (center, size) = (Vec3::new(0.5, 0.2, 0.3), Vec3::new(1.0, 2.0, 1.0));
    let turned = Obb3::new(center, size, Rotation3::new(0.9, 0.1, 0.2, -0.3));
    let cpu = Cpu::new();
    let own = cpu.aligned(IouAabb3Obb3, (&[aligned][..], &[turned][..]));
    assert_eq!(own.unwrap(), [aligned.iou_with(turned)]);
    let of_aligned = cpu.aligned(IouAabb3Obb3.value_grad(), (&[aligned][..], &[turned][..]));
    let of_upright = cpu.aligned(IouYawObb3.value_grad(), (&[upright][..], &[turned][..]));
    let ((iou, (by_bounds, _)), (other, (by_box, _))) = (of_aligned.unwrap(), of_upright.unwrap());
    assert_eq!(iou, other);
    // Moving both bounds is moving the box.
    let moved = by_bounds[0].min + by_bounds[0].max;
    assert!((moved - by_box[0].center).length() < 1e-15);
}

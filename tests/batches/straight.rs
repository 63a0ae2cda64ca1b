//! Straight lines of shapes in batches; `rows` has every row.
use geograd::ad::check::sample::{Draw, Sample, random};
use geograd::kernels::Cpu;
use geograd::kernels::op::Op;
use geograd::{Fixed, Pack};
use geograd_tests::calls::{Number, wide};

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
    numbers.map(|x| wide(x).to_bits()).collect()
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
    use geograd::{Aabb3, Obb3, Rotation3, Vec3, YawBox3};
    use geograd_tests::rows::{IouAabb3Obb3, IouYawObb3};
    let aligned = Aabb3::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 1.5_f64));
    let upright = YawBox3::new(aligned.center(), aligned.size(), 0.0);
    let (center, size) = (Vec3::new(0.5, 0.2, 0.3), Vec3::new(1.0, 2.0, 1.0));
    let turned = Obb3::new(center, size, Rotation3::new(0.9, 0.1, 0.2, -0.3));
    let cpu = Cpu::new();
    let own = cpu.aligned(IouAabb3Obb3, (&[aligned][..], &[turned][..]));
    assert_eq!(own.unwrap(), [aligned.iou(turned)]);
    let of_aligned = cpu.aligned(IouAabb3Obb3.value_grad(), (&[aligned][..], &[turned][..]));
    let of_upright = cpu.aligned(IouYawObb3.value_grad(), (&[upright][..], &[turned][..]));
    let ((iou, (by_bounds, _)), (other, (by_box, _))) = (of_aligned.unwrap(), of_upright.unwrap());
    assert_eq!(iou, other);
    // Moving both bounds is moving the box.
    let moved = by_bounds[0].min + by_bounds[0].max;
    assert!((moved - by_box[0].center).length() < 1e-15);
}

//! A direction in which round shapes part whose cores meet in a point.
use super::core::Core3;
use super::spot::fixed_vector;
use crate::{Scalar, Vec3};

/// Returns a direction of length one across both of two cores, a constant: orthogonal to the two directions of their
/// edges that are the farthest from parallel, else to the longest edge. It is along the first axis if both are points.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn of_cores<S: Scalar, A: Core3<S>, B: Core3<S>>(a: A, b: B) -> Vec3<S> {
    let (a, b) = (a.plain(), b.plain());
    let (of_a, of_b) = (a.ways(), b.ways());
    let ways = of_a.as_ref().iter().chain(of_b.as_ref()).copied();
    // With a volume in their types, cores that no plane parts are parallel.
    match A::DIMENSION + B::DIMENSION < 3 {
        true => across(ways),
        false => fixed_vector(unit(beside(longest(ways)))),
    }
}

/// Returns a direction of length one orthogonal to vectors along edges. No product of four lengths within the
/// documented range over- or underflows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn across<S: Scalar>(ways: impl Iterator<Item = Vec3<S::Primal>> + Clone) -> Vec3<S> {
    let along = longest(ways.clone());
    let second = ways.fold(Vec3::zero(), |most, way| {
        let [product, other] = [along.cross(most), along.cross(way)];
        let more = product.length_squared().below(other.length_squared());
        Vec3::select(more, way, most)
    });
    let product = along.cross(second);
    let rounding = S::Primal::rounding(1.0, 1);
    let squares = along.length_squared() * second.length_squared();
    let clear = product.length_squared().above(squares * rounding);
    fixed_vector(unit(Vec3::select(clear, product, beside(along))))
}

/// Returns the longest of some vectors; zero of none.
#[cfg_attr(not(debug_assertions), inline(always))]
fn longest<P: Scalar>(vectors: impl Iterator<Item = Vec3<P>>) -> Vec3<P> {
    vectors.fold(Vec3::zero(), |most, v| {
        let longer = most.length_squared().below(v.length_squared());
        Vec3::select(longer, v, most)
    })
}

/// Returns a vector across another one, along the first axis where that is zero.
#[cfg_attr(not(debug_assertions), inline(always))]
fn beside<P: Scalar>(Vec3 { x, y, z }: Vec3<P>) -> Vec3<P> {
    let zero = P::zero();
    let flat = x.unsigned().at_most(y.unsigned());
    let across = Vec3::select(flat, Vec3::new(zero, z, -y), Vec3::new(-z, zero, x));
    let none = across.length_squared().equals(zero);
    Vec3::select(none, Vec3::new(P::one(), zero, zero), across)
}

/// Returns a vector with length one.
#[cfg_attr(not(debug_assertions), inline(always))]
fn unit<P: Scalar>(v: Vec3<P>) -> Vec3<P> {
    v * P::one().over(v.length_squared().root())
}

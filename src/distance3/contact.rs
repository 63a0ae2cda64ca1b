//! Directions of cores that touch within rounding.
use super::core::Core3;
use super::near::normal;
use super::relation::direction;
use crate::{Scalar, Vec3};

/// Returns the width of the slab with a normal that separates b from a, whose reference points are `way` apart;
/// negative where they overlap.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn parted<P: Scalar, A: Core3<P>, B: Core3<P>>(
    (a, on_a): (&A, Vec3<P>),
    (b, on_b): (&B, Vec3<P>),
    (way, normal): (Vec3<P>, Vec3<P>),
) -> P {
    let zero = P::zero();
    let rises = |corners: &[Vec3<P>], from: Vec3<P>, up: Vec3<P>| {
        let heights = corners.iter().map(|&corner| up.dot(corner - from));
        heights.fold(zero, P::least)
    };
    let low_a = rises(a.corners().as_ref(), on_a, -normal);
    let low_b = rises(b.corners().as_ref(), on_b, normal);
    (low_a + low_b) + normal.dot(way)
}

/// Returns a direction across both of two cores whose difference has no volume, on the side of a given one: it
/// separates them where they touch. For parallel cores it is orthogonal to both, and as near to the given one as that
/// allows.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn across<P: Scalar, A: Core3<P>, B: Core3<P>>(a: &A, b: &B, given: Vec3<P>) -> Vec3<P> {
    let (zero, one, none) = (P::zero(), P::one(), Vec3::zero());
    let (of_a, of_b) = (a.ways(), b.ways());
    let ways = || of_a.as_ref().iter().chain(of_b.as_ref()).copied();
    let longest = |most: Vec3<P>, way: Vec3<P>| {
        let longer = most.length_squared().below(way.length_squared());
        Vec3::select(longer, way, most)
    };
    let along = ways().fold(none, longest);
    let square = along.length_squared();
    let square = P::select(square.above(zero), square, one);
    let beside = given - along * along.dot(given).over(square);
    // Any direction across, where the given one is along.
    let [x, y, z] = [along.x, along.y, along.z];
    let flat = x.unsigned().at_most(y.unsigned());
    let any = Vec3::select(flat, Vec3::new(zero, z, -y), Vec3::new(-z, zero, x));
    let clear = beside.length_squared().above(P::lit(0.25));
    let beside = direction(Vec3::select(clear, beside, any));
    // With a volume in their types, cores that no plane parts are parallel.
    if A::DIMENSION + B::DIMENSION >= 3 {
        return beside;
    }
    let crossed = |most: Vec3<P>, way: Vec3<P>| {
        let more = along.cross(most).length_squared();
        Vec3::select(more.below(along.cross(way).length_squared()), way, most)
    };
    let up = normal(along, ways().fold(none, crossed));
    let side = up.unit * one.signed_as(up.unit.dot(given));
    Vec3::select(up.clear & !up.none, side, beside)
}

//! A direction in which round shapes part whose cores meet in a point.
use super::core::Core;
use super::near::{normal, size_of};
use super::relation::direction;
use super::spot::fixed_vector;
use crate::distance::edge::scale_of;
use crate::{Scalar, Vec3};

/// A direction of length one across both of two cores, a constant: across the two ways along their edges that are the
/// farthest from parallel, else across the longest one, and along the first axis where both are points.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn of_cores<S: Scalar, A: Core<S>, B: Core<S>>(a: A, b: B) -> Vec3<S> {
    let (a, b) = (a.plain(), b.plain());
    let (of_a, of_b) = (a.ways(), b.ways());
    let ways = || of_a.as_ref().iter().chain(of_b.as_ref()).copied();
    let size = ways().fold(S::Primal::zero(), |most, way| most.most(size_of(way)));
    let scale = scale_of::<S::Primal>(size);
    across(ways().map(|way| way * scale))
}

/// The same of ways whose lengths are about one.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn across<S: Scalar>(ways: impl Iterator<Item = Vec3<S::Primal>> + Clone) -> Vec3<S> {
    let (zero, one) = (S::Primal::zero(), S::Primal::one());
    let longer = |most: Vec3<S::Primal>, way: Vec3<S::Primal>| {
        most.length_squared().below(way.length_squared())
    };
    let none = Vec3::zero();
    let along = ways
        .clone()
        .fold(none, |most, way| Vec3::select(longer(most, way), way, most));
    let second = ways.fold(none, |most, way| {
        let more = longer(along.cross(most), along.cross(way));
        Vec3::select(more, way, most)
    });
    let up = normal(along, second);
    let [x, y, z] = [along.x, along.y, along.z];
    let flat = x.unsigned().at_most(y.unsigned());
    let any = Vec3::select(flat, Vec3::new(zero, z, -y), Vec3::new(-z, zero, x));
    let is_point = along.length_squared().equals(zero);
    let any = Vec3::select(is_point, Vec3::new(one, zero, zero), direction(any));
    fixed_vector(Vec3::select(up.clear & !up.none, up.unit, any))
}

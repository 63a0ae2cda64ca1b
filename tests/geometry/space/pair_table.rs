//! The shapes of space that have distances from each other: all pairs but those that are named here, with the reason.
use geograd::distance3::Apart;
use geograd::prelude::*;
use geograd::{Disc, Ellipsoid};
use std::marker::PhantomData;

struct Probe<A, B>(PhantomData<(A, B)>);

trait Found {
    fn found(&self) -> bool;
}
impl<A: Apart<B>, B> Found for Probe<A, B> {
    fn found(&self) -> bool {
        true
    }
}
trait Missing {
    fn found(&self) -> bool;
}
impl<A, B> Missing for &Probe<A, B> {
    fn found(&self) -> bool {
        false
    }
}

type Hull = Hull3<f64, 8>;

macro_rules! table {
    ([$($A:ident: $a:ty,)*] $columns:tt) => {
        vec![$( table!(row $A: $a, $columns) ),*]
    };
    (row $A:ident: $a:ty, [$($B:ident: $b:ty,)*]) => {
        vec![$( (stringify!($A), stringify!($B), (&Probe::<$a, $b>(PhantomData)).found()) ),*]
    };
}
macro_rules! shapes {
    ($($shape:ident: $type:ty,)*) => { table!([$($shape: $type,)*] [$($shape: $type,)*]) };
}

/// Pairs without a distance: any of the first with any of the second, both ways, and why.
const HOLES: [(&[&str], &[&str], &str); 1] = [(
    &["half_space"],
    &["half_space", "line", "ray"],
    "shapes without end meet unless they are parallel: the distance is zero, the depth none",
)];

#[test]
fn every_pair_of_shapes_has_distances_but_those_that_are_named() {
    let table: Vec<Vec<(&str, &str, bool)>> = shapes! {
        point: Vec3<f64>,
        ball: Sphere<f64>,
        segment: Segment3<f64>,
        capsule: Capsule3<f64>,
        triangle: Triangle3<f64>,
        tetrahedron: Tetrahedron<f64>,
        aligned_box: Aabb3<f64>,
        upright_box: YawBox3<f64>,
        rotated_box: Obb3<f64>,
        round_box: RoundBox3<f64>,
        hull: Hull,
        cylinder: Cylinder<f64>,
        cone: Cone<f64>,
        ellipsoid: Ellipsoid<f64>,
        disc: Disc<f64>,
        half_space: Plane3<f64>,
        line: Line3<f64>,
        ray: Ray3<f64>,
    };
    let mut used = [false; HOLES.len()];
    for (a, b, found) in table.iter().flatten() {
        let hole = HOLES.iter().position(|(first, second, _)| {
            first.contains(a) && second.contains(b) || first.contains(b) && second.contains(a)
        });
        assert_eq!(*found, hole.is_none(), "{a} {b}");
        if let Some(hole) = hole {
            used[hole] = true;
        }
    }
    assert!(used.iter().all(|used| *used));
    let count = |found: bool| {
        table
            .iter()
            .flatten()
            .filter(|pair| pair.2 == found)
            .count()
    };
    assert_eq!((count(true), count(false)), (319, 5));
}

//! Exact ties of three and more: equal shares, whatever the coordinates are called.
use geograd::distance3::signed_distance;
use geograd::iou3::penetration_or_gap;
use geograd::scalar::{least_of, most_of};
use geograd::{Aabb2, Aabb3, Jet, Obb3, Rotation3, Scalar, Triangle2, Vec2, Vec3, YawBox3};

fn variables<const N: usize>(x: [f64; N]) -> [Jet<f64, N>; N] {
    std::array::from_fn(|i| Jet::variable(x[i], i))
}
fn fixed(x: f64) -> Jet<f64, 3> {
    geograd::Scalar::lit(x)
}
fn three(x: f64) -> Vec3<Jet<f64, 3>> {
    Vec3::new(fixed(x), fixed(x), fixed(x))
}
fn cube(center: Vec3<Jet<f64, 3>>) -> Obb3<Jet<f64, 3>> {
    let turn = Rotation3::new(fixed(1.0), fixed(0.0), fixed(0.0), fixed(0.0));
    Obb3::new(center, three(2.0), turn)
}
fn close(derivatives: &[f64], expected: &[f64]) {
    for (a, b) in derivatives.iter().zip(expected) {
        assert!((a - b).abs() < 1e-15, "{derivatives:?} {expected:?}");
    }
}

#[test]
fn several_that_tie_share_equally() {
    let x = variables([2.0, 2.0, 5.0, 2.0, 5.0, 7.0, 7.0, 7.0]);
    close(
        &least_of(x).derivative,
        &[1.0 / 3.0, 1.0 / 3.0, 0.0, 1.0 / 3.0, 0.0, 0.0, 0.0, 0.0],
    );
    let third = 1.0 / 3.0;
    close(
        &most_of(x).derivative,
        &[0.0, 0.0, 0.0, 0.0, 0.0, third, third, third],
    );
    for (x, shares) in [
        ([1.0, 1.0, 1.0], [third, third, third]),
        ([1.0, 1.0, 2.0], [0.5, 0.5, 0.0]),
        ([1.0, 2.0, 1.0], [0.5, 0.0, 0.5]),
        ([2.0, 1.0, 1.0], [0.0, 0.5, 0.5]),
        ([3.0, 1.0, 2.0], [0.0, 1.0, 0.0]),
    ] {
        let (least, most) = (
            least_of(variables(x)),
            most_of(variables(x.map(|x: f64| -x))),
        );
        assert_eq!((least.value, most.value), (least_of(x), -least_of(x)));
        close(&least.derivative, &shares);
        close(&most.derivative, &shares);
    }
    assert_eq!(most_of(variables([f64::INFINITY; 3])).value, f64::INFINITY);
}

/// Infinite numbers share as others do, whatever carries the derivatives.
#[test]
fn infinite_ties_share_the_derivative() {
    let infinite = f64::INFINITY;
    let [x, y] = [0, 1].map(|i| Jet::<f64, 2>::variable(infinite, i));
    for shared in [x.most(y), x.least(y), (-x).least(-y), x.clamp(y, y)] {
        let all = shared.derivative.map(f64::abs);
        assert!(all == [0.5, 0.5] || all == [0.25, 0.75], "{shared:?}");
    }
    let [x, y] = [1.0, 3.0].map(|derivative| num_dual::Dual64::new(infinite, derivative));
    assert_eq!((x.most(y).re, x.most(y).eps), (infinite, 2.0));
    let [x, y] = [1.0, 3.0]
        .map(|derivative| num_dual::Dual2_64::new(infinite, derivative, 2.0 * derivative));
    assert_eq!((x.least(y).v1, x.least(y).v2), (2.0, 4.0));
    // Within one that is nested in another.
    let x = Jet::<Jet<f64, 1>, 1>::variable(Jet::variable(infinite, 0), 0);
    assert_eq!(x.most(x).value.derivative, [1.0]);
}

#[test]
fn a_point_at_a_corner_belongs_to_three_faces() {
    let thirds = [1.0 / 3.0; 3];
    for at in [1.0, 0.5, 0.25] {
        let [x, y, z] = variables([at; 3]);
        let point = Vec3::new(x, y, z);
        let found = [
            signed_distance(point, Aabb3::new(three(-1.0), three(1.0))),
            signed_distance(point, YawBox3::new(three(0.0), three(2.0), fixed(0.0))),
            signed_distance(point, cube(three(0.0))),
        ];
        for distance in found {
            assert_eq!(distance.value, at - 1.0);
            close(&distance.derivative, &thirds);
        }
    }
}

#[test]
fn bounds_share_among_all_that_reach_them() {
    let [a, b, c, d, e, f] = variables([0.0, 1.0, 0.0, 2.0, 0.0, 3.0]);
    let triangle = Triangle2::new(Vec2::new(a, b), Vec2::new(c, d), Vec2::new(e, f));
    let third = 1.0 / 3.0;
    close(
        &triangle.bounding().min.x.derivative,
        &[third, 0.0, third, 0.0, third, 0.0],
    );
    close(
        &triangle.bounding().max.x.derivative,
        &[third, 0.0, third, 0.0, third, 0.0],
    );
    close(
        &triangle.bounding().max.y.derivative,
        &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    );
    let points = variables([1.0, 1.0, 4.0, 1.0, 1.0]).map(|x| Vec2::new(x, x));
    let bounds = Aabb2::around(&points).expect("there are points");
    close(&bounds.min.x.derivative, &[0.25, 0.25, 0.0, 0.25, 0.25]);
    close(&bounds.max.y.derivative, &[0.0, 0.0, 1.0, 0.0, 0.0]);
    let points = points.map(|p| Vec3::new(p.x, p.y, p.x));
    let bounds = Aabb3::around(&points).expect("there are points");
    close(&bounds.min.z.derivative, &[0.25, 0.25, 0.0, 0.25, 0.25]);
}

#[test]
fn cubes_that_leave_each_other_do_so_along_three_axes() {
    let [x, y, z] = variables([1.0; 3]);
    let gap = penetration_or_gap(cube(three(0.0)), cube(Vec3::new(x, y, z)));
    assert_eq!(gap.value, -1.0);
    close(&gap.derivative, &[1.0 / 3.0; 3]);
}

//! Adjoints of the measures of polygons and of their distance from a point, against duals.
use super::cases::{at, stars};
use super::rings::{made, zeros};
use geograd::ad::adjoint::polygon::{area_vjp, centroid_vjp, perimeter_vjp, signed_distance_vjp};
use geograd::polygon::{self, Fill};
use geograd::{Pack, Polygon, Scalar, Vec2};
use geograd_tests::Dice;

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-12 * (1.0 + expected.abs()),
            "{found} {expected}"
        );
    }
}

#[test]
fn adjoints_of_measures_are_those_of_duals() {
    let mut dice = Dice(21);
    for _ in 0..60 {
        let rings = made(&stars(&mut dice));
        let mut bars = zeros(&rings);
        let count = bars.len();
        let duals = |f: &dyn Fn(Polygon<geograd::ad::forward::First<f64>>) -> _| {
            geograd::gradient(f, rings.clone()).1.scalars()
        };
        area_vjp(&rings, 2.0, &mut bars);
        let expected = duals(&|p| polygon::area(&p) * Scalar::lit(2.0));
        close(&bars.scalars(), &expected);
        perimeter_vjp(&rings, -1.0, &mut bars);
        close(&bars.scalars(), &duals(&|p| -polygon::perimeter(&p)));
        centroid_vjp(&rings, at(1.0, -0.5), &mut bars);
        let along = duals(&|p| {
            let centre = polygon::centroid(&p);
            centre.x - centre.y * Scalar::lit(0.5)
        });
        close(&bars.scalars(), &along);
        assert_eq!(bars.len(), count);
    }
    // Without area the centroid is the mean of the vertices; without vertices nothing is written.
    let flat = made(&[vec![at(0.0, 0.0), at(1.0, 1.0), at(3.0, 3.0)]]);
    let mut bars = zeros(&flat);
    centroid_vjp(&flat, at(3.0, 0.0), &mut bars);
    close(&bars.scalars(), &[1.0, 0.0, 1.0, 0.0, 1.0, 0.0]);
    centroid_vjp(&Polygon::<f64>::new(), at(1.0, 1.0), &mut []);
}

#[test]
fn the_adjoint_of_a_signed_distance_is_that_of_duals() {
    let mut dice = Dice(22);
    let square = vec![at(0.0, 0.0), at(4.0, 0.0), at(4.0, 4.0), at(0.0, 4.0)];
    let frame = made(&[
        square,
        vec![at(1.0, 1.0), at(3.0, 1.0), at(3.0, 3.0), at(1.0, 3.0)],
    ]);
    // Edges that tie, points on edges and on vertices.
    let hard = [
        (2.0, 2.0),
        (0.5, 0.5),
        (4.0, 2.0),
        (1.0, 2.0),
        (1.0, 1.0),
        (4.0, 4.0),
        (9.0, 9.0),
    ];
    let mut all: Vec<_> = hard.map(|(x, y)| (frame.clone(), at(x, y))).into();
    for _ in 0..200 {
        let point = at(dice.within(-4.0, 4.0), dice.within(-4.0, 4.0));
        all.push((made(&stars(&mut dice)), point));
    }
    for (rings, point) in all {
        for fill in [Fill::EvenOdd, Fill::NonZero] {
            let (mut by_point, mut bars) = (Vec2::zero(), zeros(&rings));
            let value = signed_distance_vjp(point, &rings, fill, 2.0, &mut by_point, &mut bars);
            let of = |(point, rings): (Vec2<_>, Polygon<_>)| {
                rings.rings().signed_distance(point, fill) * Scalar::lit(2.0)
            };
            let (twice, expected) = geograd::gradient(of, (point, rings.clone()));
            assert_eq!(2.0 * value, twice);
            close(&(by_point, bars).scalars(), &expected.scalars());
            assert_eq!(value, -rings.rings().depth(point, fill));
        }
    }
    let none = Polygon::<f64>::new();
    let mut by = Vec2::zero();
    let far = signed_distance_vjp(at(0.0, 0.0), &none, Fill::EvenOdd, 1.0, &mut by, &mut []);
    assert_eq!((far, by), (f64::MAX, Vec2::zero()));
}

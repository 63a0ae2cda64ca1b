//! Volumes that bodies with flat faces share, against an oracle and closed forms.
use super::draw::Random;
use super::hull_draw::{FAMILIES, pair};
use super::hull_oracle::Point;
use super::volume_oracle::{planes, shared, volume};
use geograd::prelude::*;

type Hull = Hull3<f64, 8>;

fn hull(corners: &[Point]) -> Hull {
    let vertices: Vec<_> = corners
        .iter()
        .map(|&[x, y, z]| Vec3::new(x, y, z))
        .collect();
    Hull3::from_vertices(&vertices)
}

fn extent(corners: &[Point]) -> f64 {
    let along = |i: usize| {
        let all = corners.iter().map(|p| p[i]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    along(0).max(along(1)).max(along(2))
}

/// Both hulls in units of the larger one, near the origin: exactly, but for families far from it.
fn placed([a, b]: &[Vec<Point>; 2]) -> ([Vec<Point>; 2], f64) {
    let from = a[0];
    let size = extent(a).max(extent(b)).max(f64::MIN_POSITIVE);
    let unit = size.log2().floor().exp2().recip();
    let place = |all: &[Point]| -> Vec<Point> {
        let of = |p: &Point| [0, 1, 2].map(|i| (p[i] - from[i]) * unit);
        all.iter().map(of).collect()
    };
    ([place(a), place(b)], unit)
}

/// The error of a volume, in roundings of the smaller size squared times the larger.
fn error(corners: &[Vec<Point>; 2], found: f64, right: f64, epsilon: f64) -> f64 {
    let sizes = corners.each_ref().map(|all| extent(all));
    let (less, more) = (sizes[0].min(sizes[1]), sizes[0].max(sizes[1]));
    let size = less * less * more;
    if size == 0.0 {
        return if found == right { 0.0 } else { f64::INFINITY };
    }
    (found - right).abs() / (size * epsilon)
}

#[test]
fn volumes_of_hulls_are_those_of_an_oracle() {
    let mut random = Random(0x2b99_2ddf_a232_49d6);
    for (family, name) in FAMILIES.iter().enumerate() {
        let mut worst: f64 = 0.0;
        for _ in 0..12 {
            let drawn = pair(&mut random, family);
            let ([a, b], unit) = placed(&drawn);
            if a.iter().chain(&b).any(|p| p.iter().any(|x| x.abs() > 8.0)) {
                continue;
            }
            let right = shared(&a, &b);
            let found = hull(&drawn[0]).intersection_volume(hull(&drawn[1])) * unit * unit * unit;
            let other = hull(&b).intersection_volume(hull(&a));
            let here = [a, b];
            for found in [found, other] {
                let error = error(&here, found, right, f64::EPSILON);
                worst = worst.max(error);
                assert!(error < 64.0, "{name}: {found} {right} {error} {here:?}");
            }
        }
        println!("{name}: {worst}");
    }
}

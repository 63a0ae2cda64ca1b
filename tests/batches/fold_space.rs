//! Folds over polylines and clouds of space, and over elements of a user's choice.
use geograd::distance3::polyline::distance_to_polyline;
use geograd::error::{Argument, Field, Flaw};
use geograd::kernels::fold::fold;
use geograd::kernels::op::{Declared, Declares, Jumps};
use geograd::kernels::{Cpu, Distance, Fold, Length, One, SecondMoments};
use geograd::measure::cloud::{centroid, covariance};
use geograd::{Error, Pack, Scalar, Symmetric3, Triangle3, Vec3};
use geograd_tests::Dice;
use geograd_tests::rows::{
    CentroidOfCloud3, CovarianceOfCloud3, DistancePointPolyline3, LengthOfPolyline3,
};

fn point(dice: &mut Dice) -> Vec3<f64> {
    let [x, y, z] = [0; 3].map(|_| dice.within(-2.0, 2.0));
    Vec3::new(x, y, z)
}

/// Paths of zero to thirteen vertices.
fn paths(dice: &mut Dice, count: usize) -> (Vec<Vec3<f64>>, Vec<usize>) {
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for _ in 0..count {
        let place = point(dice) * 100.0;
        for _ in 0..dice.below(14) {
            vertices.push(place + point(dice));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

fn parts(v: Vec3<f64>) -> [f64; 3] {
    [v.x, v.y, v.z]
}

/// The squared distance of a point and a segment by bisection of the derivative of a convex function.
fn squared_by_bisection(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    let at = |t: f64| [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * t - p[k]);
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let t = 0.5 * (low + high);
        let rising = (0..3).map(|k| at(t)[k] * (b[k] - a[k])).sum::<f64>() > 0.0;
        *(if rising { &mut high } else { &mut low }) = t;
    }
    at(0.5 * (low + high)).iter().map(|x| x * x).sum()
}

#[test]
fn polylines_and_clouds_have_the_values_of_other_formulas() {
    let mut dice = Dice(31);
    let (vertices, offsets) = paths(&mut dice, 600);
    let points: Vec<Vec3<f64>> = (0..600)
        .map(|i| vertices.get(offsets[i]).copied().unwrap_or(Vec3::zero()) + point(&mut dice))
        .collect();
    let cpu = Cpu::new();
    let none = One([]);
    let lengths = cpu
        .fold(LengthOfPolyline3, none, &vertices, &offsets)
        .unwrap();
    let distances = cpu
        .fold(DistancePointPolyline3, &points, &vertices, &offsets)
        .unwrap();
    let means = cpu
        .fold(CentroidOfCloud3, none, &vertices, &offsets)
        .unwrap();
    let spreads = cpu
        .fold(CovarianceOfCloud3, none, &vertices, &offsets)
        .unwrap();
    for i in 0..600 {
        let own: Vec<[f64; 3]> = vertices[offsets[i]..offsets[i + 1]]
            .iter()
            .map(|&v| parts(v))
            .collect();
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>();
        let length: f64 = own.windows(2).map(|e| apart(e[0], e[1]).sqrt()).sum();
        assert!(
            (lengths[i] - length).abs() <= 1e-13 * length,
            "{i}: {} {length}",
            lengths[i]
        );
        let edges = own
            .windows(2)
            .map(|e| squared_by_bisection(parts(points[i]), e[0], e[1]));
        let nearest = edges.fold(f64::INFINITY, f64::min).sqrt().min(f64::MAX);
        assert!(
            (distances[i] - nearest).abs() <= 1e-13 * (1.0 + nearest),
            "{i}: {} {nearest}",
            distances[i]
        );
        let n = own.len() as f64;
        // Half the mean of the squared differences of all pairs.
        let pairs = |j: usize, k: usize| {
            let mut sum = 0.0;
            for a in &own {
                for b in &own {
                    sum += (a[j] - b[j]) * (a[k] - b[k]);
                }
            }
            if n > 0.0 { 0.5 * sum / (n * n) } else { 0.0 }
        };
        let Symmetric3 {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        } = spreads[i];
        let found = [
            (xx, 0, 0),
            (yy, 1, 1),
            (zz, 2, 2),
            (xy, 0, 1),
            (xz, 0, 2),
            (yz, 1, 2),
        ];
        for (value, j, k) in found {
            assert!(
                (value - pairs(j, k)).abs() < 1e-13,
                "{i}: {value} {}",
                pairs(j, k)
            );
        }
        let mean = [0, 1, 2].map(|k| own.iter().map(|p| p[k]).sum::<f64>() / n.max(1.0));
        assert!(
            (0..3).all(|k| (parts(means[i])[k] - mean[k]).abs() < 1e-12),
            "{i}"
        );
        let path = &vertices[offsets[i]..offsets[i + 1]];
        assert_eq!((means[i], spreads[i]), (centroid(path), covariance(path)));
        assert_eq!(distances[i], distance_to_polyline(points[i], path));
        assert_eq!(lengths[i], fold::<LengthOfPolyline3, f64>([], path));
    }
}

/// A cloud far from the origin has the spread that it has there, to the rounding of its coordinates.
#[test]
fn places_cost_no_digits() {
    let mut dice = Dice(32);
    for _ in 0..200 {
        // Coordinates of few digits, which a shift by a power of two leaves exact.
        let near: Vec<Vec3<f64>> = (0..7)
            .map(|_| {
                let v = point(&mut dice) * 1024.0;
                Vec3::new(v.x.round(), v.y.round(), v.z.round()) * (1.0 / 1024.0)
            })
            .collect();
        let shift = Vec3::new(1048576.0, -2097152.0, 4194304.0);
        let far: Vec<Vec3<f64>> = near.iter().map(|&v| v + shift).collect();
        let (a, b) = (covariance(&near), covariance(&far));
        for (x, y) in a.scalars().iter().zip(b.scalars()) {
            assert!((x - y).abs() < 1e-8, "{a:?} {b:?}");
        }
        let off = (centroid(&far) - shift - centroid(&near)).length();
        assert!(off < 1e-9, "{off}");
    }
}

#[test]
fn adjoints_are_those_of_the_formulas() {
    let mut dice = Dice(33);
    let (vertices, offsets) = paths(&mut dice, 100);
    let cpu = Cpu::new();
    let ups: Vec<Symmetric3<f64>> = (0..100)
        .map(|_| {
            let (a, b) = (point(&mut dice), point(&mut dice));
            Symmetric3::new(a.x, a.y, a.z, b.x, b.y, b.z)
        })
        .collect();
    let fold = SecondMoments.over_cloud3();
    let (_, bars) = cpu
        .fold_vjp(fold, One([]), &vertices, &offsets, &ups)
        .unwrap();
    let up: Vec<Vec3<f64>> = (0..100).map(|_| point(&mut dice)).collect();
    let (_, shares) = cpu
        .fold_vjp(CentroidOfCloud3, One([]), &vertices, &offsets, &up)
        .unwrap();
    let ones = [1.0; 100];
    let run = Length.over_polyline3();
    let (_, pulls) = cpu
        .fold_vjp(run, One([]), &vertices, &offsets, &ones)
        .unwrap();
    for i in 0..100 {
        let own = &vertices[offsets[i]..offsets[i + 1]];
        let (mean, n) = (centroid(own), own.len() as f64);
        for k in offsets[i]..offsets[i + 1] {
            let arm = (vertices[k] - mean) * (1.0 / n);
            let u = ups[i];
            // The symmetric matrix counts what is beside its diagonal once.
            let doubled = Symmetric3::new(2.0 * u.xx, 2.0 * u.yy, 2.0 * u.zz, u.xy, u.xz, u.yz);
            assert!((bars[k] - doubled * arm).length() < 1e-12, "{i} {k}");
            assert!((shares[k] - up[i] * (1.0 / n)).length() < 1e-15, "{i} {k}");
            let mut pull = Vec3::zero();
            if k > offsets[i] {
                pull += (vertices[k] - vertices[k - 1]).normalize_or_zero();
            }
            if k + 1 < offsets[i + 1] {
                pull += (vertices[k] - vertices[k + 1]).normalize_or_zero();
            }
            assert!((pulls[k] - pull).length() < 1e-14, "{i} {k}");
        }
    }
}

/// Three edges at one distance share the derivative in thirds; a corner has that of the distance to it.
#[test]
fn edges_that_tie_share() {
    let p = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    // Three sides of a square around the point, then away.
    let path = [
        p(-1.0, -1.0, 0.0),
        p(1.0, -1.0, 0.0),
        p(1.0, 1.0, 0.0),
        p(-1.0, 1.0, 0.0),
    ];
    let run = Distance.over_polyline3();
    let cpu = Cpu::new();
    let (by_point, _) = cpu
        .fold_vjp(run, One(p(0.0, 0.0, 0.0)), &path, &[0, 4], &[1.0])
        .unwrap();
    assert!(
        (by_point[0] - p(-1.0 / 3.0, 0.0, 0.0)).length() < 1e-15,
        "{by_point:?}"
    );
    let corner = One(p(3.0, 3.0, 0.0));
    let (by_point, by_vertex) = cpu
        .fold_vjp(run, corner, &path[..3], &[0, 3], &[1.0])
        .unwrap();
    let diagonal = p(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0);
    assert!((by_point[0] - diagonal).length() < 1e-15);
    assert!((by_vertex[2] + diagonal).length() < 1e-15);
    assert_eq!(by_vertex[0], Vec3::zero());
}

#[test]
fn bad_vertices_are_named() {
    let mut path = vec![Vec3::new(0.0_f64, 0.0, 0.0); 5];
    path[3].z = f64::NAN;
    let found = Cpu::new().fold(LengthOfPolyline3, One([]), &path, &[0, 2, 5]);
    let expected = Error::Invalid {
        argument: Argument::Vertices,
        item: 3,
        flaw: Flaw::NotFinite(Field::new("z")),
    };
    assert_eq!(found, Err(expected));
}

/// The area of a surface made of triangles.
#[derive(Clone, Copy, Debug, Default)]
struct SurfaceArea;

impl Declares for SurfaceArea {
    const DECLARED: Declared = Declared::new("surface_area", &[], Jumps::Never);
}

impl Fold for SurfaceArea {
    const CLOSED: bool = true;
    type Element<S: Scalar> = Triangle3<S>;
    type Context<S: Scalar> = [S; 0];
    type Reference<S: Scalar> = [S; 0];
    type State<S: Scalar> = S;
    type Out<S: Scalar> = S;
    fn reference<S: Scalar>(_: [S; 0], _: &[Triangle3<S>]) -> [S; 0] {
        []
    }
    fn empty<S: Scalar>() -> S {
        S::zero()
    }
    fn edge<S: Scalar>(_: [S; 0], _: [S; 0], face: Triangle3<S>, _: Triangle3<S>) -> S {
        (face.b - face.a).cross(face.c - face.a).length().halved()
    }
    fn join<S: Scalar>(one: S, other: S) -> S {
        one + other
    }
    fn finish<S: Scalar>(_: [S; 0], _: [S; 0], area: S) -> S {
        area
    }
}

/// A fold over triangles: areas of surfaces, and how they change with every corner.
#[test]
fn elements_may_be_triangles() {
    let p = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let faces = [
        Triangle3::new(p(0.0, 0.0, 0.0), p(2.0, 0.0, 0.0), p(0.0, 2.0, 0.0)),
        Triangle3::new(p(0.0, 0.0, 0.0), p(0.0, 0.0, 1.0), p(0.0, 4.0, 0.0)),
        Triangle3::new(p(0.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, 0.0, 1.0)),
    ];
    let cpu = Cpu::new();
    let areas = cpu
        .fold(SurfaceArea, One([]), &faces, &[0, 2, 3, 3])
        .unwrap();
    assert_eq!(areas, [4.0, 0.5, 0.0]);
    let (_, bars) = cpu
        .fold_vjp(
            SurfaceArea,
            One([]),
            &faces,
            &[0, 2, 3, 3],
            &[1.0, 2.0, 1.0],
        )
        .unwrap();
    assert_eq!(bars[0].b, p(1.0, 0.0, 0.0));
    assert_eq!(bars[2].c, p(0.0, 0.0, 1.0));
}

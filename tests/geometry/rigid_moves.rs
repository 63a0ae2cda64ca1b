//! A pose moves rigidly, whatever the length of its cosine and sine.
//!
//! Multiples of Pythagorean triples have rational cosines and sines: the witness is whole numbers over a hypotenuse.
use geograd::kernels::{Cpu, Move};
use geograd::{Error, Flaw, Pose2, Real, Rotation2, Segment2, Vec2};

/// Cosine and sine over a hypotenuse, also of axes.
const TRIPLES: [[i64; 3]; 7] = [
    [1, 0, 1],
    [0, -1, 1],
    [3, 4, 5],
    [-4, 3, 5],
    [5, -12, 13],
    [-8, -15, 17],
    [20, 21, 29],
];

fn pose<T: Real>([cos, sin]: [f64; 2], [x, y]: [i64; 2]) -> Pose2<T> {
    let number = |x: f64| T::lit(x);
    Pose2 {
        rotation: Rotation2 {
            cos: number(cos),
            sin: number(sin),
        },
        translation: Vec2::new(number(x as f64), number(y as f64)),
    }
}

/// Every triple, at every length, on every segment of a small grid.
fn moves<T: Real + Into<f64>>(lengths: &[f64]) {
    let grid = [[0, 0], [1, 0], [-2, 3], [7, 5], [1, 0]];
    for [cos, sin, hypotenuse] in TRIPLES {
        for &length in lengths {
            let turn = [cos as f64 * length, sin as f64 * length];
            for shift in [[0, 0], [3, -2]] {
                for (from, to) in grid.iter().flat_map(|a| grid.iter().map(move |b| (*a, *b))) {
                    let corner = |[x, y]: [i64; 2]| Vec2::new(T::lit(x as f64), T::lit(y as f64));
                    let segment = Segment2::new(corner(from), corner(to));
                    let moved = Cpu::new()
                        .aligned(Move, (&[pose::<T>(turn, shift)], &[segment]))
                        .unwrap()[0];
                    for (end, [x, y]) in [(moved.from, from), (moved.to, to)] {
                        let expected = [cos * x - sin * y, sin * x + cos * y];
                        for (found, (turned, by)) in [end.x, end.y]
                            .into_iter()
                            .zip(expected.into_iter().zip(shift))
                        {
                            let right = (turned + by * hypotenuse) as f64 / hypotenuse as f64;
                            let error = (found.into() - right).abs();
                            assert!(
                                error <= 32.0 * T::format().epsilon(),
                                "{cos} {sin} times {length}, {from:?}: {found:?} is not {right}"
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn any_length_of_cosine_and_sine_is_the_same_motion() {
    moves::<f64>(&[1.0, 0.2, 2.0, 3e150, 1e-150, 5e306, 1e-300]);
    moves::<f32>(&[1.0, 0.2, 2.0, 3e18, 1e-18, 5e36, 1e-36]);
}

#[test]
fn the_derivative_along_the_length_is_zero() {
    let segment = Segment2::new(Vec2::new(2.0, 1.0), Vec2::new(-3.0, 5.0));
    let upstream = Segment2::new(Vec2::new(1.0, -2.0), Vec2::new(0.5, 3.0));
    for length in [1.0, 0.5, 7.0] {
        let pose = pose::<f64>([3.0 * length, 4.0 * length], [1, 1]);
        let (bars, _) = Cpu::new()
            .aligned(Move.vjp(), ((&[pose], &[segment]), &[upstream]))
            .unwrap();
        let bar = bars[0];
        let along = bar.rotation.cos * 3.0 + bar.rotation.sin * 4.0;
        assert!(along.abs() < 1e-14, "{along}");
        // That across is by the angle, over the length: the derivative of the turned ends by the angle, times upstream.
        let across = bar.rotation.sin * 3.0 - bar.rotation.cos * 4.0;
        let turned = |v: Vec2<f64>| Vec2::new(0.6 * v.x - 0.8 * v.y, 0.8 * v.x + 0.6 * v.y);
        let slope = |v: Vec2<f64>, up: Vec2<f64>| -turned(v).y * up.x + turned(v).x * up.y;
        let right = slope(segment.from, upstream.from) + slope(segment.to, upstream.to);
        assert!((across * length - right).abs() < 1e-13, "{across} {right}");
    }
}

#[test]
fn a_pose_without_direction_is_an_error() {
    let none = pose::<f64>([0.0, 0.0], [1, 1]);
    let segment = Segment2::new(Vec2::new(0.0, 0.0), Vec2::new(1.0, 0.0));
    let found = Cpu::new().aligned(Move, (&[none], &[segment]));
    assert!(matches!(
        found,
        Err(Error::Invalid {
            flaw: Flaw::Broken(field, "and sin are both zero"),
            ..
        }) if field.as_str() == "rotation.cos"
    ));
    assert_eq!(
        Rotation2::<f64> { cos: 0.0, sin: 0.0 }.normalized(),
        Rotation2::identity()
    );
}

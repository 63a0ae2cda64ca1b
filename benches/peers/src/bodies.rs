//! Signed distances of curved bodies, call by call and with slopes in batches, and the same pairs for `coal_bodies.cpp`.
use super::space::draw::Random;
use geograd::kernels::{Cpu, SignedDistance};
use geograd::prelude::*;
use geograd::{Cone, Cylinder, Ellipsoid, Hull3, Obb3, Pack, Rotation3, Vec3};
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

/// Pairs of a list.
const PAIRS: usize = 2000;
/// Runs, of which the fastest counts.
const RUNS: usize = 9;

/// A body whose numbers `coal_bodies.cpp` reads.
trait Body: Pack<Scalar = f64> {
    /// Returns a body around a centre, between 0.3 and 0.8 of extent.
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self;
    /// The letter of its kind.
    const LETTER: char;
}

fn axis(random: &mut Random) -> Vec3<f64> {
    random.vector(1.0).normalize_or_zero() * random.within(0.3, 0.8)
}

fn turn(random: &mut Random) -> Rotation3<f64> {
    let [w, x, y, z] = [(); 4].map(|()| random.within(-1.0, 1.0));
    Rotation3 { w, x, y, z }
}

impl Body for Ellipsoid<f64> {
    const LETTER: char = 'E';
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self {
        let [x, y, z] = [(); 3].map(|()| random.within(0.3, 0.8));
        Ellipsoid::new(center, Vec3::new(x, y, z), turn(random))
    }
}

impl Body for Cylinder<f64> {
    const LETTER: char = 'Y';
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self {
        let axis = axis(random);
        Cylinder::new(center - axis, center + axis, random.within(0.3, 0.8))
    }
}

impl Body for Cone<f64> {
    const LETTER: char = 'O';
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self {
        let axis = axis(random);
        Cone::new(center + axis, center - axis, random.within(0.3, 0.8))
    }
}

impl Body for Obb3<f64> {
    const LETTER: char = 'B';
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self {
        let [x, y, z] = [(); 3].map(|()| random.within(0.6, 1.6));
        Obb3::new(center, Vec3::new(x, y, z), turn(random))
    }
}

impl Body for Hull3<f64, 8> {
    const LETTER: char = 'H';
    fn drawn(random: &mut Random, center: Vec3<f64>) -> Self {
        let corner = |_| center + random.vector(1.0).normalize_or_zero();
        Hull3::from(std::array::from_fn(corner))
    }
}

/// Nanoseconds a pair of the fastest run.
fn fastest(mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        run();
        best = best.min(start.elapsed().as_secs_f64());
    }
    best / PAIRS as f64 * 1e9
}

fn numbers(text: &mut String, body: &impl Body, letter: char) {
    write!(text, " {letter}").expect("text has room");
    for x in body.scalars() {
        write!(text, " {x:e}").expect("text has room");
    }
}

/// Times pairs of two kinds that are apart, and that overlap, and adds their lines.
macro_rules! timed {
    ($text:ident, $name:literal, $A:ty, $B:ty) => {{
        for apart in [true, false] {
            let mut random = Random(0x0b0d_1e5b_0d1e_5b0d);
            let (mut all_a, mut all_b): (Vec<$A>, Vec<$B>) = (vec![], vec![]);
            while all_a.len() < PAIRS {
                let a = <$A>::drawn(&mut random, Vec3::zero());
                let center = random.vector(1.2);
                let b = <$B>::drawn(&mut random, center);
                if (a.signed_distance(b) > 0.0) == apart {
                    all_a.push(a);
                    all_b.push(b);
                }
            }
            let pairs = || all_a.iter().zip(&all_b);
            let alone = fastest(|| {
                black_box(pairs().map(|(a, b)| a.signed_distance(*b)).sum::<f64>());
            });
            let both = (&all_a[..], &all_b[..]);
            let cpu = Cpu::new();
            let batch = fastest(|| {
                black_box(cpu.aligned(SignedDistance, both).expect("valid bodies"));
            });
            let slopes = fastest(|| {
                let found = cpu.aligned(SignedDistance.value_grad(), both);
                black_box(found.expect("valid bodies"));
            });
            let place = if apart { "apart" } else { "overlapping" };
            println!(
                "| {}, {place} | {alone:.0} | {batch:.0} | {slopes:.0} |",
                $name
            );
            for (a, b) in pairs() {
                write!($text, "{}_{place}", $name.replace(' ', "_")).expect("text has room");
                numbers(&mut $text, a, <$A>::LETTER);
                numbers(&mut $text, b, <$B>::LETTER);
                writeln!($text, " {:e}", a.signed_distance(*b)).expect("text has room");
            }
        }
    }};
}

/// Prints nanoseconds a signed distance; returns the pairs as lines: the name, a letter and numbers of each body, and the
/// signed distance by geograd.
pub fn bodies() -> String {
    println!("| bodies | call by call, ns | batch | with slopes |\n| --- | ---: | ---: | ---: |");
    let mut text = String::new();
    timed!(text, "box and cylinder", Obb3<f64>, Cylinder<f64>);
    timed!(text, "cylinders", Cylinder<f64>, Cylinder<f64>);
    timed!(text, "ellipsoids", Ellipsoid<f64>, Ellipsoid<f64>);
    timed!(
        text,
        "cylinder and ellipsoid",
        Cylinder<f64>,
        Ellipsoid<f64>
    );
    timed!(text, "cones", Cone<f64>, Cone<f64>);
    timed!(text, "cylinder and cone", Cylinder<f64>, Cone<f64>);
    timed!(text, "cone and ellipsoid", Cone<f64>, Ellipsoid<f64>);
    timed!(text, "box and ellipsoid", Obb3<f64>, Ellipsoid<f64>);
    timed!(text, "hull and ellipsoid", Hull3<f64, 8>, Ellipsoid<f64>);
    timed!(text, "box and hull", Obb3<f64>, Hull3<f64, 8>);
    timed!(text, "hulls", Hull3<f64, 8>, Hull3<f64, 8>);
    text
}

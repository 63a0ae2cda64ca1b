//! A path in the space of joint angles, and how it leaves what it collides with.
use crate::arm::{Joints, RADIUS, clearance};
use geograd::Error;
use geograd::kernels::{Cpu, One, function};

/// The clearance that a path shall have, in metres.
pub const MARGIN: f64 = 0.04;
/// How much a lack of clearance weighs against the velocity of the joints.
const WEIGHT: f64 = 12000.0;
/// The share of a full step.
const RATE: f64 = 0.01;
/// The longest way of one joint in one step, in radians.
const LONGEST: f64 = 0.05;
/// Both ends of the path.
const ENDS: [Joints<f64>; 2] = [
    [2.2, -1.0, 1.5, -2.07, -1.57, 0.0],
    [3.9, -1.0, 1.5, -2.07, -1.57, 0.6],
];

pub type Path = Vec<Joints<f64>>;

/// The point between two others.
fn between(a: Joints<f64>, b: Joints<f64>, t: f64) -> Joints<f64> {
    std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t)
}

/// The straight path of so many points.
pub fn straight(points: usize) -> Path {
    let part = |i: usize| i as f64 / (points - 1) as f64;
    (0..points)
        .map(|i| between(ENDS[0], ENDS[1], part(i)))
        .collect()
}

/// A path with further points on each of its pieces.
pub fn refined(path: &[Joints<f64>], pieces: usize) -> Path {
    let part = |i: usize| i as f64 / pieces as f64;
    let of =
        |w: &[Joints<f64>]| -> Path { (0..pieces).map(|i| between(w[0], w[1], part(i))).collect() };
    let mut fine: Path = path.windows(2).flat_map(of).collect();
    fine.extend(path.last());
    fine
}

/// The length of a path in radians.
pub fn length(path: &[Joints<f64>]) -> f64 {
    let step = |w: &[Joints<f64>]| {
        (0..6)
            .map(|k| (w[1][k] - w[0][k]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    path.windows(2).map(step).sum()
}

/// The clearance of every point.
pub fn clearances(path: &[Joints<f64>]) -> Result<Vec<f64>, Error> {
    Cpu::new().aligned(function(clearance), (path, One(RADIUS)))
}

/// Descends on half the integral of the squared velocity of the joints, plus [`WEIGHT`] times that of the squared lack
/// of clearance. The ends stay.
///
/// Steps go along the derivative as velocities measure it (Zucker and others 2013, "CHOMP"): a push at one point moves
/// its neighbours, too, and the part of the velocity is the way back to the straight path.
pub fn descend(mut path: Path, steps: usize, told: impl Fn()) -> Result<Path, Error> {
    let goal = straight(path.len());
    for _ in 0..steps {
        let columns = (&path[..], One(RADIUS));
        let (values, (by_joints, _)) =
            Cpu::new().aligned(function(clearance).value_grad(), columns)?;
        let lack = |i: usize| WEIGHT * (MARGIN - values[i]).max(0.0);
        let pushes: Path = (0..path.len())
            .map(|i| by_joints[i].map(|by| lack(i) * by))
            .collect();
        let pushes = spread(&pushes);
        for i in 1..path.len() - 1 {
            for k in 0..6 {
                let step = RATE * (pushes[i][k] + goal[i][k] - path[i][k]);
                path[i][k] += step.clamp(-LONGEST, LONGEST);
            }
        }
        told();
    }
    Ok(path)
}

/// Solves `−x″ = pushes` by differences over a time of one, with zero at both ends (elimination, Thomas 1949).
fn spread(pushes: &[Joints<f64>]) -> Path {
    let (count, mut ahead) = (pushes.len(), vec![0.0; pushes.len()]);
    let (mut found, part) = (vec![[0.0; 6]; count], 1.0 / (count - 1) as f64);
    for i in 1..count - 1 {
        let pivot = 1.0 / (2.0 - ahead[i - 1]);
        ahead[i] = pivot;
        found[i] = std::array::from_fn(|k| (pushes[i][k] * part * part + found[i - 1][k]) * pivot);
    }
    for i in (1..count - 1).rev() {
        found[i] = std::array::from_fn(|k| found[i][k] + ahead[i] * found[i + 1][k]);
    }
    found
}

//! The peg's path into the hole, and the least squares that push it out of the walls.
use crate::bodies::{self, ENDS, HALF, MovingPeg, PLAY, Place, Solid};
use geograd::Error;
use geograd::kernels::verbs::{Clearance, SignedDistance};
use geograd::kernels::{Cpu, One, function};
use geograd::motion::Motion3;

/// The clearance that the path shall have, in metres.
pub const MARGIN: f64 = 0.5 * PLAY;
/// How much ways of a metre and turns of a radian weigh: as far as a turn moves the peg's sides.
const UNITS: [f64; 2] = [1.0, 0.3];
/// How much a lack of a metre weighs: at first little, so that the points spread; then as much as the margin needs.
const WEIGHTS: [f64; 2] = [30.0, 1000.0];
/// The damping of the first step with a weight.
const DAMPING: f64 = 1000.0;
/// The number of places of a piece whose distances push it.
const SAMPLES: usize = 16;
/// The number of last steps, in which clearances over all times push, too.
const EXACT: usize = 8;

pub type Path = Vec<Place<f64>>;

/// The clearance of one piece of a path from one part of the block, with its derivatives.
pub struct Near {
    /// The number of the piece.
    pub piece: usize,
    /// In metres; minus the depth where they collide.
    pub clearance: f64,
    /// By the places at both ends.
    pub by_ends: [Place<f64>; 2],
    /// By half the width of the peg.
    pub by_half: f64,
}

/// Returns the straight path of so many points.
pub fn straight(points: usize) -> Path {
    let part = |k: usize| k as f64 / (points - 1) as f64;
    (0..points)
        .map(|k| bodies::between(ENDS[0], ENDS[1], part(k)))
        .collect()
}

/// The pieces of a path, each repeated for some parts of the way and for every part of the block.
struct Pairs {
    piece: Vec<usize>,
    from: Path,
    to: Path,
    part: Vec<f64>,
    solid: Vec<Solid<f64>>,
}

impl Pairs {
    fn of(path: &[Place<f64>], samples: usize) -> Self {
        let (block, count) = (bodies::block(), 7 * samples);
        let all = 0..(path.len() - 1) * count;
        Pairs {
            piece: all.clone().map(|i| i / count).collect(),
            from: all.clone().map(|i| path[i / count]).collect(),
            to: all.clone().map(|i| path[i / count + 1]).collect(),
            part: all
                .clone()
                .map(|i| (i / 7 % samples) as f64 / samples as f64)
                .collect(),
            solid: all.map(|i| block[i % 7]).collect(),
        }
    }
    fn near(&self, values: Vec<f64>, by_from: Path, by_to: Path, by_half: Vec<f64>) -> Vec<Near> {
        let near = |i: usize| Near {
            piece: self.piece[i],
            clearance: values[i],
            by_ends: [by_from[i], by_to[i]],
            by_half: by_half[i],
        };
        (0..values.len()).map(near).collect()
    }
}

/// Returns the distances of some places of every piece of a path from all parts of the block.
pub fn sampled(path: &[Place<f64>]) -> Result<Vec<Near>, Error> {
    let (cpu, pairs) = (Cpu::new(), Pairs::of(path, SAMPLES));
    let columns = (&pairs.from[..], &pairs.to[..], &pairs.part[..], One(HALF));
    let corners = cpu.aligned(function(bodies::corners), columns)?;
    let pegs: Vec<_> = corners.into_iter().map(Solid::from).collect();
    let run = SignedDistance.value_grad();
    let (values, (by_pegs, _)) = cpu.aligned(run, (&pegs[..], &pairs.solid[..]))?;
    let by: Vec<_> = by_pegs.into_iter().map(|peg| peg.vertices).collect();
    let (by_from, by_to, _, by_half) =
        cpu.aligned(function(bodies::corners).vjp(), (columns, &by[..]))?;
    Ok(pairs.near(values, by_from, by_to, by_half))
}

/// Returns the clearances of all pieces of a path from all parts of the block, over all times between the points.
pub fn clearances(path: &[Place<f64>]) -> Result<Vec<Near>, Error> {
    let (cpu, pairs) = (Cpu::new(), Pairs::of(path, 1));
    let columns = (&pairs.from[..], &pairs.to[..], One(HALF));
    let pegs = cpu.aligned(function(bodies::moving), columns)?;
    let body: Vec<_> = pegs.iter().map(|peg| Solid::from(peg.corners)).collect();
    let motion: Vec<_> = pegs.iter().map(|peg| peg.motion).collect();
    let moving = (
        &body[..],
        &motion[..],
        &pairs.solid[..],
        One(Motion3::still()),
    );
    let (values, (by_body, by_motion, ..)) = cpu.aligned(Clearance.value_grad(), moving)?;
    // Derivatives by the peg at the start and by its motion are pulled back to the places.
    let by = by_body.into_iter().zip(by_motion);
    let by: Vec<_> = by
        .map(|(body, motion)| MovingPeg {
            corners: body.vertices,
            motion,
        })
        .collect();
    let (by_from, by_to, by_half) =
        cpu.aligned(function(bodies::moving).vjp(), (columns, &by[..]))?;
    Ok(pairs.near(values, by_from, by_to, by_half))
}

/// Returns the distances of pegs from the nearest part of the block, in metres; minus the depth where they collide.
pub fn distances(pegs: &[Solid<f64>]) -> Result<Vec<f64>, Error> {
    let nearest = Cpu::new().row_min(SignedDistance, pegs, &bodies::block())?;
    Ok(nearest.into_iter().map(|best| best.value).collect())
}

/// The normal equations of least squares.
struct Squares {
    sum: f64,
    matrix: Vec<Vec<f64>>,
    right: Vec<f64>,
}

impl Squares {
    /// Returns those of a path: its ways between points, and what `near` lacks of the margin.
    fn of(path: &[Place<f64>], near: &[Near], weight: f64) -> Self {
        let count = 6 * (path.len() - 2);
        let (matrix, right) = (vec![vec![0.0; count]; count], vec![0.0; count]);
        let mut all = Squares {
            sum: 0.0,
            matrix,
            right,
        };
        for (k, ends) in path.windows(2).enumerate() {
            for i in 0..6 {
                let unit = UNITS[i / 3];
                let by = [(6 * k + i, -unit), (6 * k + 6 + i, unit)];
                all.add(unit * (ends[1][i] - ends[0][i]), &by);
            }
        }
        for near in near.iter().filter(|near| near.clearance < MARGIN) {
            let by = near.by_ends.as_flattened();
            let by: Vec<_> = by
                .iter()
                .enumerate()
                .map(|(i, x)| (6 * near.piece + i, -weight * x))
                .collect();
            all.add(weight * (MARGIN - near.clearance), &by);
        }
        all
    }
    /// Adds a residual, by its derivatives by numbers of the path.
    fn add(&mut self, residual: f64, by: &[(usize, f64)]) {
        self.sum += residual * residual;
        // The ends of the path stay.
        let inside = || {
            by.iter()
                .filter_map(|&(v, x)| Some((v.checked_sub(6)?, x)))
                .filter(|&(v, _)| v < self.right.len())
        };
        let own: Vec<_> = inside().collect();
        for &(v, x) in &own {
            self.right[v] -= x * residual;
            for &(w, y) in &own {
                self.matrix[v][w] += x * y;
            }
        }
    }
}

/// Returns a path that is short and keeps the margin: least squares of the ways between points and of what distances
/// lack, with damped steps (Levenberg 1944). The ends stay.
pub fn descend(mut path: Path, steps: usize, told: impl Fn()) -> Result<Path, Error> {
    let (mut damping, mut weight) = (DAMPING, WEIGHTS[0]);
    let mut squares = Squares::of(&path, &sampled(&path)?, weight);
    for step in 0..steps {
        let exact = step + EXACT >= steps;
        let near = |path: &[Place<f64>]| -> Result<Vec<Near>, Error> {
            let mut all = sampled(path)?;
            if exact {
                all.extend(clearances(path)?);
            }
            Ok(all)
        };
        if step == steps / 2 || step + EXACT == steps {
            (damping, weight) = (DAMPING, WEIGHTS[1]);
            squares = Squares::of(&path, &near(&path)?, weight);
        }
        let mut matrix = squares.matrix.clone();
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] += damping;
        }
        let mut next = path.clone();
        for (i, change) in solved(matrix, squares.right.clone())
            .into_iter()
            .enumerate()
        {
            next[1 + i / 6][i % 6] += change;
        }
        let better = Squares::of(&next, &near(&next)?, weight);
        if better.sum < squares.sum {
            (path, squares, damping) = (next, better, damping / 3.0);
        } else {
            damping *= 4.0;
        }
        told();
    }
    Ok(path)
}

/// Returns the solution of equations whose matrix is symmetric and positive definite (Cholesky).
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let count = right.len();
    for i in 0..count {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| matrix[i][k] * matrix[j][k]).sum();
            let rest = matrix[i][j] - sum;
            matrix[i][j] = if i == j {
                rest.sqrt()
            } else {
                rest / matrix[j][j]
            };
        }
        let sum: f64 = (0..i).map(|k| matrix[i][k] * right[k]).sum();
        right[i] = (right[i] - sum) / matrix[i][i];
    }
    for i in (0..count).rev() {
        let sum: f64 = (i + 1..count).map(|k| matrix[k][i] * right[k]).sum();
        right[i] = (right[i] - sum) / matrix[i][i];
    }
    right
}

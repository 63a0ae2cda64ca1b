//! Four ways to find the pose in which a scan fits a mesh. All minimise the same robust sum of distances (Huber 1964).
//!
//! | way | a step |
//! | --- | --- |
//! | points | each point of the scan is drawn to the nearest point of the mesh (Besl and McKay 1992) |
//! | planes | each point is drawn to the plane of the nearest face (Chen and Medioni 1992) |
//! | Gauss and Newton | derivatives of distances by the pose, of first order |
//! | Newton | the exact Hessian of the sum: of faces, edges, corners, and of the motion |
use common::positive::solved;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::kernels::{Cpu, One, function};
use geograd::mesh::{FaceFeature, FaceRecord, MeshSurface, distance_replay};
use geograd::procrustes::procrustes_rigid;
use geograd::{Error, Pose3, Rotation3, Scalar, Triangle3, Vec3};
use std::time::Instant;

/// A turn as a rotation vector, and a shift.
type Step<S> = [S; 6];
type Square = [[f64; 6]; 6];

/// Damping of the first step that needs one, and the least one that is not zero.
const DAMPING: [f64; 2] = [1e-3, 1e-6];
/// Newton's method takes Hessians after a step that moves points by less than this, in metres.
const NEAR_END: f64 = 1e-4;
/// A registration ends with a step that moves points by less than this, in metres.
const STILL: f64 = 1e-9;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    Points,
    Planes,
    GaussNewton,
    Newton,
}

impl Way {
    pub const ALL: [Way; 4] = [Way::Points, Way::Planes, Way::GaussNewton, Way::Newton];
    pub fn name(self) -> &'static str {
        match self {
            Way::Points => "ICP, points",
            Way::Planes => "ICP, planes",
            Way::GaussNewton => "Gauss-Newton",
            Way::Newton => "Newton",
        }
    }
}

/// A registration, step by step.
#[derive(Clone, Debug)]
pub struct Course {
    /// The pose before every step and at the end.
    pub poses: Vec<Pose3<f64>>,
    /// Half the robust sum of squares at the end, in square metres.
    pub loss: f64,
    pub seconds: f64,
}

impl Course {
    pub fn end(&self) -> Pose3<f64> {
        self.poses[self.poses.len() - 1]
    }
    /// The number of steps after which points stay within a distance of where they end.
    pub fn steps_to(&self, distance: f64, points: &[Vec3<f64>]) -> usize {
        let end = self.end();
        let is_away = |pose: &Pose3<f64>| way(points, *pose, end) > distance;
        self.poses.iter().rposition(is_away).map_or(0, |k| k + 1)
    }
}

/// How far the points are apart under two poses, as a root of the mean square.
fn way(points: &[Vec3<f64>], a: Pose3<f64>, b: Pose3<f64>) -> f64 {
    let squares = points.iter().map(|&p| (a * p - b * p).length_squared());
    (squares.sum::<f64>() / points.len() as f64).sqrt()
}

/// Huber's function: half the square up to a width, from there on straight; with its slope and curvature.
pub fn huber(x: f64, width: f64) -> [f64; 3] {
    match x.abs() <= width {
        true => [0.5 * x * x, x, 1.0],
        false => [width * (x.abs() - 0.5 * width), width * x.signum(), 0.0],
    }
}

/// The weight of a square that stands for Huber's function at a number.
fn weight(x: f64, width: f64) -> f64 {
    match x.abs() <= width {
        true => 1.0,
        false => width / x.abs(),
    }
}

/// The place of a point that a step moves; turns are about the origin.
fn moved<S: Scalar>([a, b, c, x, y, z]: Step<S>, arm: Vec3<S>) -> Vec3<S> {
    Rotation3::from_rotation_vector(Vec3::new(a, b, c)) * arm + Vec3::new(x, y, z)
}
/// The distance of a moved point from the interior of a face.
fn of_face<S: Scalar>(step: Step<S>, arm: Vec3<S>, face: Triangle3<S>) -> S {
    distance_replay(moved(step, arm), face, FaceFeature::Interior)
}
/// The same from the edge between the first two corners.
fn of_edge<S: Scalar>(step: Step<S>, arm: Vec3<S>, face: Triangle3<S>) -> S {
    distance_replay(moved(step, arm), face, FaceFeature::Edge { from: 0, to: 1 })
}
/// The same from the first corner.
fn of_corner<S: Scalar>(step: Step<S>, arm: Vec3<S>, face: Triangle3<S>) -> S {
    distance_replay(moved(step, arm), face, FaceFeature::Vertex { corner: 0 })
}

/// The kind of a feature, and the corners of its face with those of the feature first.
fn kind(feature: FaceFeature) -> (usize, [u8; 3]) {
    match feature {
        FaceFeature::Interior => (0, [0, 1, 2]),
        FaceFeature::Edge { from, to } => (1, [from, to, 3 - from - to]),
        FaceFeature::Vertex { corner } => (2, [corner, (corner + 1) % 3, (corner + 2) % 3]),
    }
}

/// Distances with derivatives by a step from where the points are.
pub struct Slopes {
    pub distances: Vec<f64>,
    pub first: Vec<Step<f64>>,
    /// Empty unless asked for.
    pub second: Vec<Square>,
}

/// Returns the distances of points from the features of their records, with derivatives by a step about a centre.
pub fn slopes(
    surface: &MeshSurface<'_, f64>,
    center: Vec3<f64>,
    points: &[Vec3<f64>],
    records: &[FaceRecord],
    second: bool,
) -> Result<Slopes, Error> {
    let mut found = Slopes {
        distances: vec![0.0; points.len()],
        first: vec![[0.0; 6]; points.len()],
        second: vec![[[0.0; 6]; 6]; if second { points.len() } else { 0 }],
    };
    let mut own: [Vec<usize>; 3] = Default::default();
    for (i, record) in records.iter().enumerate() {
        own[kind(record.feature).0].push(i);
    }
    let (cpu, still) = (Cpu::new(), One([0.0; 6]));
    for (k, own) in own.iter().enumerate().filter(|(_, own)| !own.is_empty()) {
        let arms: Vec<_> = own.iter().map(|&i| points[i] - center).collect();
        let face = |&i: &usize| {
            let corners = surface.mesh().triangle(records[i].face).corners();
            let order = kind(records[i].feature).1;
            let [a, b, c] = order.map(|k| corners[usize::from(k)] - center);
            Triangle3::new(a, b, c)
        };
        let faces: Vec<_> = own.iter().map(face).collect();
        let columns = (still, &arms[..], &faces[..]);
        if second {
            let ((values, (first, ..)), rows) = match k {
                0 => cpu.aligned(function(of_face).hessian(), columns)?,
                1 => cpu.aligned(function(of_edge).hessian(), columns)?,
                _ => cpu.aligned(function(of_corner).hessian(), columns)?,
            };
            for (n, &i) in own.iter().enumerate() {
                (found.distances[i], found.first[i]) = (values[n], first[n]);
                found.second[i] = rows[n].1.0.each_ref().map(|row| row.0);
            }
        } else {
            let (values, (first, ..)) = match k {
                0 => cpu.aligned(function(of_face).value_grad(), columns)?,
                1 => cpu.aligned(function(of_edge).value_grad(), columns)?,
                _ => cpu.aligned(function(of_corner).value_grad(), columns)?,
            };
            for (n, &i) in own.iter().enumerate() {
                (found.distances[i], found.first[i]) = (values[n], first[n]);
            }
        }
    }
    Ok(found)
}

/// A sum of squares about a pose: its slope, and a matrix that stands for its curvature.
struct Normal {
    slope: Step<f64>,
    matrix: Square,
}

impl Normal {
    fn zero() -> Self {
        let (slope, matrix) = ([0.0; 6], [[0.0; 6]; 6]);
        Normal { slope, matrix }
    }
    /// Adds the outer product of a row, times a weight.
    fn add(&mut self, weight: f64, row: &Step<f64>) {
        for i in 0..6 {
            for j in 0..6 {
                self.matrix[i][j] += weight * row[i] * row[j];
            }
        }
    }
    fn slope(&mut self, weight: f64, row: &Step<f64>) {
        for (slope, x) in self.slope.iter_mut().zip(row) {
            *slope += weight * x;
        }
    }
    /// The step to the least sum; `None` if the matrix has none.
    fn step(&self, damping: f64, sizes: &Step<f64>) -> Option<Step<f64>> {
        let mut matrix = self.matrix;
        for (i, row) in matrix.iter_mut().enumerate() {
            row[i] += damping * sizes[i];
        }
        Some(solved(matrix, self.slope)?.map(|x| -x))
    }
}

/// The motion of a step about a centre.
fn motion([a, b, c, x, y, z]: Step<f64>, center: Vec3<f64>) -> Pose3<f64> {
    let turn = Rotation3::from_rotation_vector(Vec3::new(a, b, c));
    Pose3::new(center + Vec3::new(x, y, z) - turn * center, turn)
}

/// Points in a pose, with what the mesh says of them.
struct Fit {
    points: Vec<Vec3<f64>>,
    records: Vec<FaceRecord>,
    distances: Vec<f64>,
}

impl Fit {
    fn new(
        surface: &MeshSurface<'_, f64>,
        scan: &[Vec3<f64>],
        pose: Pose3<f64>,
    ) -> Result<Self, Error> {
        let points: Vec<_> = scan.iter().map(|&point| pose * point).collect();
        let cpu = Cpu::new();
        let records = cpu.nearest_faces(surface, &points)?;
        let distances = cpu.mesh_distances(MeshDistance::Plain, surface, &points, &records)?;
        Ok(Fit {
            points,
            records,
            distances,
        })
    }
    fn loss(&self, width: f64) -> f64 {
        self.distances.iter().map(|&x| huber(x, width)[0]).sum()
    }
    /// The weights of squares that stand for Huber's function here.
    fn weights(&self, width: f64) -> Vec<f64> {
        self.distances.iter().map(|&x| weight(x, width)).collect()
    }
    fn center(&self) -> Vec3<f64> {
        let sum = self.points.iter().fold(Vec3::zero(), |sum, &p| sum + p);
        sum * (1.0 / self.points.len() as f64)
    }
}

/// The slope and matrix of planes, by the normals of the nearest faces.
fn of_planes(
    surface: &MeshSurface<'_, f64>,
    fit: &Fit,
    center: Vec3<f64>,
    width: f64,
) -> Result<Normal, Error> {
    let feet = Cpu::new().closest_points(surface, &fit.points, &fit.records)?;
    let mut sum = Normal::zero();
    for (i, foot) in feet.into_iter().enumerate() {
        let normal = surface.mesh().triangle(fit.records[i].face).normal();
        let (arm, height) = (fit.points[i] - center, normal.dot(fit.points[i] - foot));
        let turn = arm.cross(normal);
        let row = [turn.x, turn.y, turn.z, normal.x, normal.y, normal.z];
        let weight = weight(height, width);
        sum.add(weight, &row);
        sum.slope(weight * height, &row);
    }
    Ok(sum)
}

/// The slope of the sum of distances, with the matrix of Gauss and Newton or the Hessian; and the diagonal of the former.
fn of_distances(
    surface: &MeshSurface<'_, f64>,
    fit: &Fit,
    center: Vec3<f64>,
    width: f64,
    exact: bool,
) -> Result<(Normal, Step<f64>), Error> {
    let all = slopes(surface, center, &fit.points, &fit.records, exact)?;
    let (mut sum, mut sizes) = (Normal::zero(), [0.0; 6]);
    for (i, row) in all.first.iter().enumerate() {
        let [_, slope, curvature] = huber(all.distances[i], width);
        let weight = weight(all.distances[i], width);
        for (size, x) in sizes.iter_mut().zip(row) {
            *size += weight * x * x;
        }
        sum.slope(slope, row);
        if !exact {
            sum.add(weight, row);
            continue;
        }
        sum.add(curvature, row);
        for (own, more) in sum.matrix.iter_mut().zip(&all.second[i]) {
            for (own, more) in own.iter_mut().zip(more) {
                *own += slope * more;
            }
        }
    }
    Ok((sum, sizes))
}

/// Registers a scan: finds the pose in which it fits the mesh, from another one. Distances beyond `width` count less; at
/// first the width is twice the median of distances, and every step halves it.
pub fn registered(
    way_of: Way,
    surface: &MeshSurface<'_, f64>,
    scan: &[Vec3<f64>],
    start: Pose3<f64>,
    width: f64,
    most: usize,
) -> Result<Course, Error> {
    let clock = Instant::now();
    let (mut pose, mut poses) = (start, vec![start]);
    let mut fit = Fit::new(surface, scan, pose)?;
    let mut sorted = fit.distances.clone();
    sorted.sort_by(f64::total_cmp);
    let mut wide = 2.0 * sorted[sorted.len() / 2];
    let (mut damping, mut last) = (0.0, f64::INFINITY);
    for _ in 0..most {
        wide = width.max(0.5 * wide);
        let center = fit.center();
        let next = match way_of {
            Way::Points => {
                let feet = Cpu::new().closest_points(surface, &fit.points, &fit.records)?;
                Some(procrustes_rigid(&fit.points, &feet, &fit.weights(wide))? * pose)
            }
            Way::Planes => {
                let sum = of_planes(surface, &fit, center, wide)?;
                sum.step(0.0, &[0.0; 6])
                    .map(|step| motion(step, center) * pose)
            }
            Way::GaussNewton | Way::Newton => {
                // Far from the end the Hessian is no matrix of a least sum.
                let exact = way_of == Way::Newton && last < NEAR_END;
                let (mut sum, sizes) = of_distances(surface, &fit, center, wide, exact)?;
                if exact && sum.step(damping, &sizes).is_none() {
                    sum = of_distances(surface, &fit, center, wide, false)?.0;
                }
                let mut step = sum.step(damping, &sizes);
                while step.is_none() && damping < 1e6 {
                    damping = DAMPING[0].max(4.0 * damping);
                    step = sum.step(damping, &sizes);
                }
                step.map(|step| motion(step, center) * pose)
            }
        };
        let Some(next) = next else { break };
        let better = Fit::new(surface, scan, next)?;
        let moved = way(scan, pose, next);
        if matches!(way_of, Way::GaussNewton | Way::Newton) {
            // A step that makes the sum larger is not taken; the next one is shorter.
            if better.loss(wide) > fit.loss(wide) && moved > STILL {
                damping = DAMPING[0].max(4.0 * damping);
                poses.push(pose);
                continue;
            }
            damping *= 0.1;
            if damping < DAMPING[1] {
                damping = 0.0;
            }
        }
        (pose, fit, last) = (next, better, moved);
        poses.push(pose);
        if moved < STILL && wide == width {
            break;
        }
    }
    Ok(Course {
        poses,
        loss: fit.loss(width),
        seconds: clock.elapsed().as_secs_f64(),
    })
}

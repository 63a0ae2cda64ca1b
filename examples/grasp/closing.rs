//! Grasps by gradient: least squares of what contacts, normals and clearances lack, with damped steps of Gauss and
//! Newton (Levenberg 1944), for many starts at once.
use crate::gripper::{self, GAPS, Grasp, Guard, SIDES};
use common::positive::solved;
use common::random::Draw;
use geograd::distance3::closest_points;
use geograd::kernels::cpu::mesh_batches::MeshDistance;
use geograd::kernels::reduce::Best;
use geograd::kernels::verbs::Distance;
use geograd::kernels::{Cpu, function};
use geograd::mesh::{ClosedMesh, FaceFeature, FaceRecord, MeshSurface, closest_replay};
use geograd::{Capsule3, Error, Pack as _, Rotation3, Scalar, Triangle3, Vec3, jacobian};
use std::f64::consts::{PI, TAU};

/// Lengths that weigh as much as one: of contacts and clearances, and of the way from the centroid to the closing line.
const TOUCH: f64 = 1e-3;
const PULL: f64 = 0.03;
/// How much a normal of length one weighs.
const NORMAL: f64 = 4.0;
/// Clearances in metres that palm and table shall have.
const CLEAR: f64 = 2e-3;
/// A turn of a radian is damped as a way of so many metres.
const ARM: f64 = 0.03;
const DAMPING: f64 = 1.0;

/// A body on a table.
pub struct Scene<'a> {
    pub surface: MeshSurface<'a, f64>,
    pub closed: &'a ClosedMesh,
    pub faces: Vec<Triangle3<f64>>,
    /// The mean normal of the faces around every vertex.
    pub normals: Vec<Vec3<f64>>,
    pub centroid: Vec3<f64>,
    /// The height of the table.
    pub table: f64,
}

impl<'a> Scene<'a> {
    pub fn new(surface: MeshSurface<'a, f64>, closed: &'a ClosedMesh) -> Self {
        let mesh = surface.mesh();
        let mut normals = vec![Vec3::zero(); mesh.vertices().len()];
        for (face, corners) in mesh.faces().iter().enumerate() {
            let normal = mesh.triangle(face as u32).twice_area_normal();
            for &vertex in corners {
                normals[vertex as usize] += normal;
            }
        }
        let heights = mesh.vertices().iter().map(|vertex| vertex.z);
        Scene {
            surface,
            closed,
            faces: (0..mesh.faces().len() as u32)
                .map(|k| mesh.triangle(k))
                .collect(),
            normals: normals.iter().map(|n| n.normalize_or_zero()).collect(),
            centroid: mesh.centroid(),
            table: heights.fold(f64::INFINITY, f64::min),
        }
    }
}

/// Returns starts: open grippers around the centroid that come from above in random directions.
pub fn starts(scene: &Scene<'_>, count: usize, seed: u64) -> Vec<Grasp<f64>> {
    let mut draw = Draw::new(&[seed, 3]);
    let mut number = |low: f64, high: f64| low + (high - low) * f64::from(draw.uniform());
    let mut start = || {
        let (down, turn, roll) = (number(-1.0, 0.0), number(0.0, TAU), number(0.0, TAU));
        let level = (1.0 - down * down).sqrt();
        let ahead = Vec3::new(level * turn.cos(), level * turn.sin(), down);
        let side = ahead
            .cross(Vec3::new(turn.sin(), -turn.cos(), 0.0))
            .normalize_or_zero();
        let (sin, cos) = roll.sin_cos();
        let closing = side * cos + ahead.cross(side) * sin;
        let axes = [closing, ahead.cross(closing), ahead];
        let Vec3 { x: a, y: b, z: c } = Rotation3::from_axes(axes).rotation_vector();
        let away = Vec3::new(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
        let Vec3 { x, y, z } = scene.centroid + away * 0.03;
        [x, y, z, a, b, c, GAPS[1]]
    };
    (0..count).map(|_| start()).collect()
}

/// The mean normal at the point of a face that is nearest to a point.
fn mean_normal<S: Scalar>(
    point: Vec3<S>,
    face: Triangle3<S>,
    normals: Triangle3<S>,
    feature: FaceFeature,
) -> Vec3<S> {
    let foot = closest_replay(point, face, feature);
    let [a, b, c] = face.corners().map(|corner| corner - foot);
    let whole = face.twice_area_normal();
    let part = |b: Vec3<S>, c: Vec3<S>| b.cross(c).dot(whole);
    let sum = normals.a * part(b, c) + normals.b * part(c, a) + normals.c * part(a, b);
    sum.normalize_or_zero()
}

/// The mean normal where a finger is nearest to the body, in the gripper's frame, with derivatives by the grasp.
fn normal_at(
    scene: &Scene<'_>,
    grasp: Grasp<f64>,
    side: f64,
    record: FaceRecord,
) -> (Vec3<f64>, [Grasp<f64>; 3]) {
    let mesh = scene.surface.mesh();
    let face = mesh.triangle(record.face);
    let [a, b, c] = mesh.faces()[record.face as usize].map(|vertex| scene.normals[vertex as usize]);
    let normals = Triangle3::new(a, b, c);
    let (normal, slopes) = jacobian(
        |grasp: Grasp<_>| {
            let point = gripper::place(grasp, Vec3::zero(), Scalar::lit(side));
            let normal = mean_normal(point, face.lift(), normals.lift(), record.feature);
            gripper::pose(grasp).rotation.inverse() * normal
        },
        grasp,
    );
    (normal, [slopes.x, slopes.y, slopes.z])
}

/// A sum of squares about a grasp.
#[derive(Clone)]
pub struct Squares {
    pub sum: f64,
    /// Half the derivative of the sum.
    pub slope: Grasp<f64>,
    matrix: [[f64; 7]; 7],
}

impl Squares {
    /// Adds a residual with its derivatives by the grasp.
    fn add(&mut self, residual: f64, by: Grasp<f64>) {
        self.sum += residual * residual;
        for i in 0..7 {
            self.slope[i] += by[i] * residual;
            for j in 0..7 {
                self.matrix[i][j] += by[i] * by[j];
            }
        }
    }
    /// Adds what a number lacks of being positive.
    fn add_lack(&mut self, lack: f64, by: Grasp<f64>) {
        if lack > 0.0 {
            self.add(lack / TOUCH, by.map(|x| -x / TOUCH));
        }
    }
}

/// The place of the centroid beside the closing line in the gripper's frame.
fn beside<S: Scalar>(grasp: Grasp<S>, centroid: Vec3<S>) -> [S; 2] {
    let local = gripper::pose(grasp).inverse() * centroid;
    [local.y, local.z]
}

/// Returns the squares of every grasp. The closing line is drawn to the centroid with a weight.
pub fn squares(
    scene: &Scene<'_>,
    guards: &[Guard],
    grasps: &[Grasp<f64>],
    pull: f64,
) -> Result<Vec<Squares>, Error> {
    let (cpu, count) = (Cpu::new(), guards.len());
    let all = 0..count * grasps.len();
    let repeated: Vec<_> = all.clone().map(|i| grasps[i / count]).collect();
    let locals: Vec<_> = all.clone().map(|i| guards[i % count].local).collect();
    let sides: Vec<_> = all.clone().map(|i| guards[i % count].side).collect();
    let columns = (&repeated[..], &locals[..], &sides[..]);
    let points = cpu.aligned(function(gripper::place), columns)?;
    let records = cpu.nearest_faces(&scene.surface, &points)?;
    let signed = MeshDistance::Signed(scene.closed);
    let distances = cpu.mesh_distances(signed, &scene.surface, &points, &records)?;
    let ones = vec![1.0; points.len()];
    let bars = cpu.mesh_distances_vjp(signed, &scene.surface, &points, &records, &ones)?;
    let back = function(gripper::place).vjp();
    let (by_distance, ..) = cpu.aligned(back, (columns, &bars.queries[..]))?;
    let ups = vec![Vec3::new(0.0, 0.0, 1.0); points.len()];
    let (by_height, ..) = cpu.aligned(back, (columns, &ups[..]))?;

    let of = |(k, &grasp): (usize, &Grasp<f64>)| {
        let mut squares = Squares {
            sum: 0.0,
            slope: [0.0; 7],
            matrix: [[0.0; 7]; 7],
        };
        for (g, guard) in guards.iter().enumerate() {
            let i = k * count + g;
            let gap = distances[i] - guard.radius;
            if g < 2 {
                squares.add(gap / TOUCH, by_distance[i].map(|x| x / TOUCH));
                let (normal, by) = normal_at(scene, grasp, guard.side, records[i]);
                for (residual, by) in [normal.x - guard.side, normal.y, normal.z]
                    .into_iter()
                    .zip(by)
                {
                    squares.add(NORMAL * residual, by.map(|x| NORMAL * x));
                }
                continue;
            }
            let wanted = if guard.side == 0.0 { CLEAR } else { 0.0 };
            squares.add_lack(wanted - gap, by_distance[i]);
            let height = points[i].z - scene.table - guard.radius;
            squares.add_lack(CLEAR - height, by_height[i]);
        }
        let mut by_gap = [0.0; 7];
        by_gap[6] = 1.0;
        squares.add_lack(GAPS[0] - grasp[6], by_gap);
        squares.add_lack(grasp[6] - GAPS[1], by_gap.map(|x| -x));
        if pull > 0.0 {
            let of = |grasp: Grasp<_>| beside(grasp, scene.centroid.lift());
            let (away, by) = jacobian(of, grasp);
            for (away, by) in away.into_iter().zip(by) {
                squares.add(pull * away / PULL, by.map(|x| pull * x / PULL));
            }
        }
        squares
    };
    Ok(grasps.iter().enumerate().map(of).collect())
}

/// A grasp after a step, its rotation at most a half turn.
fn stepped(grasp: Grasp<f64>, step: Grasp<f64>) -> Grasp<f64> {
    let mut next: Grasp<f64> = std::array::from_fn(|k| grasp[k] - step[k]);
    let angle = Vec3::new(next[3], next[4], next[5]).length();
    if angle > PI {
        for x in &mut next[3..6] {
            *x *= 1.0 - TAU / angle;
        }
    }
    next
}

/// Returns grasps that touch the body with both fingers, as far as starts lead to them. The pull towards the centroid
/// ends half way.
pub fn closed(
    scene: &Scene<'_>,
    mut grasps: Vec<Grasp<f64>>,
    steps: usize,
    told: impl Fn(),
) -> Result<Vec<Grasp<f64>>, Error> {
    let guards = gripper::guards();
    let mut damping = vec![DAMPING; grasps.len()];
    let mut known = squares(scene, &guards, &grasps, 1.0)?;
    for step in 0..steps {
        let pull = if 2 * step < steps { 1.0 } else { 0.0 };
        if step == steps.div_ceil(2) {
            damping.fill(DAMPING);
            known = squares(scene, &guards, &grasps, pull)?;
        }
        let next = grasps.iter().zip(&known).zip(&damping);
        let next: Vec<_> = next
            .map(|((&grasp, squares), damping)| {
                let mut matrix = squares.matrix;
                for (i, row) in matrix.iter_mut().enumerate() {
                    let size = if (3..6).contains(&i) { 1.0 } else { 1.0 / ARM };
                    row[i] += damping * size * size;
                }
                solved(matrix, squares.slope).map_or(grasp, |step| stepped(grasp, step))
            })
            .collect();
        let better = squares(scene, &guards, &next, pull)?;
        for (k, better) in better.into_iter().enumerate() {
            if better.sum < known[k].sum {
                (grasps[k], known[k]) = (next[k], better);
                damping[k] = (0.3 * damping[k]).max(1e-6);
            } else {
                damping[k] = (4.0 * damping[k]).min(1e9);
            }
        }
        told();
    }
    Ok(grasps)
}

/// A capsule beside the body.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    /// The gap in metres; negative where the capsule is in the body.
    pub gap: f64,
    /// The point of the body.
    pub foot: Vec3<f64>,
    /// Out of the body there.
    pub normal: Vec3<f64>,
}

/// Returns how near capsules come to the body: their axes are compared with all faces in one batch.
fn nears(scene: &Scene<'_>, parts: &[Capsule3<f64>]) -> Result<Vec<Near>, Error> {
    let axes: Vec<_> = parts.iter().map(|part| part.segment()).collect();
    let nearest = Cpu::new().row_min(Distance, &axes, &scene.faces)?;
    let near = |(part, nearest): (&Capsule3<f64>, Best<f64>)| {
        let pair = closest_points(part.segment(), scene.faces[nearest.index]);
        let (on_axis, foot) = (pair.on_a, pair.on_b);
        let away = (on_axis - foot).normalize_or_zero();
        let (gap, normal) = match scene.surface.encloses(part.start) {
            true => (-nearest.value - part.radius, -away),
            false => (nearest.value - part.radius, away),
        };
        Near { gap, foot, normal }
    };
    Ok(parts.iter().zip(nearest).map(near).collect())
}

/// The gap up to which a finger touches, in metres.
pub const TOUCHING: f64 = 5e-6;
/// Fingers farther from the body than this do not settle on it.
const WITHIN: f64 = 3e-3;

/// Returns grasps whose fingers are moved along the closing line until they just touch; `None` where that fails.
pub fn settled(
    scene: &Scene<'_>,
    grasps: Vec<Grasp<f64>>,
) -> Result<Vec<Option<Grasp<f64>>>, Error> {
    let mut all: Vec<_> = grasps.into_iter().map(Some).collect();
    for _ in 0..8 {
        let rest: Vec<_> = (0..all.len()).filter(|&k| all[k].is_some()).collect();
        let known = rest.iter().filter_map(|&k| all[k]);
        let parts: Vec<_> = known
            .flat_map(|grasp| gripper::parts(grasp)[..2].to_vec())
            .collect();
        for (&k, near) in rest.iter().zip(nears(scene, &parts)?.chunks_exact(2)) {
            all[k] = all[k].and_then(|grasp| touching(grasp, [near[0], near[1]]));
        }
    }
    Ok(all)
}

/// A grasp whose fingers are moved along the closing line by what their gaps say.
fn touching(mut grasp: Grasp<f64>, fingers: [Near; 2]) -> Option<Grasp<f64>> {
    let closing = gripper::pose(grasp).rotation * Vec3::new(1.0, 0.0, 0.0);
    let mut out = [0.0; 2];
    for (k, side) in SIDES.into_iter().enumerate() {
        let slope = fingers[k].normal.dot(closing) * side;
        if slope < 0.3 || fingers[k].gap.abs() > WITHIN {
            return None;
        }
        out[k] = (0.5 * TOUCHING - fingers[k].gap) / slope;
    }
    let middle = closing * (0.5 * (out[1] - out[0]));
    for (x, more) in grasp.iter_mut().zip([middle.x, middle.y, middle.z]) {
        *x += more;
    }
    grasp[6] += out[0] + out[1];
    Some(grasp)
}

/// A grasp as it is judged.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// The gaps of both fingers and the palm from the body, in metres.
    pub gaps: [f64; 3],
    /// The height of the lowest part over the table.
    pub height: f64,
    /// The angles between the line of both contacts and the normals there, in radians.
    pub angles: [f64; 2],
    /// How far the centroid is from that line, in metres.
    pub lever: f64,
}

/// The angle of friction: contacts do not slip where the force is nearer to the normal. Its tangent is 0.5.
pub fn cone() -> f64 {
    0.5_f64.atan()
}

impl Judged {
    /// `true` for a grasp with force closure that touches with both fingers and overlaps nothing.
    pub fn is_good(&self, gap: f64) -> bool {
        let touches = |gap: f64| (0.0..=TOUCHING).contains(&gap);
        touches(self.gaps[0])
            && touches(self.gaps[1])
            && self.gaps[2] > 0.0
            && self.height > 0.0
            && (GAPS[0]..=GAPS[1]).contains(&gap)
            && self.angles.iter().all(|&angle| angle < cone())
    }
    /// How safe it is; more is better.
    pub fn score(&self) -> f64 {
        1.0 - self.angles[0].max(self.angles[1]) / cone() - self.lever / 0.03
    }
}

/// Returns the angles between the line of two contacts and the normals out of the body.
pub fn angles(feet: [Vec3<f64>; 2], normals: [Vec3<f64>; 2]) -> [f64; 2] {
    let line = feet[1] - feet[0];
    [normals[0].angle_to(-line), normals[1].angle_to(line)]
}

/// The least height of capsules over a level.
pub fn height(parts: &[Capsule3<f64>; 3], level: f64) -> f64 {
    let low = parts
        .iter()
        .map(|part| part.start.z.min(part.end.z) - part.radius);
    low.fold(f64::INFINITY, f64::min) - level
}

/// Judges grasps.
pub fn judged(scene: &Scene<'_>, grasps: &[Grasp<f64>]) -> Result<Vec<Judged>, Error> {
    let parts: Vec<_> = grasps.iter().map(|&grasp| gripper::parts(grasp)).collect();
    let near = nears(scene, parts.as_flattened())?;
    let judged = |(parts, all): (&[Capsule3<f64>; 3], &[Near])| {
        let feet = [all[0].foot, all[1].foot];
        let line = (feet[1] - feet[0]).normalize_or_zero();
        Judged {
            gaps: [all[0].gap, all[1].gap, all[2].gap],
            height: height(parts, scene.table),
            angles: angles(feet, [all[0].normal, all[1].normal]),
            lever: (scene.centroid - feet[0]).cross(line).length(),
        }
    };
    Ok(parts.iter().zip(near.chunks_exact(3)).map(judged).collect())
}

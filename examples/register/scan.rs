//! A noisy scan of the side of a body that a camera sees, and poses from which registration starts.
use common::random::Draw;
use geograd::kernels::Cpu;
use geograd::mesh::MeshSurface;
use geograd::{Error, Pose3, Ray3, Rotation3, Vec3};

/// How far the camera is from the middle of the body, in metres.
const CAMERA: f64 = 0.4;
/// Half the edge of the cube in which outliers are, in metres.
const AROUND: f64 = 0.1;
/// Rays that are cast at once.
const RAYS: usize = 2048;

/// How a scan is taken.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// The number of points, outliers included.
    pub points: usize,
    /// The standard deviation of depths, in metres.
    pub noise: f64,
    /// The share of points that are anywhere.
    pub outliers: f64,
    pub seed: u64,
}

/// A scan in the frame of its camera.
#[derive(Clone, Debug)]
pub struct Scan {
    pub points: Vec<Vec3<f64>>,
    /// The motion from the camera's frame to the body's.
    pub truth: Pose3<f64>,
    /// The direction from the body to the camera, in the body's frame.
    pub towards: Vec3<f64>,
}

fn normals(draw: &mut Draw) -> Vec3<f64> {
    let [x, y, z] = [(); 3].map(|()| f64::from(draw.normal()));
    Vec3::new(x, y, z)
}
fn between(draw: &mut Draw, size: f64) -> Vec3<f64> {
    let [x, y, z] = [(); 3].map(|()| (2.0 * f64::from(draw.uniform()) - 1.0) * size);
    Vec3::new(x, y, z)
}

/// Takes a scan of a body around the origin from above or from the side, by rays that hit it first.
pub fn taken(surface: &MeshSurface<'_, f64>, rules: &Rules) -> Result<Scan, Error> {
    let mut draw = Draw::new(&[rules.seed, 1]);
    let mut towards = normals(&mut draw).normalize_or_zero();
    towards.z = towards.z.abs();
    let eye = towards * CAMERA;
    let turn = Rotation3::from_rotation_vector(normals(&mut draw));
    let truth = Pose3::new(between(&mut draw, 1.0), turn);
    let (cpu, camera) = (Cpu::new(), truth.inverse());
    let mut points = Vec::with_capacity(rules.points);
    while points.len() < rules.points {
        let ray = |_| Ray3::new(eye, between(&mut draw, AROUND) - eye);
        let rays: Vec<_> = (0..RAYS).map(ray).collect();
        let faces = cpu.hit_faces(surface, &rays)?;
        let hits = cpu.first_hits(surface, &rays, &faces)?;
        for (ray, hit) in rays.iter().zip(hits) {
            let Some(hit) = hit else { continue };
            let depth = rules.noise * f64::from(draw.normal());
            let point = match f64::from(draw.uniform()) < rules.outliers {
                true => between(&mut draw, AROUND),
                false => hit.hit.point + ray.direction.normalize_or_zero() * depth,
            };
            if points.len() < rules.points {
                points.push(camera * point);
            }
        }
    }
    Ok(Scan {
        points,
        truth,
        towards,
    })
}

/// A wrong pose: turned about the middle of the body by an angle in radians and shifted by metres, both in random
/// directions.
pub fn start(truth: Pose3<f64>, turn: f64, shift: f64, seed: u64) -> Pose3<f64> {
    let mut draw = Draw::new(&[seed, 2]);
    let axis = normals(&mut draw).normalize_or_zero();
    let away = normals(&mut draw).normalize_or_zero();
    Pose3::new(away * shift, Rotation3::from_rotation_vector(axis * turn)) * truth
}

/// How wrong a pose is: the angle in radians, and how far the middle of the body is away, in metres.
pub fn error(pose: Pose3<f64>, truth: Pose3<f64>) -> [f64; 2] {
    let rest = pose * truth.inverse();
    [rest.rotation.angle(), rest.translation.length()]
}

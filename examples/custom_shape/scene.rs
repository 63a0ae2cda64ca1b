//! The arms and what is around them, the help, and what is told about a batch.
use crate::Arm;
use geograd::{Circle, Obb2, Vec2};
use indicatif::{ProgressBar, ProgressStyle};
use std::f32::consts::{PI, TAU};
use std::time::Duration;

pub const HELP: &str = "\
The clearance of a two-link arm from a wall and a post, with its slopes, for a million postures.

Usage: custom_shape [option]

  --count N     for so many postures [default: 1000000]
  --prove       instead: prove the slopes in f64 and f32, and print the report
  --program     instead: what the clearance was recorded as, and what it costs
  --wgsl        instead: the same as a function for GPUs
  --svg FILE    instead: a picture of the clearance over both joints, with its slopes
  --help        this text
";

/// What stands around the arm.
pub const WALL: Obb2<f32> = Obb2::new(0.85, 1.05, 1.1, 0.24, -0.35);
pub const POST: Circle<f32> = Circle::new(Vec2::new(-0.95, -0.35), 0.34);

/// The arm with its joints at two angles.
pub fn posture(shoulder: f32, elbow: f32) -> Arm<f32> {
    Arm {
        base: Vec2::new(0.0, 0.0),
        links: [1.0, 0.75],
        shoulder,
        elbow,
        thickness: 0.16,
    }
}

/// So many postures, evenly spread over both joints.
pub fn postures(count: usize) -> Vec<Arm<f32>> {
    let side = (count as f64).sqrt().ceil() as usize;
    let angle = |i: usize| TAU * i as f32 / side as f32 - PI;
    let all = (0..count).map(|k| posture(angle(k % side), angle(k / side)));
    all.collect()
}

pub fn progress(count: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} postures ({elapsed})");
    ProgressBar::new(count as u64).with_style(style.expect("a valid template"))
}

/// What came out of a batch.
pub fn summary(took: Duration, values: &[f32], slopes: &[Arm<f32>]) -> String {
    let (count, seconds) = (values.len(), took.as_secs_f64());
    let rate = count as f64 / seconds / 1e6;
    let hit = values.iter().filter(|value| **value < 0.0).count();
    let share = 100.0 * hit as f64 / count.max(1) as f64;
    let steep = slopes.iter().map(|by| by.shoulder.hypot(by.elbow));
    let steepest = steep.fold(0.0, f32::max);
    format!(
        "{count} postures with slopes in {seconds:.3} s, {rate:.2} million a second\n\
         {share:.1} % collide; clearance changes by at most {steepest:.2} m per radian\n"
    )
}

//! Moves boxes onto their truths along the gradient of the overlap.
//!
//! The loss of a pair is `1 − IoU`. Its slope says which way to go but not how far: IoU grows
//! steeply towards a peak with a kink, where slopes do not fade but flip. So a box moves by its four
//! sides and its heading, which hardly depend on each other there, and each of the five keeps a step
//! length of its own, which grows while the sign of its slope stays and halves when it flips (resilient
//! gradient descent, Riedmiller and Braun 1993). A step that would not raise the overlap of its pair is
//! taken back and tried shorter, so no pair ever gets worse. Pairs that overlap by a sliver have small
//! slopes, which makes no difference to their steps.
use geograd::Error;
use geograd::kernels::Backend;
use geograd::kernels::ops::overlap::IouObb2;
use geograd::{Obb2, Rotation2, Vec2};
use std::time::{Duration, Instant};

/// A step longer by this after one that went well, shorter by that after one too far.
const LONGER: f32 = 1.25;
const SHORTER: f32 = 0.5;

/// A pair is left alone when its overlap is this near to one,
const CLOSE: f32 = 0.9995;
/// or when its longest step, relative to its size, is this short.
const STILL: f32 = 1e-5;

/// What it cost.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    /// Overlaps computed with their gradients.
    pub gradients: usize,
    /// Time spent on them.
    pub time: Duration,
}

/// A box on its way.
struct Walker {
    /// The best place so far, and its overlap.
    shape: Obb2<f32>,
    iou: f32,
    /// The slopes there: of moving the front, rear, left and right side outwards, and of turning.
    slopes: [f32; 5],
    /// How far to go next, in metres and radians, in the same order.
    steps: [f32; 5],
}

impl Walker {
    fn new(shape: Obb2<f32>) -> Self {
        let (length, width) = (0.04 * shape.size.x, 0.04 * shape.size.y);
        Walker {
            shape,
            iou: -1.0,
            slopes: [0.0; 5],
            steps: [length, length, width, width, 0.03],
        }
    }

    /// The next place to try.
    fn next(&self) -> Obb2<f32> {
        let mut by = [0.0; 5];
        for ((by, step), slope) in by.iter_mut().zip(self.steps).zip(self.slopes) {
            if slope != 0.0 {
                *by = step.copysign(slope);
            }
        }
        let [front, rear, left, right, turn] = by;
        let Obb2 {
            center,
            size,
            heading,
        } = self.shape;
        let off = Vec2::new(front - rear, left - right) * 0.5;
        // A size halves at most, so it stays positive.
        Obb2 {
            center: center + Rotation2::from_angle(heading) * off,
            size: (size + Vec2::new(front + rear, left + right)).most(size * 0.5),
            heading: heading + turn,
        }
    }

    /// Takes the step if the overlap there is better, and learns from it either way.
    fn learn(&mut self, tried: Obb2<f32>, iou: f32, slope: Obb2<f32>) {
        // A side moves the centre by half of what it moves the size.
        let off = Rotation2::from_angle(tried.heading).inverse() * slope.center * 0.5;
        let slopes = [
            slope.size.x + off.x,
            slope.size.x - off.x,
            slope.size.y + off.y,
            slope.size.y - off.y,
            slope.heading,
        ];
        let better = iou > self.iou;
        let mut flips = 0;
        for ((step, old), new) in self.steps.iter_mut().zip(self.slopes).zip(slopes) {
            if old * new < 0.0 {
                *step *= SHORTER;
                flips += 1;
            } else if better && old * new > 0.0 {
                *step *= LONGER;
            }
        }
        if better {
            (self.shape, self.iou, self.slopes) = (tried, iou, slopes);
        } else if flips == 0 {
            for step in &mut self.steps {
                *step *= SHORTER;
            }
        }
    }

    fn is_done(&self) -> bool {
        let size = self.shape.size.x.max(self.shape.size.y);
        let [front, rear, left, right, turn] = self.steps;
        let longest = front.max(rear).max(left).max(right);
        self.iou >= CLOSE || longest.max(turn * size) <= STILL * size
    }
}

/// Where the boxes end up after at most that many steps towards their truths. Every step of all
/// pairs that still move is one batch.
pub fn refine(
    backend: Backend<'_>,
    shapes: &[Obb2<f32>],
    truths: &[Obb2<f32>],
    steps: u64,
    mut stepped: impl FnMut(),
) -> Result<(Vec<Obb2<f32>>, Cost), Error> {
    let mut walkers: Vec<Walker> = shapes.iter().map(|&shape| Walker::new(shape)).collect();
    let mut moving: Vec<usize> = (0..walkers.len()).collect();
    let mut tried = shapes.to_vec();
    let mut goals = truths.to_vec();
    let mut cost = Cost::default();
    // The first evaluation is of the boxes as they are.
    for _ in 0..=steps {
        if moving.is_empty() {
            break;
        }
        let started = Instant::now();
        let (ious, slopes, _) = backend.aligned_grad::<IouObb2>(&tried, &goals)?;
        cost.time += started.elapsed();
        cost.gradients += moving.len();
        for (i, &walker) in moving.iter().enumerate() {
            walkers[walker].learn(tried[i], ious[i], slopes[i]);
        }
        moving.retain(|&walker| !walkers[walker].is_done());
        tried.clear();
        tried.extend(moving.iter().map(|&walker| walkers[walker].next()));
        goals.clear();
        goals.extend(moving.iter().map(|&walker| truths[walker]));
        stepped();
    }
    Ok((walkers.iter().map(|walker| walker.shape).collect(), cost))
}

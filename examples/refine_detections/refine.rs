//! Moves boxes onto their truths along the gradient of a score of both.
//!
//! The loss of a pair is one minus its score. Its derivative says which way to go but not how far: IoU grows
//! steeply towards a peak with a kink, where derivatives do not fade but flip. So a box moves by its sides
//! (in space top and bottom, too) and its heading, which hardly depend on each other there, and each of
//! them keeps a step length of its own, which grows while the sign of its derivative stays and halves when it
//! flips (resilient gradient descent, Riedmiller and Braun 1993). A step that would not raise the score
//! of its pair is taken back and tried shorter, so no pair ever gets worse. Pairs that overlap by a
//! sliver have small derivatives, which makes no difference to their steps.
use crate::loss::Space;
use crate::scorer::Scorer;
use geograd::kernels::Backend;
use geograd::{Error, Rotation2, Vec2, Vec3, YawBox3};
use std::time::{Duration, Instant};

/// A step longer by this after one that went well, shorter by that after one too far.
const LONGER: f32 = 1.25;
const SHORTER: f32 = 0.5;

/// A pair is left alone when its longest step, relative to its size, is this short.
const STILL: f32 = 1e-5;

/// The cost of a refinement.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    /// Scores computed with their gradients.
    pub gradients: usize,
    /// Time spent on them.
    pub time: Duration,
}

/// A number for each of what moves: the front, rear, left and right side, the heading, top and bottom.
type Moves = [f32; 7];

/// A box on its way.
struct Walker {
    /// The best place so far, and its score.
    shape: YawBox3<f32>,
    score: f32,
    /// The derivatives there: of moving the sides outwards, and of turning.
    derivatives: Moves,
    /// How far to go next, in metres and radians.
    steps: Moves,
}

impl Walker {
    fn new(shape: YawBox3<f32>, space: Space) -> Self {
        let size = shape.size * 0.04;
        let height = match space {
            Space::BirdsEye => 0.0,
            Space::Full => size.z,
        };
        Walker {
            shape,
            score: f32::NEG_INFINITY,
            derivatives: [0.0; 7],
            steps: [size.x, size.x, size.y, size.y, 0.03, height, height],
        }
    }

    /// The next place to try.
    fn next(&self) -> YawBox3<f32> {
        let mut by = [0.0; 7];
        for ((by, step), derivative) in by.iter_mut().zip(self.steps).zip(self.derivatives) {
            if derivative != 0.0 {
                *by = step.copysign(derivative);
            }
        }
        let [front, rear, left, right, turn, top, bottom] = by;
        let YawBox3 {
            center,
            size,
            heading,
        } = self.shape;
        let off = Rotation2::from_angle(heading) * (Vec2::new(front - rear, left - right) * 0.5);
        // A size halves at most, so it stays positive.
        let larger = Vec3::new(front + rear, left + right, top + bottom);
        YawBox3 {
            center: center + Vec3::new(off.x, off.y, (top - bottom) * 0.5),
            size: (size + larger).most(size * 0.5),
            heading: heading + turn,
        }
    }

    /// Takes the step if the score there is better, and learns from it either way.
    fn learn(&mut self, tried: YawBox3<f32>, score: f32, derivative: YawBox3<f32>) {
        // A side moves the centre by half of what it moves the size.
        let flat = Vec2::new(derivative.center.x, derivative.center.y);
        let off = Rotation2::from_angle(tried.heading).inverse() * flat * 0.5;
        let up = derivative.center.z * 0.5;
        let derivatives = [
            derivative.size.x + off.x,
            derivative.size.x - off.x,
            derivative.size.y + off.y,
            derivative.size.y - off.y,
            derivative.heading,
            derivative.size.z + up,
            derivative.size.z - up,
        ];
        let better = score > self.score;
        let mut flips = 0;
        for ((step, old), new) in self.steps.iter_mut().zip(self.derivatives).zip(derivatives) {
            if old * new < 0.0 {
                *step *= SHORTER;
                flips += 1;
            } else if better && old * new > 0.0 {
                *step *= LONGER;
            }
        }
        if better {
            (self.shape, self.score, self.derivatives) = (tried, score, derivatives);
        } else if flips == 0 {
            for step in &mut self.steps {
                *step *= SHORTER;
            }
        }
    }

    fn is_done(&self, close: f32) -> bool {
        let size = self.shape.size.x.max(self.shape.size.y);
        let [front, rear, left, right, turn, top, bottom] = self.steps;
        let longest = [front, rear, left, right, top, bottom]
            .into_iter()
            .fold(0.0, f32::max);
        self.score >= close || longest.max(turn * size) <= STILL * size
    }
}

/// The boxes after at most `steps` steps towards their truths. Every step of all
/// pairs that still move is one batch.
pub fn refine(
    backend: Backend<'_>,
    scorer: &Scorer,
    shapes: &[YawBox3<f32>],
    truths: &[YawBox3<f32>],
    steps: u64,
    mut stepped: impl FnMut(),
) -> Result<(Vec<YawBox3<f32>>, Cost), Error> {
    let goal = scorer.goal();
    let start = |&shape| Walker::new(shape, goal.space);
    let mut walkers: Vec<Walker> = shapes.iter().map(start).collect();
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
        let (scores, derivatives) = scorer.scores(backend, &tried, &goals)?;
        cost.time += started.elapsed();
        cost.gradients += moving.len();
        for (i, &walker) in moving.iter().enumerate() {
            walkers[walker].learn(tried[i], scores[i], derivatives[i]);
        }
        moving.retain(|&walker| !walkers[walker].is_done(goal.loss.close()));
        tried.clear();
        tried.extend(moving.iter().map(|&walker| walkers[walker].next()));
        goals.clear();
        goals.extend(moving.iter().map(|&walker| truths[walker]));
        stepped();
    }
    Ok((walkers.iter().map(|walker| walker.shape).collect(), cost))
}

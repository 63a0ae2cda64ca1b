//! Descent on the overlap of two sensors' boxes, over the motion between the sensors.
//!
//! The loss of a pair is one minus its separation-aware overlap: the IoU of two boxes that overlap, and of
//! boxes apart minus their separation over itself and their size. So there are derivatives from far away, where
//! IoU has none, and no pair counts by more than two, however wrong it is. Derivatives by the boxes go back to
//! the motion through its adjoint, and from its quaternion to a small turn and a small shift in the body's own
//! frame, in which the steps are made (Adam, Kingma and Ba 2015, on six numbers).
use crate::scene::{FAR, Scene};
use common::known::known;
use geograd::assignment::greedy;
use geograd::iou3::separation_aware;
use geograd::kernels::{Cpu, Iou, One};
use geograd::suppression::Pair;
use geograd::{Error, Obb3, Pose3, Rotation3, Vec3, operation};

operation! {
    /// A box carried along by a motion.
    Carry = "carry": (motion: Pose3<S>, shape: Obb3<S>) -> Obb3<S> { motion * shape }
    invariances []
    jumps Never
    derivative Reverse

    /// The separation-aware overlap of two boxes whose IoU is known.
    Separation = "separation": (a: Obb3<S>, b: Obb3<S>, iou: S) -> S {
        let [a, b] = known(a, b, iou);
        separation_aware(a, b)
    }
    invariances []
    jumps FromZero
    derivative Reverse
}

/// Pairs farther apart than this, in metres, are no pairs.
const REACH: f64 = 6.0;

/// The first and the last step, in metres; a turn moves boxes halfway out by as much.
const STEPS: [f64; 2] = [0.15, 0.001];
/// How much of the past Adam keeps, of derivatives and of their squares.
const KEPT: [f64; 2] = [0.8, 0.95];

/// The state of a descent.
#[derive(Clone, Debug)]
pub struct State {
    pub a_from_b: Pose3<f64>,
    /// The mean loss of all pairs.
    pub loss: f64,
    /// Their mean IoU.
    pub iou: f64,
    /// How far the motion is from the truth: radians and metres.
    pub angle_error: f64,
    pub shift_error: f64,
    /// Which box of a goes with which one of b, and their IoU.
    pub pairs: Vec<Pair<f64>>,
}

/// Adam on a small turn and a small shift.
#[derive(Default)]
struct Adam {
    derivatives: [f64; 6],
    squares: [f64; 6],
    steps: i32,
}

impl Adam {
    /// A step of about this length against the derivatives.
    fn step(&mut self, derivatives: [f64; 6], length: f64) -> [f64; 6] {
        self.steps += 1;
        let mut by = [0.0; 6];
        let [kept, kept_squares] = KEPT;
        for (i, derivative) in derivatives.into_iter().enumerate() {
            self.derivatives[i] = kept * self.derivatives[i] + (1.0 - kept) * derivative;
            self.squares[i] =
                kept_squares * self.squares[i] + (1.0 - kept_squares) * derivative * derivative;
            let mean = self.derivatives[i] / (1.0 - kept.powi(self.steps));
            let square = self.squares[i] / (1.0 - kept_squares.powi(self.steps));
            // No derivative at all is no step.
            by[i] = -length * mean / square.sqrt().max(f64::MIN_POSITIVE);
        }
        by
    }
}

/// Goes down for that many steps, and shows every state, the first one too.
pub fn descend(scene: &Scene, steps: usize, mut show: impl FnMut(State)) -> Result<(), Error> {
    let lever = 0.5 * FAR;
    let mut adam = Adam::default();
    let mut a_from_b = scene.guess;
    for step in 0..=steps {
        let (state, [turn, shift]) = evaluate(scene, a_from_b)?;
        show(state);
        let [first, last] = STEPS;
        let length = first * (last / first).powf(step as f64 / steps.max(1) as f64);
        // In metres all six.
        let turn = turn * (1.0 / lever);
        let derivatives = [turn.x, turn.y, turn.z, shift.x, shift.y, shift.z];
        let [x, y, z, u, v, w] = adam.step(derivatives, length);
        let turn = Vec3::new(x, y, z) * (1.0 / lever);
        a_from_b = a_from_b.retract(turn, Vec3::new(u, v, w));
    }
    Ok(())
}

/// The loss of a motion, and its derivatives by a small turn and a small shift in the frame of b.
fn evaluate(scene: &Scene, a_from_b: Pose3<f64>) -> Result<(State, [Vec3<f64>; 2]), Error> {
    let cpu = Cpu::new();
    let seen: Vec<_> = scene.b.iter().map(|&shape| a_from_b * shape).collect();
    let mut pairs = pair_up(&scene.a, &seen);
    let of_a: Vec<_> = pairs.iter().map(|pair| scene.a[pair.first]).collect();
    let of_b: Vec<_> = pairs.iter().map(|pair| scene.b[pair.second]).collect();
    let moved: Vec<_> = pairs.iter().map(|pair| seen[pair.second]).collect();

    let (ious, (by_iou, _)) = cpu.aligned(Iou.value_grad(), (&moved, &of_a))?;
    let columns = (&moved, &of_a, &ious);
    let (overlaps, (mut by_moved, _, along)) = cpu.aligned(Separation.value_grad(), columns)?;
    // The mean loss is one minus the mean overlap.
    let share = -1.0 / pairs.len().max(1) as f64;
    for ((by, along), iou) in by_moved.iter_mut().zip(along).zip(by_iou) {
        by.center = (by.center + iou.center * along) * share;
        by.rotation = sum(by.rotation, iou.rotation, along);
        by.rotation = sum(Rotation3::new(0.0, 0.0, 0.0, 0.0), by.rotation, share);
        by.size = Vec3::zero();
    }
    let (motions, _) = cpu.aligned(Carry.vjp(), ((One(a_from_b), &of_b), &by_moved))?;
    let (mut by_rotation, mut by_shift) = (Rotation3::new(0.0, 0.0, 0.0, 0.0), Vec3::zero());
    for by in motions {
        by_rotation = sum(by_rotation, by.rotation, 1.0);
        by_shift += by.translation;
    }
    let derivatives = [
        a_from_b.rotation.tangent_gradient(by_rotation),
        a_from_b.rotation.inverse() * by_shift,
    ];

    for (pair, &iou) in pairs.iter_mut().zip(&ious) {
        pair.overlap = iou;
    }
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len().max(1) as f64;
    let (turn, shift) = a_from_b.tangent_to(scene.a_from_b);
    let state = State {
        a_from_b,
        loss: 1.0 - mean(&overlaps),
        iou: mean(&ious),
        angle_error: turn.length(),
        shift_error: shift.length(),
        pairs,
    };
    Ok((state, derivatives))
}

/// `x + y · factor`, number by number.
fn sum(x: Rotation3<f64>, y: Rotation3<f64>, factor: f64) -> Rotation3<f64> {
    Rotation3::new(
        x.w + y.w * factor,
        x.x + y.x * factor,
        x.y + y.y * factor,
        x.z + y.z * factor,
    )
}

/// Boxes that may be of one object, one to one: near each other and of similar size, the nearest first.
fn pair_up(a: &[Obb3<f64>], b: &[Obb3<f64>]) -> Vec<Pair<f64>> {
    let mut pairs = Vec::new();
    for (first, p) in a.iter().enumerate() {
        for (second, q) in b.iter().enumerate() {
            let distance = p.center.distance(q.center) + 2.0 * p.size.distance(q.size);
            if distance < REACH {
                pairs.push(Pair {
                    first,
                    second,
                    overlap: -distance,
                });
            }
        }
    }
    greedy(&pairs)
}

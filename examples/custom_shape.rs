//! A shape and a function of your own: a two-link arm and its clearance from what is around it.
//! `cargo run --release -p geograd-examples --example custom_shape`; `-- --help` has the options.
#[path = "custom_shape/command.rs"]
mod command;
#[path = "custom_shape/draw.rs"]
mod draw;

use common::cli::{Failure, Machine};
use draw::{POST, WALL};
use geograd::kernels::{One, Op, Skip};
use geograd::{Capsule2, Circle, Obb2, Pose2, Program, Scalar, Shape, Sym, Vec2};
use geograd::{ad::program::WGSL, distance::Convex, operation};

/// Two thick links on a base. (`repr(C)` lets batches read and write its numbers in place.)
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
struct Arm<S> {
    base: Vec2<S>,
    #[shape(positive)]
    links: [S; 2],
    #[shape(angle)] // from the x axis: turning the whole turns it, too
    shoulder: S,
    #[shape(number)] // between the links
    elbow: S,
    #[shape(positive)]
    thickness: S,
}

/// A round obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[repr(C)]
struct Post<S> {
    center: Vec2<S>,
    #[shape(positive)]
    radius: S,
}

impl<S: Scalar> Arm<S> {
    /// The links as shapes.
    fn links(self) -> [Capsule2<S>; 2] {
        let along = |length| Vec2::new(length, S::zero());
        let elbow =
            Pose2::new(self.base, self.shoulder) * Pose2::new(along(self.links[0]), self.elbow);
        let ends = [self.base, elbow.translation, elbow * along(self.links[1])];
        [0, 1].map(|i| Capsule2::new(ends[i], ends[i + 1], self.thickness.halved()))
    }
}

operation! {
    /// How far the arm is from a wall and a post; minus the depth where it is in one of them.
    Clearance = "clearance": (arm: Arm<S>, wall: Obb2<S>, post: Post<S>) -> S {
        let disc = Circle::new(post.center, post.radius);
        let [upper, lower] = arm.links().map(|x| x.signed_distance(wall).least(x.signed_distance(disc)));
        upper.least(lower)
    }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    jumps Never
    derivative Reverse
}

/// Value and derivatives for many arms, on all cores or on a GPU.
fn batch(count: usize, machine: &Machine) -> Result<String, Failure> {
    let (arms, start, piece) = (command::postures(count), std::time::Instant::now(), 1 << 16);
    let (mut values, mut derivatives) = (vec![0.0; count], arms.clone());
    let bar = command::progress(count);
    let results = values.chunks_mut(piece).zip(derivatives.chunks_mut(piece));
    for (arms, (values, derivatives)) in arms.chunks(piece).zip(results) {
        let columns = (arms, One(WALL), One(POST));
        machine.backend().aligned_into(
            Clearance.value_grad(),
            columns,
            (values, (derivatives, Skip, Skip)),
        )?;
        bar.inc(arms.len() as u64);
    }
    bar.finish_and_clear();
    Ok(command::summary(start.elapsed(), &values, &derivatives))
}

/// The report of the harness in both formats.
#[cfg(feature = "check")]
fn check() -> Result<String, Failure> {
    use geograd::{ad::check::Sampling, kernels::check::check_with};
    // Every eighth of the hard cases, which are many for three shapes; fewer in slow, unoptimised builds.
    let (samples, every) = if cfg!(debug_assertions) {
        (40, 101)
    } else {
        (200, 8)
    };
    let mut plan = Sampling::new(samples, 1);
    plan.hard = every;
    let reports = [
        check_with::<Clearance, f64>(&plan),
        check_with::<Clearance, f32>(&plan),
    ];
    let text: String = reports.iter().map(|report| format!("{report}\n")).collect();
    match reports.iter().all(|report| report.passed()) {
        true => Ok(text),
        false => Err(Failure::Work(format!(
            "some derivatives were refused\n{text}"
        ))),
    }
}

/// The recorded function, and what it costs; as text or as a function for GPUs.
fn program(wgsl: bool) -> Result<String, Failure> {
    let program = Program::trace(|x: (Arm<Sym<f32>>, Obb2<_>, Post<_>)| Clearance::eval(x))?;
    Ok(match wgsl {
        true => format!("{WGSL}\n{}", program.wgsl("clearance")?),
        false => format!("{program}\n{}\n", program.cost()),
    })
}

fn main() -> std::process::ExitCode {
    common::cli::finish("custom_shape", command::run())
}

//! The inputs that a function is judged at, and declarations about the function: domain, resolution, scales. Callers of
//! the harness fill a [`Sampling`]; [`examine`](fn@crate::ad::check::examine) reads it.
use crate::ad::check::certificate::Proof;
use crate::ad::sample::Draw;

/// The seed of everything random, unless another one is given.
pub const SEED: u64 = 0x6765_6f67_7261_6421;

/// The number and choice of inputs to judge, and declarations about the function.
#[derive(Clone, Copy)]
pub struct Sampling<'a> {
    /// The number of random inputs.
    pub samples: usize,
    /// The seed of the random inputs.
    pub seed: u64,
    /// Hard cases come first: every `hard`-th of them, all by default, none for zero.
    pub hard: usize,
    /// Inputs that come before all others, as lists of numbers, for an operation of fixed size.
    pub points: &'a [Vec<f64>],
    /// `true` to draw the worst case of an operation.
    pub draws: bool,
    /// A function that is called after every sample, for a progress bar.
    pub tick: Option<&'a dyn Fn()>,
    /// A function that is asked after every sample: the check ends once it returns `true`.
    pub ends: Option<&'a dyn Fn() -> bool>,
    /// `true` if a derivative by hand must share an exact tie as duals do. Otherwise any element between the
    /// derivatives of both sides is right.
    pub shared_ties: bool,
    /// The error that values may have, absolutely and as a share: see
    /// [`Check::resolution`](crate::check::Check::resolution). `None` takes the operation's own resolution.
    pub resolution: Option<[f64; 2]>,
    /// The number of roundings of the format that values may be off by terms that cancel, in the unit of the result.
    /// `None` takes the operation's own number.
    pub roundings: Option<&'a dyn Fn(&[f64]) -> f64>,
    /// The domain, in addition to the rules of the shapes: inputs outside are not judged, no step leads there. `None`
    /// takes the operation's own domain.
    pub inside: Option<&'a dyn Fn(&[f64]) -> bool>,
    /// The length over which the function may be expected to change, for each number, if shapes do not give it.
    pub scales: Option<&'a dyn Fn(&[f64]) -> Vec<f64>>,
    /// The proof of the value at an input, for a distance in space.
    pub proof: Option<&'a dyn Fn(&[f64]) -> Option<Proof>>,
}

impl Sampling<'_> {
    /// Creates a sample of hard cases and `samples` random inputs.
    #[must_use]
    pub fn new(samples: usize, seed: u64) -> Self {
        Sampling {
            samples,
            seed,
            hard: 1,
            points: &[],
            draws: false,
            tick: None,
            ends: None,
            shared_ties: false,
            resolution: None,
            roundings: None,
            inside: None,
            scales: None,
            proof: None,
        }
    }
    /// Returns the generator of random sample `i`: samples do not depend on each other.
    #[must_use]
    pub fn draw(&self, i: usize) -> Draw {
        Draw::new(
            self.seed
                .wrapping_add((i as u64).wrapping_mul(0x2545_f491_4f6c_dd1d)),
        )
    }
}

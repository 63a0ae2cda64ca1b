//! Every number by which the harness decides, with its reason. None belongs to a function: tolerances proper are
//! measured at every input (the deviation under perturbed rounding, the error of an extrapolation). The constants here
//! control these measurements and the factors by which they may be exceeded.
//!
//! Sizes are relative: to a unit in the last place, to a scale of the input, or to the largest derivative.

use std::time::Duration;

// The largest difference of two exact witnesses.

/// The number of roundings by which two exact computations of a derivative may differ: a sum of a few products has
/// about as many.
pub(crate) const ROUNDINGS: f64 = 16.0;
/// The number of roundings of the largest coordinate by which a distance in space may differ from its proof: corners
/// are sums of a few products, and a height is one more.
pub(crate) const PROVED_ROUNDINGS: f64 = 4.0 * ROUNDINGS;
/// The factor on estimated errors before they count as exceeded. The deviation of a dozen draws, and the change from
/// one extrapolation to the next, estimate an error and do not bound it. A factor off by 10⁻⁶ is refused nevertheless.
pub(crate) const SAFETY: f64 = 8.0;
/// The factor by which a derivative of single precision may scatter more than the exact function changes. Lengths of
/// thin boxes that cross are differences of coordinates: derivatives were off by a factor of twelve there, and of sixty
/// near a tie of enclosing rectangles. No value scatters more than the exact function.
pub(crate) const SCATTER: f64 = 100.0;
/// The factor on the tolerance of the adjoint of a sum if no source shows the roundings inside it; an adjoint that is
/// not linear is off by a share of itself.
pub(crate) const UNSEEN: f64 = 1e6;
/// The number of roundings of a second derivative: each product of two derivatives has two, and both are sums.
pub(crate) const CURVATURE_ROUNDINGS: f64 = 4.0 * ROUNDINGS;
/// A change larger than this share of the size comes from another decision, not from rounding.
pub(crate) const DECIDED: f64 = 1e-3;
/// The roughness, in units in the last place of a derivative's typical size, up to which rounding of such terms
/// explains it. A rougher derivative loses digits without need, and is allowed one unit.
pub(crate) const ROUGH: f64 = 4.0;
/// The ratio of a derivative times the size of its number to the value above which it belongs to another feature: a
/// logit of forty with a loss near zero has thirty times the slope of the loss at zero.
pub(crate) const TALL: f64 = 64.0;
/// The ratio for a second derivative along a direction as long as the scales, times the size of its number: the square,
/// since two derivatives are steeper.
pub(crate) const TALL_SECOND: f64 = TALL * TALL;
/// The multiples of the input at which the size of a derivative is measured too: zero, half, one and a half.
pub(crate) const ELSEWHERE: [f64; 3] = [0.0, 0.5, 1.5];
/// The error of a sum of numbers of `f64`, in units of double precision, as the noise of a function known in double
/// precision.
pub(crate) const WIDE_NOISE: f64 = 4.0;

// Numbers of draws and evaluations.

/// Inputs of up to this length are judged number by number, longer ones along random directions: the work of the former
/// grows with the square of the length.
pub(crate) const FEW_INPUTS: usize = 48;
/// Up to this number of outputs are checked one by one, more in random combinations.
pub(crate) const FEW_OUTPUTS: usize = 8;
/// The number of combinations of many outputs, or of the derivatives of a long input: a fault of a single number is in
/// each of them, with a factor of its own.
pub(crate) const COMBINATIONS: usize = 4;
/// The number of neighbouring inputs, moved by their rounding. A multiple of the three modes of perturbation.
pub(crate) const ROUNDS: u64 = 12;
/// The number of neighbours that estimate the noise of a value. It is only a lower bound: every sequence of steps adds
/// its own noise.
pub(crate) const NOISE_ROUNDS: usize = 4;
/// The number of runs with a derivative's own roundings drawn: each has three outcomes, so it needs more runs than
/// neighbours.
pub(crate) const RUNS: u64 = 24;
/// The number of perturbations if a motion seems broken: the moved input has a conditioning of its own, and a dozen
/// draws may miss its worst.
pub(crate) const DRAWS: u64 = 48;
/// The perturbations of a number in units of its last place, and the largest one in roundings.
pub(crate) const LAST_DIGITS: [i32; 4] = [-2, -1, 1, 2];
pub(crate) const MOVED_ROUNDINGS: f64 = 2.0;
/// The factor on the rounding within which two branches count as tied in single precision: functions average if values
/// differ by less than a few roundings.
pub(crate) const TIED: f64 = 8.0;
/// The number of random directions for an input whose Jacobian is too large. Two wrong derivatives cancel along one of
/// them with probability zero; further directions guard against rounding.
pub(crate) const PROJECTIONS: usize = 3;
/// The number of parts of a direction that the search for the number at fault may compute: halving two thousand numbers
/// takes twenty-two; the others are for halves that both differ.
pub(crate) const PARTS: usize = 256;
/// The number of random directions of steps for a long input, and at a kink of a short one.
pub(crate) const LONG_DIRECTIONS: usize = 12;
pub(crate) const KINK_DIRECTIONS: usize = 4;
/// The number of directions that keep a tie.
pub(crate) const TIED_DIRECTIONS: usize = 8;

// Steps.

/// First steps of the sequence that judges and of those that confirm, in units of the scales. The last ones find
/// features too small for the first one. The quotient of no two is a power of the ratio, so that no two sequences share
/// a step.
pub(crate) const FIRST: [f64; 5] = [0.1, 0.037, 0.23, 1e-3, 1e-5];
/// The range of the finer ones in [`FIRST`].
pub(crate) const FINER: std::ops::Range<usize> = 3..5;
/// The number of steps of a sequence on each side.
pub(crate) const STEPS: i32 = 12;
/// The ratio of successive steps: twelve of them span seven decades.
pub(crate) const RATIO: f64 = 4.0;
/// Two steps whose ratio is below this count as one: rounding has removed the difference.
pub(crate) const SAME_STEP: f64 = 1.5;
/// The number of steps in one branch from which a side is judged by them alone.
pub(crate) const SETTLED: usize = 3;
/// The number of smallest steps that show the rounding of the value.
pub(crate) const SMALL_STEPS: usize = 5;
/// The largest number of powers of the step that an extrapolation eliminates; more would only amplify rounding.
pub(crate) const POWERS: usize = 6;
/// The factors on the truncation error of a large step, and on the noise, within which an extrapolation may differ from
/// the derivatives of smaller steps. A larger difference counts as its error.
pub(crate) const TRUNCATION: f64 = 2.0;
pub(crate) const NOISE_OF_STEPS: f64 = 16.0;
/// A value jumps if the smallest of the changes to the nearest steps is this share of the largest, and exceeds the
/// noise by a factor. With a derivative the changes fall by the ratio.
pub(crate) const JUMP_STAYS: f64 = 0.8;
pub(crate) const JUMP_NOISE: f64 = 64.0;
/// First step of the sequence that distinguishes a jump from a kink very near.
pub(crate) const NEAR_JUMP: f64 = 1e-8;
/// The distance, in its scale, within which a number counts as on the border of its domain: less than the steps of the
/// first sequence that count.
pub(crate) const BORDER: f64 = 1e-6;
/// The distance if the value is zero and a convention may decide: an exact witness has no steps, so the border is
/// looked for farther away.
pub(crate) const CONVENTION_BORDER: f64 = 1e-3;
/// A difference whose error is larger than this share of the largest derivative decides nothing: it would accept any
/// derivative.
pub(crate) const INFORMATIVE: f64 = 0.02;
/// First steps in units of the number itself, used if it is smaller than a share of its scale.
pub(crate) const OWN_FIRST: [f64; 2] = [0.1, 0.037];
pub(crate) const OWN_SIZE: f64 = 0.5;
/// Both sides have one derivative if they differ by less than this factor times the error of each.
pub(crate) const SIDES: f64 = 2.0;
/// The number of sequences that must give a refusal.
pub(crate) const REPEATED: usize = 2;
/// A derivative counts as judged by a difference that is known to this share of the derivative's typical size, although
/// the difference is too coarse for one of the largest size.
pub(crate) const COARSE: f64 = 0.5;

// Points near the input.

/// The distance of points whose derivatives bound a derivative at a kink, in the scales of the input, unless rounding
/// is larger. Duals give derivatives there, which need no room for steps. A derivative that is off by more than a
/// millionth of the second derivative is outside.
pub(crate) const NEARBY: f64 = 1e-6;
/// The factor by which every other of them may be nearer: a branch between two kinks may be as small as rounding.
pub(crate) const NEARER: f64 = 1e-8;
/// The factor if only differences give the derivative, with steps of at most a tenth of the distance to the point:
/// smaller steps show nothing but rounding.
pub(crate) const NEARER_STEPS: f64 = 1e-2;
/// The number of them that count, and the number that are tried: near a box without width only boxes with a positive
/// width are in the domain.
pub(crate) const PLACES: usize = 48;
pub(crate) const TRIES: usize = 4000;
/// The number that are tried if only differences give the derivative, each of which takes two dozen values. A refused
/// input is judged four hundred times while it is made simpler.
pub(crate) const TRIES_OF_STEPS: usize = 96;
/// The number of points near an input at which derivatives must be right if a choice at the input is to explain a wrong
/// one.
pub(crate) const FEW_PLACES: usize = 6;
/// The number of iterations towards the nearest point in the hull of the branches' derivatives: one is enough for the
/// two branches of most kinks.
pub(crate) const APPROACHES: usize = 100;
/// The amounts by which a whole input moves in a test of invariance: a part of its smallest scale, an angle that is no
/// simple part of a circle, a factor that is no power of two.
pub(crate) const TRANSLATION: f64 = 0.75;
pub(crate) const ROTATION: f64 = 0.6;
pub(crate) const SCALING: f64 = 3.0;
/// The largest factor by which rounding is taken to grow with the value when the input is scaled: that of an area.
pub(crate) const GROWTH: f64 = SCALING * SCALING;

// Roughness of a function, estimated from its values.

/// The spacings of its tables, in powers of two of the scales: from just above the last digits to where truncation
/// begins.
pub(crate) const SPACINGS_F32: [i32; 3] = [-11, -9, -7];
pub(crate) const SPACINGS_F64: [i32; 3] = [-32, -22, -12];
/// `(k!)² / (2k)!` for the orders 3 and 4: the variance of an error by that of their difference.
pub(crate) const SHARE_OF_ORDER: [f64; 2] = [1.0 / 20.0, 1.0 / 70.0];
/// The standard deviation of normal errors by the median of their size.
pub(crate) const MEDIAN: f64 = 1.4826;

// Default scales, and the whole run.

/// The least length over which a number is taken to change, as a share of the largest number.
pub(crate) const LEAST_SCALE: f64 = 1e-3;
/// The size above which numbers have no common unit, and products of them would overflow.
pub(crate) const NO_UNIT: f64 = 1e150;
/// From this many random inputs on, one in `SMOOTH_ONE_IN` must be smooth as far as chance allows, or nothing was checked.
pub(crate) const ENOUGH: usize = 20;
pub(crate) const SMOOTH_ONE_IN: usize = 10;
/// One in this number must be inside the domain.
pub(crate) const INSIDE_ONE_IN: usize = 10;
/// The number of refused inputs without a new reason after which no further ones are judged.
pub(crate) const TIRED: usize = 32;
/// The number of failures that a report keeps, one of each reason.
pub(crate) const KEPT: usize = 8;
/// The count of numbers that simpler inputs of the first failure of a report may have together: 400 short inputs. All
/// further failures together have a quarter of it, since most appear at the input found for the first one.
pub(crate) const SHRINKING: usize = 400 * FEW_INPUTS;
/// The time that simpler inputs of one failure may take; a quarter of it for each further one. A judgement of a costly
/// function takes seconds where it refuses.
pub(crate) const SHRINKING_TIME: Duration = Duration::from_secs(20);

//! Every number by which the harness decides, with its reason. None belongs to a function: tolerances
//! proper are measured at every input (the spread under provoked rounding, the error of an
//! extrapolation), and what stands here says how measurements are taken and by how much they may be
//! exceeded.
//!
//! Sizes are relative: to a unit in the last place, to a scale of the input, or to the largest derivative.

// How far apart two exact witnesses may be.

/// How many roundings the last step of a derivative may have more than the other way to get it: a sum of
/// a few products has about as many.
pub(crate) const ROUNDINGS: f64 = 16.0;
/// By how many roundings of the largest coordinate a distance in space may differ from its proof: corners are sums of
/// a few products, and a height is one more.
pub(crate) const PROVED_ROUNDINGS: f64 = 4.0 * ROUNDINGS;
/// By how much estimated errors are multiplied before they count as exceeded. A spread of a dozen draws,
/// and the change from one extrapolation to the next, estimate an error and do not bound it. A factor off
/// by 10⁻⁶ is refused all the same.
pub(crate) const SAFETY: f64 = 8.0;
/// How many times the change of the exact function a derivative of single precision may scatter. Lengths of thin
/// boxes that cross are differences of coordinates: derivatives were off by twelve times as much there, and by
/// sixty beside a tie of enclosing rectangles. No value scatters more than the exact function.
pub(crate) const SCATTER: f64 = 100.0;
/// How many times that much the adjoint of a sum may be off where no source shows the roundings inside it; an adjoint
/// that is not linear is off by a share of itself.
pub(crate) const UNSEEN: f64 = 1e6;
/// How many roundings more than a derivative a second derivative may have: each product of two derivatives has two,
/// and both are sums.
pub(crate) const CURVATURE_ROUNDINGS: f64 = 4.0 * ROUNDINGS;
/// A change larger than this share of the size comes from another decision, not from rounding.
pub(crate) const DECIDED: f64 = 1e-3;
/// By how many units in its last place a derivative may be rough and still be as good as terms as large
/// as the derivative typically is allow; rougher ones lose digits without need, and get one unit.
pub(crate) const ROUGH: f64 = 4.0;
/// How many times the value a derivative times the size of its number may be before it belongs to another
/// feature: a logit of forty that leaves a loss of nothing is as steep as thirty times the loss at
/// zero.
pub(crate) const TALL: f64 = 64.0;
/// The same of a second derivative along a direction as long as the scales, times the size of its number:
/// the feature is as much steeper once more.
pub(crate) const TALL_BEND: f64 = TALL * TALL;
/// The multiples of the input at which the size of a derivative is measured too: zero, half, one and a half.
pub(crate) const ELSEWHERE: [f64; 3] = [0.0, 0.5, 1.5];
/// How many units of double precision a sum of numbers of `f64` may be off by, where it stands for the
/// noise of a function known in double precision.
pub(crate) const WIDE_NOISE: f64 = 4.0;

// How often things are drawn or looked at.

/// Inputs up to this number are judged one by one, more of them along random directions: the work of
/// the one grows with the square of their number, that of the other does not.
pub(crate) const FEW_INPUTS: usize = 48;
/// Outputs up to this number are checked one by one, more of them in random combinations.
pub(crate) const FEW_OUTPUTS: usize = 8;
/// How many combinations of many outputs, or of the derivatives of a long input, there are: a fault of a single
/// number is in each of them, with a factor of its own.
pub(crate) const COMBINATIONS: usize = 4;
/// How often the input is moved by its rounding. A multiple of the three ways of moving it.
pub(crate) const ROUNDS: u64 = 12;
/// How many of those are enough for the noise of a value, which is only a lower bound: every ladder shows
/// its own noise beside it.
pub(crate) const NOISE_ROUNDS: usize = 4;
/// How often a derivative's own roundings are drawn: of three outcomes each, so more than inputs are moved.
pub(crate) const RUNS: u64 = 24;
/// How often rounding is provoked where a motion seems broken: the moved input has a conditioning of its
/// own, and a dozen draws may miss its worst.
pub(crate) const DRAWS: u64 = 48;
/// By how many of its last digits a number moves, and by how many of its roundings.
pub(crate) const LAST_DIGITS: [i32; 4] = [-2, -1, 1, 2];
pub(crate) const MOVED_ROUNDINGS: f64 = 2.0;
/// By how many times that two branches count as tied in single precision: functions average where values differ by
/// less than a few roundings.
pub(crate) const TIED: f64 = 8.0;
/// Random directions for an input whose Jacobian is too large. Two derivatives that are both wrong
/// cancel along one of them with probability zero; more only guard against that.
pub(crate) const PROJECTIONS: usize = 3;
/// How many parts of a direction are looked at in search of the number at fault: halving two thousand
/// numbers takes twenty-two; the others are for halves that both differ.
pub(crate) const PARTS: usize = 256;
/// Along how many random directions steps are taken of a long input, and at a kink of a short one.
pub(crate) const LONG_DIRECTIONS: usize = 12;
pub(crate) const KINK_DIRECTIONS: usize = 4;
/// Along how many directions that keep a tie.
pub(crate) const TIED_DIRECTIONS: usize = 8;

// Steps.

/// First steps of the ladder that judges and of those that confirm, in units of the scales. The
/// last ones look for features smaller than the first one can see. No two are a power of the ratio apart,
/// so that no two ladders share a step.
pub(crate) const FIRST: [f64; 5] = [0.1, 0.037, 0.23, 1e-3, 1e-5];
/// The range of the finer ones in [`FIRST`].
pub(crate) const FINER: std::ops::Range<usize> = 3..5;
/// How many steps a ladder has on each side.
pub(crate) const RUNGS: i32 = 12;
/// By what the step falls from one to the next: 12 of them span seven decades.
pub(crate) const RATIO: f64 = 4.0;
/// Two steps nearer to each other than this are one: rounding has swallowed the difference.
pub(crate) const SAME_STEP: f64 = 1.5;
/// How many rungs of one branch a side needs before it is judged by them alone.
pub(crate) const SETTLED: usize = 3;
/// How many of the smallest rungs show the rounding of the value.
pub(crate) const SMALL_RUNGS: usize = 5;
/// How many powers of the step an extrapolation eliminates at most; more only amplify rounding.
pub(crate) const POWERS: usize = 6;
/// How much of the truncation error of a large step, and how often the noise, may stand between an
/// extrapolation and the derivatives of smaller steps before it counts as its error.
pub(crate) const TRUNCATION: f64 = 2.0;
pub(crate) const NOISE_OF_RUNGS: f64 = 16.0;
/// A value jumps where the changes to the nearest rungs are as large as this share of each other, and so
/// many times the noise: those of a derivative fall by the ratio.
pub(crate) const JUMP_STAYS: f64 = 0.8;
pub(crate) const JUMP_NOISE: f64 = 64.0;
/// First step of the ladder that tells a jump from a kink very near.
pub(crate) const NEAR_JUMP: f64 = 1e-8;
/// How near the border of its domain a number is on it, in its scale: less than the steps of the first
/// ladder that counts.
pub(crate) const BORDER: f64 = 1e-6;
/// The same where the value is zero and a convention may decide: an exact witness has no steps that could
/// tell, so the border is looked for farther away.
pub(crate) const CONVENTION_BORDER: f64 = 1e-3;
/// A difference whose error is larger than this share of the largest derivative says nothing: it would pass
/// whatever is compared with it.
pub(crate) const INFORMATIVE: f64 = 0.02;
/// First steps in units of the number itself, where that is smaller than this share of its scale.
pub(crate) const OWN_FIRST: [f64; 2] = [0.1, 0.037];
pub(crate) const OWN_SIZE: f64 = 0.5;
/// Both sides are the same derivative where they differ by less than so many times what each may be off by.
pub(crate) const SIDES: f64 = 2.0;
/// How many ladders must repeat a complaint.
pub(crate) const REPEATED: usize = 2;
/// A derivative is covered by a difference that is known to this share of what the derivative typically is, although
/// that says nothing of one as large as others are.
pub(crate) const COARSE: f64 = 0.5;

// Places beside the input.

/// How far the places are whose derivatives bound a derivative at a kink, in the scales of the input, unless rounding
/// is larger: derivatives there are those of duals, which need no room for steps, so a derivative that is off by more
/// than a millionth of the function's bend is outside.
pub(crate) const NEARBY: f64 = 1e-6;
/// How much nearer every other of them may be: a piece between two kinks may be as small as rounding.
pub(crate) const NEARER: f64 = 1e-8;
/// The same where only steps tell the derivative, a tenth of the way to the place at most: of steps still nearer rounding
/// is all that shows.
pub(crate) const NEARER_STEPS: f64 = 1e-2;
/// How many of them are looked at, and how many are tried: of a box without width only those are in the
/// domain that have one.
pub(crate) const PLACES: usize = 48;
pub(crate) const TRIES: usize = 4000;
/// How many are tried where only steps tell, each of which asks for two dozen values; a refused input is judged anew four
/// hundred times while it is made simpler.
pub(crate) const TRIES_OF_STEPS: usize = 96;
/// At how many places beside an input derivatives must be right to be taken for a choice at the input itself.
pub(crate) const FEW_PLACES: usize = 6;
/// How many steps lead to the nearest of all derivatives between those of several pieces: with the two pieces of most
/// kinks one is enough.
pub(crate) const APPROACHES: usize = 100;
/// By how much a whole input moves to see that an invariance is kept: by a part of its smallest scale, by an
/// angle that is no part of a circle, by a factor that is no power of two.
pub(crate) const TRANSLATION: f64 = 0.75;
pub(crate) const ROTATION: f64 = 0.6;
pub(crate) const SCALING: f64 = 3.0;
/// The most by which rounding is taken to grow with the value when the input is scaled: as its area does.
pub(crate) const GROWTH: f64 = SCALING * SCALING;

// Roughness of a function seen from outside.

/// Spacings of its tables, in powers of two of the scales: from just above the last digits to where
/// truncation begins to show.
pub(crate) const SPACINGS_F32: [i32; 3] = [-11, -9, -7];
pub(crate) const SPACINGS_F64: [i32; 3] = [-32, -22, -12];
/// `(k!)² / (2k)!` for the orders 3 and 4: the variance of an error by that of their difference.
pub(crate) const SHARE_OF_ORDER: [f64; 2] = [1.0 / 20.0, 1.0 / 70.0];
/// The standard deviation of normal errors by the median of their size.
pub(crate) const MEDIAN: f64 = 1.4826;

// Default scales, and the whole run.

/// A number is taken to change over no less than this share of the largest one.
pub(crate) const LEAST_SCALE: f64 = 1e-3;
/// Above this numbers have no unit in common, and products of them would overflow.
pub(crate) const NO_UNIT: f64 = 1e150;
/// From this many random inputs on, one in `SMOOTH_ONE_IN` must be smooth as far as chance allows, or nothing was checked.
pub(crate) const ENOUGH: usize = 20;
pub(crate) const SMOOTH_ONE_IN: usize = 10;
/// And one in so many must be inside the domain.
pub(crate) const INSIDE_ONE_IN: usize = 10;
/// After so many refused inputs without a new reason no further ones are judged.
pub(crate) const TIRED: usize = 32;
/// How many failures a report keeps: one of each reason is what is read.
pub(crate) const KEPT: usize = 8;
/// How many numbers simpler inputs of the first failure of a report may have together: 400 short inputs are tried. All
/// further failures together have a quarter of it, since most show at the input found for the first one.
pub(crate) const SHRINKING: usize = 400 * FEW_INPUTS;

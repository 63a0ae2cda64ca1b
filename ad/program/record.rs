//! The recording of a function, and the test that the recording equals the function.
use super::graph::{Format, Graph, Id, Node};
use super::in_progress::Recording;
use super::packed::numbers;
use super::recorded::Recorded;
use super::sym::{Neutral, Sym, retyped};
use crate::{Error, Fixed, Real, Scalar, Unrecordable};

/// The number of inputs that a function with hints is tried on.
pub(crate) const TRIALS: usize = 192;

/// The number of inputs for one of many replays of a function.
const TRIALS_OF_REPLAY: usize = 12;

/// A function of shapes as one of lists of symbols.
pub(crate) type Listed<'a> = &'a dyn Fn(&[Neutral]) -> Vec<Neutral>;

/// Records a function of shapes of symbols.
pub(crate) fn record<T, X, Y>(function: impl Fn(X) -> Y) -> Result<Recorded, Error>
where
    T: Real,
    X: Fixed<Scalar = Sym<T>>,
    Y: Fixed<Scalar = Sym<T>>,
{
    record_in::<T, X, Y>(T::FORMAT, function)
}

/// Records a function of shapes of symbols in a format. Functions over [`Neutral`] are compiled for both formats at
/// once.
pub(crate) fn record_in<T, X, Y>(
    format: Format,
    function: impl Fn(X) -> Y,
) -> Result<Recorded, Error>
where
    T: Real,
    X: Fixed<Scalar = Sym<T>>,
    Y: Fixed<Scalar = Sym<T>>,
{
    if X::CODES + Y::CODES > 0 {
        return Err(Error::Program(Unrecordable::Codes));
    }
    // All that follows is compiled once, and the function itself once.
    listed(format, X::LEN, TRIALS, &|symbols| {
        retyped(&numbers(function(X::load(&retyped(symbols)))))
    })
}

/// Records a function of shapes of symbols whose input has these codes.
pub(crate) fn record_with_codes<X, Y>(
    format: Format,
    codes: &[u32],
    function: impl Fn(X) -> Y,
) -> Result<Recorded, Error>
where
    X: Fixed<Scalar = Neutral>,
    Y: Fixed<Scalar = Neutral>,
{
    if Y::CODES > 0 {
        return Err(Error::Program(Unrecordable::Codes));
    }
    listed(format, X::LEN, TRIALS_OF_REPLAY, &|symbols| {
        numbers(function(X::load(symbols).load_codes(codes)))
    })
}

/// Records a function of lists of symbols.
pub(crate) fn listed(
    format: Format,
    inputs: usize,
    trials: usize,
    function: Listed<'_>,
) -> Result<Recorded, Error> {
    let (recorded, hints) = recorded(format, inputs, function).map_err(Error::Program)?;
    let agrees = |trial| match format {
        Format::F32 => agrees::<f32>(&recorded, inputs, function, trial),
        Format::F64 => agrees::<f64>(&recorded, inputs, function, trial),
    };
    // Without hints the function has one path, which was recorded.
    if hints > 0 && !(0..trials).all(agrees) {
        return Err(Error::Program(Unrecordable::Hint));
    }
    Ok(recorded)
}

/// Returns the program of a function, and the number of hints it requested that were not known.
fn recorded(
    format: Format,
    inputs: usize,
    function: Listed<'_>,
) -> Result<(Recorded, usize), Unrecordable> {
    let (outputs, recording) = run(format, false, &mut || function(&symbols(inputs)));
    let mut recording = recording?;
    let outputs = places(&mut recording, &outputs)?;
    let recorded = Recorded::new(recording.graph, inputs, &outputs).checked_constants()?;
    Ok((recorded, recording.hints))
}

/// Returns the graph of a straight line of plain numbers and its results, of which zeros keep their signs. It may have
/// infinite constants.
pub(super) fn graph_of(
    format: Format,
    inputs: usize,
    function: Listed<'_>,
) -> Result<(Graph, Vec<Id>), Unrecordable> {
    let (outputs, recording) = run(format, false, &mut || function(&symbols(inputs)));
    let mut recording = recording?;
    let outputs = places(&mut recording, &outputs)?;
    Ok(recording.graph.lowered(&outputs))
}

/// Returns the symbols of an input.
fn symbols(inputs: usize) -> Vec<Neutral> {
    let places = 0..inputs as u32;
    places.map(|place| Sym::leaf(Node::Input(place))).collect()
}

/// Runs a body in a recording.
fn run(
    format: Format,
    plain: bool,
    body: &mut dyn FnMut() -> Vec<Neutral>,
) -> (Vec<Neutral>, Result<Recording, Unrecordable>) {
    let mut outputs = Vec::new();
    let recording = Recording::run(format, plain, &mut || outputs = body());
    (outputs, recording)
}

/// Returns the indices of the results, which must belong to this recording, too.
pub(super) fn places<T: Real>(
    recording: &mut Recording,
    results: &[Sym<T>],
) -> Result<Vec<Id>, Unrecordable> {
    let places = results.iter().map(|x| recording.place(x.symbol)).collect();
    recording.sound().map(|()| places)
}

/// Returns `true` if the program gives the results of the function on plain numbers, for which every hint is answered
/// by the truth. Plain numbers are symbols of constants here, and every operation on them is carried out at once.
fn agrees<T: Real>(recorded: &Recorded, inputs: usize, function: Listed<'_>, trial: usize) -> bool {
    let input: Vec<T> = sample(trial, inputs).into_iter().map(T::lit).collect();
    let (outputs, recording) = run(T::FORMAT, true, &mut || {
        let symbols: Vec<Neutral> = input.iter().map(|x| Sym::lit(x.widen())).collect();
        function(&symbols)
    });
    let Ok(mut recording) = recording else {
        return false;
    };
    let Ok(places) = places(&mut recording, &outputs) else {
        return false;
    };
    let same = |(&place, found): (&Id, T)| {
        let expected = recording.graph.constant(place).unwrap_or(f64::NAN) + 0.0;
        let found = found.widen();
        expected.to_bits() == found.to_bits() || (expected.is_nan() && found.is_nan())
    };
    places.iter().zip(recorded.run(&input)).all(same)
}

/// Returns numbers to try a function on: ties, equal shapes, zeros, positive ones (sizes), signed ones, large and small
/// ones, by turns.
fn sample(trial: usize, count: usize) -> Vec<f64> {
    let mut state = (trial as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    // SplitMix64 (Steele, Lea and Flood 2014).
    let mut uniform = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    };
    let mut numbers: Vec<f64> = (0..count)
        .map(|_| {
            let x = uniform();
            match trial % 6 {
                0 => (x * 5.0).floor(),
                1 => x * 4.0,
                2 => x * 8.0 - 4.0,
                3 => (x * 9.0).floor() - 4.0,
                4 => Scalar::exp(x * 12.0 - 6.0),
                _ => (x - 0.5).signum() * Scalar::exp(uniform() * 12.0 - 6.0),
            }
        })
        .collect();
    // Every fourth time the second half repeats the first, as two equal shapes.
    if trial % 4 == 3 {
        for i in 0..count / 2 {
            numbers[count / 2 + i] = numbers[i];
        }
    }
    numbers
}

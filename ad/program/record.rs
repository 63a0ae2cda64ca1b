//! How a function is recorded, and how it is found out whether the recording is that function.
use super::graph::{Id, Node};
use super::recorded::Recorded;
use super::recording::Recording;
use super::shapes::numbers;
use super::symbol::{Plain, Sym};
use crate::{Error, Fixed, Scalar, Unrecordable};

/// How many inputs a function that asks for hints is tried on.
const TRIALS: usize = 192;

/// Records a function of shapes of symbols.
pub(crate) fn record<T, X, Y>(function: impl Fn(X) -> Y) -> Result<Recorded, Error>
where
    T: Plain,
    X: Fixed<Scalar = Sym<T>>,
    Y: Fixed<Scalar = Sym<T>>,
{
    if X::CODES + Y::CODES > 0 {
        return Err(Error::Program(Unrecordable::Codes));
    }
    let (recorded, hints) = recorded(&function).map_err(Error::Program)?;
    // Without hints there is one way through the function, which was recorded.
    if hints > 0 && !(0..TRIALS).all(|trial| agrees::<T, X, Y>(&recorded, &function, trial)) {
        return Err(Error::Program(Unrecordable::Hint));
    }
    Ok(recorded)
}

/// The program of a function, and how many hints it asked for that were not known.
fn recorded<T, X, Y>(function: &impl Fn(X) -> Y) -> Result<(Recorded, usize), Unrecordable>
where
    T: Plain,
    X: Fixed<Scalar = Sym<T>>,
    Y: Fixed<Scalar = Sym<T>>,
{
    let (outputs, recording) = Recording::run(T::FORMAT, false, || {
        let inputs: Vec<Sym<T>> = (0..X::LEN)
            .map(|place| Sym::leaf(Node::Input(place as u32)))
            .collect();
        numbers(function(X::load(&inputs)))
    });
    let mut recording = recording?;
    let outputs = places(&mut recording, &outputs)?;
    let recorded = Recorded::new(recording.graph, X::LEN, &outputs).finite()?;
    Ok((recorded, recording.hints))
}

/// The places of the results, which must be of this recording, too.
fn places<T: Plain>(
    recording: &mut Recording,
    results: &[Sym<T>],
) -> Result<Vec<Id>, Unrecordable> {
    let places = results.iter().map(|x| recording.place(x.symbol)).collect();
    recording.sound().map(|()| places)
}

/// Whether the program gives what the function gives where every hint is answered by the truth: on
/// plain numbers. Those are symbols of constants, with which every operation is carried out at once.
fn agrees<T, X, Y>(recorded: &Recorded, function: &impl Fn(X) -> Y, trial: usize) -> bool
where
    T: Plain,
    X: Fixed<Scalar = Sym<T>>,
    Y: Fixed<Scalar = Sym<T>>,
{
    let input: Vec<T> = sample(trial, X::LEN).into_iter().map(T::lit).collect();
    let (outputs, recording) = Recording::run(T::FORMAT, true, || {
        let inputs: Vec<Sym<T>> = input.iter().map(|x| Sym::lit(x.widen())).collect();
        numbers(function(X::load(&inputs)))
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

/// Numbers to try a function on: ties, equal shapes, zeros, positive ones (sizes), signed ones, large and
/// small ones, by turns.
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
                4 => (x * 12.0 - 6.0).exp(),
                _ => (x - 0.5).signum() * (uniform() * 12.0 - 6.0).exp(),
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

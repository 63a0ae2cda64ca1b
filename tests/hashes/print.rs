//! Hashes of numbers and text, and the inputs whose results are hashed.
use geograd::ad::check::sample::{Draw, Sample, hard_cases, moved, random};

/// A hash (FNV-1a) of bytes.
struct Print(u64);

impl Print {
    fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

fn print(bytes: impl Iterator<Item = [u8; 8]>) -> u64 {
    let mut print = Print(0xcbf2_9ce4_8422_2325);
    bytes.for_each(|bytes| print.take(&bytes));
    print.0
}

/// The hash of numbers by their bits in double precision. All NaN count as one: processors choose sign and payload.
pub fn of_numbers(numbers: &[f64]) -> u64 {
    let one = |x: &f64| if x.is_nan() { f64::NAN.abs() } else { *x };
    print(numbers.iter().map(|x| one(x).to_bits().to_le_bytes()))
}

/// The hash of a text.
pub fn of_text(text: &str) -> u64 {
    let mut print = Print(0xcbf2_9ce4_8422_2325);
    print.take(text.as_bytes());
    print.0
}

/// From where random inputs and cotangents are drawn.
const SEED: u64 = 25;
/// The most hard cases of a row.
const HARD: usize = 110;
/// Random inputs of a row.
const RANDOM: usize = 70;
/// How much every tenth random input is scaled once more, so that compiled kernels leave it to scalar code.
const EXTREME: [f64; 2] = [1e-30, 1e25];

/// Inputs of one row as lists of numbers: hard cases, random inputs and some extreme ones, rounded to a format.
pub fn inputs<X: Sample>(round: fn(f64) -> f64, flat: fn(&X) -> Vec<f64>) -> Vec<Vec<f64>> {
    let hard = hard_cases::<X>();
    let step = hard.len().div_ceil(HARD).max(1);
    let mut all: Vec<X> = hard.into_iter().step_by(step).collect();
    let mut draw = Draw::new(SEED);
    for i in 0..RANDOM {
        let x: X = random(&mut draw);
        if i % 10 == 0 {
            all.extend(
                EXTREME
                    .map(|scale| x.refill(&moved(&x.scalars(), &x.kinds(), 0.0, scale, [0.0; 2]))),
            );
        }
        all.push(x);
    }
    let rounded = all.into_iter().map(|x| {
        let numbers: Vec<f64> = x.scalars().into_iter().map(round).collect();
        x.refill(&numbers)
    });
    rounded.filter(Sample::inside).map(|x| flat(&x)).collect()
}

/// Cotangents of results of so many numbers, one per input, with zeros among them.
pub fn cotangents(inputs: usize, outputs: usize) -> Vec<Vec<f64>> {
    let mut draw = Draw::new(SEED);
    let mut one = || match draw.below(8) {
        0 => 0.0,
        _ => draw.within(-2.0, 2.0),
    };
    (0..inputs)
        .map(|_| (0..outputs).map(|_| one()).collect())
        .collect()
}

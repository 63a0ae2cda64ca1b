//! A scalar that makes one mistake: how a formula is wrong in one place.
//!
//! It counts operations. Number so and so is carried out wrongly, in its value (a formula with a wrong sign, a
//! forgotten factor, a sine for a cosine) or in its derivative (a rule of differentiation that is broken or left
//! out).
use geograd::error::Field;
use geograd::scalar::dual::Tangent;
use geograd::{Fixed, Pack, Scalar};
use std::cell::Cell;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// The place of the mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In a value: sums are differences, factors are forgotten, functions are left out or replaced by their
    /// derivatives, constants are others.
    Value,
    /// In a derivative: terms of a rule are dropped or have the wrong sign, what is inside a function is taken as
    /// constant.
    Derivative,
}

/// A mistake: operation number `at`, in one of two ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// In value or derivative.
    pub place: Place,
    /// The number of the operation.
    pub at: usize,
    /// Which of two ways to be wrong.
    pub second: bool,
}

thread_local! {
    // Operators have no place to carry a plan along, so it belongs to the thread.
    static MISTAKE: Cell<Option<Mistake>> = const { Cell::new(None) };
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// Runs a function with a mistake, or with none; beside its result it gives how many operations there were.
pub fn mistaken<R>(mistake: Option<Mistake>, run: impl FnOnce() -> R) -> (R, usize) {
    MISTAKE.set(mistake);
    COUNT.set(0);
    let result = run();
    MISTAKE.set(None);
    (result, COUNT.get())
}

/// The next operation: whether it is wrong, and in which of two ways.
fn next() -> Option<(Place, bool)> {
    let count = COUNT.get();
    COUNT.set(count + 1);
    let here = MISTAKE.get().filter(|mistake| mistake.at == count);
    here.map(|mistake| (mistake.place, mistake.second))
}

/// A number and its derivative along one direction.
#[derive(Clone, Copy, Debug)]
pub struct Mutant {
    /// The number.
    pub value: f64,
    /// Its derivative.
    pub derivative: f64,
}

/// A result: right, or with the wrong value or the wrong derivative.
fn either([value, derivative]: [f64; 2], values: [f64; 2], derivatives: [f64; 2]) -> Mutant {
    let mut out = Mutant { value, derivative };
    match next() {
        Some((Place::Value, second)) => out.value = values[usize::from(second)],
        Some((Place::Derivative, second)) => out.derivative = derivatives[usize::from(second)],
        None => {}
    }
    out
}

impl Add for Mutant {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        let (x, y, dx, dy) = (self.value, b.value, self.derivative, b.derivative);
        either([x + y, dx + dy], [x - y, x], [dx - dy, dx])
    }
}
impl Sub for Mutant {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        let (x, y, dx, dy) = (self.value, b.value, self.derivative, b.derivative);
        either([x - y, dx - dy], [x + y, x], [dx + dy, dx])
    }
}
impl Mul for Mutant {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let (x, y, dx, dy) = (self.value, b.value, self.derivative, b.derivative);
        either([x * y, dx * y + dy * x], [x, y], [dx * y, dy * x])
    }
}
impl Div for Mutant {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let (x, y, dx, dy) = (self.value, b.value, self.derivative, b.derivative);
        let q = x / y;
        either(
            [q, (dx - q * dy) / y],
            [x, x * y],
            [dx / y, (dx + q * dy) / y],
        )
    }
}
impl Neg for Mutant {
    type Output = Self;
    fn neg(self) -> Self {
        let (x, dx) = (self.value, self.derivative);
        either([-x, -dx], [x, 0.0], [dx, 0.0])
    }
}
impl AddAssign for Mutant {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}
impl SubAssign for Mutant {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}
impl MulAssign for Mutant {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

impl Tangent for Mutant {
    type Inner = f64;
    fn value(self) -> f64 {
        self.value
    }
    fn constant(value: f64) -> Self {
        // Zeros and ones stay as they are: a mistake in them is not planted.
        if value == 0.0 || value == 1.0 {
            return Mutant {
                value,
                derivative: 0.0,
            };
        }
        either([value, 0.0], [1.0, 2.0 * value], [0.0, 0.0])
    }
    fn chain(self, [f, derivative, ..]: [f64; 4]) -> Self {
        let dx = self.derivative;
        either(
            [f, derivative * dx],
            [self.value, derivative],
            [0.0, f * dx],
        )
    }
    fn pick(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

// A lone number is a shape of one.
impl Pack for Mutant {
    type Scalar = Self;
    type With<R: Clone> = R;
    fn remake<R: Clone>(&self, f: &mut impl FnMut(&Self) -> R) -> R {
        f(self)
    }
    fn each(&mut self, f: &mut impl FnMut(&mut Self)) {
        f(self);
    }
}
impl Fixed for Mutant {
    type Of<R: Scalar> = R;
    const LEN: usize = 1;
    fn load(from: &[Self]) -> Self {
        from[0]
    }
    fn store(self, to: &mut [Self]) {
        to[0] = self;
    }
    fn filled(scalar: Self) -> Self {
        scalar
    }
    fn name(_: usize) -> Field {
        Field::VALUE
    }
}

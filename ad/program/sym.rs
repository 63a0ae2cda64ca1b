//! A scalar that records the operations on it.
use super::graph::{Id, Node};
use super::in_progress::Symbol;
use crate::pack::leaf;
use crate::{Mask, Real, Scalar};
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// A number of a program that is being recorded: it stands for every `T` that it will be.
///
/// It is a [`Scalar`], so that a generic function can be called with shapes over it; see [`Program`](super::Program). A
/// symbol is valid only in the recording that created it. Its use in another one ends that one in an error; outside
/// recordings it has no effect.
#[derive(Clone, Copy, Debug)]
pub struct Sym<T> {
    pub(super) symbol: Symbol,
    number: PhantomData<fn() -> T>,
}

/// A symbol of either format: which one it is the recording knows. Functions of rows are compiled for it alone.
pub(crate) type Neutral = Sym<f64>;

/// Returns the same symbols as numbers of another type.
pub(super) fn retyped<T: Real, U: Real>(symbols: &[Sym<T>]) -> Vec<Sym<U>> {
    symbols.iter().map(|x| Sym::new(x.symbol)).collect()
}

/// A truth of a program that is being recorded.
#[derive(Clone, Copy, Debug)]
pub struct SymMask<T> {
    pub(super) symbol: Symbol,
    number: PhantomData<fn() -> T>,
}

impl<T: Real> Sym<T> {
    #[inline(always)]
    fn new(symbol: Symbol) -> Self {
        Sym {
            symbol,
            number: PhantomData,
        }
    }
    /// Returns the symbol of a node without operands.
    #[inline(always)]
    pub(super) fn leaf(node: Node) -> Self {
        Self::new(Symbol::leaf(node))
    }
    #[inline(always)]
    fn of_one(self, node: impl FnOnce(Id) -> Node) -> Self {
        Self::new(self.symbol.of_one(node))
    }
    #[inline(always)]
    fn of_two(self, other: Self, node: impl FnOnce(Id, Id) -> Node) -> Self {
        Self::new(self.symbol.of_two(other.symbol, node))
    }
    #[inline(always)]
    fn compared(self, other: Self, node: impl FnOnce(Id, Id) -> Node) -> SymMask<T> {
        SymMask::new(self.symbol.of_two(other.symbol, node))
    }
    /// Returns a symbol with the value of `value` and the sum of the derivatives of every symbol of the list times its
    /// number.
    pub(crate) fn with_derivatives(
        value: Self,
        derivatives: impl Iterator<Item = (Self, Self)>,
    ) -> Self {
        let along = derivatives.fold(Self::zero(), |sum, (x, share)| {
            sum + Self::new(Self::zero().symbol.with_share(x.symbol, share.symbol))
        });
        along.with_primal(value)
    }
}

leaf! { [T: Real] Sym<T> }

impl<T: Real> Add for Sym<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.of_two(other, Node::Add)
    }
}
impl<T: Real> Sub for Sym<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.of_two(other, Node::Sub)
    }
}
impl<T: Real> Mul for Sym<T> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.of_two(other, Node::Mul)
    }
}
impl<T: Real> Div for Sym<T> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.of_two(other, Node::Div)
    }
}
impl<T: Real> Neg for Sym<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.of_one(Node::Neg)
    }
}
impl<T: Real> AddAssign for Sym<T> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<T: Real> SubAssign for Sym<T> {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
impl<T: Real> MulAssign for Sym<T> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Real> SymMask<T> {
    #[inline(always)]
    fn new(symbol: Symbol) -> Self {
        SymMask {
            symbol,
            number: PhantomData,
        }
    }
    #[inline(always)]
    fn of_two(self, other: Self, node: impl FnOnce(Id, Id) -> Node) -> Self {
        Self::new(self.symbol.of_two(other.symbol, node))
    }
}
impl<T: Real> BitAnd for SymMask<T> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        self.of_two(other, Node::And)
    }
}
impl<T: Real> BitOr for SymMask<T> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        self.of_two(other, Node::Or)
    }
}
impl<T: Real> Not for SymMask<T> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self::new(self.symbol.of_one(Node::Not))
    }
}
impl<T: Real> Mask for SymMask<T> {
    /// Returns `true` if it is not known to be false.
    #[inline(always)]
    fn any(self) -> bool {
        self.symbol.hint(true)
    }
    /// Returns `true` if it is known to be true.
    #[inline(always)]
    fn all(self) -> bool {
        self.symbol.hint(false)
    }
}

impl<T: Real> Scalar for Sym<T> {
    type Mask = SymMask<T>;
    type Primal = Self;
    const RECORDS: bool = true;
    #[inline(always)]
    fn format() -> crate::scalar::Format {
        Symbol::format()
    }

    #[inline(always)]
    fn lit(x: f64) -> Self {
        Self::new(Symbol::constant(x))
    }
    #[inline(always)]
    fn rounding(factor: f64, power: i32) -> Self {
        Self::new(Symbol::rounding(factor, power))
    }
    #[inline(always)]
    fn largest() -> Self {
        Self::new(Symbol::largest())
    }
    #[inline(always)]
    fn largest_to(power: f64) -> Self {
        Self::new(Symbol::largest_to(power))
    }
    #[inline(always)]
    fn lowest() -> Self {
        Self::new(Symbol::lowest())
    }
    #[inline(always)]
    fn from_primal(x: Self) -> Self {
        x
    }
    #[inline(always)]
    fn primal(self) -> Self {
        Self::new(self.symbol.primal())
    }
    #[inline(always)]
    fn below(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Lt)
    }
    #[inline(always)]
    fn at_most(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Le)
    }
    #[inline(always)]
    fn equals(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Eq)
    }
    #[inline(always)]
    fn select(mask: SymMask<T>, yes: Self, no: Self) -> Self {
        Self::new(mask.symbol.of_three(yes.symbol, no.symbol, Node::Select))
    }
    #[inline(always)]
    fn over(self, divisor: Self) -> Self {
        self / divisor
    }
    #[inline(always)]
    fn root(self) -> Self {
        self.of_one(Node::Root)
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        (self.of_one(Node::Sin), self.of_one(Node::Cos))
    }
    #[inline(always)]
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        [
            (self.of_one(Node::SinHigh), self.of_one(Node::SinLow)),
            (self.of_one(Node::CosHigh), self.of_one(Node::CosLow)),
        ]
    }
    #[inline(always)]
    fn parts(self) -> (Self, Self) {
        let high = self.of_one(Node::High);
        (high, self - high)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        self.of_two(x, Node::Atan2)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        self.of_one(Node::Exp)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.of_one(Node::Ln)
    }
    #[inline(always)]
    fn binade(self) -> Self {
        self.of_one(Node::Binade)
    }
    #[inline(always)]
    fn may_be_nan(self) -> bool {
        !self.symbol.is_number()
    }
    // A product with one, of which derivatives are products with one, too.
    #[inline(always)]
    fn known(self, known: SymMask<T>, nan: Self) -> Self {
        self * Self::select(known, Self::one(), nan)
    }
    // Recorded as nodes of their own, not as choices.
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        self.of_two(other, Node::Min)
    }
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        self.of_two(other, Node::Max)
    }
    #[inline(always)]
    fn magnitude(self) -> Self {
        self.of_one(Node::Magnitude)
    }
    #[inline(always)]
    fn unsigned(self) -> Self {
        self.of_one(Node::Unsigned)
    }
    #[inline(always)]
    fn damp(self, share: Self) -> Self {
        Self::new(self.symbol.with_share(self.symbol, share.symbol))
    }
    #[inline(always)]
    fn with_primal(self, value: Self) -> Self {
        Self::new(self.symbol.with_primal(value.symbol))
    }
    #[inline(always)]
    fn canonical(self) -> Self {
        self.of_one(Node::Canonical)
    }
}

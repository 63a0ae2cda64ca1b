//! A scalar that records the operations on it.
use super::graph::Node;
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

/// A truth of a program that is being recorded.
#[derive(Clone, Copy, Debug)]
pub struct SymMask<T> {
    pub(super) symbol: Symbol,
    number: PhantomData<fn() -> T>,
}

impl<T: Real> Sym<T> {
    fn new(symbol: Symbol) -> Self {
        Sym {
            symbol,
            number: PhantomData,
        }
    }
    /// Returns the symbol of a node without operands.
    #[inline(never)]
    pub(super) fn leaf(node: Node) -> Self {
        Self::new(Symbol::made(T::FORMAT, [], |[]| node))
    }
    // Not inlined, nor the others: a recorded function is long, and is called once.
    #[inline(never)]
    fn of_one(self, node: impl FnOnce(u32) -> Node) -> Self {
        Self::new(Symbol::made(T::FORMAT, [self.symbol], |[x]| node(x)))
    }
    #[inline(never)]
    fn of_two(self, other: Self, node: impl FnOnce(u32, u32) -> Node) -> Self {
        let operands = [self.symbol, other.symbol];
        Self::new(Symbol::made(T::FORMAT, operands, |[a, b]| node(a, b)))
    }
    #[inline(never)]
    fn compared(self, other: Self, node: impl FnOnce(u32, u32) -> Node) -> SymMask<T> {
        let operands = [self.symbol, other.symbol];
        SymMask::new(Symbol::made(T::FORMAT, operands, |[a, b]| node(a, b)))
    }
    /// Returns a symbol with the value of `value` and the sum of the derivatives of every symbol of the list times its
    /// number.
    pub(crate) fn with_derivatives(
        value: Self,
        derivatives: impl Iterator<Item = (Self, Self)>,
    ) -> Self {
        let along = derivatives.fold(Self::zero(), |sum, (x, share)| {
            let operands = [Self::zero().symbol, x.symbol, share.symbol];
            sum + Self::new(Symbol::made(
                T::FORMAT,
                operands,
                |[value, derivative, share]| Node::Graft {
                    value,
                    derivative: Some(derivative),
                    share: Some(share),
                },
            ))
        });
        along.with_primal(value)
    }
}

leaf! { [T: Real] Sym<T> }

impl<T: Real> Add for Sym<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.of_two(other, Node::Add)
    }
}
impl<T: Real> Sub for Sym<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.of_two(other, Node::Sub)
    }
}
impl<T: Real> Mul for Sym<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.of_two(other, Node::Mul)
    }
}
impl<T: Real> Div for Sym<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        self.of_two(other, Node::Div)
    }
}
impl<T: Real> Neg for Sym<T> {
    type Output = Self;
    fn neg(self) -> Self {
        self.of_one(Node::Neg)
    }
}
impl<T: Real> AddAssign for Sym<T> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<T: Real> SubAssign for Sym<T> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}
impl<T: Real> MulAssign for Sym<T> {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Real> SymMask<T> {
    fn new(symbol: Symbol) -> Self {
        SymMask {
            symbol,
            number: PhantomData,
        }
    }
    #[inline(never)]
    fn of_two(self, other: Self, node: impl FnOnce(u32, u32) -> Node) -> Self {
        let operands = [self.symbol, other.symbol];
        Self::new(Symbol::made(T::FORMAT, operands, |[a, b]| node(a, b)))
    }
}
impl<T: Real> BitAnd for SymMask<T> {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        self.of_two(other, Node::And)
    }
}
impl<T: Real> BitOr for SymMask<T> {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        self.of_two(other, Node::Or)
    }
}
impl<T: Real> Not for SymMask<T> {
    type Output = Self;
    #[inline(never)]
    fn not(self) -> Self {
        Self::new(Symbol::made(T::FORMAT, [self.symbol], |[x]| Node::Not(x)))
    }
}
impl<T: Real> Mask for SymMask<T> {
    /// Returns `true` if it is not known to be false.
    fn any(self) -> bool {
        self.symbol.hint(true)
    }
    /// Returns `true` if it is known to be true.
    fn all(self) -> bool {
        self.symbol.hint(false)
    }
}

impl<T: Real> Scalar for Sym<T> {
    type Mask = SymMask<T>;
    type Primal = Self;
    const COMPENSATED: bool = T::COMPENSATED;
    const EPSILON: f64 = T::EPSILON;
    const PARALLEL: f64 = T::PARALLEL;
    const LARGEST: f64 = T::LARGEST;

    fn lit(x: f64) -> Self {
        Self::leaf(Node::Const(T::FORMAT.round(x).to_bits()))
    }
    fn from_primal(x: Self) -> Self {
        x
    }
    fn primal(self) -> Self {
        self.of_one(|value| Node::Graft {
            value,
            derivative: None,
            share: None,
        })
    }
    fn below(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Lt)
    }
    fn at_most(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Le)
    }
    fn equals(self, other: Self) -> SymMask<T> {
        self.compared(other, Node::Eq)
    }
    #[inline(never)]
    fn select(mask: SymMask<T>, yes: Self, no: Self) -> Self {
        let operands = [mask.symbol, yes.symbol, no.symbol];
        Self::new(Symbol::made(T::FORMAT, operands, |[mask, yes, no]| {
            Node::Select(mask, yes, no)
        }))
    }
    fn over(self, divisor: Self) -> Self {
        self / divisor
    }
    fn root(self) -> Self {
        self.of_one(Node::Root)
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.of_one(Node::Sin), self.of_one(Node::Cos))
    }
    fn sin_cos_parts(self) -> [(Self, Self); 2] {
        [
            (self.of_one(Node::SinHigh), self.of_one(Node::SinLow)),
            (self.of_one(Node::CosHigh), self.of_one(Node::CosLow)),
        ]
    }
    fn parts(self) -> (Self, Self) {
        let high = self.of_one(Node::High);
        (high, self - high)
    }
    fn atan2(self, x: Self) -> Self {
        self.of_two(x, Node::Atan2)
    }
    fn exp(self) -> Self {
        self.of_one(Node::Exp)
    }
    fn ln(self) -> Self {
        self.of_one(Node::Ln)
    }
    fn binade(self) -> Self {
        self.of_one(Node::Binade)
    }
    fn may_be_nan(self) -> bool {
        !self.symbol.is_number()
    }
    // A product with one, of which derivatives are products with one, too.
    fn known(self, known: SymMask<T>, nan: Self) -> Self {
        self * Self::select(known, Self::one(), nan)
    }
    // Recorded as nodes of their own, not as choices.
    fn least(self, other: Self) -> Self {
        self.of_two(other, Node::Min)
    }
    fn most(self, other: Self) -> Self {
        self.of_two(other, Node::Max)
    }
    fn magnitude(self) -> Self {
        self.of_one(Node::Magnitude)
    }
    fn unsigned(self) -> Self {
        self.of_one(Node::Unsigned)
    }
    fn damp(self, share: Self) -> Self {
        self.of_two(share, |x, share| Node::Graft {
            value: x,
            derivative: Some(x),
            share: Some(share),
        })
    }
    fn with_primal(self, value: Self) -> Self {
        self.of_two(value, |derivative, value| Node::Graft {
            value,
            derivative: Some(derivative),
            share: None,
        })
    }
    fn canonical(self) -> Self {
        self.of_one(Node::Canonical)
    }
}

//! The kinds of mistakes.

/// The kind of mistake of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A plausible mistake in a gradient by hand.
    ByHand,
    /// One step of the formula is another one.
    Formula,
    /// One rule of differentiation is broken on the way: what is inside is taken as constant, a term has the wrong
    /// sign.
    Rule,
    /// A derivative, or all, have the wrong sign.
    Sign,
    /// A derivative is zero.
    Dropped,
    /// A derivative, or all, are double or half.
    Factor,
    /// A derivative is off by one part in so many: the power of ten.
    Off(u8),
    /// Two derivatives are exchanged, or all are in another order.
    Exchanged,
    /// A derivative is that of the next number.
    Neighbour,
    /// A derivative has the number itself as a factor too many or too few.
    Power,
    /// The gradient is that of the square, the root, the logarithm or the exponential.
    Outer,
    /// Something is added to a derivative.
    Added,
    /// A derivative is off by a tenth in half of the domain.
    HalfDomain,
    /// A derivative is off by a tenth in a corner of the domain.
    Corner,
    /// The gradient is that of an input nearby.
    OtherPlace,
    /// Near a kink the gradient is that of the other side.
    OtherSide,
    /// At a kink, to the last digit, the gradient is no share of those of the sides.
    AtKink,
    /// At one input, to the last digit, a derivative is zero or has the wrong sign.
    OneInput,
    /// At one input, or at a kink, a derivative is not finite.
    NotFinite,
    /// The gradient has single precision.
    Single,
    /// The gradient is a difference with a fixed step.
    Difference,
    /// The rest of an earlier call is added.
    Stale,
}

impl Kind {
    /// A short name for tables.
    #[must_use]
    pub fn name(self) -> String {
        let name = match self {
            Kind::ByHand => "written by hand",
            Kind::Formula => "step of the formula",
            Kind::Rule => "rule of differentiation",
            Kind::Sign => "sign",
            Kind::Dropped => "derivative dropped",
            Kind::Factor => "double or half",
            Kind::Off(power) => return format!("off by 1e-{power}"),
            Kind::Exchanged => "exchanged",
            Kind::Neighbour => "next number's derivative",
            Kind::Power => "power of the number",
            Kind::Outer => "of the square, root, …",
            Kind::Added => "constant added",
            Kind::HalfDomain => "in half of the domain",
            Kind::Corner => "in a corner",
            Kind::OtherPlace => "at an input nearby",
            Kind::OtherSide => "other side of a kink",
            Kind::AtKink => "at a kink only",
            Kind::OneInput => "at one input only",
            Kind::NotFinite => "not finite at one input",
            Kind::Single => "single precision",
            Kind::Difference => "fixed differences",
            Kind::Stale => "left from before",
        };
        name.to_owned()
    }
}

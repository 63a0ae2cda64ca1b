//! The properties that operations can break.
use std::fmt;

/// How an operation broke a declared property.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Property {
    /// No input inside of its domain was found.
    Domain,
    /// A valid input was refused.
    Accepted,
    /// A value or a derivative is infinite or not a number.
    Finite,
    /// The value is within the range of its row.
    Range,
    /// Identical shapes score 1 (or 0 where they count as empty) with derivatives of zero.
    Identical,
    /// Shapes apart score 0 with derivatives of zero.
    Apart,
    /// Exchanging the shapes changes nothing.
    Symmetric,
    /// All forms give the same bits.
    SameBits,
    /// Duals have the value of plain numbers.
    Duals,
    /// Rows of several verbs say the same; which sentence of [`identities`](crate::kernels::identities).
    Identity(&'static str),
    /// A NaN in a number of an input is NaN in every number of the result, which is as it was without one.
    Nan,
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Property::Domain => "no input inside the domain was drawn",
            Property::Accepted => "a valid input is refused",
            Property::Finite => "a number is not finite",
            Property::Range => "the value is out of range",
            Property::Identical => "identical shapes do not score as such",
            Property::Apart => "shapes apart do not score zero with derivatives of zero",
            Property::Symmetric => "exchanging the shapes changes the value",
            Property::SameBits => "two forms give different bits",
            Property::Duals => "duals have another value",
            Property::Identity(sentence) => {
                return write!(f, "not so: {sentence}");
            }
            Property::Nan => "a NaN is lost, or a number became one",
        })
    }
}

/// A broken property, and the place among many inputs.
pub(super) struct Finding {
    pub(super) property: Property,
    pub(super) at: usize,
}

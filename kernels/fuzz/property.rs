//! The properties that operations can break.
use std::fmt;

/// A declared property that an operation breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Property {
    /// No input inside of its domain was found.
    Domain,
    /// A valid input was refused.
    Accepted,
    /// A value or a derivative is infinite or NaN.
    Finite,
    /// The value is within the range of its row.
    Range,
    /// Identical shapes score 1 (or 0 where they count as empty) with derivatives of zero.
    Identical,
    /// Shapes apart score 0 with derivatives of zero.
    Apart,
    /// Exchanging the shapes changes nothing.
    Symmetric,
    /// All forms give equal bits.
    SameBits,
    /// Duals have the values of plain numbers.
    Duals,
    /// An identity between rows of several verbs holds; its sentence in [`identities`](crate::kernels::identities).
    Identity(&'static str),
    /// A NaN in an input is NaN in every number of the result, and a guarded result without NaN keeps its bits.
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

/// A broken property, and the index of the input.
pub(super) struct Finding {
    pub(super) property: Property,
    pub(super) at: usize,
}

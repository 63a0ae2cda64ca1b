//! Bounds of a shape's numbers, from its rules.
use crate::Rule;
use crate::kernels::row::item::Leaf;

/// Which values a number of a shape may have, beside that it is finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// Any.
    Any,
    /// None below zero.
    NotNegative,
    /// All above zero.
    Positive,
    /// None above the number in this place of the same shape.
    AtMost(usize),
    /// None below the number in this place of the same shape.
    AtLeast(usize),
    /// A part of a direction: not all numbers of which are zero.
    Direction,
    /// A whole number.
    Whole,
}

/// Returns the bounds of every number of a shape, as far as its rules say.
pub(crate) fn bounds<T>(leaf: &Leaf<T>) -> Vec<Bound> {
    let mut bounds = vec![Bound::Any; leaf.fields];
    for rule in Rule::flat(leaf.rules) {
        match rule {
            Rule::NotNegative { first, count } => {
                bounds[first..first + count].fill(Bound::NotNegative)
            }
            Rule::Positive { first, count } => bounds[first..first + count].fill(Bound::Positive),
            Rule::Ordered { low, high, count } => {
                for i in 0..count {
                    bounds[low + i] = Bound::AtMost(high + i);
                    bounds[high + i] = Bound::AtLeast(low + i);
                }
            }
            Rule::NonZero { first, count } => bounds[first..first + count].fill(Bound::Direction),
            // Points that differ are not both zero.
            Rule::Distinct {
                first,
                other,
                count,
            } => {
                bounds[first..first + count].fill(Bound::Direction);
                bounds[other..other + count].fill(Bound::Direction);
            }
            Rule::ConvexQuad { .. } | Rule::Parts { .. } => (),
        }
    }
    bounds[leaf.fields - leaf.codes..].fill(Bound::Whole);
    bounds
}

//! Rules of a shape's numbers as data.

/// A rule of the numbers of a shape, which have the places of [`Fixed::load`](crate::Fixed::load), from zero.
///
/// ```
/// use geograd::{Obb2, Obb3, Rule, Validate};
/// assert_eq!(Obb2::<f64>::RULES.last(), Some(&Rule::NotNegative { first: 2, count: 2 }));
/// // Those of a part, its rotation, come before its own.
/// let rules = Rule::flat(Obb3::<f64>::RULES);
/// assert_eq!(rules, [Rule::NonZero { first: 6, count: 4 }, Rule::NotNegative { first: 3, count: 3 }]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Rule {
    /// Numbers that are not below zero.
    NotNegative {
        /// The place of the first number.
        first: usize,
        /// How many there are.
        count: usize,
    },
    /// Numbers above zero.
    Positive {
        /// The place of the first number.
        first: usize,
        /// How many there are.
        count: usize,
    },
    /// Numbers none of which is above the same one of others.
    Ordered {
        /// The place of the first lower number.
        low: usize,
        /// The place of the first upper number.
        high: usize,
        /// How many there are of either.
        count: usize,
    },
    /// Numbers that are not all zero: a vector other than zero.
    NonZero {
        /// The place of the first number.
        first: usize,
        /// How many there are.
        count: usize,
    },
    /// Numbers that are not all equal to others: two points at different places.
    Distinct {
        /// The place of the first number of one point.
        first: usize,
        /// The place of the first number of the other point.
        other: usize,
        /// How many numbers a point has.
        count: usize,
    },
    /// Corners of a convex quadrilateral in either order: eight numbers.
    ConvexQuad {
        /// The place of the first number.
        first: usize,
    },
    /// Rules of parts of the same shape that lie one after another.
    Parts {
        /// The place of the first number of the first part.
        first: usize,
        /// How many parts there are.
        count: usize,
        /// Numbers of a part.
        width: usize,
        /// The rules of a part.
        rules: &'static [Rule],
    },
}

impl Rule {
    /// Returns the rules with those of parts, of parts of parts and so on at the places of the whole shape; in the
    /// order given, without [`Rule::Parts`].
    #[must_use]
    pub fn flat(rules: &[Rule]) -> Vec<Rule> {
        let mut all = Vec::new();
        for &rule in rules {
            match rule {
                Rule::Parts {
                    first,
                    count,
                    width,
                    rules,
                } => {
                    let own = Rule::flat(rules);
                    let part = |i: usize| own.iter().map(move |rule| rule.after(first + i * width));
                    all.extend((0..count).flat_map(part));
                }
                _ => all.push(rule),
            }
        }
        all
    }

    /// Returns the same rule of numbers that follow `before` others.
    fn after(self, before: usize) -> Self {
        match self {
            Rule::NotNegative { first, count } => Rule::NotNegative {
                first: before + first,
                count,
            },
            Rule::Positive { first, count } => Rule::Positive {
                first: before + first,
                count,
            },
            Rule::Ordered { low, high, count } => Rule::Ordered {
                low: before + low,
                high: before + high,
                count,
            },
            Rule::NonZero { first, count } => Rule::NonZero {
                first: before + first,
                count,
            },
            Rule::Distinct {
                first,
                other,
                count,
            } => Rule::Distinct {
                first: before + first,
                other: before + other,
                count,
            },
            Rule::ConvexQuad { first } => Rule::ConvexQuad {
                first: before + first,
            },
            Rule::Parts {
                first,
                count,
                width,
                rules,
            } => Rule::Parts {
                first: before + first,
                count,
                width,
                rules,
            },
        }
    }
}

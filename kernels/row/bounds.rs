//! Rules of a shape's numbers, found by asking what it refuses.
use crate::Real;
use crate::ad::declared::Kind;
use crate::error::Flaw;
use crate::kernels::row::item::Leaf;

/// A rule of a shape's numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// A size is not negative.
    NotNegative(usize),
    /// A size is positive.
    Positive(usize),
    /// A lower bound is not above its upper bound.
    Ordered(usize, usize),
    /// One of them is not zero.
    Some(Vec<usize>),
    /// Four corners of a parallelogram: convex, but for rounding.
    Parallelogram,
}

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

/// Returns the bounds of every number of a shape, as far as its refusals tell.
pub(crate) fn bounds<T: Real>(leaf: &Leaf<T>, kinds: &[Kind]) -> Vec<Bound> {
    let mut bounds = vec![Bound::Any; leaf.fields];
    for rule in rules_of(leaf, kinds, false) {
        match rule {
            Rule::NotNegative(i) => bounds[i] = Bound::NotNegative,
            Rule::Positive(i) => bounds[i] = Bound::Positive,
            Rule::Ordered(i, j) => {
                (bounds[i], bounds[j]) = (Bound::AtMost(j), Bound::AtLeast(i));
            }
            Rule::Some(any) => any.iter().for_each(|&i| bounds[i] = Bound::Direction),
            Rule::Parallelogram => (),
        }
    }
    bounds[leaf.fields - leaf.codes..].fill(Bound::Whole);
    bounds
}

/// Returns the rules of a shape with numbers of these kinds, as far as its refusals tell; none of a shape with codes.
pub(crate) fn rules_of<T: Real>(leaf: &Leaf<T>, kinds: &[Kind], is_convex: bool) -> Vec<Rule> {
    let (n, mut rules) = (leaf.fields, Vec::new());
    if leaf.codes > 0 {
        return rules;
    }
    let (zero, one) = (T::zero(), T::one());
    let flaw = |ones: &[usize], sign: T| {
        let mut x = vec![zero; n];
        ones.iter().for_each(|&i| x[i] = sign);
        (leaf.check)(&x).err()
    };
    // A direction: all numbers that alone make it valid.
    if let Some(Flaw::Zero(_) | Flaw::Broken(..)) = flaw(&[], one) {
        let mends = |i: &usize| flaw(&[*i], one) != flaw(&[], one);
        rules.push(Rule::Some((0..n).filter(mends).collect()));
    }
    let base: Vec<usize> = rules
        .iter()
        .flat_map(|rule| match rule {
            Rule::Some(any) => any[..1].to_vec(),
            _ => Vec::new(),
        })
        .collect();
    let with = |more: &[usize]| [&base[..], more].concat();
    for i in 0..n {
        let mut x = vec![one; n];
        x[i] = -one;
        if let Err(Flaw::Negative(_) | Flaw::NotPositive(_)) = (leaf.check)(&x) {
            x[i] = zero;
            rules.push(match (leaf.check)(&x) {
                Err(Flaw::NotPositive(_)) => Rule::Positive(i),
                _ => Rule::NotNegative(i),
            });
        } else if let Some(Flaw::Inverted(..)) = flaw(&with(&[i]), one) {
            let upper = (0..n).find(|&j| j != i && flaw(&with(&[i, j]), one).is_none());
            rules.extend(upper.map(|j| Rule::Ordered(i, j)));
        }
    }
    if is_convex && n == 8 && kinds.iter().all(|kind| matches!(kind, Kind::X | Kind::Y)) {
        rules.push(Rule::Parallelogram);
    }
    rules
}

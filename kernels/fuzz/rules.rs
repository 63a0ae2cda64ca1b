//! Rules of a shape's numbers, found by asking what it refuses, and how numbers are made to keep to them.
use crate::ad::check::symmetry::Kind;
use crate::error::Flaw;
use crate::kernels::item::Leaf;
use crate::kernels::real::Real;

/// A rule of a shape's numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Rule {
    /// A size is not negative.
    NotNegative(usize),
    /// A size is positive.
    Positive(usize),
    /// A lower bound is not above its upper bound.
    Ordered(usize, usize),
    /// One of them is not zero.
    Some(Vec<usize>),
    /// The cosine and the sine of an angle.
    Unit(usize, usize),
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
    /// Those above zero.
    Positive,
    /// None above the number in this place of the same shape.
    AtMost(usize),
    /// None below the number in this place of the same shape.
    AtLeast(usize),
    /// A part of a direction: not all numbers of which are zero.
    Direction,
    /// The cosine or the sine of an angle, the other of which is beside it.
    Unit,
    /// A whole number.
    Whole,
}

/// The bounds of every number of a shape, as far as its refusals tell.
pub(crate) fn bounds<T: Real>(leaf: &Leaf<T>, kinds: &[Kind]) -> Vec<Bound> {
    let mut bounds = vec![Bound::Any; leaf.fields];
    for rule in Rules::of(leaf, kinds, false).rules {
        match rule {
            Rule::NotNegative(i) => bounds[i] = Bound::NotNegative,
            Rule::Positive(i) => bounds[i] = Bound::Positive,
            Rule::Ordered(i, j) => {
                (bounds[i], bounds[j]) = (Bound::AtMost(j), Bound::AtLeast(i));
            }
            Rule::Some(any) => any.iter().for_each(|&i| bounds[i] = Bound::Direction),
            Rule::Unit(i, j) => (bounds[i], bounds[j]) = (Bound::Unit, Bound::Unit),
            Rule::Parallelogram => (),
        }
    }
    bounds[leaf.fields - leaf.codes..].fill(Bound::Whole);
    bounds
}

/// The rules of one shape.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    rules: Vec<Rule>,
    /// `true` if they are all rules that there are.
    pub known: bool,
}

impl Rules {
    /// The rules of a shape with numbers of these kinds.
    pub fn of<T: Real>(leaf: &Leaf<T>, kinds: &[Kind], is_convex: bool) -> Self {
        let n = leaf.fields;
        let mut rules = Vec::new();
        if leaf.codes > 0 {
            return Rules {
                rules,
                known: false,
            };
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
            } else if let Some(Flaw::Inverted(_)) = flaw(&with(&[i]), one) {
                let upper = (0..n).find(|&j| j != i && flaw(&with(&[i, j]), one).is_none());
                rules.extend(upper.map(|j| Rule::Ordered(i, j)));
            }
        }
        for i in 0..n.saturating_sub(1) {
            let ends = |i: usize, word: &str| (leaf.name)(i).as_str().ends_with(word);
            if ends(i, "cos") && ends(i + 1, "sin") {
                rules.push(Rule::Unit(i, i + 1));
            }
        }
        if is_convex && n == 8 && kinds.iter().all(|kind| matches!(kind, Kind::X | Kind::Y)) {
            rules.push(Rule::Parallelogram);
        }
        let mut rules = Rules { rules, known: true };
        // Numbers that nobody would choose show whether something else is asked.
        rules.known = (0..n as u32 + 8).all(|k| {
            let number = |i: usize| T::lit(f64::from((i as u32 * 7 + k * 5) % 11) - 5.0);
            let mut x: Vec<T> = (0..n).map(number).collect();
            rules.mend(&mut x);
            (leaf.check)(&x).is_ok()
        });
        rules
    }

    /// Makes numbers keep to the rules.
    #[inline]
    pub fn mend<T: Real>(&self, x: &mut [T]) {
        for rule in &self.rules {
            match *rule {
                Rule::NotNegative(i) => x[i] = x[i].unsigned(),
                Rule::Positive(i) => {
                    x[i] = x[i].unsigned();
                    if x[i] == T::zero() {
                        x[i] = T::one();
                    }
                }
                Rule::Ordered(i, j) => {
                    if x[i] > x[j] {
                        x.swap(i, j);
                    }
                }
                Rule::Some(ref any) => {
                    if any.iter().all(|&i| x[i] == T::zero()) {
                        x[any[0]] = T::one();
                    }
                }
                Rule::Unit(i, j) => {
                    let (sin, cos) = x[i].sin_cos();
                    (x[i], x[j]) = (cos, sin);
                }
                Rule::Parallelogram => {
                    // Sums of three numbers must be finite.
                    let quarter = T::lit(0.25);
                    for k in 0..2 {
                        let [p, u, v] = [0, 2, 4].map(|i| x[i + k] * quarter);
                        [x[k], x[2 + k], x[4 + k], x[6 + k]] = [p, p + u, p + u + v, p + v];
                    }
                }
            }
        }
    }

    /// The lengths of its sides; none for what is no box.
    pub fn sides<T: Real>(&self, x: &[T]) -> Vec<f64> {
        let at = |i: usize| x[i].widen();
        let size = |x: f64| x.abs();
        let mut sides = Vec::new();
        for rule in &self.rules {
            match *rule {
                Rule::NotNegative(i) | Rule::Positive(i) => sides.push(size(at(i))),
                Rule::Ordered(i, j) => sides.push(size(at(j) - at(i))),
                Rule::Parallelogram => {
                    let corner = |i: usize| [at(2 * i), at(2 * i + 1)];
                    let [p, q, r, s] = [0, 1, 2, 3].map(corner);
                    let length = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
                    let area = (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
                    // The height of a flat one is far shorter than its sides.
                    let longest = length(p, q)
                        .max(length(p, s))
                        .max(length(p, r))
                        .max(length(q, s));
                    sides.extend([area.abs() / longest, longest]);
                }
                _ => (),
            }
        }
        sides
    }
}

//! How numbers of a shape are made to keep to its rules.
use crate::kernels::row::item::Leaf;
use crate::{Real, Rule};

/// The rules of one shape.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    rules: Vec<Rule>,
    /// `true` if they are all rules that there are.
    pub known: bool,
}

impl Rules {
    /// Returns the rules of a shape.
    pub fn of<T: Real>(leaf: &Leaf<T>) -> Self {
        let mut rules = Rules {
            rules: Rule::flat(leaf.rules),
            known: leaf.codes == 0,
        };
        let n = leaf.fields;
        // Arbitrary numbers, and equal ones, show whether the shape has other rules.
        let keeps = |number: &dyn Fn(usize) -> f64| {
            let mut x: Vec<T> = (0..n).map(|i| T::lit(number(i))).collect();
            rules.mend(&mut x);
            (leaf.check)(&x).is_ok()
        };
        let arbitrary = |k: u32| keeps(&|i| f64::from((i as u32 * 7 + k * 5) % 11) - 5.0);
        rules.known = rules.known && (0..n as u32 + 8).all(arbitrary) && keeps(&|_| 1.0);
        rules
    }

    /// Makes numbers keep to the rules.
    #[inline]
    pub fn mend<T: Real>(&self, x: &mut [T]) {
        for rule in &self.rules {
            match *rule {
                Rule::NotNegative { first, count } => {
                    x[first..first + count]
                        .iter_mut()
                        .for_each(|x| *x = x.unsigned());
                }
                Rule::Positive { first, count } => {
                    for x in &mut x[first..first + count] {
                        *x = x.unsigned();
                        if *x == T::zero() {
                            *x = T::one();
                        }
                    }
                }
                Rule::Ordered { low, high, count } => {
                    for i in 0..count {
                        if x[low + i] > x[high + i] {
                            x.swap(low + i, high + i);
                        }
                    }
                }
                Rule::NonZero { first, count } => {
                    if x[first..first + count].iter().all(|&x| x == T::zero()) {
                        x[first] = T::one();
                    }
                }
                // Others that are equal are left to the validator.
                Rule::Distinct {
                    first,
                    other,
                    count,
                } => {
                    if (0..count).all(|i| x[first + i] == T::zero() && x[other + i] == T::zero()) {
                        x[first.min(other)] = T::one();
                    }
                }
                // A parallelogram. Sums of three numbers must be finite.
                Rule::ConvexQuad { first } => {
                    let quarter = T::lit(0.25);
                    for k in first..first + 2 {
                        let [p, u, v] = [0, 2, 4].map(|i| x[i + k] * quarter);
                        [x[k], x[2 + k], x[4 + k], x[6 + k]] = [p, p + u, p + u + v, p + v];
                    }
                }
                Rule::Parts { .. } => (),
            }
        }
    }

    /// Returns the lengths of its sides; none for what is no box.
    pub fn sides<T: Real>(&self, x: &[T]) -> Vec<f64> {
        let at = |i: usize| x[i].widen();
        let size = |x: f64| x.abs();
        let mut sides = Vec::new();
        for rule in &self.rules {
            match *rule {
                Rule::NotNegative { first, count } | Rule::Positive { first, count } => {
                    sides.extend((first..first + count).map(|i| size(at(i))));
                }
                Rule::Ordered { low, high, count } => {
                    sides.extend((0..count).map(|i| size(at(high + i) - at(low + i))));
                }
                Rule::ConvexQuad { first } => {
                    let corner = |i: usize| [at(first + 2 * i), at(first + 2 * i + 1)];
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

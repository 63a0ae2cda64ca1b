//! Rules of shapes as data are those that their validators show.
use geograd::error::Error;
use geograd::kernels::dynamic::{Bound, Layout};
use geograd::{Flaw, Rule};
use geograd_tests::list;

/// A rule of certain numbers.
#[derive(Debug, PartialEq)]
enum Shown {
    NotNegative(usize),
    Positive(usize),
    Ordered(usize, usize),
    NonZero(Vec<usize>),
    Distinct(Vec<usize>),
}

impl Shown {
    fn is_of_all(&self) -> bool {
        matches!(self, Shown::NonZero(_) | Shown::Distinct(_))
    }
}

/// Returns the rules that a validator shows by what it refuses: of all numbers together, then of single ones.
fn probed(layout: &Layout<f64>) -> Vec<Shown> {
    let (n, mut rules) = (layout.fields(), Vec::new());
    let check = |x: &[f64]| match layout.check(x) {
        Ok(()) => None,
        Err(Error::Invalid { flaw, .. }) => Some(flaw),
        Err(error) => panic!("{error}"),
    };
    let flaw = |ones: &[usize]| {
        let mut x = vec![0.0; n];
        ones.iter().for_each(|&i| x[i] = 1.0);
        check(&x)
    };
    // All numbers that alone make zeros valid.
    let mut base = Vec::new();
    if let Some(Flaw::Zero(_) | Flaw::Broken(..)) = flaw(&[]) {
        let mends = |i: &usize| flaw(&[*i]) != flaw(&[]);
        let all: Vec<usize> = (0..n).filter(mends).collect();
        base.push(all[0]);
        rules.push(match check(&vec![1.0; n]) {
            Some(Flaw::Broken(..)) => Shown::Distinct(all),
            _ => Shown::NonZero(all),
        });
    }
    let with = |more: &[usize]| [&base[..], more].concat();
    for i in 0..n {
        let mut x = vec![1.0; n];
        x[i] = -1.0;
        if let Some(Flaw::Negative(_) | Flaw::NotPositive(_)) = check(&x) {
            x[i] = 0.0;
            rules.push(match check(&x) {
                Some(Flaw::NotPositive(_)) => Shown::Positive(i),
                _ => Shown::NotNegative(i),
            });
        } else if let Some(Flaw::Inverted(..)) = flaw(&with(&[i])) {
            let upper = (0..n).find(|&j| j != i && flaw(&with(&[i, j])).is_none());
            rules.extend(upper.map(|j| Shown::Ordered(i, j)));
        }
    }
    rules
}

/// Returns the rules of certain numbers: of all numbers together, then of single ones in their order.
fn declared(rules: &[Rule]) -> Vec<Shown> {
    let mut all: Vec<Shown> = Vec::new();
    for rule in Rule::flat(rules) {
        match rule {
            Rule::NotNegative { first, count } => {
                all.extend((first..first + count).map(Shown::NotNegative));
            }
            Rule::Positive { first, count } => {
                all.extend((first..first + count).map(Shown::Positive));
            }
            Rule::Ordered { low, high, count } => {
                all.extend((0..count).map(|i| Shown::Ordered(low + i, high + i)));
            }
            Rule::NonZero { first, count } => {
                all.push(Shown::NonZero((first..first + count).collect()));
            }
            Rule::Distinct {
                first,
                other,
                count,
            } => {
                let mut both: Vec<usize> =
                    (0..count).flat_map(|i| [first + i, other + i]).collect();
                both.sort_unstable();
                all.push(Shown::Distinct(both));
            }
            other => panic!("{other:?}"),
        }
    }
    all.sort_by_key(|rule| !rule.is_of_all());
    all
}

/// Returns the bounds of numbers with these rules.
fn bounds(fields: usize, rules: &[Shown]) -> Vec<Bound> {
    let mut bounds = vec![Bound::Any; fields];
    for rule in rules {
        match rule {
            Shown::NotNegative(i) => bounds[*i] = Bound::NotNegative,
            Shown::Positive(i) => bounds[*i] = Bound::Positive,
            Shown::Ordered(i, j) => {
                (bounds[*i], bounds[*j]) = (Bound::AtMost(*j), Bound::AtLeast(*i));
            }
            Shown::NonZero(all) | Shown::Distinct(all) => {
                all.iter().for_each(|&i| bounds[i] = Bound::Direction);
            }
        }
    }
    bounds
}

#[test]
fn validators_keep_to_the_rules_of_every_shape() {
    let mut ruled = 0;
    for row in list::rows() {
        let arguments = row.operation.arguments();
        for (layout, argument) in row.operation.layouts::<f64>().iter().zip(arguments) {
            // Numbers of a shape with codes mean something for some codes only.
            if layout.codes() > 0 {
                assert!(layout.rules().is_empty(), "{}", layout.name());
                continue;
            }
            let rules = probed(layout);
            assert_eq!(declared(layout.rules()), rules, "{}", layout.name());
            let shown: Vec<Bound> = argument.shape.fields.iter().map(|x| x.bound).collect();
            assert_eq!(shown, bounds(layout.fields(), &rules), "{}", layout.name());
            ruled += usize::from(!rules.is_empty());
        }
    }
    assert!(ruled > 100, "{ruled} arguments have rules");
}

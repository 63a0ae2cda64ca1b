//! A sample of the corpus: everyday functions whose right gradients are accepted and planted faults refused. All of
//! it is `cargo run --release -p geograd-tests --example corpus`.
use geograd::Jet;
use geograd_tests::corpus::FIELDS;
use geograd_tests::corpus::checkers::{Checker, Geograd, Task};
use geograd_tests::corpus::faults::faults;
use geograd_tests::corpus::function::Function;
use geograd_tests::corpus::inputs::Inputs;
use geograd_tests::corpus::kind::Kind;
use geograd_tests::corpus::measure::right;
use geograd_tests::corpus::mutant::{Mutant, mistaken};
use geograd_tests::corpus::record::{GEOGRAD, refused};
use std::collections::BTreeMap;

const SEED: u64 = 11;

fn functions() -> impl Iterator<Item = &'static Function> {
    FIELDS.iter().flat_map(|(_, functions)| functions.iter())
}
fn close(a: f64, b: f64, unit: f64) -> bool {
    (a - b).abs() <= 1e-10 * unit.max(f64::MIN_POSITIVE)
}

#[test]
fn gradients_by_hand_are_those_of_duals() {
    let mut count = 0;
    for function in functions() {
        let inputs = Inputs::new(function, 100, SEED);
        for x in &inputs.points {
            let within = |(x, [low, high]): (&f64, &[f64; 2])| low <= x && x <= high;
            assert!(
                x.iter().zip(function.domain).all(within),
                "{} {x:?}",
                function.name
            );
            let by_hand = (function.gradient)(x);
            assert_eq!(by_hand.len(), x.len(), "{}", function.name);
            for (i, &own) in by_hand.iter().enumerate() {
                let jet = |(k, &value): (usize, &f64)| Jet {
                    value,
                    derivative: [f64::from(k == i)],
                };
                let jets: Vec<_> = x.iter().enumerate().map(jet).collect();
                let jet = (function.dual)(&jets);
                assert_eq!(jet.value, (function.value)(x), "{}", function.name);
                let tie = function.kinks.contains(&x.as_slice());
                assert!(
                    // At a tie of three or more there are many ways to share.
                    tie || close(own, jet.derivative[0], inputs.usual[i]),
                    "{} at {x:?}, derivative {i}: {} by hand, {} by duals",
                    function.name,
                    own,
                    jet.derivative[0]
                );
            }
            count += 1;
        }
        // Every number matters somewhere.
        assert!(
            inputs
                .usual
                .iter()
                .all(|&size| size > 0.0 && size.is_finite()),
            "{}",
            function.name
        );
    }
    assert!(count > 6000);
}

#[test]
fn without_a_mistake_a_mutant_is_right() {
    for function in functions() {
        for x in &Inputs::new(function, 5, SEED).points {
            let mutants: Vec<Mutant> = x
                .iter()
                .map(|&value| Mutant {
                    value,
                    derivative: 1.0,
                })
                .collect();
            let (g, _) = mistaken(None, || (function.gradient_mutant)(&mutants));
            let g: Vec<f64> = g.iter().map(|g| g.value).collect();
            assert_eq!(g, (function.gradient)(x), "{}", function.name);
            let jets: Vec<_> = x
                .iter()
                .map(|&value| Jet {
                    value,
                    derivative: [1.0],
                })
                .collect();
            let (mutant, _) = mistaken(None, || (function.value_mutant)(&mutants));
            let jet = (function.dual)(&jets);
            assert_eq!(mutant.value, jet.value, "{}", function.name);
            let size = jet.derivative[0].abs().max(1.0);
            assert!(
                (mutant.derivative - jet.derivative[0]).abs() <= 1e-9 * size,
                "{}",
                function.name
            );
        }
    }
}

#[test]
fn right_ones_are_accepted() {
    let mut count = 0;
    for function in functions() {
        let inputs = Inputs::new(function, 3, SEED);
        for (what, gradient) in right(function) {
            let error = inputs.error(&gradient);
            assert!(error <= 1e-10, "{}, {what}: {error}", function.name);
            let task = Task::new(function, &inputs.points, &gradient, SEED);
            let accepted = Geograd { generic: true }.accepts(&task);
            let known = refused(GEOGRAD, function.name);
            assert!(accepted || known, "{}, {what}", function.name);
            count += usize::from(accepted);
        }
    }
    assert!(count > 195, "{count}");
}

#[test]
fn a_few_faults_of_every_kind_are_refused() {
    // So many faults of every kind, each of another function.
    const EACH: usize = 4;
    let mut asked = BTreeMap::new();
    for (k, function) in functions().enumerate() {
        let inputs = Inputs::new(function, 6, SEED);
        let faults = faults(function, &inputs);
        let mut kinds = std::collections::BTreeSet::new();
        // Begins elsewhere in every function, so that all parts of the list have their turn.
        let order = (0..faults.len()).map(|i| &faults[(i * 7 + k * 13) % faults.len()]);
        for fault in order {
            let count = asked.entry(fault.kind).or_insert(0);
            if *count == EACH || !kinds.insert(fault.kind) {
                continue;
            }
            // A gradient that is wrong at one input and right at its neighbours in the last digit is accepted; the
            // rates of the corpus count it.
            let error = inputs.error(&fault.gradient());
            if inputs.unsteady(&fault.gradient()) || error < 1e-9 {
                continue; // Or changes nothing.
            }
            // Differences alone, now and then, where they can tell.
            let generic = *count % 2 == 0 || error < 1e-6;
            let gradient = fault.gradient();
            let task = Task::new(function, &inputs.points, &gradient, SEED);
            let accepted = Geograd { generic }.accepts(&task);
            assert!(
                !accepted,
                "{}: {:?}, {}",
                function.name, fault.kind, fault.what
            );
            *count += 1;
        }
    }
    let never = |kind: &Kind| matches!(kind, Kind::AtKink | Kind::OneInput);
    for (kind, count) in &asked {
        assert!(*count > 0 || never(kind), "{kind:?} was never refused");
    }
    assert!(asked.len() >= 24, "{asked:?}");
}

#[test]
fn what_changes_nothing_is_no_fault() {
    for function in functions() {
        let inputs = Inputs::new(function, 4, SEED);
        assert_eq!(inputs.error(&function.gradient), 0.0, "{}", function.name);
        let reordered = |x: &[f64]| -> Vec<f64> {
            let g = (function.gradient)(x);
            g.iter().map(|g| (g * 3.0) / 3.0).collect()
        };
        assert!(inputs.error(&reordered) <= geograd_tests::corpus::inputs::ROUNDING);
        let off = |x: &[f64]| -> Vec<f64> {
            let mut g = (function.gradient)(x);
            g[0] *= 1.0 + 1e-9;
            g
        };
        let error = inputs.error(&off);
        assert!((1e-10..1e-8).contains(&error), "{}: {error}", function.name);
    }
}

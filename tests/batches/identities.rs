//! Identities between verbs, on grids of few numbers.
use geograd::kernels::identities;
use geograd_tests::list;

/// Inputs of every identity in either format; the report takes many more.
const COUNT: u64 = 256;

#[test]
fn every_identity_holds() {
    let sampled = list::sample(list::rows(), &[]);
    let is_sampled = |name: &str| sampled.iter().any(|row| row.name() == name);
    let mut broken = Vec::new();
    let mut asked = 0;
    for identity in identities::all().filter(|identity| is_sampled(identity.row())) {
        for fuzzed in [
            identity.fuzz::<f64>(COUNT, 1),
            identity.fuzz::<f32>(COUNT, 1),
        ] {
            let is_whole = fuzzed.broken.is_some() || fuzzed.inputs == COUNT;
            assert!(is_whole, "{fuzzed}");
            broken.extend(fuzzed.broken.is_some().then(|| fuzzed.to_string()));
            asked += 1;
        }
    }
    eprintln!("{asked} identities");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

//! Edges along each other are cut here by the rules of i_overlay: beside those of i_overlay itself.
use super::boolean::OPERATIONS;
use super::cases::at;
use super::scanline::Ring;
use geograd::boolean::is_cut_alike;
use geograd::polygon::Fill;
use geograd_tests::Dice;

/// Rings on a small lattice, turned as a whole: edges on one line of it lie along each other but for rounding.
fn turned(dice: &mut Dice) -> [Vec<Ring>; 2] {
    let (sin, cos) = dice.within(0.0, 6.3).sin_cos();
    let mut rings = |count: usize| -> Vec<Ring> {
        let corner = |dice: &mut Dice| {
            let (x, y) = (dice.below(5) as f64, dice.below(5) as f64);
            at(cos * x - sin * y, sin * x + cos * y)
        };
        let ring = |dice: &mut Dice| (0..3 + dice.below(4)).map(|_| corner(dice)).collect();
        (0..count).map(|_| ring(dice)).collect()
    };
    [rings(2), rings(1)]
}

#[test]
fn edges_are_cut_as_i_overlay_cuts_them() {
    let (mut dice, mut compared) = (Dice(11), 0);
    for case in 0..600 {
        let [a, b] = turned(&mut dice);
        if [&a, &b]
            .iter()
            .any(|x| geograd::Rings::from(&x[..]).validate().is_err())
        {
            continue;
        }
        for fill in [Fill::NonZero, Fill::EvenOdd] {
            let (operation, _) = OPERATIONS[case % OPERATIONS.len()];
            let alike = is_cut_alike(&a[..], &b[..], operation, fill).expect("valid rings");
            assert_ne!(alike, Some(false), "{operation:?} {fill:?} {a:?} {b:?}");
            compared += usize::from(alike.is_some());
        }
    }
    assert!(compared > 200, "{compared} compared");
}

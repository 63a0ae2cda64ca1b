//! Inputs on a grid of few numbers, so that shapes share coordinates, ends, vertices, planes and directions, touch,
//! lie flush or have no size.
use crate::ad::declared::Kind;
use crate::ad::sample::Draw;
use std::f64::consts::FRAC_PI_4;

/// Steps of the grid: whole numbers are exact, tenths and thirds are rounded.
const STEPS: [f64; 5] = [1.0, 1.0, 0.5, 0.1, 1.0 / 3.0];

/// Returns numbers of the given kinds on a grid whose step is drawn, too. They may violate the rules of their shapes.
pub(crate) fn lattice(kinds: &[Kind], draw: &mut Draw) -> Vec<f64> {
    let step = STEPS[draw.below(STEPS.len())];
    // Few numbers make few inputs with much in common, more of them shapes apart.
    let reach = 1 + draw.below(3);
    let whole = |draw: &mut Draw| draw.below(2 * reach + 1) as f64 - reach as f64;
    let zero_sizes = draw.once_in(6);
    let mut x: Vec<f64> = Vec::with_capacity(kinds.len());
    for &kind in kinds {
        let number = match kind {
            Kind::X | Kind::Y | Kind::Z | Kind::Offset => whole(draw) * step,
            Kind::Length if zero_sizes => draw.below(2) as f64 * step,
            Kind::Length => (1 + draw.below(3)) as f64 * step,
            Kind::Angle | Kind::AngleX | Kind::AngleY => whole(draw) * quarter(draw),
            Kind::RotationVectorX | Kind::RotationVectorY | Kind::RotationVectorZ => {
                whole(draw) * quarter(draw)
            }
            Kind::DirectionX | Kind::DirectionY | Kind::DirectionZ => whole(draw),
            Kind::QuaternionW | Kind::QuaternionX | Kind::QuaternionY | Kind::QuaternionZ => {
                draw.below(3) as f64 - 1.0
            }
            Kind::Number => 0.5 * draw.below(3) as f64,
        };
        x.push(number);
    }
    share(kinds, &mut x, draw);
    repeat(kinds, &mut x, draw, step);
    x
}

/// Makes the second of two like shapes a copy of the first that is moved along the grid, now and then.
fn repeat(kinds: &[Kind], x: &mut [f64], draw: &mut Draw, step: f64) {
    let half = kinds.len() / 2;
    if kinds[..half] != kinds[half..] || !draw.once_in(6) {
        return;
    }
    let shift = [(); 3].map(|()| step * 0.25 * (draw.below(9) as f64 - 4.0));
    x.copy_within(..half, half);
    for (x, kind) in x[half..].iter_mut().zip(kinds) {
        match kind {
            Kind::X => *x += shift[0],
            Kind::Y => *x += shift[1],
            Kind::Z => *x += shift[2],
            _ => {}
        }
    }
}

/// Returns a quarter of a turn, or half of that.
fn quarter(draw: &mut Draw) -> f64 {
    match draw.once_in(4) {
        true => FRAC_PI_4,
        false => 2.0 * FRAC_PI_4,
    }
}

/// Returns the ranges of points among numbers: the first index and the count of numbers of each.
pub(crate) fn places(kinds: &[Kind]) -> Vec<(usize, usize)> {
    let starts = (0..kinds.len()).filter(|&i| kinds[i] == Kind::X);
    let length = |i: usize| {
        let rest = &kinds[i + 1..];
        match (rest.first(), rest.get(1)) {
            (Some(Kind::Y), Some(Kind::Z)) => 3,
            (Some(Kind::Y), _) => 2,
            _ => 1,
        }
    };
    starts.map(|i| (i, length(i))).collect()
}

/// Makes points equal, now and then: vertices repeated within a shape, or shared by two shapes.
fn share(kinds: &[Kind], x: &mut [f64], draw: &mut Draw) {
    let places = places(kinds);
    if places.len() < 2 || !draw.once_in(3) {
        return;
    }
    for _ in 0..=draw.below(2) {
        let (from, n) = places[draw.below(places.len())];
        let (to, m) = places[draw.below(places.len())];
        if n == m {
            x.copy_within(from..from + n, to);
        }
    }
}

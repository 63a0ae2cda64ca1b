//! What segments share, against whole numbers.
use super::any::Dice;
use geograd::intersection::{CommonPart, meeting_of_segments};
use geograd::{Jet, Pack, Segment2, Vec2};

type Whole = [i128; 2];

/// A coordinate in units that every number of at most one decimal digit is a multiple of, in both formats.
fn whole(x: f64) -> i128 {
    let units = x * 2.0_f64.powi(57);
    assert!(
        units.abs() < 2.0_f64.powi(60) && units.fract() == 0.0,
        "{x}"
    );
    units as i128
}

fn side(a: Whole, b: Whole, c: Whole) -> i128 {
    let cross = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    cross.signum()
}

/// `true` if a point is on a segment.
fn on(a: Whole, b: Whole, c: Whole) -> bool {
    let between = |k: usize| a[k].min(b[k]) <= c[k] && c[k] <= a[k].max(b[k]);
    side(a, b, c) == 0 && between(0) && between(1)
}

/// The kind of meeting, and the ends that are on the other segment.
fn expected([a, b, p, q]: [Whole; 4]) -> (f64, Vec<Whole>) {
    let mut ends: Vec<Whole> = [(a, p, q), (b, p, q), (p, a, b), (q, a, b)]
        .into_iter()
        .filter(|&(end, from, to)| on(from, to, end))
        .map(|(end, ..)| end)
        .collect();
    ends.sort_unstable();
    ends.dedup();
    let across = side(a, b, p) * side(a, b, q) < 0 && side(p, q, a) * side(p, q, b) < 0;
    let kind = if ends.len() > 1 {
        2.0
    } else {
        f64::from(u8::from(across || !ends.is_empty()))
    };
    (kind, ends)
}

/// Coordinates of one decimal digit; ends that are shared, and ends on the other segment as far as rounding lets them.
fn drawn(dice: &mut Dice, round: fn(f64) -> f64) -> [[f64; 2]; 4] {
    let mut point = || [0, 1].map(|_| round(dice.whole(19) as f64 / 10.0 - 0.9));
    let mut all = [point(), point(), point(), point()];
    let (end, other) = (2 + dice.whole(2) as usize, dice.whole(2) as usize);
    match dice.whole(5) {
        0 => all[end] = all[other],
        1 => all[end] = [0, 1].map(|k| round((all[0][k] + all[1][k]) / 2.0)),
        2 => all[end] = [0, 1].map(|k| round(all[0][k] + (all[1][k] - all[0][k]) * 0.25)),
        3 => {
            all[2] = [0, 1].map(|k| round((all[0][k] + all[1][k]) / 2.0));
            all[3] = [0, 1].map(|k| round(2.0 * all[1][k] - all[0][k]));
        }
        _ => {}
    }
    if dice.whole(8) == 0 {
        all[1] = all[0];
    }
    all
}

fn judged(all: [[f64; 2]; 4], found: CommonPart<f64>) -> bool {
    let (kind, ends) = expected(all.map(|p| p.map(whole)));
    let place = |p: Vec2<f64>| [whole(p.x), whole(p.y)];
    found.kind == kind
        && (ends.is_empty() || ends.contains(&place(found.from)) && ends.contains(&place(found.to)))
        && (kind < 2.0 || found.from != found.to)
}

/// How often every kind of a hundred is drawn.
fn meet(round: fn(f64) -> f64, of: fn([[f64; 2]; 4]) -> CommonPart<f64>) {
    let mut dice = Dice(3);
    let mut kinds = [0; 3];
    for _ in 0..20_000 {
        let [a, b, p, q] = drawn(&mut dice, round);
        for all in [[a, b, p, q], [p, q, a, b], [b, a, p, q], [b, a, q, p]] {
            let found = of(all);
            assert!(judged(all, found), "{all:?} {found:?}");
            kinds[found.kind as usize] += 1;
        }
    }
    assert!(kinds.iter().all(|&count| count > 2000), "{kinds:?}");
}

#[test]
fn segments_meet_as_whole_numbers_say() {
    meet(
        |x| x,
        |all| {
            let [a, b, p, q] = all.map(|[x, y]| Vec2::new(x, y));
            meeting_of_segments(Segment2::new(a, b), Segment2::new(p, q))
        },
    );
    meet(
        |x| f64::from(x as f32),
        |all| {
            let [a, b, p, q] = all.map(|[x, y]| Vec2::new(x as f32, y as f32));
            let found = meeting_of_segments(Segment2::new(a, b), Segment2::new(p, q));
            CommonPart {
                from: found.from.cast(),
                to: found.to.cast(),
                kind: found.kind.into(),
            }
        },
    );
}

#[test]
fn ends_that_are_shared_have_the_slopes_of_their_lines() {
    // Two segments end in the origin; as the end of one moves along the other, the crossing stays.
    let all = [0.1, 0.1, 0.0, 0.0, 0.1, 0.3, 0.0, 0.0];
    let x: Vec<Jet<f64, 8>> = (0..8).map(|k| Jet::variable(all[k], k)).collect();
    let p = |k: usize| Vec2::new(x[k], x[k + 1]);
    let found = meeting_of_segments(Segment2::new(p(0), p(2)), Segment2::new(p(4), p(6)));
    assert_eq!(
        (found.kind.value, found.from.x.value, found.from.y.value),
        (1.0, 0.0, 0.0)
    );
    // The line of the first by (u, v) at its end, the other one's fixed: the crossing moves along y = 3 x.
    let [u, v] = [2, 3].map(|k| (found.from.x.derivative[k], found.from.y.derivative[k]));
    for ((dx, dy), expected) in [(u, -0.5), (v, 0.5)] {
        assert!(
            (dx - expected).abs() < 1e-14 && (dy - 3.0 * expected).abs() < 1e-14,
            "{dx} {dy}"
        );
    }
}

//! Offsets of polygons and paths: closed forms, identities, derivatives, hard inputs, errors.
use super::cases::{any_ring, at, hard_rings, ring, star, stars};
use super::offset_peers::{LINES, SHAPES, of_lines, of_shapes, style};
use super::rings::{made, zeros};
use super::simple::flaw;
use geograd::ad::adjoint::offset::{
    offset_area_vjp, offset_perimeter_vjp, offset_vjp, valid_offset_vjp,
};
use geograd::ad::adjoint::ring::signed_area_vjp;
use geograd::ad::forward::First;
use geograd::error::{Argument, Field, Flaw, VertexFault};
use geograd::offset::{
    Chords, End, Join, OffsetStyle, offset, offset_area, offset_perimeter, offset_replay,
    offset_search, path_offset, path_offset_search, valid_offset_replay, valid_offset_search,
};
use geograd::polygon::{self, Fill};
use geograd::{Error, Pack, Polygon, Vec2};
use geograd_tests::Dice;

fn joined(join: Join) -> OffsetStyle {
    OffsetStyle {
        join,
        ..OffsetStyle::default()
    }
}
const MITRE: Join = Join::Mitre(1e6);
fn total(parts: &[Polygon<f64>]) -> [f64; 2] {
    let area = parts.iter().map(polygon::signed_area).sum();
    [area, parts.iter().map(polygon::perimeter).sum()]
}
fn near(found: f64, expected: f64, by: f64) {
    assert!(
        (found - expected).abs() <= by * (1.0 + expected.abs()),
        "{found} {expected}"
    );
}
fn square(size: f64) -> Vec<Vec2<f64>> {
    ring(&[(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)])
}
/// The area of the sectors of a full turn by chords: `q` per quarter.
fn disc(q: f64, r: f64) -> [f64; 2] {
    let step = std::f64::consts::FRAC_PI_2 / q;
    [
        2.0 * q * step.sin() * r * r,
        8.0 * q * (step / 2.0).sin() * r,
    ]
}

#[test]
fn a_square_and_a_frame_have_closed_forms() {
    let (d, diagonal) = (0.5, 0.5_f64.sqrt());
    let cut = d * (2f64.sqrt() - 1.0);
    let [sectors, arcs] = disc(16.0, d);
    let cases = [
        (MITRE, 25.0, 20.0),
        (Join::Bevel, 24.5, 16.0 + 4.0 * diagonal),
        (Join::Round, 24.0 + sectors, 16.0 + arcs),
        // Cut one distance from the vertex: a triangle of height `cut` is missing.
        (
            Join::Mitre(1.0),
            25.0 - 4.0 * cut * cut,
            20.0 - 8.0 * cut * (2f64.sqrt() - 1.0),
        ),
    ];
    for (join, area, perimeter) in cases {
        let parts = offset(&square(4.0), d, &joined(join)).unwrap();
        let found = total(&parts);
        near(found[0], area, 1e-14);
        near(found[1], perimeter, 1e-14);
        assert_eq!(flaw(&parts), Ok(()));
        // Inward all joins are one: no corner opens.
        assert_eq!(
            total(&offset(&square(4.0), -d, &joined(join)).unwrap()),
            [9.0, 12.0]
        );
    }
    let hole = ring(&[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]);
    for turned in [false, true] {
        let mut hole = hole.clone();
        if turned {
            hole.reverse();
        }
        let frame = made(&[square(6.0), hole]);
        // The hole shrinks with sharp corners, and grows with joined ones.
        let out = total(&offset(&frame, d, &joined(Join::Round)).unwrap());
        near(out[0], 36.0 + 12.0 + sectors - 1.0, 1e-14);
        let inner = total(&offset(&frame, -d, &joined(Join::Round)).unwrap());
        near(inner[0], 25.0 - (4.0 + 4.0 + sectors), 1e-14);
        near(inner[1], 20.0 + 8.0 + arcs, 1e-14);
        // The hole closes.
        let closed = offset(&frame, 1.5, &joined(MITRE)).unwrap();
        assert_eq!((closed.len(), total(&closed)), (1, [81.0, 36.0]));
        assert!(offset(&frame, -1.0, &joined(MITRE)).unwrap().is_empty());
    }
}

#[test]
fn an_ell_a_triangle_and_segments_have_closed_forms() {
    let ell = ring(&[
        (0.0, 0.0),
        (5.0, 0.0),
        (5.0, 2.0),
        (2.0, 2.0),
        (2.0, 5.0),
        (0.0, 5.0),
    ]);
    let [sector, _] = disc(16.0, 0.5);
    let out = offset_area(&ell, 0.5, &joined(Join::Round)).unwrap();
    // Five corners open by a quarter, one closes and is covered twice.
    near(out, 16.0 + 0.5 * 20.0 - 0.25 + sector * 1.25, 1e-14);
    near(
        offset_area(&ell, 0.5, &joined(MITRE)).unwrap(),
        36.0 - 9.0,
        1e-14,
    );
    near(
        offset_area(&ell, -0.5, &joined(MITRE)).unwrap(),
        4.0 + 3.0,
        1e-14,
    );
    near(
        offset_area(&ell, -0.5, &joined(Join::Bevel)).unwrap(),
        7.0 + 0.125,
        1e-14,
    );
    // A triangle with sides 3, 4, 5 moves to a similar one: its inscribed circle has the radius 1.
    let triangle = ring(&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]);
    for d in [-0.75, -0.25, 0.5, 2.0] {
        let (scale, style) = (1.0 + d, joined(MITRE));
        near(
            offset_area(&triangle, d, &style).unwrap(),
            6.0 * scale * scale,
            1e-13,
        );
        near(
            offset_perimeter(&triangle, d, &style).unwrap(),
            12.0 * scale,
            1e-13,
        );
    }
    let segment = ring(&[(1.0, 1.0), (4.0, 5.0)]);
    for (end, area, perimeter) in [
        (End::Flat, 10.0, 14.0),
        (End::Square, 10.0 + 4.0, 10.0 + 8.0),
        (
            End::Round,
            10.0 + disc(16.0, 1.0)[0],
            10.0 + disc(16.0, 1.0)[1],
        ),
    ] {
        let style = OffsetStyle {
            end,
            ..OffsetStyle::default()
        };
        let parts = path_offset(&segment, 1.0, &style).unwrap();
        let found = total(&parts);
        assert_eq!((parts.len(), flaw(&parts)), (1, Ok(())));
        near(found[0], area, 1e-14);
        near(found[1], perimeter, 1e-14);
    }
}

#[test]
fn bevels_mitres_and_ends_are_those_of_shapely() {
    let rings = SHAPES.map(|(name, rings)| {
        (
            name,
            made(&rings.iter().map(|all| ring(all)).collect::<Vec<_>>()),
        )
    });
    let mut count = 0;
    for (name, look, d, area, length) in of_shapes() {
        let (_, polygon) = rings.iter().find(|(of, _)| *of == name).unwrap();
        let parts = offset(polygon, d, &style(look)).unwrap();
        assert_eq!(flaw(&parts), Ok(()), "{name} {look} {d}");
        let found = total(&parts);
        near(found[0], area, 3e-14);
        near(found[1], length, 3e-14);
        count += 1;
    }
    for (name, look, d, area, length) in of_lines() {
        let (_, line) = LINES.iter().find(|(of, _)| *of == name).unwrap();
        let parts = path_offset(&ring(line), d, &style(look)).unwrap();
        assert_eq!(flaw(&parts), Ok(()), "{name} {look} {d}");
        let found = total(&parts);
        near(found[0], area, 3e-14);
        near(found[1], length, 3e-14);
        count += 1;
    }
    assert_eq!(count, 132);
}

/// Joins, ends and distances.
fn looks() -> Vec<OffsetStyle> {
    let mut all = Vec::new();
    for join in [Join::Round, Join::Mitre(5.0), Join::Mitre(1.3), Join::Bevel] {
        for end in [End::Round, End::Flat, End::Square] {
            let chords = Chords::PerQuarter(5);
            all.push(OffsetStyle {
                join,
                end,
                chords,
                ..OffsetStyle::default()
            });
        }
    }
    all
}

#[test]
fn adjoints_are_duals_and_duals_are_differences() {
    type Dual = First<f64>;
    let mut dice = Dice(48);
    let mut compared = 0;
    for (k, style) in looks().into_iter().cycle().take(72).enumerate() {
        let is_path = k % 3 == 2;
        let rings = match is_path {
            true => made(&[any_path(&mut dice)]),
            false => made(&stars(&mut dice)),
        };
        let d = if is_path {
            dice.within(0.05, 0.6)
        } else {
            dice.within(-0.2, 0.4)
        };
        let search = |rings: &Polygon<f64>, d: f64| match is_path {
            true => path_offset_search(rings, d, &style).unwrap(),
            false => offset_search(rings, d, &style).unwrap(),
        };
        let trace = search(&rings, d);
        for is_area in [true, false] {
            let of = |(p, d): (Polygon<Dual>, Dual)| {
                let shape = offset_replay(&p, d, &trace);
                if is_area {
                    polygon::signed_area(&shape)
                } else {
                    polygon::perimeter(&shape)
                }
            };
            let (value, (by, by_d)) = geograd::gradient(of, (rings.clone(), d));
            let mut bars = zeros(&rings);
            let vjp = if is_area {
                offset_area_vjp
            } else {
                offset_perimeter_vjp
            };
            let (same, d_bar) = vjp(&rings, d, &trace, 1.0, &mut bars);
            let size = by.scalars().iter().fold(by_d.abs(), |m, x| m.max(x.abs()));
            near(same, value, 1e-13);
            assert!(
                (d_bar - by_d).abs() < 1e-9 * (1.0 + size),
                "{d_bar} {by_d} {style:?}"
            );
            for (found, expected) in bars.scalars().iter().zip(by.scalars()) {
                assert!(
                    (found - expected).abs() < 1e-9 * (1.0 + size),
                    "{found} {expected}"
                );
            }
            // Differences of the whole search, where both sides agree: away from kinks.
            let at = |numbers: &[f64]| {
                let (rings, d) = (rings.clone(), d).refill(numbers);
                let shape = offset_replay(&rings, d, &search(&rings, d));
                if is_area {
                    polygon::signed_area(&shape)
                } else {
                    polygon::perimeter(&shape)
                }
            };
            let start = (rings.clone(), d).scalars();
            let slopes = (by, by_d).scalars();
            for _ in 0..4 {
                let k = dice.below(start.len());
                let moved = |by: f64| {
                    let mut numbers = start.clone();
                    numbers[k] += by;
                    at(&numbers)
                };
                let step = 1e-6;
                let (low, high) = (moved(-step), moved(step));
                if ((high - value) - (value - low)).abs() / step < 1e-4 {
                    near((high - low) / (2.0 * step), slopes[k], 1e-7);
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

fn any_path(dice: &mut Dice) -> Vec<Vec2<f64>> {
    let n = 2 + dice.below(6);
    let mut number = || dice.within(0.0, 4.0);
    (0..n).map(|_| at(number(), number())).collect()
}

#[test]
fn valid_results_have_the_same_derivatives() {
    let mut dice = Dice(49);
    for style in looks() {
        let (rings, d) = (made(&stars(&mut dice)), dice.within(-0.15, 0.3));
        let trace = valid_offset_search(&rings, d, &style).unwrap();
        let parts = valid_offset_replay(&rings, d, &trace);
        let mut out_bars = Vec::new();
        for part in &parts {
            for ring in part.rings().iter() {
                let mut own = vec![Vec2::zero(); ring.len()];
                signed_area_vjp(ring, 1.0, &mut own);
                out_bars.extend(own);
            }
        }
        assert_eq!(out_bars.len(), trace.vertex_count());
        let (mut bars, mut plain) = (zeros(&rings), zeros(&rings));
        let d_bar = valid_offset_vjp(&rings, d, &trace, &out_bars, &mut bars);
        let of_area = offset_search(&rings, d, &style).unwrap();
        let (area, by_d) = offset_area_vjp(&rings, d, &of_area, 1.0, &mut plain);
        near(total(&parts)[0], area, 1e-13);
        near(d_bar, by_d, 1e-9);
        for (found, expected) in bars.scalars().iter().zip(plain.scalars()) {
            near(*found, expected, 1e-9);
        }
    }
}

#[test]
fn the_area_grows_by_the_perimeter_and_moves_with_its_input() {
    let mut dice = Dice(50);
    for k in 0..40 {
        let rings = made(&stars(&mut dice));
        let d = dice.within(-0.15, 0.3);
        let chords = Chords::PerQuarter(256);
        let join = if k % 2 == 0 { Join::Round } else { MITRE };
        let style = OffsetStyle {
            join,
            chords,
            ..OffsetStyle::default()
        };
        let trace = offset_search(&rings, d, &style).unwrap();
        let mut bars = zeros(&rings);
        let (area, by_d) = offset_area_vjp(&rings, d, &trace, 1.0, &mut bars);
        let perimeter = polygon::perimeter(&offset_replay(&rings, d, &trace));
        near(by_d, perimeter, if k % 2 == 0 { 2e-5 } else { 1e-10 });
        // Moved, turned and scaled about the origin: no change, none, twice the area.
        let sum = bars.iter().fold(Vec2::zero(), |sum, &bar| sum + bar);
        assert!(sum.length() < 1e-10, "{sum:?}");
        let pairs = bars.iter().zip(rings.vertices());
        let turn: f64 = pairs.clone().map(|(bar, v)| v.perp_dot(*bar)).sum();
        let growth: f64 = pairs.map(|(bar, v)| v.dot(*bar)).sum();
        near(turn, 0.0, 1e-10);
        near(growth + d * by_d, 2.0 * area, 1e-10);
    }
}

#[test]
fn convex_rings_obey_steiner_and_rests_add_up() {
    let mut dice = Dice(51);
    for _ in 0..30 {
        let polygon = super::cases::convex(&mut dice);
        let rings = polygon.as_slice();
        let style = OffsetStyle {
            chords: Chords::PerQuarter(64),
            ..OffsetStyle::default()
        };
        let d = dice.within(0.01, 2.0);
        let (area, length) = (polygon::signed_area(rings), polygon::perimeter(rings));
        let found = offset_area(rings, d, &style).unwrap();
        let steiner = area + length * d + std::f64::consts::PI * d * d;
        near(found, steiner, 2e-4);
        assert!(found < steiner);
    }
    // Inward and the offset of all outside of it fill a box that both are in.
    for _ in 0..20 {
        let rings = made(&[star(&mut dice, at(0.0, 0.0), 9, 0.6, 1.6)]);
        let style = looks()[dice.below(12)];
        let r = dice.within(0.02, 0.3);
        let inner = offset_area(&rings, -r, &style).unwrap();
        let mut outside = rings.clone();
        outside.push(ring(&[(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0)]));
        let mitre = OffsetStyle {
            join: style.join,
            ..style
        };
        let rest = offset_area(&outside, r, &mitre).unwrap();
        let frame = offset_area(
            &ring(&[(-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0)]),
            r,
            &mitre,
        );
        near(inner + rest, frame.unwrap(), 1e-13);
    }
}

#[test]
fn results_of_hard_input_are_valid() {
    if !geograd_tests::is_due("results_of_hard_input_are_valid") {
        return;
    }
    let mut dice = Dice(52);
    let mut all = hard_rings();
    for _ in 0..60 {
        all.push(vec![any_ring(&mut dice, 9)]);
    }
    let looks = looks();
    for (k, rings) in all.iter().enumerate() {
        for fill in [Fill::EvenOdd, Fill::NonZero] {
            for (i, d) in [0.25, -0.25, 0.0, 1.0, -1.0, 1e-9, -1e-9]
                .into_iter()
                .enumerate()
            {
                let style = OffsetStyle {
                    fill,
                    ..looks[(k + i) % 12]
                };
                let rings = made(rings);
                if rings.validate_rings().is_err() {
                    continue;
                }
                let parts = offset(&rings, d, &style).unwrap();
                assert_eq!(flaw(&parts), Ok(()), "{rings:?} {d} {style:?}");
                let plain = offset_search(&rings, d, &style).unwrap();
                let mut bars = zeros(&rings);
                let (area, by_d) = offset_area_vjp(&rings, d, &plain, 1.0, &mut bars);
                near(total(&parts)[0], area, 1e-12);
                assert!(by_d.is_finite() && bars.iter().all(|bar| bar.is_finite()));
            }
        }
    }
    for k in 0..60 {
        let path = if k % 2 == 0 {
            any_ring(&mut dice, 7)
        } else {
            any_path(&mut dice)
        };
        if path.iter().all(|v| *v == path[0]) {
            continue;
        }
        let parts = path_offset(&path, [0.3, 1.0][k % 2], &looks[k % 12]).unwrap();
        assert_eq!(flaw(&parts), Ok(()), "{path:?}");
    }
}

trait Valid {
    fn validate_rings(&self) -> Result<(), Flaw>;
}
impl Valid for Polygon<f64> {
    fn validate_rings(&self) -> Result<(), Flaw> {
        self.rings().validate()
    }
}

/// Repeated and collinear vertices and spikes add nothing to a square.
#[test]
fn what_encloses_nothing_changes_nothing() {
    let clean = square(4.0);
    let same = [
        ring(&[
            (0., 0.),
            (1., 0.),
            (2., 0.),
            (4., 0.),
            (4., 4.),
            (2., 4.),
            (0., 4.),
        ]),
        ring(&[
            (0., 0.),
            (4., 0.),
            (4., 0.),
            (4., 4.),
            (4., 4.),
            (4., 4.),
            (0., 4.),
            (0., 0.),
        ]),
        ring(&[
            (0., 0.),
            (4., 0.),
            (4., 2.),
            (6., 2.),
            (4., 2.),
            (4., 4.),
            (0., 4.),
        ]),
        ring(&[
            (0., 0.),
            (4., 0.),
            (4., 2.),
            (2., 2.),
            (4., 2.),
            (4., 4.),
            (0., 4.),
        ]),
        ring(&[(0., 4.), (4., 4.), (4., 0.), (0., 0.)]),
    ];
    for style in looks() {
        for d in [0.5, -0.5, 0.0] {
            let expected = total(&offset(&clean, d, &style).unwrap());
            for other in &same {
                let found = total(&offset(other, d, &style).unwrap());
                near(found[0], expected[0], 1e-14);
                near(found[1], expected[1], 1e-14);
            }
        }
    }
    // A bow tie is two triangles; a ring that crosses itself by a little keeps its corner.
    let style = joined(MITRE);
    let tie = ring(&[(0., 0.), (4., 4.), (4., 0.), (0., 4.)]);
    let triangles = made(&[
        ring(&[(0., 0.), (2., 2.), (0., 4.)]),
        ring(&[(4., 0.), (4., 4.), (2., 2.)]),
    ]);
    for d in [0.25, -0.25] {
        let expected = offset_area(&triangles, d, &style).unwrap();
        near(offset_area(&tie, d, &style).unwrap(), expected, 1e-13);
    }
    let crossed = ring(&[
        (0., 0.),
        (4., 0.),
        (4., 4.),
        (1e-8, 4.),
        (-1e-8, 4.0 + 1e-8),
        (0.0, 4.0),
    ]);
    near(
        offset_area(&crossed, 0.5, &joined(Join::Round)).unwrap(),
        24.0 + disc(16.0, 0.5)[0],
        1e-7,
    );
}

#[test]
fn slots_close_and_plates_vanish() {
    // A slot of width one, four deep, in a plate.
    let plate = ring(&[
        (0., 0.),
        (7., 0.),
        (7., 6.),
        (4., 6.),
        (4., 2.),
        (3., 2.),
        (3., 6.),
        (0., 6.),
    ]);
    let style = joined(MITRE);
    let slope = |d: f64| {
        let trace = offset_search(&plate, d, &style).unwrap();
        offset_area_vjp(&plate, d, &trace, 1.0, &mut [Vec2::zero(); 8])
    };
    let (before, at, after) = (slope(0.5 - 1e-9), slope(0.5), slope(0.5 + 1e-9));
    near(before.0, at.0, 1e-7);
    near(after.0, at.0, 1e-7);
    near(at.0, 8.0 * 7.0, 1e-14);
    // The perimeter loses both sides of the slot; its end stays as a mitre's nothing.
    near(before.1, 30.0 + 2.0 * 4.0, 1e-7);
    near(after.1, 30.0, 1e-7);
    near(at.1, 30.0, 1e-14);
    let thin = ring(&[(0., 0.), (4., 0.), (4., 1.), (0., 1.)]);
    let mut bars = [Vec2::zero(); 4];
    let trace = offset_search(&thin, -0.5, &style).unwrap();
    assert_eq!(
        offset_area_vjp(&thin, -0.5, &trace, 1.0, &mut bars),
        (0.0, 0.0)
    );
    assert_eq!((trace.vertex_count(), bars), (0, [Vec2::zero(); 4]));
    let perimeter = offset_perimeter_vjp(
        &thin,
        -9.0,
        &offset_search(&thin, -9.0, &style).unwrap(),
        1.0,
        &mut bars,
    );
    assert_eq!(perimeter, (0.0, 0.0));
}

#[test]
fn zero_is_the_polygon_with_the_slope_of_moved_edges() {
    for style in looks() {
        let frame = made(&[square(6.0), ring(&[(2., 2.), (2., 4.), (4., 4.), (4., 2.)])]);
        let trace = offset_search(&frame, 0.0, &style).unwrap();
        let mut bars = zeros(&frame);
        let found = offset_area_vjp(&frame, 0.0, &trace, 1.0, &mut bars);
        assert_eq!(found, (32.0, 32.0));
        assert_eq!(bars[0], at(-3.0, -3.0));
        assert!(path_offset(&square(4.0), 0.0, &style).unwrap().is_empty());
        assert!(path_offset(&square(4.0), -1.0, &style).unwrap().is_empty());
        assert_eq!(offset(&frame, -0.0, &style).unwrap().len(), 1);
    }
}

#[test]
fn results_follow_size_place_and_format() {
    let mut dice = Dice(53);
    for style in looks() {
        let (rings, d) = (stars(&mut dice), 0.1);
        let expected = offset_area(&made(&rings), d, &style).unwrap();
        for scale in [2f64.powi(-400), 2f64.powi(400)] {
            let scaled = made(&super::rings::moved(&rings, Vec2::zero(), scale));
            let found = offset_area(&scaled, d * scale, &style).unwrap() / scale / scale;
            near(found, expected, 1e-13);
        }
        let far = made(&super::rings::moved(&rings, at(1e6, -1e6), 1.0));
        near(offset_area(&far, d, &style).unwrap(), expected, 1e-8);
        let single: Polygon<f32> = made(&rings).cast();
        near(
            f64::from(offset_area(&single, 0.1_f32, &style).unwrap()),
            expected,
            1e-5,
        );
        let parts = offset(&single, -0.05_f32, &style).unwrap();
        assert!(
            parts
                .iter()
                .all(|part| part.vertices().iter().all(|v| v.is_finite()))
        );
    }
    // Duals pass the search as well.
    let area = |d: First<f64>| {
        let square: Polygon<f64> = made(&[square(4.0)]);
        offset_area(&square.lift(), d, &joined(MITRE)).unwrap()
    };
    assert_eq!(geograd::gradient(area, 1.0), (36.0, 24.0));
}

#[test]
fn chords_hold_their_tolerance() {
    let mut last = f64::INFINITY;
    for tolerance in [1e-1, 1e-2, 1e-3, 1e-4] {
        let chords = Chords::Within(tolerance);
        let style = OffsetStyle {
            chords,
            ..OffsetStyle::default()
        };
        let point = ring(&[(0.0, 0.0), (1e-9, 0.0)]);
        let parts = path_offset(&point, 2.0, &style).unwrap();
        let ring = parts[0].ring(0);
        let middle = |k: usize| (ring[k] + ring[(k + 1) % ring.len()]) * 0.5;
        let miss = (0..ring.len())
            .map(|k| 2.0 - middle(k).length())
            .fold(0.0, f64::max);
        assert!(
            miss <= tolerance * (1.0 + 1e-6) && miss < last,
            "{miss} {tolerance}"
        );
        // No more than needed: with a chord less per quarter it is missed.
        let quarter = style.quarter(2.0);
        let half = std::f64::consts::FRAC_PI_4 / f64::from(quarter - 1);
        assert!(2.0 * (1.0 - half.cos()) > tolerance);
        last = miss;
    }
}

#[test]
fn errors_name_ring_and_vertex() {
    let style = OffsetStyle::default();
    let invalid = |argument, flaw| Error::Invalid {
        argument,
        item: 0,
        flaw,
    };
    let of_ring = |ring, index, fault| invalid(Argument::A, Flaw::Ring { ring, index, fault });
    let two = made(&[square(4.0), ring(&[(1., 1.), (2., 2.), (1., 1.), (2., 2.)])]);
    let nan = made(&[square(4.0), ring(&[(1., 1.), (2., 1.), (2., f64::NAN)])]);
    let short = made(&[ring(&[(1., 1.), (2., 2.)])]);
    for is_trusted in [false, true] {
        let style = OffsetStyle {
            is_trusted,
            ..style
        };
        let error = |rings: &Polygon<f64>| offset_search(rings, 1.0, &style).unwrap_err();
        assert_eq!(error(&two), of_ring(1, 2, VertexFault::Coincident));
        assert_eq!(error(&nan), of_ring(1, 2, VertexFault::NotFinite));
        assert_eq!(error(&short), of_ring(0, 2, VertexFault::Missing));
    }
    let path = |all: &[(f64, f64)]| path_offset(&ring(all), 1.0, &style).unwrap_err();
    assert_eq!(path(&[(1., 1.)]), of_ring(0, 1, VertexFault::Missing));
    assert_eq!(path(&[]), of_ring(0, 0, VertexFault::Missing));
    assert_eq!(
        path(&[(1., 1.), (1., 1.)]),
        of_ring(0, 0, VertexFault::Repeated)
    );
    assert_eq!(
        path(&[(1., 1.), (f64::INFINITY, 1.)]),
        of_ring(0, 1, VertexFault::NotFinite)
    );
    let of_distance = |flaw| invalid(Argument::Named("distance"), flaw);
    for d in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let expected = of_distance(Flaw::NotFinite(Field::VALUE));
        assert_eq!(offset(&square(4.0), d, &style).unwrap_err(), expected);
    }
    let rule = "moves a vertex beyond the largest number";
    for d in [f64::MAX, -f64::MAX] {
        let found = offset(
            &super::rings::moved(&[square(4.0)], Vec2::zero(), 1e307)[0],
            d,
            &style,
        );
        assert_eq!(
            found.unwrap_err(),
            of_distance(Flaw::Broken(Field::VALUE, rule))
        );
    }
    let of_style = |style: OffsetStyle| offset(&square(4.0), 1.0, &style).unwrap_err();
    let broken = |flaw| invalid(Argument::Named("style"), flaw);
    let limit = Field::new("limit");
    assert_eq!(
        of_style(joined(Join::Mitre(0.5))),
        broken(Flaw::Broken(limit, "is below one"))
    );
    assert_eq!(
        of_style(joined(Join::Mitre(f64::NAN))),
        broken(Flaw::NotFinite(limit))
    );
    let chords = |chords| OffsetStyle { chords, ..style };
    let field = Field::new("chords");
    assert_eq!(
        of_style(chords(Chords::PerQuarter(0))),
        broken(Flaw::NotPositive(field))
    );
    assert_eq!(
        of_style(chords(Chords::Within(0.0))),
        broken(Flaw::NotPositive(field))
    );
    assert_eq!(
        of_style(chords(Chords::Within(f64::NAN))),
        broken(Flaw::NotFinite(field))
    );
    // Nothing has no offset.
    assert!(offset(&Polygon::new(), 1.0, &style).unwrap().is_empty());
    assert!(offset(&Polygon::new(), -1.0, &style).unwrap().is_empty());
    let none = offset_search(&Polygon::new(), -1.0, &style).unwrap();
    assert_eq!(offset_vjp(&Polygon::new(), -1.0, &none, &[], &mut []), 0.0);
}

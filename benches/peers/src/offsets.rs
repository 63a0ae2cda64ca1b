//! Offsets of polygons next to other libraries: chords for arcs, mitres, and exact arcs with their area.
use super::{Dice, median};
use cavalier_contours::polyline::{PlineSource, PlineSourceMut, Polyline};
use clipper2::{EndType, JoinType, Paths, PointScaler};
use geograd::Vec2;
use geograd::ad::adjoint::round_offset::round_offset_vjp;
use geograd::offset::{
    Chords, Join, OffsetMeasures, OffsetStyle, offset, offset_replay, offset_search,
    round_offset_measures, round_offset_search,
};
use geograd::polygon::area;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};
use std::hint::black_box;

type Ring = Vec<Vec2<f64>>;

/// Chords per quarter of a turn: Clipper2 takes 49.7 for a turn, unless told.
const CHORDS: u32 = 12;

/// Whole numbers of Clipper2: millionths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Hash)]
struct Millionths;

impl PointScaler for Millionths {
    const MULTIPLIER: f64 = 1e6;
}

/// An ell of six vertices, turned: the shape of most buildings of a map.
fn footprint(dice: &mut Dice) -> Ring {
    let (w, h) = (dice.within(5.0, 15.0), dice.within(5.0, 15.0));
    let (u, v) = (w * dice.within(0.3, 0.7), h * dice.within(0.3, 0.7));
    let (sin, cos) = dice.within(0.0, std::f64::consts::TAU).sin_cos();
    [(0.0, 0.0), (w, 0.0), (w, v), (u, v), (u, h), (0.0, h)]
        .map(|(x, y)| Vec2::new(x * cos - y * sin, x * sin + y * cos))
        .to_vec()
}

/// A star-shaped ring with a radius of about ten.
fn star(dice: &mut Dice, vertices: usize) -> Ring {
    let spoke = |k: usize| {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / vertices as f64).sin_cos();
        Vec2::new(cos, sin) * dice.within(7.0, 13.0)
    };
    (0..vertices).map(spoke).collect()
}

/// A bay and cape after another: a star whose neighbouring spokes differ little.
fn coast(dice: &mut Dice, vertices: usize) -> Ring {
    let mut waves = Vec::new();
    for k in 1..60 {
        let size = 2.0 / f64::from(k);
        waves.push((
            f64::from(k),
            dice.within(-size, size),
            dice.within(0.0, 6.0),
        ));
    }
    let spoke = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / vertices as f64;
        let height = |&(k, size, at): &(f64, f64, f64)| size * (k * turn + at).sin();
        let (sin, cos) = turn.sin_cos();
        Vec2::new(cos, sin) * (20.0 + waves.iter().map(height).sum::<f64>())
    };
    (0..vertices).map(spoke).collect()
}

/// A library, and the area that it finds for the offset of a ring.
struct Peer<'a> {
    name: &'static str,
    areas: Box<dyn Fn(&Ring) -> f64 + 'a>,
}

/// Prints microseconds a ring and the area of all, which is wrong if it differs by more than a share from the first.
fn table(title: &str, rings: &[Ring], share: f64, peers: &[Peer]) {
    println!("\n| {title} | µs | area |\n| --- | ---: | ---: |");
    let mut known = None;
    for Peer { name, areas } in peers {
        let whole: f64 = rings.iter().map(areas).sum();
        let own = *known.get_or_insert(whole);
        let is_same = (whole - own).abs() <= share * own;
        assert!(
            is_same || !name.starts_with("geograd"),
            "{name}: {whole} {own}"
        );
        let seconds = median(|| {
            for ring in rings {
                black_box(areas(ring));
            }
        });
        let each = 1e6 * seconds / rings.len() as f64;
        let flaw = if is_same { "" } else { ", wrong" };
        println!("| {name} | {each:.2} | {whole:.3}{flaw} |");
    }
}

fn of_clipper(ring: &Ring) -> Paths<Millionths> {
    vec![ring.iter().map(|v| (v.x, v.y)).collect::<Vec<_>>()].into()
}

fn contours(ring: &Ring) -> Vec<[f64; 2]> {
    ring.iter().map(|v| [v.x, v.y]).collect()
}

fn twice_area(ring: &[[f64; 2]]) -> f64 {
    let next = ring.iter().cycle().skip(1);
    ring.iter()
        .zip(next)
        .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
        .sum()
}

fn chords(title: &str, rings: &[Ring], d: f64, join: Join) {
    let style = OffsetStyle {
        join,
        chords: Chords::PerQuarter(CHORDS),
        ..OffsetStyle::default()
    };
    let (theirs, look) = match join {
        Join::Mitre(limit) => (
            OutlineStyle::new(d).line_join(LineJoin::Miter(2.0 * (1.0 / limit).asin())),
            (JoinType::Miter, limit / Millionths::MULTIPLIER),
        ),
        _ => (
            OutlineStyle::new(d).line_join(LineJoin::Round(
                std::f64::consts::FRAC_PI_2 / f64::from(CHORDS),
            )),
            (JoinType::Round, 0.0),
        ),
    };
    let mut trusted = style;
    trusted.is_trusted = true;
    let peers = [
        Peer {
            name: "geograd, valid by the OGC's rules",
            areas: Box::new(|ring| offset(ring, d, &style).unwrap().iter().map(area).sum()),
        },
        Peer {
            name: "geograd, with the record for derivatives",
            areas: Box::new(|ring| {
                let trace = offset_search(ring, d, &style).unwrap();
                area(&offset_replay(ring, d, &trace))
            }),
        },
        Peer {
            name: "geograd, the same without a union of the input first",
            areas: Box::new(|ring| {
                let trace = offset_search(ring, d, &trusted).unwrap();
                area(&offset_replay(ring, d, &trace))
            }),
        },
        Peer {
            name: "Clipper2",
            areas: Box::new(|ring| {
                of_clipper(ring)
                    .inflate(d, look.0, EndType::Polygon, look.1)
                    .signed_area()
            }),
        },
        Peer {
            name: "i_overlay",
            areas: Box::new(|ring| {
                let shapes = contours(ring).outline(&theirs);
                shapes.iter().flatten().map(|c| twice_area(c)).sum::<f64>() / 2.0
            }),
        },
    ];
    // Beyond its limit Clipper2 cuts a mitre elsewhere.
    table(
        title,
        rings,
        if join == Join::Round { 3e-4 } else { 1e-2 },
        &peers,
    );
}

fn arcs(title: &str, rings: &[Ring], d: f64) {
    let style = OffsetStyle::default();
    let bar = OffsetMeasures {
        area: 1.0,
        perimeter: 0.0,
    };
    let peers = [
        Peer {
            name: "geograd, area and perimeter",
            areas: Box::new(|ring| round_offset_measures(ring, d, &style).unwrap().area),
        },
        Peer {
            name: "geograd, with the derivatives of the area",
            areas: Box::new(|ring| {
                let trace = round_offset_search(ring, d, &style).unwrap();
                let mut bars = vec![Vec2::zero(); ring.len()];
                let found = round_offset_vjp(ring, d, &trace, bar, &mut bars);
                black_box((found.1, bars));
                found.0.area
            }),
        },
        Peer {
            name: "cavalier_contours, area",
            areas: Box::new(|ring| {
                let mut line = Polyline::new_closed();
                for v in ring {
                    line.add(v.x, v.y, 0.0);
                }
                line.parallel_offset(-d).iter().map(|out| out.area()).sum()
            }),
        },
    ];
    table(title, rings, 1e-6, &peers);
}

/// Offsets of footprints and of stars, outward and inward.
pub fn offsets() {
    let mut dice = Dice(23);
    let kinds: [(&str, usize, Box<dyn Fn(&mut Dice) -> Ring>); 5] = [
        ("footprints of 6 vertices", 500, Box::new(footprint)),
        ("stars of 12 vertices", 500, Box::new(|dice| star(dice, 12))),
        ("stars of 50 vertices", 200, Box::new(|dice| star(dice, 50))),
        (
            "coasts of 1000 vertices",
            20,
            Box::new(|dice| coast(dice, 1000)),
        ),
        (
            "coasts of 20,000 vertices",
            2,
            Box::new(|dice| coast(dice, 20_000)),
        ),
    ];
    for (name, count, one) in kinds {
        let rings: Vec<Ring> = (0..count).map(|_| one(&mut dice)).collect();
        for d in [0.5, -0.5] {
            chords(&format!("{name}, round, {d}"), &rings, d, Join::Round);
            chords(&format!("{name}, mitres, {d}"), &rings, d, Join::Mitre(5.0));
            arcs(&format!("{name}, exact arcs, {d}"), &rings, d);
        }
    }
}

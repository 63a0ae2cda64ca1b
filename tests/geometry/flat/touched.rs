//! Lines and rays through flat polygons, segments and corners, against whole numbers; seams of capsules.
use super::any::Dice;
use geograd::distance::Convex;
use geograd::intersection::{Chord, first_hit, length_inside, span};
use geograd::{Capsule2, Line2, Pack, Ray2, Segment2, Triangle2, Vec2};

type Whole = [i64; 2];

fn place(at: Whole) -> Vec2<f64> {
    Vec2::new(at[0] as f64, at[1] as f64)
}

/// The parameters between which a line is in the hull of corners of which no three make a turn to the right.
fn range(point: Whole, way: Whole, corners: &[Whole]) -> Option<[f64; 2]> {
    let arm = |c: &Whole| [c[0] - point[0], c[1] - point[1]];
    let side = |c: &Whole| way[0] * arm(c)[1] - way[1] * arm(c)[0];
    let along = |c: &Whole| way[0] * arm(c)[0] + way[1] * arm(c)[1];
    let square = (way[0] * way[0] + way[1] * way[1]) as f64;
    let mut all = Vec::new();
    for p in corners {
        for q in corners {
            let (s, t) = (side(p), side(q));
            if s == 0 {
                all.push(along(p) as f64 / square);
            } else if s > 0 && t < 0 {
                let over = (s - t) as f64 * square;
                all.push((along(q) * s - along(p) * t) as f64 / over);
            }
        }
    }
    let low = all.iter().copied().reduce(f64::min)?;
    Some([low, all.into_iter().fold(low, f64::max)])
}

fn judge(found: Chord<f64>, wanted: Option<[f64; 2]>, by: f64) -> bool {
    let close = |x: f64, y: f64| (x - y).abs() <= by * (1.0 + y.abs());
    match wanted {
        None => found.found == 0.0,
        Some([enter, exit]) => {
            found.found == 1.0 && close(found.enter, enter) && close(found.exit, exit)
        }
    }
}

/// A hull of whole corners in both formats: chords, hits and lengths.
fn through<A, B>(point: Whole, way: Whole, corners: &[Whole], double: A, single: B)
where
    A: Convex<f64> + std::fmt::Debug,
    B: Convex<f32>,
{
    let wanted = range(point, way, corners);
    let line = Line2::new(place(point), place(way));
    let thin = line.cast::<f32>();
    let about = || format!("{line:?} {double:?} {wanted:?}");
    let found = span(line, double);
    assert!(judge(found, wanted, 1e-13), "{} {found:?}", about());
    let found = span(thin, single);
    let wide = Chord {
        enter: found.enter.into(),
        exit: found.exit.into(),
        found: found.found.into(),
    };
    assert!(judge(wide, wanted, 2e-5), "{} {found:?}", about());
    let hit = first_hit(Ray2::new(line.point, line.direction), double);
    let ahead = wanted.filter(|range| range[1] >= -1e-13);
    // A hull that ends where the ray starts is left there or not met, as its last parameter rounds.
    if wanted.is_none_or(|range| range[1].abs() > 1e-13) {
        assert_eq!(hit.kind > 0.0, ahead.is_some(), "{} {hit:?}", about());
    }
    if hit.kind > 0.0 {
        assert!(
            (hit.normal.length() - 1.0).abs() < 1e-14,
            "{} {hit:?}",
            about()
        );
    }
    let wire = Segment2::new(line.point, line.point + line.direction);
    let inside = wanted.map_or(0.0, |[enter, exit]| {
        (exit.min(1.0) - enter.max(0.0)).max(0.0)
    });
    let length = length_inside(wire, double);
    assert!(
        (length - inside * line.direction.length()).abs() < 1e-12,
        "{} {length}",
        about()
    );
}

#[test]
fn lines_meet_hulls_as_whole_numbers_say() {
    let mut dice = Dice(71);
    let mut met = 0;
    for k in 0..20_000 {
        let mut at = || [0, 1].map(|_| dice.whole(13) as i64 - 6);
        let (point, mut way, a, b) = (at(), at(), at(), at());
        let (u, mut c) = (at(), at());
        if way == [0, 0] {
            continue;
        }
        match k % 5 {
            // On one line; repeated; a line through a corner, along a side.
            0 => c = [2 * b[0] - a[0], 2 * b[1] - a[1]],
            1 => c = a,
            2 => way = [a[0] - point[0], a[1] - point[1]],
            3 => way = [b[0] - a[0], b[1] - a[1]],
            _ => {}
        }
        let point = if k % 10 == 3 {
            [a[0] - way[0], a[1] - way[1]]
        } else {
            point
        };
        if way == [0, 0] {
            continue;
        }
        let [p, q, r] = [a, b, c].map(place);
        let wide = Triangle2::new(p, q, r);
        through(point, way, &[a, b, c], wide, wide.cast::<f32>());
        let wire = Segment2::new(p, q);
        through(point, way, &[a, b], wire, wire.cast::<f32>());
        let flat = [a, b, [2 * b[0] - a[0], 2 * b[1] - a[1]], b].map(place);
        through(
            point,
            way,
            &[a, [2 * b[0] - a[0], 2 * b[1] - a[1]]],
            flat,
            flat.map(|v| v.cast::<f32>()),
        );
        let dot = [place(u); 3];
        through(point, way, &[u], dot, dot.map(|v| v.cast::<f32>()));
        met += usize::from(range(point, way, &[a, b, c]).is_some());
    }
    assert!(met > 5000, "{met}");
}

/// The slopes of where a line enters a capsule, and the normal of a ray's hit, are those of the smooth border.
#[test]
fn seams_of_capsules_have_the_slopes_of_one_border() {
    let mut dice = Dice(72);
    for k in 0..4000 {
        // A turn by whole numbers and by five.
        let (cos, sin) = [(0.6, 0.8), (1.0, 0.0), (0.0, 1.0), (-0.8, 0.6)][k % 4];
        let turn = |x: f64, y: f64| Vec2::new(cos * x - sin * y, sin * x + cos * y);
        let digit = |dice: &mut Dice| dice.whole(21) as f64 / 10.0 - 1.0;
        let shift = Vec2::new(digit(&mut dice), digit(&mut dice));
        let (radius, height) = (
            0.1 + dice.whole(20) as f64 / 10.0,
            0.5 + dice.whole(20) as f64 / 10.0,
        );
        let link = Capsule2::new(shift, shift + turn(height, 0.0), radius);
        let seam = shift + turn(0.0, -radius);
        let way = turn(digit(&mut dice), 0.2 + dice.whole(20) as f64 / 10.0);
        let line = Line2::new(seam - way * (0.5 + dice.whole(3) as f64), way);
        let out = turn(0.0, -1.0);
        let expected = out * (-1.0 / out.dot(way));
        let (_, (by_line, _)) = geograd::gradient(
            |(line, link): (Line2<_>, Capsule2<_>)| span(line, link).enter,
            (line, link),
        );
        let off = (by_line.point - expected).length() / expected.length();
        assert!(off < 1e-10, "{line:?} {link:?} {by_line:?} {expected:?}");
        let hit = first_hit(Ray2::new(line.point, line.direction), link);
        assert!(
            (hit.normal - out).length() < 1e-10,
            "{line:?} {link:?} {hit:?}"
        );
        let (line, link) = (line.cast::<f32>(), link.cast::<f32>());
        let (_, (by_line, _)) = geograd::gradient(
            |(line, link): (Line2<_>, Capsule2<_>)| span(line, link).enter,
            (line, link),
        );
        let off = (by_line.point.cast::<f64>() - expected).length() / expected.length();
        assert!(off < 1e-2, "{line:?} {link:?} {by_line:?} {expected:?}");
    }
    // Along the side: the ray grazes it from seam to seam.
    let link = Capsule2::new(Vec2::new(2.0, 0.0), Vec2::new(2.0, 1.0), 1.0);
    let hit = first_hit(Ray2::new(Vec2::new(3.0, -3.0), Vec2::new(0.0, 3.0)), link);
    assert_eq!(
        (hit.kind, hit.parameter, hit.normal),
        (1.0, 1.0, Vec2::new(1.0, 0.0))
    );
}

//! Lines, rays and segments against solids that are thin, flat, without a radius or a point.
use super::draw::Random;
use super::exact::{self, Whole, line_in_hull, place, plus};
use geograd::intersection3::{first_hit, length_inside, span};
use geograd::prelude::*;

/// A line through a point that is a mean of some corners, or through no such point.
fn line(random: &mut Random, corners: [Whole; 4], size: usize) -> (Whole, Whole) {
    let from = exact::draw(random, size);
    let aim = (0..2).fold(corners[random.below(4)], |at, _| {
        let other = corners[random.below(4)];
        [0, 1, 2].map(|k| (at[k] + other[k]).div_euclid(2))
    });
    match random.below(5) {
        0 => (from, exact::draw(random, size)),
        // From a corner.
        1 => (corners[random.below(4)], exact::draw(random, size)),
        // Along an edge.
        2 => {
            let [a, b] = [0; 2].map(|_| corners[random.below(4)]);
            let way = exact::minus(b, a);
            (plus(a, way, random.below(4) as i128 - 2), way)
        }
        _ => (from, exact::minus(aim, from)),
    }
}

/// Corners on a grid; some hulls are flat, and some a unit thin in a larger size.
fn corners(random: &mut Random, size: usize, thin: bool) -> [Whole; 4] {
    let mut all = [0; 4].map(|_| exact::draw(random, size));
    if thin || random.below(2) == 0 {
        let axis = random.below(3);
        let height = all[0][axis];
        all.iter_mut().for_each(|corner| corner[axis] = height);
        if thin {
            all[random.below(4)][axis] += random.below(3) as i128;
        }
    }
    if !thin && random.below(4) == 0 {
        all[random.below(4)] = all[random.below(4)];
    }
    all
}

macro_rules! hulls {
    ($float:ident, $sizes:expr) => {
        let mut random = Random(0x61);
        let (mut hits, mut misses) = (0, 0);
        for round in 0..30_000 {
            let (size, thin) = $sizes[round % $sizes.len()];
            let corners = corners(&mut random, size, thin);
            let (from, way) = line(&mut random, corners, size);
            if way == [0; 3] {
                continue;
            }
            let [a, b, c, d] = corners.map(place::<$float>);
            let solid = Tetrahedron::new(a, b, c, d);
            let ray = Ray3::new(place(from), place(way));
            let (found, hit) = (span(ray.line(), solid), first_hit(ray, solid));
            let told = format!("{corners:?} {from:?} {way:?} {found:?}");
            let Some([enter, exit]) = line_in_hull(corners, from, way) else {
                misses += 1;
                assert_eq!((found.found, hit.kind), (0.0, 0.0), "{told}");
                continue;
            };
            hits += 1;
            assert_eq!(found.found, 1.0, "{told}");
            // What rounding moves the corners by is seen in units of the direction, and grows at grazing faces.
            let reach = corners.map(|corner| exact::length(exact::minus(corner, from)));
            let reach = reach.into_iter().fold(0.0, f64::max) / exact::length(way);
            let unit = 32.0 * f64::from($float::EPSILON) * reach;
            for (met, found) in [(enter, found.enter), (exit, found.exit)] {
                let error = (f64::from(found) - met.t).abs();
                assert!(error <= unit / met.sine, "{told} {met:?}");
            }
            let ahead = |t: f64| t > unit;
            if enter.t == 0.0 || ahead(enter.t - unit / enter.sine) {
                let told = format!("{told} {hit:?}");
                assert!(hit.kind == 1.0 || enter.t == 0.0 && hit.kind != 0.0, "{told}");
                let error = (f64::from(hit.parameter) - enter.t).abs();
                assert!(hit.kind == 2.0 || error <= unit / enter.sine, "{told}");
            }
            let wire = Segment3::new(ray.point, ray.point_at(1.0));
            let part = (exit.t.min(1.0) - enter.t.max(0.0)).max(0.0);
            let error = f64::from(length_inside(wire, solid)) / exact::length(way) - part;
            assert!(error.abs() <= unit / enter.sine + unit / exit.sine, "{told} {part}");
        }
        assert!(hits > 8000 && misses > 3000, "{hits} {misses}");
    };
}

#[test]
fn thin_and_flat_tetrahedra_are_hit_where_whole_numbers_say() {
    hulls!(f64, [(2, false), (4, false), (50, true), (1 << 12, true)]);
    hulls!(f32, [(2, false), (4, false), (50, true), (1 << 8, true)]);
}

#[test]
fn a_ray_past_a_thin_tetrahedron_misses_it_in_single_precision() {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let [a, b, c] = [at(-0.9, 0.6, 0.1), at(0.7, -0.6, 0.1), at(-0.7, 0.5, 0.1)];
    let solid = Tetrahedron::new(a, b, c, at(0.3, 0.7, 0.101));
    let from = at(1.2, -2.4, -1.2);
    let ray = Ray3::new(from, at(-0.8, 2.8, 1.4));
    assert_eq!(first_hit(ray, solid).kind, 0.0);
}

/// All that is a point at a place, or a segment to another.
#[test]
fn what_has_no_size_is_hit_where_it_is() {
    if !geograd_tests::is_due("what_has_no_size_is_hit_where_it_is") {
        return;
    }
    let mut random = Random(0x62);
    let mut hits = [0; 2];
    for _ in 0..20_000 {
        let [a, b, from] = [0; 3].map(|_| exact::draw(&mut random, 2));
        let way = match random.below(2) {
            0 => exact::minus(a, from),
            _ => exact::draw(&mut random, 2),
        };
        if way == [0; 3] {
            continue;
        }
        let (p, q) = (place::<f64>(a), place(b));
        let ray = Ray3::new(place(from), place(way));
        let none = Vec3::zero();
        let turn = Rotation3::identity();
        let is_met = |hull: [Whole; 4], [t, kind, length, found]: [f64; 4]| {
            let met = line_in_hull(hull, from, way);
            assert_eq!(found == 1.0, met.is_some(), "{hull:?} {from:?} {way:?}");
            let Some([enter, exit]) = met else {
                assert_eq!((kind, length), (0.0, 0.0), "{hull:?} {from:?} {way:?}");
                return;
            };
            let (part, error) = ((exit.t.min(1.0) - enter.t.max(0.0)).max(0.0), 1e-14);
            let told = format!("{hull:?} {from:?} {way:?} {t} {kind} {length} {enter:?} {exit:?}");
            assert!(
                (length - part * exact::length(way)).abs() <= error,
                "{told}"
            );
            let expected = if enter.t >= 0.0 {
                Some(enter.t)
            } else {
                (exit.t >= 0.0).then_some(exit.t)
            };
            match expected {
                None => assert_eq!(kind, 0.0, "{told}"),
                Some(expected) => {
                    assert!(kind != 0.0 && (t - expected).abs() <= error, "{told}");
                }
            }
        };
        macro_rules! all {
            ($hull:expr; $($shape:expr),*) => { $(
                let (shape, hit) = ($shape, first_hit(ray, $shape));
                let length = length_inside(Segment3::new(ray.point, ray.point_at(1.0)), shape);
                let found = span(ray.line(), shape).found;
                is_met($hull, [hit.parameter, hit.kind, length, found]);
            )* };
        }
        hits[0] += usize::from(line_in_hull([a; 4], from, way).is_some());
        all!([a; 4];
            Sphere::new(p, 0.0),
            Capsule3::new(p, p, 0.0),
            Tetrahedron::new(p, p, p, p),
            Aabb3::new(p, p),
            YawBox3::new(p, none, 0.0),
            Obb3::new(p, none, turn),
            RoundBox3::new(Obb3::new(p, none, turn), 0.0));
        if a == b {
            continue;
        }
        hits[1] += usize::from(line_in_hull([a, a, b, b], from, way).is_some());
        all!([a, a, b, b];
            Capsule3::new(p, q, 0.0),
            Cylinder::new(p, q, 0.0),
            Cone::new(p, q, 0.0),
            Tetrahedron::new(p, p, q, q),
            Tetrahedron::new(p, q, p, q));
        let (mut side, mut end) = ([0; 3], a);
        let k = random.below(3);
        (side[k], end[k]) = (2, a[k] + 2);
        let (middle, size) = (place(plus(a, side.map(|x| x / 2), 1)), place(side));
        all!([a, a, end, end];
            Aabb3::new(p, place(end)),
            Obb3::new(middle, size, turn),
            RoundBox3::new(Obb3::new(middle, size, turn), 0.0));
    }
    assert!(hits[0] > 5000 && hits[1] > 5000, "{hits:?}");
}

/// A cone along z in numbers of 53 bits: where a line enters and leaves it, and how far its ends are from the rim.
fn in_upright_cone(
    height: f64,
    radius: f64,
    from: [f64; 3],
    way: [f64; 3],
) -> Option<([f64; 2], f64)> {
    let at = |t: f64| [0, 1, 2].map(|k| from[k] + way[k] * t);
    let mut all = Vec::new();
    let mut doubt = f64::MAX;
    if way[2] != 0.0 {
        let t = (height - from[2]) / way[2];
        let aside = at(t)[0].hypot(at(t)[1]);
        doubt = (aside - radius).abs();
        if aside <= radius {
            all.push(t);
        }
    }
    let k = radius / height;
    let square = |p: [f64; 3], q: [f64; 3]| p[0] * q[0] + p[1] * q[1] - k * k * p[2] * q[2];
    let (a, b, c) = (square(way, way), square(way, from), square(from, from));
    let left = b * b - a * c;
    // Of a flat cone the quadratic has no digits left, and it is as good as its base.
    if left > 0.0 && height > 1e-3 {
        let sum = -(b + left.sqrt().copysign(b));
        for t in [sum / a, c / sum] {
            if (0.0..=height).contains(&at(t)[2]) {
                all.push(t);
            }
        }
    }
    all.sort_by(f64::total_cmp);
    Some(([*all.first()?, *all.last()?], doubt)).or(None)
}

#[test]
fn flat_cones_are_hit_inside_their_rim_only() {
    let mut random = Random(0x63);
    let (mut hits, mut misses) = (0, 0);
    for _ in 0..20_000 {
        let height = f64::from(random.power(-12.0, 0.0) as f32);
        let radius = f64::from(random.within(0.2, 1.0) as f32);
        let single = |v: Vec3<f64>| [v.x, v.y, v.z].map(|x| x as f32);
        let (from, way) = (single(random.vector(2.0)), single(random.vector(1.0)));
        let expected = in_upright_cone(height, radius, from.map(f64::from), way.map(f64::from));
        let [steep, length] = [way[2].abs(), way.iter().map(|x| x * x).sum::<f32>().sqrt()];
        if steep < 0.1 * length {
            continue;
        }
        let place = |[x, y, z]: [f32; 3]| Vec3::new(x, y, z);
        let ray = Ray3::new(place(from), place(way));
        let solid = Cone::new(
            Vec3::zero(),
            Vec3::new(0.0, 0.0, height as f32),
            radius as f32,
        );
        let found = span(ray.line(), solid);
        let unit = 64.0 * f64::from(f32::EPSILON) * 4.0;
        match expected {
            Some((_, doubt)) if doubt < 10.0 * unit => {}
            Some(([enter, exit], _)) => {
                hits += 1;
                assert_eq!(found.found, 1.0, "{ray:?} {solid:?}");
                let thick = if height > 1e-3 {
                    0.0
                } else {
                    height / f64::from(steep)
                };
                let allowed = unit / f64::from(length) + thick;
                // A flat side is nearly as smooth as a plane; a steep one is known less where the line grazes it.
                let graze = if height > 0.1 { 100.0 } else { 10.0 };
                let errors = [f64::from(found.enter) - enter, f64::from(found.exit) - exit];
                assert!(
                    errors.iter().all(|e| e.abs() < allowed * graze),
                    "{ray:?} {solid:?} {errors:?} {found:?}"
                );
            }
            None => {
                let aside = |t: f64| {
                    let [x, y] = [0, 1].map(|k| f64::from(from[k]) + f64::from(way[k]) * t);
                    x.hypot(y)
                };
                let t = (height - f64::from(from[2])) / f64::from(way[2]);
                if aside(t) > radius + unit * 10.0 && height < 0.01 {
                    misses += 1;
                    assert_eq!(found.found, 0.0, "{ray:?} {solid:?}");
                }
            }
        }
    }
    assert!(hits > 1000 && misses > 3000, "{hits} {misses}");
}

#[test]
fn lines_along_the_side_of_a_cone_and_through_its_apex() {
    let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let solid = Cone::new(at(0.0, 0.0, 0.0), at(0.0, 0.0, 1.0), 1.0);
    // On a straight line of the side: from the apex to the rim.
    let found = span(Line3::new(at(-1.0, 0.0, -1.0), at(1.0, 0.0, 1.0)), solid);
    assert_eq!((found.enter, found.exit, found.found), (1.0, 2.0, 1.0));
    // Parallel to it, above and below.
    let above = span(Line3::new(at(-0.5, 0.0, -1.0), at(1.0, 0.0, 1.0)), solid);
    assert_eq!(above.found, 0.0);
    let through = span(Line3::new(at(-1.0, 0.0, -0.5), at(1.0, 0.0, 1.0)), solid);
    assert_eq!(
        (through.enter, through.exit, through.found),
        (0.75, 1.5, 1.0)
    );
    // Across the apex.
    let touch = span(Line3::new(at(-1.0, 0.0, 0.0), at(1.0, 0.0, 0.0)), solid);
    assert_eq!((touch.enter, touch.exit, touch.found), (1.0, 1.0, 1.0));
}

#[test]
fn the_apex_of_a_cone_has_no_normal() {
    let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
    let mut random = Random(0x64);
    let mut told = 0;
    let given = Ray3::new(
        at(
            0.320_154_088_672_392_3,
            -0.788_508_360_077_492_1,
            3.105_793_123_208_424,
        ),
        at(
            1.525_300_917_571_190_5,
            4.012_693_754_946_114,
            -11.455_347_169_111_114,
        ),
    );
    let hat = Cone::new(at(1.0, 1.0, -2.0), at(2.0, -2.0, -1.0), 0.5);
    assert_eq!(first_hit(given, hat).normal, Vec3::zero());
    for _ in 0..5000 {
        let (apex, base) = (random.vector(2.0), random.vector(2.0));
        let solid = Cone::new(apex, base, random.within(0.1, 1.0));
        let from = random.vector(4.0);
        let ray = Ray3::new(from, (apex - from) * random.within(0.1, 2.0));
        let hit = first_hit(ray, solid);
        if hit.kind == 0.0 || (hit.point - apex).length() > 1e-13 {
            continue;
        }
        told += 1;
        assert_eq!(hit.normal, Vec3::zero(), "{ray:?} {solid:?} {hit:?}");
        // One-sided slopes are those of rays a little aside.
        let (t, slope): (f64, Vec3<f64>) = geograd::gradient(
            |point| first_hit(Ray3::new(point, ray.direction.lift()), solid.lift()).parameter,
            from,
        );
        for step in [at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(0.0, 0.0, 1.0)] {
            let size = 1e-6;
            let aside = |side: f64| {
                let hit = first_hit(Ray3::new(from + step * (side * size), ray.direction), solid);
                (hit.kind == 1.0).then_some((hit.parameter - t) / (side * size))
            };
            let (Some(low), Some(high)) = (aside(-1.0), aside(1.0)) else {
                continue;
            };
            let (found, slack) = (slope.dot(step), 1e-3 * (1.0 + low.abs() + high.abs()));
            let range = low.min(high) - slack..high.max(low) + slack;
            assert!(
                range.contains(&found),
                "{found} {range:?} {ray:?} {solid:?}"
            );
        }
    }
    assert!(told > 500, "{told}");
}

#[test]
fn rays_without_a_direction_hit_nothing() {
    let at = Vec3::new(0.0, 0.0, 0.0);
    let still = Ray3::new(at, at);
    let (solid, up) = (Sphere::new(at, 1.0), Vec3::new(0.0, 0.0, 1.0));
    assert_eq!(
        (
            first_hit(still, solid).kind,
            span(still.line(), solid).found
        ),
        (0.0, 0.0)
    );
    assert_eq!(first_hit(still, Plane3::new(up, 0.0)).kind, 0.0);
    assert_eq!(first_hit(still, Tetrahedron::new(at, up, up, at)).kind, 0.0);
    assert_eq!(first_hit(still, Cone::new(at, up, 1.0)).kind, 0.0);
    assert_eq!(length_inside(Segment3::new(at, at), solid), 0.0);
}

#[test]
fn points_of_hits_have_no_negative_zeros() {
    let ray: Ray3<f64> = Ray3::new(Vec3::new(0.0, -0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    let hit = first_hit(ray, Plane3::new(Vec3::new(1.0, -1.0, 0.0), 0.0));
    let miss = first_hit(ray, Sphere::new(Vec3::new(0.0, 5.0, 0.0), 1.0));
    let face = Triangle3::new(
        Vec3::new(-1.0, 0.0, -1.0),
        Vec3::new(-1.0, 0.0, 1.0),
        Vec3::new(-1.0, 1.0, 0.0),
    );
    let wire = Segment3::new(Vec3::new(0.0, -0.0, 0.0), Vec3::new(1.0, 0.0, 0.0));
    let past = geograd::intersection3::first_hit_of_segment(wire, face);
    for point in [hit.point, miss.point, past.point] {
        assert!(
            [point.x, point.y, point.z]
                .iter()
                .all(|x: &f64| x.is_sign_positive()),
            "{point:?}"
        );
    }
}

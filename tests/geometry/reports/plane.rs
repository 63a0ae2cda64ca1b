//! Distances, meetings and hits in the plane.
use super::{Report, flag};
use crate::polygon::exact::{Big, Point, points, side};
use geograd::distance::{closest_points, distance};
use geograd::intersection::{crossing_of_lines, first_hit, meeting_of_segments};
use geograd::{Aabb2, Line2, Ray2, Segment2, Triangle2, Vec2, contain};

fn at(x: f64, y: f64) -> Vec2<f64> {
    Vec2::new(x, y)
}

fn segment([a, b]: [[f64; 2]; 2]) -> Segment2<f64> {
    Segment2::new(at(a[0], a[1]), at(b[0], b[1]))
}

/// Whether two segments share a point, by the signs of exact areas; not for segments on one line.
fn meet(a: Segment2<f64>, b: Segment2<f64>) -> bool {
    let [p, q, r, s]: [Point; 4] = points(&[a.from, a.to, b.from, b.to]).try_into().unwrap();
    let signs =
        |a: &Point, b: &Point, c: &Point, d: &Point| side(a, b, c).sign() * side(a, b, d).sign();
    signs(&p, &q, &r, &s) <= 0 && signs(&r, &s, &p, &q) <= 0
}

/// The crossing of the lines through the ends of the two segments of a survey, seen from a place near it.
fn crossing(a: Segment2<f64>, b: Segment2<f64>) -> Vec<f64> {
    let [p, q, r, s]: [Point; 4] = points(&[a.from, a.to, b.from, b.to]).try_into().unwrap();
    let before = side(&r, &s, &p);
    let share: Big = before.div(&before.sub(&side(&r, &s, &q)));
    let place = |k: usize, from: f64| {
        let whole = p[k].add(&share.mul(&q[k].sub(&p[k])));
        whole.sub(&Big::new(from)).to_f64()
    };
    vec![place(0, 35_613_477.0), place(1, 4_257_160.0)]
}

/// The least distance of the ends of two segments that do not meet from the other one.
fn from_ends(a: Segment2<f64>, b: Segment2<f64>) -> f64 {
    let from = |p: Vec2<f64>, s: Segment2<f64>| {
        let d = s.to - s.from;
        let t = ((p - s.from).dot(d) / d.dot(d)).clamp(0.0, 1.0);
        (p - s.from - d * t).length()
    };
    [
        from(a.from, b),
        from(a.to, b),
        from(b.from, a),
        from(b.to, a),
    ]
    .into_iter()
    .fold(f64::INFINITY, f64::min)
}

fn survey() -> [Segment2<f64>; 2] {
    [
        segment([
            [35_613_471.616_501_7, 4_257_145.306_132_293_3],
            [35_613_477.770_537_8, 4_257_160.528_222_710_8],
        ]),
        segment([
            [35_613_477.775_057_241, 4_257_160.539_653_535_9],
            [35_613_479.856_073_894, 4_257_165.923_691_703_9],
        ]),
    ]
}

fn radii() -> [Segment2<f64>; 2] {
    [
        segment([[0.0, 0.0], [-10.0, 1.224_646_799_147_353_3e-15]]),
        segment([
            [-9.999_143_275_740_073, -0.130_895_955_713_339_78],
            [-10.0, 1.053_567_635_648_676_8e-13],
        ]),
    ]
}

fn drawn() -> [Segment2<f64>; 2] {
    [
        segment([
            [2.235_209_282_240_780_3, -1.706_800_488_570_597_2],
            [1.435_750_776_440_373_4, -4.418_812_812_904_743_5],
        ]),
        segment([
            [1.851_532_387_737_966_6, -1.593_698_584_852_416_6],
            [1.217_103_403_539_870_7, -3.745_879_356_682_983],
        ]),
    ]
}

fn bar() -> (Segment2<f64>, Triangle2<f64>) {
    let x = -0.170_841_376_919_851_02;
    let tip = at(-0.107_813_914_057_218_02, -0.154_336_108_625_746_43);
    let (up, down) = (
        at(-0.785_527_623_661_521_1, 0.236_942_084_047_797_95),
        at(-0.785_527_623_661_521_4, -0.545_614_301_299_290_7),
    );
    (
        segment([[x, 0.874_808_549_301_665_7], [x, 0.098_588_703_124_379_06]]),
        Triangle2::new(tip, up, down),
    )
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "locationtech/jts",
            number: 464,
            about: "a crossing off by 6·10⁻³",
            asked: "the crossing of two nearly parallel lines at 3.6·10⁷, less (35613477, 4257160)",
            source: "numbers of 320 binary places",
            found: || {
                let [a, b] = survey();
                let found =
                    crossing_of_lines(Line2::through(a.from, a.to), Line2::through(b.from, b.to))
                        .point;
                vec![found.x - 35_613_477.0, found.y - 4_257_160.0]
            },
            right: || {
                let [a, b] = survey();
                crossing(a, b)
            },
            within: 1e-7,
        },
        Report {
            library: "locationtech/jts",
            number: 270,
            about: "`intersects` says no, `intersection` is a point",
            asked: "whether two segments that pass 10⁻¹³ from one another meet, and whether their distance is 0",
            source: "signs of exact areas",
            found: || {
                let [a, b] = radii();
                vec![
                    flag(meeting_of_segments(a, b).kind > 0.0),
                    flag(distance(a, b) == 0.0),
                ]
            },
            right: || {
                let [a, b] = radii();
                let is = flag(meet(a, b));
                vec![is, is]
            },
            within: 0.0,
        },
        Report {
            library: "Turfjs/turf",
            number: 2948,
            about: "one meeting of two: the start that lies on an edge was missed",
            asked: "the meetings of a segment whose ends lie on two edges: kinds and x",
            source: "definition: ends belong to segments",
            found: || {
                let bridge = segment([[3.0, 2.0], [4.0, 2.0]]);
                [[[4.0, 0.0], [4.0, 4.0]], [[3.0, 4.0], [3.0, 1.0]]]
                    .map(segment)
                    .iter()
                    .flat_map(|edge| {
                        let part = meeting_of_segments(bridge, *edge);
                        [part.kind, part.from.x]
                    })
                    .collect()
            },
            right: || vec![1.0, 4.0, 1.0, 3.0],
            within: 0.0,
        },
        Report {
            library: "georust/geo",
            number: 370,
            about: "1.569 one way round, 1 the other",
            asked: "the distance of two segments, both ways round",
            source: "closed form 1",
            found: || {
                let (a, b) = (segment([[0., 0.], [5., 0.]]), segment([[2., 1.], [7., 2.]]));
                vec![distance(a, b), distance(b, a)]
            },
            right: || vec![1.0, 1.0],
            within: 0.0,
        },
        Report {
            library: "georust/geo",
            number: 138,
            about: "6.8·10⁻²⁰",
            asked: "the distance of a point on the border of a square of side 0.0004",
            source: "definition: the border belongs to it",
            found: || {
                vec![distance(
                    at(0.0001, 0.0),
                    [
                        at(0.0, 0.0),
                        at(0.0004, 0.0),
                        at(0.0004, 0.0004),
                        at(0.0, 0.0004),
                    ],
                )]
            },
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "georust/geo",
            number: 476,
            about: "another distance than that of the nearest edge",
            asked: "the distance of a segment and a triangle",
            source: "the segment's end and the nearest edge, in coordinates",
            found: || {
                let (a, b) = bar();
                vec![distance(a, b)]
            },
            right: || {
                let (a, b) = bar();
                vec![
                    [[b.a, b.b], [b.b, b.c], [b.c, b.a]]
                        .into_iter()
                        .map(|[p, q]| from_ends(a, Segment2::new(p, q)))
                        .fold(f64::INFINITY, f64::min),
                ]
            },
            within: 1e-15,
        },
        Report {
            library: "georust/geo",
            number: 473,
            about: "every point",
            asked: "whether a triangle of three equal corners contains another point, and its own",
            source: "definition",
            found: || {
                let o = at(0.0, 0.0);
                let t = Triangle2::new(o, o, o);
                vec![flag(t.contains(at(0.0, 1.23456))), flag(t.contains(o))]
            },
            right: || vec![0.0, 1.0],
            within: 0.0,
        },
        Report {
            library: "dimforge/parry",
            number: 431,
            about: "3.7105 one way round, 3.5732 the other",
            asked: "the distance of boxes 2 by 2 and 2 by 4, both ways round, `f32`",
            source: "closed form: the way along x less two half sides",
            found: || {
                let far = -5.573_167_f32;
                let (a, b) = (
                    Aabb2::new(-1.0, -1.0, 1.0, 1.0),
                    Aabb2::new(far - 1.0, -2.0, far + 1.0, 2.0),
                );
                vec![distance(a, b).into(), distance(b, a).into()]
            },
            right: || vec![f64::from(5.573_167_f32) - 2.0; 2],
            within: 1e-6,
        },
        Report {
            library: "davideberly/GeometricTools",
            number: 40,
            about: "two starts, which are not the closest points",
            asked: "the distance of two nearly parallel segments, and that of their closest points",
            source: "four distances of an end from the other segment",
            found: || {
                let [a, b] = drawn();
                let pair = closest_points(a, b);
                vec![distance(a, b), pair.on_a.distance(pair.on_b)]
            },
            right: || {
                let [a, b] = drawn();
                vec![from_ends(a, b); 2]
            },
            within: 1e-15,
        },
        Report {
            library: "RiSearcher/GeometRi.CSharp",
            number: 16,
            about: "10.02",
            asked: "the distance of two parallel segments beside each other",
            source: "closed form 401.53 − 399.83",
            found: || {
                vec![distance(
                    segment([[399.83, 273.22], [399.83, 253.56]]),
                    segment([[401.53, 283.1], [401.53, 272.6]]),
                )]
            },
            right: || vec![401.53 - 399.83],
            within: 1e-12,
        },
        Report {
            library: "io7m-com/jspatial",
            number: 7,
            about: "a miss, by 0 times infinity",
            asked: "the hit of a ray along the lower side of a box: kind and parameter",
            source: "closed form 32 − 16",
            found: || {
                let hit = first_hit(
                    Ray2::new(at(16.0, 32.0), at(1.0, 0.0)),
                    Aabb2::new(32.0, 32.0, 96.0, 96.0),
                );
                vec![hit.kind, hit.parameter]
            },
            right: || vec![1.0, 16.0],
            within: 0.0,
        },
        Report {
            library: "rustgd/collision-rs",
            number: 25,
            about: "a hit at (6, 14)",
            asked: "the kind of hit of an upright ray 15 beside a box",
            source: "definition: a miss",
            found: || {
                vec![
                    first_hit(
                        Ray2::new(at(6.0, 0.0), at(0.0, 1.0)),
                        Aabb2::new(21.0, 14.0, 23.0, 16.0),
                    )
                    .kind,
                ]
            },
            right: || vec![0.0],
            within: 0.0,
        },
        Report {
            library: "rowanwins/point-in-polygon-hao",
            number: 24,
            about: "outside, where a vertex is as high as the point",
            asked: "whether quadrilaterals contain (2, 0), (1, 1); (0, 0)",
            source: "definition",
            found: || {
                let kite = [at(0., 0.), at(3., -1.), at(4., 1.), at(1., 2.)];
                let diamond = [at(-1., 0.), at(0., -1.), at(1., 0.), at(0., 1.)];
                vec![
                    flag(contain::contains(&[&kite], at(2., 0.))),
                    flag(contain::contains(&[&kite], at(1., 1.))),
                    flag(contain::contains(&[&diamond], at(0., 0.))),
                ]
            },
            right: || vec![1.0; 3],
            within: 0.0,
        },
        Report {
            library: "kellydunn/golang-geo",
            number: 66,
            about: "a corner is outside, a side inside",
            asked: "whether a square contains a corner, a point of a side, one inside, one outside",
            source: "definition: the border belongs to it",
            found: || {
                let square = [at(0., 0.), at(1., 0.), at(1., 1.), at(0., 1.)];
                [at(0., 0.), at(0.5, 0.), at(0.5, 0.7), at(2., 8.)]
                    .map(|p| flag(contain::locate(&[&square], p) != contain::Location::Off(0)))
                    .to_vec()
            },
            right: || vec![1.0, 1.0, 1.0, 0.0],
            within: 0.0,
        },
        Report {
            library: "sromku/polygon-contains-point",
            number: 3,
            about: "outside at height 4, inside at 3.9 and 4.1",
            asked: "whether a polygon contains (3, 3.9), (3, 4), (3, 4.1)",
            source: "definition",
            found: || {
                let ring = [
                    at(0., 0.),
                    at(0., 1.),
                    at(1., 2.),
                    at(1., 99.),
                    at(100., 0.),
                ];
                [3.9, 4.0, 4.1]
                    .map(|y| flag(contain::contains(&[&ring], at(3., y))))
                    .to_vec()
            },
            right: || vec![1.0; 3],
            within: 0.0,
        },
    ]
}

//! Scores as their papers and the detection libraries define them, by formulas that share nothing with ours;
//! ranges, invariances, and what far pairs keep.
use super::exact;
use geograd::iou::*;
use geograd::{Aabb2, ConvexPolygon, Jet, Obb2, Scalar, Vec2};
use geograd_tests::Dice;

/// torchvision's `generalized_box_iou`, `distance_box_iou` and `complete_box_iou` without the 1e-7 that two of
/// them add, and EIoU by its paper.
fn published([x1, y1, x2, y2]: [f64; 4], [x3, y3, x4, y4]: [f64; 4]) -> [f64; 4] {
    let (w, h) = (x2 - x1, y2 - y1);
    let (u, t) = (x4 - x3, y4 - y3);
    let inter = (x2.min(x4) - x1.max(x3)).max(0.0) * (y2.min(y4) - y1.max(y3)).max(0.0);
    let union = w * h + u * t - inter;
    let iou = inter / union;
    let (wide, high) = (x2.max(x4) - x1.min(x3), y2.max(y4) - y1.min(y3));
    let giou = iou - (wide * high - union) / (wide * high);
    let way = ((x3 + x4 - x1 - x2) / 2.0).powi(2) + ((y3 + y4 - y1 - y2) / 2.0).powi(2);
    let diou = iou - way / (wide * wide + high * high);
    let v = 4.0 / std::f64::consts::PI.powi(2) * ((w / h).atan() - (u / t).atan()).powi(2);
    let alpha = if v > 0.0 { v / (1.0 - iou + v) } else { 0.0 };
    let eiou = diou - ((w - u) / wide).powi(2) - ((h - t) / high).powi(2);
    [giou, diou, diou - alpha * v, eiou]
}

fn aligned(x: [f64; 4]) -> Aabb2<f64> {
    Aabb2::new(x[0], x[1], x[2], x[3])
}

/// Random pairs, and pairs that touch, are nested, share sides, are far apart, thin, small or large.
fn pairs() -> Vec<([f64; 4], [f64; 4])> {
    let mut dice = Dice(141);
    let mut all = vec![];
    for k in 0..400 {
        let mut one = || {
            let (x, y) = (dice.within(-4.0, 4.0), dice.within(-4.0, 4.0));
            [x, y, x + dice.within(0.1, 5.0), y + dice.within(0.1, 5.0)]
        };
        let (mut a, mut b) = (one(), one());
        match k % 8 {
            1 => b = a,
            2 => (b[0], b[2]) = (a[2], a[2] + 1.0),
            3 => b = [a[0] + 0.01, a[1] + 0.01, a[2] - 0.01, a[3] - 0.01],
            4 => (b[0], b[2]) = (a[0], a[2]),
            5 => b = b.map(|x| x + 1e3),
            6 => a[3] = a[1] + 1e-3,
            7 => (a, b) = (a.map(|x| x * 1e-9), b.map(|x| x * 1e-9)),
            _ => {}
        }
        all.push((a, b));
    }
    all
}

#[test]
fn plain_verbs_of_axis_aligned_boxes_are_the_published_ones() {
    for (a, b) in pairs() {
        let want = published(a, b);
        let (a, b) = (aligned(a), aligned(b));
        let found = [
            giou_aabb2(a, b),
            diou_aabb2(a, b),
            ciou_aabb2(a, b),
            eiou_aabb2(a, b),
        ];
        for (found, want) in found.iter().zip(want) {
            assert!((found - want).abs() < 1e-11, "{a} {b} {found} {want}");
        }
        assert_eq!(a.giou(b), giou_aabb2(a, b));
    }
    // `generalized_box_iou` of torchvision's documentation: boxes that meet in a corner have −1/2.
    let (a, b) = (
        Aabb2::new(0.0, 0.0, 1.0, 1.0),
        Aabb2::new(1.0, 1.0, 2.0, 2.0),
    );
    assert_eq!(giou_aabb2(a, b), -0.5);
}

type Score = fn(Obb2<f64>, Obb2<f64>) -> f64;

/// Plain verbs of rotated boxes, and the least that they can be.
const TURNED: [(&str, Score, f64); 4] = [
    ("giou", giou_obb2, -1.0),
    ("diou", diou_obb2, -1.0),
    ("ciou", ciou_obb2, -1.5),
    ("eiou", eiou_obb2, -2.5),
];
/// Their variants, which are not invariant under rotations.
const ALONG: [(&str, Score, f64); 4] = [
    ("giou_aabb", giou_aabb_obb2, -1.0),
    ("diou_aabb", diou_aabb_obb2, -1.0),
    ("ciou_aabb", ciou_aabb_obb2, -1.5),
    ("eiou_aabb", eiou_aabb_obb2, -3.0),
];

/// Sizes of all kinds, mixed within one pair.
fn hostile(dice: &mut Dice) -> Obb2<f64> {
    let length = |dice: &mut Dice| {
        let all = [0.0, 1e-12, 1e-3, 1.0, 4.0, 1e3];
        all[dice.below(6)]
    };
    let turn = [0.0, 0.25, 0.5, 1.0, 0.3][dice.below(5)];
    let mut place = || [0.0, 0.0, 1.0, -2.0, 1e3][dice.below(5)];
    let (x, y) = (place(), place());
    let (w, h) = (length(dice), length(dice));
    Obb2::new(x, y, w, h, turn * std::f64::consts::PI)
}

#[test]
fn scores_stay_in_their_ranges_and_do_not_turn() {
    let mut dice = Dice(142);
    let mut least = [0.0_f64; 4];
    for k in 0..4000 {
        let (a, b) = match k % 2 {
            0 => (hostile(&mut dice), hostile(&mut dice)),
            _ => (dice.obb(), dice.obb()),
        };
        let iou = a.iou(b);
        let angle = dice.within(-3.0, 3.0);
        let turned = |x: Obb2<f64>| {
            let (s, c) = angle.sin_cos();
            let at = x.center;
            let at = Vec2::new(c * at.x - s * at.y, s * at.x + c * at.y);
            Obb2::new(at.x, at.y, x.size.x, x.size.y, x.heading + angle)
        };
        let thin = a.size.x.min(a.size.y).min(b.size.x.min(b.size.y)) < 1e-2;
        for (i, (name, score, low)) in TURNED.into_iter().enumerate() {
            let value = score(a, b);
            assert!(value >= low && value <= iou, "{name} {a} {b} {value}");
            // Rounding decides the shared area of boxes of almost no area, and the part of their hull that
            // they cover.
            let sides = [a.size.x, a.size.y, b.size.x, b.size.y];
            let longest = sides
                .into_iter()
                .fold(a.center.distance(b.center), f64::max);
            let vague = sides.iter().any(|x| *x < 1e-8 * longest);
            if vague && (name == "giou" || iou > 0.0) {
                continue;
            }
            assert!((score(b, a) - value).abs() < 1e-9, "{name} {a} {b}");
            least[i] = least[i].min(value);
            let moved = score(turned(a), turned(b));
            let slack = if thin { 1e-6 } else { 1e-11 };
            // IoU of boxes without a width has no digits.
            if iou == 0.0 || !thin {
                assert!(
                    (moved - value).abs() < slack,
                    "{name} {a} {b} {value} {moved}"
                );
            }
        }
        for (name, score, low) in ALONG {
            let value = score(a, b);
            assert!(value >= low && value <= iou, "{name} {a} {b} {value}");
        }
        let (c, d) = (a.bounding(), b.bounding());
        let iou = c.iou(d);
        for (value, low) in [
            (giou_aabb2(c, d), -1.0),
            (giou_hull_aabb2(c, d), -1.0),
            (diou_aabb2(c, d), -1.0),
            (diou_hull_aabb2(c, d), -1.0),
            (ciou_aabb2(c, d), -1.5),
            (ciou_hull_aabb2(c, d), -1.5),
            (eiou_aabb2(c, d), -2.25),
            (eiou_hull_aabb2(c, d), -2.5),
        ] {
            assert!(value >= low && value <= iou, "{c} {d} {value} {low}");
        }
    }
    assert!(least[0] < -0.99 && least[1] < -0.99, "{least:?}");
    // Two segments in one place that are as long as wide and as wide as long.
    let (a, b) = (
        Obb2::new(0.0, 0.0, 4.0, 0.0, 0.0),
        Obb2::new(0.0, 0.0, 0.0, 4.0, std::f64::consts::FRAC_PI_2),
    );
    assert!((eiou_obb2(a, b) + 2.0).abs() < 1e-15);
}

/// A box along another one's own axis counted sizes by a side of the box around both, however small that is.
#[test]
fn efficient_iou_of_turned_boxes_has_a_bound() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let (a, b) = (
        Obb2::new(0.0, 0.0, 10.0, 0.1, quarter),
        Obb2::new(0.0, 0.0, 0.1, 0.1, 0.0),
    );
    let hull = 0.01 - (9.9 * 9.9) / (100.0 + 0.01);
    assert!((eiou_obb2(a, b) - hull).abs() < 1e-12);
    assert!((eiou_aabb_obb2(a, b) - (0.01 - 0.99 * 0.99)).abs() < 1e-12);
    let (a, b) = (
        Obb2::new(0.0, 0.0, 4.0, 1.0, quarter),
        Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0),
    );
    assert!((eiou_obb2(a, b) - (0.25 - 9.0 / 17.0)).abs() < 1e-12);
    assert!((eiou_aabb_obb2(a, b) - (0.25 - 9.0 / 16.0)).abs() < 1e-12);
}

/// Bounds whose differences are subnormal or as large as numbers are, and boxes without area.
#[test]
fn distance_iou_of_flat_boxes_is_no_less_than_minus_one() {
    let (a, b) = (
        Aabb2::new(0.0, -8.99e307, 0.0, -8.99e307),
        Aabb2::new(-4.49e307, 0.0, -4.49e307, 0.1),
    );
    assert_eq!(diou_aabb2(a, b), -1.0);
    assert_eq!(diou_hull_aabb2(a, b), -1.0);
    let mut dice = Dice(143);
    for _ in 0..20_000 {
        let mut number = || {
            let size = 10.0_f64.powf(dice.within(-320.0, 308.2));
            [0.0, size, -size, 1.0][dice.below(4)]
        };
        let mut bounds = || {
            let (x, y, u, v) = (number(), number(), number(), number());
            match number() > 0.0 {
                true => Aabb2::new(x.min(u), y.min(v), x.max(u), y.max(v)),
                false => Aabb2::new(x, y.min(v), x, y.max(v)),
            }
        };
        let (a, b) = (bounds(), bounds());
        let one = |x: Aabb2<f64>| {
            Aabb2::new(
                x.min.x as f32,
                x.min.y as f32,
                x.max.x as f32,
                x.max.y as f32,
            )
        };
        let fits = [a, b].into_iter().all(|x| {
            [x.min.x, x.min.y, x.max.x, x.max.y]
                .into_iter()
                .all(|x| x.abs() < f64::from(f32::MAX))
        });
        for score in [giou_aabb2, giou_hull_aabb2, diou_aabb2, diou_hull_aabb2] {
            let value = score(a, b);
            assert!((-1.0..=1.0).contains(&value), "{a} {b} {value}");
        }
        for score in [giou_aabb2, giou_hull_aabb2, diou_aabb2, diou_hull_aabb2] {
            let value = if fits { score(one(a), one(b)) } else { 0.0 };
            assert!((-1.0..=1.0).contains(&value), "{a} {b} {value}");
        }
    }
}

/// The diameter and the area of a hull by all pairs of corners and by a monotone chain.
#[test]
fn hulls_are_those_of_all_corners() {
    let mut dice = Dice(144);
    for _ in 0..300 {
        let (a, b) = (dice.obb(), dice.obb());
        let corners: Vec<_> = a.corners().into_iter().chain(b.corners()).collect();
        let far = corners
            .iter()
            .flat_map(|p| corners.iter().map(move |q| p.distance(*q)))
            .fold(0.0, f64::max);
        let hull = exact::ring_area(&exact::hull(&corners));
        let iou = a.iou(b);
        let union = (a.area() + b.area()) / (1.0 + iou);
        let way = a.center.distance(b.center);
        assert!((diou_obb2(a, b) - (iou - (way / far).powi(2))).abs() < 1e-12);
        assert!((giou_obb2(a, b) - (iou - (hull - union) / hull)).abs() < 1e-12);
    }
}

/// In single precision centroids far from the origin have no digits below a thousandth.
#[test]
fn distance_iou_of_polygons_far_from_the_origin_keeps_its_digits() {
    fn triangles<S: Scalar>() -> [ConvexPolygon<S, 3>; 2] {
        let at = |corners: [[f64; 2]; 3]| {
            let corners = corners.map(|[x, y]| Vec2::new(S::lit(x), S::lit(y)));
            ConvexPolygon {
                vertices: corners,
                count: 3,
            }
        };
        [
            at([
                [10000.9931640625, 10000.11328125],
                [9999.99609375, 9999.0],
                [10000.5595703125, 9999.1708984375],
            ]),
            at([
                [9999.6337890625, 10000.9462890625],
                [9999.41796875, 9999.728515625],
                [10000.5322265625, 9999.2275390625],
            ]),
        ]
    }
    let [a, b] = triangles::<f64>();
    let truth = diou_polygons_search(&a, &b).0;
    assert!((truth + 0.156_969_04).abs() < 1e-8, "{truth}");
    let near = |x: ConvexPolygon<f64, 3>| ConvexPolygon {
        vertices: x.vertices.map(|v| Vec2::new(v.x - 1e4, v.y - 1e4)),
        count: 3,
    };
    assert!((diou_polygons_search(&near(a), &near(b)).0 - truth).abs() < 1e-15);
    let [a, b] = triangles::<f32>();
    let (found, record) = diou_polygons_search(&a, &b);
    assert!((f64::from(found) - truth).abs() < 2e-7, "{found} {truth}");
    // Its derivatives, too, are those of the same triangles at the origin.
    let derivative = |x: f64| {
        let [a, mut b] = triangles::<Jet<f64, 1>>();
        let [c, d] = [&mut a.clone(), &mut b];
        for v in c.vertices.iter_mut().chain(&mut d.vertices) {
            v.x -= Jet::lit(x);
            v.y -= Jet::lit(x);
        }
        d.vertices[1].x.derivative[0] = 1.0;
        diou_polygons_replay(c, d, record).derivative[0]
    };
    assert!((derivative(0.0) - derivative(1e4)).abs() < 1e-12);
}

#[test]
fn giou_of_polygons_far_apart_keeps_the_area_of_the_far_one() {
    let at = |corners: &[(f32, f32)]| -> ConvexPolygon<f32, 5> {
        let corners: Vec<Vec2<f32>> = corners.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        ConvexPolygon::try_new(&corners).unwrap()
    };
    let far = at(&[
        (101_700_000.0, -102_300_000.0),
        (101_800_000.0, -102_300_000.0),
        (101_800_000.0, -102_200_000.0),
        (101_700_000.0, -102_200_000.0),
    ]);
    let near = at(&[(-7e5, 1e5), (-5e5, 1e5), (0.0, 2e5)]);
    let wide = |a: &ConvexPolygon<f32, 5>| ConvexPolygon::<f64, 5> {
        vertices: a
            .vertices
            .map(|v| Vec2::new(f64::from(v.x), f64::from(v.y))),
        count: a.count,
    };
    let (found, _) = giou_polygons_search::<f32, 5, 5, 10>(&near, &far).unwrap();
    let (known, _) = giou_polygons_search::<f64, 5, 5, 10>(&wide(&near), &wide(&far)).unwrap();
    // Not one unit in the last place more: the area of the far one is 4·10⁻⁴ of the hull's.
    assert!((f64::from(found) - known).abs() < 1e-7, "{found} {known}");
}

//! Smallest circles and rectangles, hulls, centroids.
use super::{Report, flag};
use crate::polygon::exact;
use geograd::hull::{hull_area_search, hull_search};
use geograd::measure::circle::circle_search;
use geograd::measure::rectangle::rectangle_search;
use geograd::{Vec2, ring};

const PAIRS: &str = "enumeration of all pairs and triples";
const SIDES: &str = "enumeration of the sides of the hull";
const HULL: &str = "hull by enumeration, in numbers of 320 binary places";

fn points(all: &[[f64; 2]]) -> Vec<Vec2<f64>> {
    all.iter().map(|&[x, y]| Vec2::new(x, y)).collect()
}

/// The radius of the smallest circle: the least of two points' and of three points' circles that has all inside.
fn least_circle(all: &[Vec2<f64>]) -> f64 {
    let mut least = f64::INFINITY;
    let mut offer = |center: Vec2<f64>, radius: f64| {
        if all
            .iter()
            .all(|p| p.distance(center) <= radius * (1.0 + 1e-12))
        {
            least = least.min(radius);
        }
    };
    for (i, &a) in all.iter().enumerate() {
        for (j, &b) in all[..i].iter().enumerate() {
            offer((a + b) * 0.5, a.distance(b) / 2.0);
            for &c in &all[..j] {
                let (p, q) = (b - a, c - a);
                let twice = 2.0 * p.perp_dot(q);
                if twice != 0.0 {
                    let (s, t) = (p.dot(p), q.dot(q));
                    let way = Vec2::new((q.y * s - p.y * t) / twice, (p.x * t - q.x * s) / twice);
                    offer(a + way, way.length());
                }
            }
        }
    }
    least
}

/// The least area of the rectangles along a side of the hull.
fn least_rectangle(all: &[Vec2<f64>]) -> f64 {
    let mut least = f64::INFINITY;
    for &a in all {
        for &b in all {
            let d = b - a;
            let (along, across): (Vec<f64>, Vec<f64>) = all
                .iter()
                .map(|&p| (d.dot(p - a), d.perp_dot(p - a)))
                .unzip();
            let extent = |x: &[f64]| {
                let low = x.iter().copied().fold(f64::INFINITY, f64::min);
                (low, x.iter().copied().fold(-f64::INFINITY, f64::max) - low)
            };
            let ((_, length), (low, height)) = (extent(&along), extent(&across));
            if d.dot(d) > 0.0 && low >= 0.0 {
                least = least.min(length * height / d.dot(d));
            }
        }
    }
    least
}

fn circle(all: &[[f64; 2]]) -> Vec<f64> {
    let (found, _) = circle_search(&points(all)).unwrap();
    vec![found.radius]
}

/// The least rectangle's area, and whether it has all points inside, to rounding.
fn rectangle(all: &[[f64; 2]]) -> Vec<f64> {
    let all = points(all);
    let (found, _) = rectangle_search(&all).unwrap();
    let slack = 1e-12 * (found.size.x + found.size.y);
    let inside = all
        .iter()
        .all(|&p| geograd::distance::distance(p, found) <= slack);
    vec![found.area(), flag(inside)]
}

fn hull(all: &[[f64; 2]]) -> Vec<f64> {
    let all = points(all);
    vec![hull_search(&all).len() as f64, hull_area_search(&all).0]
}

fn hull_right(all: &[[f64; 2]]) -> Vec<f64> {
    let around = exact::hull(&points(all));
    vec![around.len() as f64, exact::ring_area(&around)]
}

const FLAT: [[f64; 2]; 3] = [[0.0, 0.0], [0.5, 0.01], [1.0, 0.0]];
const THREE: [[f64; 2]; 3] = [[200.0, 100.0], [240.0, 150.0], [200.0, 250.0]];
const PATTERN: [[f64; 2]; 8] = [
    [1., 2.],
    [2., 3.],
    [2., 2.],
    [2., 1.],
    [3., 4.],
    [3., 3.],
    [3., 1.],
    [4., 4.],
];
const CONTOUR: [[f64; 2]; 15] = [
    [16., 8.],
    [14., 10.],
    [13., 10.],
    [10., 13.],
    [9., 13.],
    [7., 15.],
    [6., 15.],
    [5., 16.],
    [5., 43.],
    [9., 39.],
    [10., 39.],
    [14., 35.],
    [15., 35.],
    [17., 33.],
    [17., 8.],
];
const SCAN: [[f64; 2]; 11] = [
    [7826., 5663.],
    [4190., 5685.],
    [882., 5699.],
    [879., 5390.],
    [871., 2696.],
    [865., 558.],
    [870., 140.],
    [7369., 119.],
    [7797., 119.],
    [7825., 5314.],
    [7826., 5598.],
];
const SLIVER: [[f64; 2]; 4] = [
    [188.8991, 12.400669],
    [80.64467, -49.644814],
    [469.59897, 173.28242],
    [690.4597, 299.86768],
];
const FIVE: [[f64; 2]; 5] = [[1., 1.], [1., 5.], [3., 6.], [4., 2.], [5., 5.]];
const TWIN: [[f64; 2]; 8] = [
    [-0.2, -0.1],
    [1.387_778_78e-17, -0.1],
    [0.2, -0.1],
    [-1.387_778_78e-17, -0.1],
    [-0.2, 0.1],
    [1.387_778_78e-17, 0.1],
    [0.2, 0.1],
    [-1.387_778_78e-17, 0.1],
];
const NOTCH: [[f64; 2]; 4] = [[22., 22.], [157., 447.], [146., 284.], [353., 22.]];
const FOUR: [[f64; 2]; 4] = [
    [223.25, 30.],
    [214.66796875, 53.6015625],
    [213.79296875, 38.6015625],
    [211.41796875, 29.2265625],
];
const BODY: [[f64; 2]; 5] = [
    [-1.70082211, -1.43221712],
    [0.5, -0.5],
    [0.104992867, 0.97400856],
    [-0.658002853, 0.926608086],
    [-0.994554818, 0.165337861],
];
const GRID: [[f32; 2]; 6] = [
    [813_580.3, 817_846.6],
    [813_544.4, 817_952.9],
    [813_529.3, 817_947.8],
    [813_517.7, 817_943.9],
    [813_462.3, 817_923.8],
    [813_290.44, 817_857.06],
];
const DECIMAL: [[f64; 2]; 6] = [
    [813_580.3, 817_846.6],
    [813_544.4, 817_952.9],
    [813_529.3, 817_947.8],
    [813_517.7, 817_943.9],
    [813_462.3, 817_923.8],
    [813_290.44, 817_857.06],
];
const SPIKE: [[f64; 2]; 6] = [
    [10.977_073_9, 45.396_393_9],
    [10.976_983_3, 45.396_418_3],
    [10.976_959_7, 45.396_374_9],
    [10.977_076_5, 45.396_343_3],
    [10.976_959_7, 45.396_374_9],
    [10.976_983_3, 45.396_418_3],
];

fn grid() -> Vec<[f64; 2]> {
    GRID.iter().map(|p| p.map(f64::from)).collect()
}

pub fn reports() -> Vec<Report> {
    vec![
        Report {
            library: "opencv/opencv",
            number: 6438,
            about: "radius 12.505",
            asked: "the radius of the smallest circle of three points nearly on a line",
            source: PAIRS,
            found: || circle(&FLAT),
            right: || vec![least_circle(&points(&FLAT))],
            within: 1e-15,
        },
        Report {
            library: "opencv/opencv",
            number: 9797,
            about: "a wrong circle of exactly three points",
            asked: "the radius of the smallest circle of three points, and with a fourth inside it",
            source: PAIRS,
            found: || {
                let mut all = THREE.to_vec();
                let three = circle(&all)[0];
                all.push([230.0, 190.0]);
                vec![three, circle(&all)[0]]
            },
            right: || vec![least_circle(&points(&THREE)); 2],
            within: 1e-12,
        },
        Report {
            library: "pysal/pointpats",
            number: 75,
            about: "two libraries' circles differ",
            asked: "the radius of the smallest circle of eight points of a grid",
            source: PAIRS,
            found: || circle(&PATTERN),
            right: || vec![least_circle(&points(&PATTERN))],
            within: 1e-14,
        },
        Report {
            library: "opencv/opencv",
            number: 24583,
            about: "another rectangle than the least",
            asked: "the area of the least rectangle of a contour, and whether it has all points",
            source: SIDES,
            found: || rectangle(&CONTOUR),
            right: || vec![least_rectangle(&points(&CONTOUR)), 1.0],
            within: 1e-12,
        },
        Report {
            library: "opencv/opencv",
            number: 11915,
            about: "a rectangle that does not enclose the contour",
            asked: "the area of the least rectangle of a contour, and whether it has all points",
            source: SIDES,
            found: || rectangle(&SCAN),
            right: || vec![least_rectangle(&points(&SCAN)), 1.0],
            within: 1e-7,
        },
        Report {
            library: "opencv/opencv",
            number: 21482,
            about: "a failed assertion",
            asked: "the area of the least rectangle of four points nearly on a line, and whether it has all",
            source: SIDES,
            found: || rectangle(&SLIVER),
            right: || vec![least_rectangle(&points(&SLIVER)), 1.0],
            within: 1e-9,
        },
        Report {
            library: "shapely/shapely",
            number: 1670,
            about: "20.4",
            asked: "the area of the least rectangle of five points, and whether it has all",
            source: SIDES,
            found: || rectangle(&FIVE),
            right: || vec![least_rectangle(&points(&FIVE)), 1.0],
            within: 1e-13,
        },
        Report {
            library: "georust/geo",
            number: 1028,
            about: "a doubt about six vertices: five by the decimals as written",
            asked: "the number of vertices of the hull of six points nearly on a line, in `f32`, in `f64`",
            source: HULL,
            found: || {
                let all: Vec<Vec2<f32>> = GRID.iter().map(|&[x, y]| Vec2::new(x, y)).collect();
                vec![hull_search(&all).len() as f64, hull(&DECIMAL)[0]]
            },
            right: || vec![hull_right(&grid())[0], hull_right(&DECIMAL)[0]],
            within: 0.0,
        },
        Report {
            library: "georust/geo",
            number: 905,
            about: "all three points",
            asked: "the number of vertices of the hull of three points on a line",
            source: "definition: its ends",
            found: || vec![hull_search(&points(&[[0., 0.], [1., 1.], [2., 2.]])).len() as f64],
            right: || vec![2.0],
            within: 0.0,
        },
        Report {
            library: "libgeos/geos",
            number: 722,
            about: "a hull that is not convex",
            asked: "vertices and area of the hull of eight points, of which two pairs are 3·10⁻¹⁷ apart",
            source: HULL,
            found: || hull(&TWIN),
            right: || hull_right(&TWIN),
            within: 1e-16,
        },
        Report {
            library: "kodecocodes/swift-algorithm-club",
            number: 487,
            about: "a hull that is not convex",
            asked: "vertices and area of the hull of four points",
            source: HULL,
            found: || hull(&NOTCH),
            right: || hull_right(&NOTCH),
            within: 1e-10,
        },
        Report {
            library: "brian3kb/graham_scan_js",
            number: 8,
            about: "all four points",
            asked: "vertices and area of the hull of four points, one of them inside",
            source: HULL,
            found: || hull(&FOUR),
            right: || hull_right(&FOUR),
            within: 1e-12,
        },
        Report {
            library: "erincatto/box2d",
            number: 296,
            about: "a failure: three vertices are nearly on a line",
            asked: "vertices and area of the hull of five points",
            source: HULL,
            found: || hull(&BODY),
            right: || hull_right(&BODY),
            within: 1e-15,
        },
        Report {
            library: "locationtech/jts",
            number: 193,
            about: "a place far away: the area is a rounding error",
            asked: "whether the centroid of a ring that returns along itself lies within the ring's bounds",
            source: "definition: a ring without area has the mean of its vertices",
            found: || {
                let at = ring::centroid(&points(&SPIKE));
                vec![flag(
                    (10.976..10.9771).contains(&at.x) && (45.3963..45.3965).contains(&at.y),
                )]
            },
            right: || vec![1.0],
            within: 0.0,
        },
        Report {
            library: "JuliaGeo/GeometryOps.jl",
            number: 79,
            about: "NaN",
            asked: "the centroids of two rings without area",
            source: "definition: the mean of the vertices",
            found: || {
                [
                    &[[0., 0.], [1., 0.], [2., 0.]][..],
                    &[[0., 0.], [1., 0.], [1., 1.], [1., 0.]],
                ]
                .into_iter()
                .flat_map(|r| {
                    let at = ring::centroid(&points(r));
                    [at.x, at.y]
                })
                .collect()
            },
            right: || vec![1.0, 0.0, 0.75, 0.25],
            within: 1e-15,
        },
    ]
}

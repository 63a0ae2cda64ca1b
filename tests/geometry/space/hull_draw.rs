//! Pairs of hulls at random, and all that is hard about them.
use super::draw::Random;
use super::hull_oracle::Point;

/// The families of pairs.
pub const FAMILIES: [&str; 13] = [
    "random",
    "on a grid",
    "stacked",
    "stacked and nearly parallel",
    "identical, or nearly",
    "concentric",
    "turned by tiny angles",
    "touching at corners",
    "far from the origin",
    "huge",
    "tiny",
    "one like a point",
    "one flat or thin",
];

fn plus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i])
}
fn times(a: Point, factor: f64) -> Point {
    a.map(|x| x * factor)
}
fn grid(random: &mut Random) -> Point {
    [(); 3].map(|()| random.below(5) as f64 * 0.5 - 1.0)
}
fn within(random: &mut Random, size: f64) -> Point {
    [(); 3].map(|()| random.within(-size, size))
}
fn turned([w, x, y, z]: [f64; 4], v: Point) -> Point {
    let square = w * w + x * x + y * y + z * z;
    let rows = [
        [
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ],
    ];
    rows.map(|row| (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]) / square)
}
fn cuboid(half: Point) -> Vec<Point> {
    let side = |k: usize, bit: usize| {
        if k >> bit & 1 == 1 {
            half[bit]
        } else {
            -half[bit]
        }
    };
    (0..8).map(|k| [0, 1, 2].map(|bit| side(k, bit))).collect()
}

/// Up to eight corners of a kind: with a volume, flat, on a line, at a point; with points inside and repeated ones.
fn body(random: &mut Random) -> Vec<Point> {
    let some = 1 + random.below(8);
    match random.below(9) {
        0 => (0..some.max(4)).map(|_| within(random, 1.0)).collect(),
        1 => cuboid([(); 3].map(|()| random.within(0.1, 1.0))),
        2 => (0..some).map(|_| grid(random)).collect(),
        3 => {
            let thin = random.power(-6.0, -1.0);
            cuboid([random.within(0.1, 1.0), random.within(0.1, 1.0), thin])
        }
        4 => {
            let (n, from, high) = (
                3 + random.below(2),
                random.within(0.0, 6.0),
                random.within(0.1, 1.0),
            );
            let corner = |k: usize| {
                let (sin, cos) =
                    (from + (k / 2) as f64 * std::f64::consts::TAU / n as f64).sin_cos();
                [cos, sin, if k.is_multiple_of(2) { high } else { -high }]
            };
            (0..2 * n).map(corner).collect()
        }
        5 => {
            let z = grid(random)[2];
            let mut corner = || [random.within(-1.0, 1.0), random.within(-1.0, 1.0), z];
            (0..some.max(3)).map(|_| corner()).collect()
        }
        6 => {
            let (from, along) = (grid(random), grid(random));
            let mut corner = || plus(from, times(along, random.below(5) as f64 * 0.25));
            (0..some).map(|_| corner()).collect()
        }
        7 => {
            let (center, size) = (grid(random), random.power(-15.0, -6.0));
            (0..some)
                .map(|_| plus(center, within(random, size)))
                .collect()
        }
        _ => {
            let mut all: Vec<Point> = (0..5).map(|_| within(random, 1.0)).collect();
            for _ in 0..3 {
                let (i, j) = (random.below(5), random.below(5));
                all.push(times(plus(all[i], all[j]), 0.5));
            }
            all
        }
    }
}

/// The farthest corner along a direction.
fn farthest(all: &[Point], along: Point) -> Point {
    let height = |p: &Point| along[0] * p[0] + along[1] * p[1] + along[2] * p[2];
    *all.iter()
        .max_by(|p, q| height(p).total_cmp(&height(q)))
        .unwrap()
}

/// A pair of a family.
pub fn pair(random: &mut Random, family: usize) -> [Vec<Point>; 2] {
    let (mut a, mut b) = (body(random), body(random));
    let each =
        |all: &mut Vec<Point>, f: &dyn Fn(Point) -> Point| all.iter_mut().for_each(|p| *p = f(*p));
    let quaternion = |random: &mut Random, size: f64| {
        let [x, y, z] = within(random, size);
        [1.0, x, y, z]
    };
    match family {
        0 => {
            let (turn, shift) = (quaternion(random, 3.0), within(random, 2.0));
            each(&mut b, &|p| plus(turned(turn, p), shift));
        }
        1 => {
            let shift = grid(random);
            each(&mut b, &|p| plus(p, shift));
        }
        2 | 3 => {
            let top = farthest(&a, [0.0, 0.0, 1.0])[2];
            let low = farthest(&b, [0.0, 0.0, -1.0])[2];
            let yaw = if random.below(2) == 0 {
                random.within(-3.0, 3.0)
            } else {
                0.0
            };
            let gap = [0.0, 1e-9, -1e-9, 0.1, -0.1, 1e-15][random.below(6)];
            let shift = [
                random.within(-1.0, 1.0),
                random.within(-1.0, 1.0),
                top - low + gap,
            ];
            each(&mut b, &|p| plus(turned([1.0, 0.0, 0.0, yaw], p), shift));
            if family == 3 {
                let size = random.power(-15.5, -3.0);
                let turn = quaternion(random, size);
                each(&mut b, &|p| turned(turn, p));
            }
        }
        4 => {
            b = a.clone();
            let size = if random.below(2) == 0 {
                0.0
            } else {
                random.power(-16.0, -1.0)
            };
            let shift = within(random, size);
            each(&mut b, &|p| plus(p, shift));
        }
        5 => {
            let factor = [0.5, 0.25, 1.0 + 1e-9, 1.5][random.below(4)];
            b = a.iter().map(|&p| times(p, factor)).collect();
        }
        6 => {
            b = a.clone();
            let size = random.power(-15.5, -1.0);
            let turn = quaternion(random, size);
            let shift = if random.below(2) == 0 {
                grid(random)
            } else {
                within(random, 1.5)
            };
            each(&mut b, &|p| plus(turned(turn, p), shift));
        }
        7 => {
            let along = within(random, 1.0);
            let (p, q) = (farthest(&a, along), farthest(&b, times(along, -1.0)));
            let gap = [0.0, 1e-9, -1e-9, 1e-15, 1e-6][random.below(5)];
            let shift = plus(plus(p, times(q, -1.0)), times(along, gap));
            each(&mut b, &|p| plus(p, shift));
        }
        8 => {
            let (shift, far) = (grid(random), [1e6, -2e6, 3e6]);
            each(&mut a, &|p| plus(p, far));
            each(&mut b, &|p| plus(plus(p, shift), far));
        }
        9 | 10 => {
            let (shift, power) = (within(random, 1.5), random.power(3.0, 30.0));
            let factor = if family == 9 { power } else { 1.0 / power };
            each(&mut a, &|p| times(p, factor));
            each(&mut b, &|p| times(plus(p, shift), factor));
        }
        11 => {
            let factor = random.power(-12.0, -2.0);
            let at = if random.below(2) == 0 {
                a[random.below(a.len())]
            } else {
                grid(random)
            };
            each(&mut b, &|p| plus(times(p, factor), at));
        }
        _ => {
            let (thin, turn) = (random.power(-12.0, -2.0), quaternion(random, 2.0));
            let shift = within(random, 1.0);
            each(&mut b, &|[x, y, z]| {
                plus(turned(turn, [x, y, z * thin]), shift)
            });
        }
    }
    [a, b]
}

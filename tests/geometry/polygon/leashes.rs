//! Hausdorff's and Fréchet's distance: values by enumeration in whole numbers, derivatives, identities, hard inputs.
use super::cases::at;
use geograd::similarity::{
    Outline, frechet, frechet_replay, frechet_search, hausdorff, hausdorff_replay, hausdorff_search,
};
use geograd::{Polygon, Vec2};
use geograd_tests::Dice;

type Way = Vec<Vec2<f64>>;

fn near(found: f64, expected: f64, by: f64) {
    let size = 1.0 + expected.abs();
    assert!((found - expected).abs() <= by * size, "{found} {expected}");
}
fn grid(dice: &mut Dice, count: usize, side: usize) -> Vec<[i128; 2]> {
    let mut one = || dice.below(side) as i128;
    (0..count).map(|_| [one(), one()]).collect()
}
fn placed(all: &[[i128; 2]]) -> Way {
    all.iter().map(|&[x, y]| at(x as f64, y as f64)).collect()
}
/// A squared distance as a fraction: of a point from a segment, in whole numbers.
fn squared(p: [i128; 2], [a, b]: [[i128; 2]; 2]) -> [i128; 2] {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let (length, along) = (u[0] * u[0] + u[1] * u[1], u[0] * v[0] + u[1] * v[1]);
    let of = |q: [i128; 2]| (p[0] - q[0]).pow(2) + (p[1] - q[1]).pow(2);
    match () {
        () if along <= 0 => [of(a), 1],
        () if along >= length => [of(b), 1],
        () => [(u[0] * v[1] - u[1] * v[0]).pow(2), length],
    }
}
fn below(a: [i128; 2], b: [i128; 2]) -> bool {
    a[0] * b[1] < b[0] * a[1]
}
/// The square of the largest of the least distances of vertices from edges.
fn farthest(own: &[[i128; 2]], edges: &[[[i128; 2]; 2]]) -> [i128; 2] {
    let least = |&p: &[i128; 2]| {
        let all = edges.iter().map(|&edge| squared(p, edge));
        all.reduce(|x, y| if below(y, x) { y } else { x }).unwrap()
    };
    let all = own.iter().map(least);
    all.reduce(|x, y| if below(x, y) { y } else { x }).unwrap()
}
fn links(count: usize, is_closed: bool) -> Vec<[usize; 2]> {
    let last = |k: usize| if is_closed { 0 } else { k };
    let next = |k: usize| if k + 1 < count { k + 1 } else { last(k) };
    (0..count).map(|k| [k, next(k)]).collect()
}

#[test]
fn the_farthest_vertex_is_that_of_enumeration() {
    let mut dice = Dice(1);
    for round in 0..3000 {
        let side = 2 + round % 9;
        let counts = [1 + dice.below(9), 1 + dice.below(9)];
        let both = counts.map(|count| grid(&mut dice, count, side));
        let closed = [round % 2 == 0, round % 3 == 0];
        let edges = [0, 1].map(|k| {
            let ends = links(counts[k], closed[k]);
            let ends = ends.iter().map(|edge| edge.map(|end| both[k][end]));
            ends.collect::<Vec<_>>()
        });
        let squares = [farthest(&both[0], &edges[1]), farthest(&both[1], &edges[0])];
        let [over, under] = if below(squares[0], squares[1]) {
            squares[1]
        } else {
            squares[0]
        };
        let expected = (over as f64 / under as f64).sqrt();
        let ways = both.each_ref().map(|all| placed(all));
        let [a, b] = [0, 1].map(|k| match closed[k] {
            true => Outline::rings(&ways[k][..]),
            false => Outline::path(&ways[k]),
        });
        let (found, record) = hausdorff_search(&a, &b).unwrap();
        near(found, expected, 1e-15);
        assert_eq!(hausdorff_replay(&ways[0], &ways[1], record), found);
        assert_eq!(hausdorff(&b, &a), Some(found));
        // In single precision by the same pair, or one as far.
        let narrow = ways.each_ref().map(|way| {
            let all = way.iter().map(|v| Vec2::new(v.x as f32, v.y as f32));
            all.collect::<Vec<_>>()
        });
        let following = [0, 1].map(|k| {
            links(counts[k], closed[k])
                .iter()
                .map(|e| e[1])
                .collect::<Vec<_>>()
        });
        let [c, d] = [0, 1].map(|k| Outline::linked(&narrow[k], &following[k]).unwrap());
        near(f64::from(hausdorff(&c, &d).unwrap()), expected, 1e-6);
    }
}

/// Returns `true` if walkers with a leash of a squared length reach the ends, by all places that they can reach.
fn reaches(a: &[[i128; 2]], b: &[[i128; 2]], square: i128) -> bool {
    let is_near = |i: usize, j: usize| squared(a[i], [b[j], b[j]])[0] <= square;
    let (mut left, mut seen) = (vec![(0, 0)], vec![false; a.len() * b.len()]);
    while let Some((i, j)) = left.pop() {
        if i >= a.len() || j >= b.len() || seen[i * b.len() + j] || !is_near(i, j) {
            continue;
        }
        if i + 1 == a.len() && j + 1 == b.len() {
            return true;
        }
        seen[i * b.len() + j] = true;
        left.extend([(i + 1, j), (i, j + 1), (i + 1, j + 1)]);
    }
    false
}

#[test]
fn the_leash_is_the_shortest_with_which_both_arrive() {
    let mut dice = Dice(2);
    for round in 0..3000 {
        let counts = [1 + dice.below(8), 1 + dice.below(8)];
        let [a, b] = counts.map(|count| grid(&mut dice, count, 2 + round % 9));
        let squares = a
            .iter()
            .flat_map(|&p| b.iter().map(move |&q| squared(p, [q, q])[0]));
        let least = squares
            .filter(|&square| reaches(&a, &b, square))
            .min()
            .unwrap();
        let [p, q] = [&a, &b].map(|all| placed(all));
        let (found, pair) = frechet_search(&p, &q).unwrap();
        near(found, (least as f64).sqrt(), 1e-15);
        assert_eq!(frechet_replay(&p, &q, pair), found);
        assert_eq!(frechet(&q, &p), Some(found));
        // No leash is shorter than that between the farthest vertices.
        let points = |all: &[Vec2<f64>]| all.to_vec();
        let (from, to) = (points(&p), points(&q));
        let alone = |own: &[Vec2<f64>], other: &[Vec2<f64>]| {
            let least = |v: &Vec2<f64>| {
                other
                    .iter()
                    .map(|w| v.distance(*w))
                    .fold(f64::INFINITY, f64::min)
            };
            own.iter().map(least).fold(0.0, f64::max)
        };
        assert!(found >= alone(&from, &to).max(alone(&to, &from)));
    }
}

#[test]
fn long_walks_have_the_shortest_leash() {
    let mut dice = Dice(12);
    for round in 0..60 {
        let counts = [1 + dice.below(160), 1 + dice.below(160)];
        let [mut a, mut b] = counts.map(|count| grid(&mut dice, count, 2 + round % 30));
        if round % 3 == 0 {
            // Walks near each other, of which a search looks at few pairs.
            a = (0..counts[0] as i128).map(|k| [4 * k, k % 3]).collect();
            b = a
                .iter()
                .map(|[x, y]| [x + 1, y + dice.below(3) as i128])
                .collect();
        }
        // The squares at which more walks arrive, by halves.
        let (mut low, mut high) = (-1, 4 * 200_i128.pow(2) * 10);
        while high - low > 1 {
            let middle = (low + high) / 2;
            match reaches(&a, &b, middle) {
                true => high = middle,
                false => low = middle,
            }
        }
        let [p, q] = [&a, &b].map(|all| placed(all));
        let (found, pair) = frechet_search(&p, &q).unwrap();
        near(found, (high as f64).sqrt(), 1e-15);
        assert_eq!(frechet_replay(&p, &q, pair), found);
        let narrow = |all: &[Vec2<f64>]| -> Vec<Vec2<f32>> {
            all.iter()
                .map(|v| Vec2::new(v.x as f32, v.y as f32))
                .collect()
        };
        let (_, of_narrow) = frechet_search(&narrow(&p), &narrow(&q)).unwrap();
        assert_eq!(of_narrow, pair);
    }
}

fn wavy(dice: &mut Dice, count: usize, lift: f64) -> Way {
    let mut place = |k: usize| at(k as f64 * 0.1, lift + dice.within(-0.3, 0.3));
    (0..count).map(&mut place).collect()
}

#[test]
fn long_outlines_have_the_distance_of_all_pairs() {
    let mut dice = Dice(3);
    for round in 0..12 {
        let (a, b) = (wavy(&mut dice, 300, 0.0), wavy(&mut dice, 170 + round, 0.4));
        let of = |own: &Way, other: &Way| {
            let least = |&v: &Vec2<f64>| {
                let edges = other.windows(2).map(|e| {
                    let (u, w) = (e[1] - e[0], v - e[0]);
                    let t = (u.dot(w) / u.dot(u)).clamp(0.0, 1.0);
                    (w - u * t).length()
                });
                edges.fold(f64::INFINITY, f64::min)
            };
            own.iter().map(least).fold(0.0, f64::max)
        };
        let (found, record) = hausdorff_search(&Outline::path(&a), &Outline::path(&b)).unwrap();
        near(found, of(&a, &b).max(of(&b, &a)), 1e-14);
        // One vertex and the ends of an edge have slopes: a unit at the vertex, and as much back at the edge.
        let inputs = (a.clone(), b.clone());
        let step = 1e-6;
        let moved = |sign: f64| {
            let (mut a, mut b) = inputs.clone();
            let own = if record.of_second { &mut b } else { &mut a };
            own[record.vertex].y += sign * step;
            hausdorff(&Outline::path(&a), &Outline::path(&b)).unwrap()
        };
        let slope = (moved(1.0) - moved(-1.0)) / (2.0 * step);
        let three = {
            let (own, other) = if record.of_second { (&b, &a) } else { (&a, &b) };
            [
                own[record.vertex],
                other[record.edge[0]],
                other[record.edge[1]],
            ]
        };
        let short = geograd::similarity::FarthestVertex {
            of_second: false,
            vertex: 0,
            edge: [1, 2],
        };
        let (value, by) = geograd::gradient(
            |all: [Vec2<_>; 3]| hausdorff_replay(&all, &all, short),
            three,
        );
        near(value, found, 1e-15);
        near(by[0].y, slope, 1e-6);
        let sum = by[0] + by[1] + by[2];
        near(sum.length(), 0.0, 1e-14);
        near(by[0].length(), 1.0, 1e-14);
    }
}

#[test]
fn far_away_tiny_huge_and_empty() {
    // Differences whose squares are below the format, beside an ordinary coordinate.
    for [near, far] in [[1e-200, 2e-200], [2.9e-162, 3e-162]] {
        let (p, q) = ([at(0.0, 1.0); 2], [at(near, 1.0), at(far, 1.0)]);
        assert_eq!(frechet(&p, &q), Some(far));
        assert_eq!(frechet(&p, &p), Some(0.0));
    }
    let mut dice = Dice(4);
    let (a, b) = (wavy(&mut dice, 40, 0.0), wavy(&mut dice, 30, 1.0));
    let of = |a: &Way, b: &Way| {
        let [p, q] = [a, b].map(|way| Outline::path(way));
        [hausdorff(&p, &q).unwrap(), frechet(a, b).unwrap()]
    };
    let known = of(&a, &b);
    for power in [-300, -40, 40, 300] {
        let scale = 2.0_f64.powi(power);
        let scaled = |way: &Way| way.iter().map(|&v| v * scale).collect::<Way>();
        // Powers of two change no digit.
        assert_eq!(of(&scaled(&a), &scaled(&b)), known.map(|x| x * scale));
    }
    let away = |way: &Way| way.iter().map(|&v| v + at(1e6, -1e6)).collect::<Way>();
    for (found, expected) in of(&away(&a), &away(&b)).into_iter().zip(known) {
        near(found, expected, 1e-9);
    }
    assert_eq!(of(&a, &a), [0.0; 2]);
    // A hole and parts have vertices and edges as borders have.
    let square = [at(0.0, 0.0), at(4.0, 0.0), at(4.0, 4.0), at(0.0, 4.0)];
    let hole = square.map(|v| v * 0.25 + at(1.0, 1.0));
    let [whole, frame] = [
        Polygon::from_rings([&square[..]]),
        Polygon::from_rings([&square[..], &hole]),
    ];
    let (found, record) =
        hausdorff_search(&Outline::rings(&frame), &Outline::rings(&whole)).unwrap();
    assert_eq!((found, record.vertex, record.of_second), (2.0, 6, false));
    let none = Outline::path(&[]);
    assert_eq!(hausdorff(&none, &Outline::rings(&square)), None);
    assert_eq!(
        (frechet::<f64>(&[], &square), frechet(&square, &[])),
        (None, None)
    );
    assert!(Outline::linked(&square, &[1, 2, 3, 4]).is_none());
    assert!(Outline::linked(&square, &[1, 2, 3]).is_none());
}

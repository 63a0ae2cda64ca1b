//! Clouds against all pairs: ties on grids, derivatives against differences, bits on any threads.
use crate::space::draw::Random;
use geograd::cloud::{CloudFault, CloudTree};
use geograd::error::Error;
use geograd::kernels::Cpu;
use geograd::kernels::cpu::cloud_batches::PointDistance;
use geograd::{Vec3, gradient, hessian};
use geograd_tests::with_threads;

/// Points at random, on a grid with many repeated ones, along a line, in one place, and far from the origin.
fn clouds(random: &mut Random) -> Vec<Vec<Vec3<f64>>> {
    let grid = |random: &mut Random| {
        let [x, y, z] = [0; 3].map(|_| random.below(7) as f64 - 3.0);
        Vec3::new(x, y, z)
    };
    let far = Vec3::new(1e9, -2e9, 3e8);
    vec![
        (0..400).map(|_| random.vector(1.0)).collect(),
        (0..500).map(|_| grid(random)).collect(),
        (0..300)
            .map(|k| Vec3::new(f64::from(k % 100), 0.0, 0.0))
            .collect(),
        vec![Vec3::new(0.5, 0.25, -1.0); 40],
        (0..200).map(|_| random.vector(1.0) + far).collect(),
        vec![Vec3::new(1.0, 2.0, 3.0)],
        (0..300)
            .map(|_| random.vector(1.0) * random.power(-12.0, 3.0))
            .collect(),
    ]
}

fn queries(points: &[Vec3<f64>], random: &mut Random) -> Vec<Vec3<f64>> {
    let mut all = Vec::new();
    for k in 0..150 {
        let near = points[random.below(points.len())];
        all.push(match k % 5 {
            0 => near,
            1 => (near + points[random.below(points.len())]) * 0.5,
            2 => near + random.vector(0.5),
            3 => Vec3::new(
                random.below(13) as f64 * 0.5 - 3.0,
                random.below(7) as f64 - 3.0,
                0.5,
            ),
            _ => random.vector(1.0) * random.power(-3.0, 20.0),
        });
    }
    all
}

/// Squared distances and indices, in the order of both.
fn sorted(points: &[Vec3<f64>], query: Vec3<f64>) -> Vec<(f64, u32)> {
    let square = |(k, &p): (usize, &Vec3<f64>)| ((p - query).length_squared(), k as u32);
    let mut all: Vec<_> = points.iter().enumerate().map(square).collect();
    all.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    all
}

#[test]
fn nearest_points_are_those_of_all_pairs() {
    if !geograd_tests::is_due("nearest_points_are_those_of_all_pairs") {
        return;
    }
    let mut random = Random(0xc10d_5eed_0000_0001);
    let mut ties = 0;
    for points in clouds(&mut random) {
        let tree = CloudTree::new(&points).unwrap();
        let cloud = tree.on(&points).unwrap();
        for query in queries(&points, &mut random) {
            let expected = sorted(&points, query);
            ties += usize::from(expected.len() > 1 && expected[0].0 == expected[1].0);
            assert_eq!(cloud.nearest(query), expected[0].1, "{query}");
            assert_eq!(cloud.squared_distance(query), expected[0].0);
            assert_eq!(
                cloud.distance(query),
                (query - points[expected[0].1 as usize]).length()
            );
            for count in [0, 1, 3, 20, 1000] {
                let found = cloud.nearest_some(query, count);
                let expected: Vec<u32> = expected.iter().take(count).map(|pair| pair.1).collect();
                assert_eq!(found, expected, "{query} {count}");
            }
            for radius in [
                0.0,
                0.5,
                1.0,
                2.5,
                expected[expected.len() / 2].0.sqrt(),
                f64::MAX.sqrt(),
            ] {
                let near = expected.iter().filter(|pair| pair.0 <= radius * radius);
                let mut expected: Vec<u32> = near.map(|pair| pair.1).collect();
                expected.sort_unstable();
                assert_eq!(cloud.within(query, radius), expected, "{query} {radius}");
            }
        }
    }
    assert!(ties > 200, "{ties}");
}

#[test]
fn derivatives_are_those_of_the_nearest_point() {
    let mut random = Random(0xc10d_5eed_0000_0002);
    let points: Vec<_> = (0..200).map(|_| random.vector(1.0)).collect();
    let tree = CloudTree::new(&points).unwrap();
    for _ in 0..50 {
        let query = random.vector(1.5);
        let own = tree.on(&points).unwrap();
        let away = query - points[own.nearest(query) as usize];
        let of = |q| {
            let lifted: Vec<_> = points.iter().map(geograd::Pack::lift).collect();
            tree.on(&lifted).unwrap().distance(q)
        };
        let (value, slope) = gradient(of, query);
        assert!((value - away.length()).abs() < 1e-15);
        assert!((slope - away.normalize_or_zero()).length() < 1e-14);
        let (_, _, bend) = hessian(
            |q| {
                let lifted: Vec<_> = points.iter().map(geograd::Pack::lift).collect();
                tree.on(&lifted).unwrap().squared_distance(q)
            },
            query,
        );
        assert_eq!(
            [bend.x, bend.y, bend.z],
            [
                Vec3::new(2.0, 0.0, 0.0),
                Vec3::new(0.0, 2.0, 0.0),
                Vec3::new(0.0, 0.0, 2.0)
            ]
        );
    }
}

/// Both means and the largest distance, over all pairs.
fn brute(a: &[Vec3<f64>], b: &[Vec3<f64>], kind: PointDistance) -> (f64, f64) {
    let least = |from: &[Vec3<f64>], to: &[Vec3<f64>]| -> Vec<f64> {
        let of = |p: &Vec3<f64>| sorted(to, *p)[0].0;
        from.iter()
            .map(of)
            .map(|square| {
                if kind == PointDistance::Plain {
                    square.sqrt()
                } else {
                    square
                }
            })
            .collect()
    };
    let (p, q) = (least(a, b), least(b, a));
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    (
        mean(&p) + mean(&q),
        p.iter().chain(&q).fold(0.0, |most: f64, &x| most.max(x)),
    )
}

#[test]
fn distances_of_clouds_are_those_of_all_pairs_with_the_slopes_of_differences() {
    let (cpu, mut random) = (Cpu::new(), Random(0xc10d_5eed_0000_0003));
    let a: Vec<_> = (0..60).map(|_| random.vector(1.0)).collect();
    let b: Vec<_> = (0..45).map(|_| random.vector(1.2)).collect();
    let trees = [CloudTree::new(&a).unwrap(), CloudTree::new(&b).unwrap()];
    let (first, second) = (trees[0].on(&a).unwrap(), trees[1].on(&b).unwrap());
    for kind in [PointDistance::Plain, PointDistance::Squared] {
        let found = cpu.chamfer(kind, &first, &second).unwrap();
        assert!((found - brute(&a, &b, kind).0).abs() < 1e-13);
        let bars = cpu.chamfer_vjp(kind, [&first, &second], 0.75).unwrap();
        let ways: [Vec<Vec3<f64>>; 2] =
            [&a, &b].map(|all| all.iter().map(|_| random.vector(1.0)).collect());
        let moved = |all: &[Vec3<f64>], ways: &[Vec3<f64>], step: f64| -> Vec<Vec3<f64>> {
            all.iter().zip(ways).map(|(&p, &w)| p + w * step).collect()
        };
        let at = |step| brute(&moved(&a, &ways[0], step), &moved(&b, &ways[1], step), kind).0;
        let difference = 0.75 * (at(1e-6) - at(-1e-6)) / 2e-6;
        let slope: f64 = bars
            .iter()
            .flatten()
            .zip(ways.iter().flatten())
            .map(|(bar, way)| bar.dot(*way))
            .sum();
        assert!((slope - difference).abs() < 1e-7, "{slope} {difference}");
    }
    let found = cpu.hausdorff(&first, &second).unwrap();
    assert!((found.distance - brute(&a, &b, PointDistance::Plain).1).abs() < 1e-15);
    let (from, to) = if found.from_second {
        (&b, &a)
    } else {
        (&a, &b)
    };
    assert_eq!(
        (from[found.point as usize] - to[found.nearest as usize]).length(),
        found.distance
    );
    let shares = [(&a, &b), (&b, &a)].map(|(from, to)| {
        from.iter().filter(|&&p| sorted(to, p)[0].0 <= 0.09).count() as f64 / from.len() as f64
    });
    let expected = 2.0 * shares[0] * shares[1] / (shares[0] + shares[1]);
    assert_eq!(cpu.f_score(&first, &second, 0.3).unwrap(), expected);
    assert!(0.1 < expected && expected < 0.9);
    let same = cpu.hausdorff(&first, &first).unwrap();
    assert_eq!(
        (same.distance, same.point, same.from_second),
        (0.0, 0, false)
    );
}

#[test]
fn ties_have_the_lowest_points() {
    let cpu = Cpu::new();
    let at = |x: f64| Vec3::new(x, 0.0, 0.0);
    let (a, b) = ([at(0.0), at(10.0)], [at(5.0), at(5.0), at(-5.0), at(15.0)]);
    let trees = (CloudTree::new(&a).unwrap(), CloudTree::new(&b).unwrap());
    let (first, second) = (trees.0.on(&a).unwrap(), trees.1.on(&b).unwrap());
    let found = cpu.hausdorff(&first, &second).unwrap();
    assert_eq!(
        (
            found.distance,
            found.from_second,
            found.point,
            found.nearest
        ),
        (5.0, false, 0, 0)
    );
    let [own, other] = cpu
        .chamfer_vjp(PointDistance::Plain, [&first, &second], 1.0)
        .unwrap();
    // Half a step to the left and right for each of the first cloud, a quarter for each of the second one.
    assert_eq!(own, [at(-0.5 - 0.25 - 0.25 + 0.25), at(0.5 - 0.25)]);
    assert_eq!(other, [at(0.5 + 0.25 - 0.5), at(0.25), at(-0.25), at(0.25)]);
}

#[test]
fn batches_have_the_bits_of_one_query_and_of_any_threads() {
    if !geograd_tests::is_due("batches_have_the_bits_of_one_query_and_of_any_threads") {
        return;
    }
    let (cpu, mut random) = (Cpu::new(), Random(0xc10d_5eed_0000_0004));
    let points: Vec<_> = (0..2000).map(|_| random.vector(1.0)).collect();
    let asked: Vec<_> = (0..3000).map(|_| random.vector(1.2)).collect();
    let tree = CloudTree::new(&points).unwrap();
    let cloud = tree.on(&points).unwrap();
    let by: Vec<_> = asked.iter().map(|_| random.within(-1.0, 1.0)).collect();
    let plain = PointDistance::Plain;
    let run = |threads: usize| {
        with_threads(threads, || {
            let found = cpu.nearest_points(&cloud, &asked).unwrap();
            let some = cpu.nearest_some_points(&cloud, &asked, 5).unwrap();
            let within = cpu.points_within(&cloud, &asked, 0.1).unwrap();
            let values = cpu.point_distances(plain, &cloud, &asked, &found).unwrap();
            let bars = cpu
                .point_distances_vjp(plain, &cloud, &asked, &found, &by)
                .unwrap();
            (found, some, within, values, bars)
        })
    };
    let all = run(1);
    for (k, &query) in asked.iter().enumerate() {
        assert_eq!(all.0[k], cloud.nearest(query));
        assert_eq!(all.1[k], cloud.nearest_some(query, 5));
        assert_eq!(all.2[k], cloud.within(query, 0.1));
        assert_eq!(all.3[k].to_bits(), cloud.distance(query).to_bits());
    }
    let sum = |all: &[Vec3<f64>]| all.iter().fold(Vec3::zero(), |sum, &v| sum + v);
    assert!((sum(&all.4.queries) + sum(&all.4.points)).length() < 1e-10);
    assert!(all.4.queries[7].length() > 0.0);
    assert!(all == run(3));
}

#[test]
fn faults_of_clouds_name_the_point() {
    let cpu = Cpu::new();
    let points = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.0, f64::NAN)];
    assert_eq!(CloudTree::new(&points[..0]).unwrap_err(), CloudFault::Empty);
    let fault = CloudTree::new(&points).unwrap_err();
    assert_eq!(fault, CloudFault::NotFinite { point: 1 });
    assert_eq!(
        fault.to_string(),
        "point 1 has a coordinate that is not a finite number"
    );
    let tree = CloudTree::new(&points[..1]).unwrap();
    let fault = tree.on(&[points[0]; 3]).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "the tree is of 1 points, the cloud has 3"
    );
    let cloud = tree.on(&points[..1]).unwrap();
    assert!(matches!(
        cpu.nearest_points(&cloud, &points),
        Err(Error::Invalid { item: 1, .. })
    ));
    let plain = PointDistance::Plain;
    let error = cpu
        .point_distances(plain, &cloud, &points[..1], &[1])
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "`found` item 0: value is not a point of the cloud"
    );
    assert!(cpu.f_score(&cloud, &cloud, f64::NAN).is_err());
    assert!(
        cloud.nearest_some(points[1], 1).is_empty() && cloud.within(points[0], -1.0).is_empty()
    );
}

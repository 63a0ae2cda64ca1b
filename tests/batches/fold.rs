//! Folds over paths and operations with a search, in batches.
use geograd::error::{Argument, Field, Flaw};
use geograd::kernels::check::Folded;
use geograd::kernels::check::WithAdjoint;
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::fold::fold;
use geograd::kernels::{Cpu, One};
use geograd::kernels::{Diameter, Iou, LengthInside};
use geograd::measure::moments::{AreaMoments, second_moments};
use geograd::{ConvexPolygon, Error, Pack, Segment2, Triangle2, Vec2};
use geograd_tests::Dice;
use geograd_tests::rows::{
    LengthInsideRing, SecondMomentsOfRing, SignedDistancePointRing, WindingOfRing,
};

fn point(dice: &mut Dice) -> Vec2<f64> {
    Vec2::new(dice.within(-2.0, 2.0), dice.within(-2.0, 2.0))
}

/// Rings of zero to thirteen vertices.
fn rings(dice: &mut Dice, count: usize) -> (Vec<Vec2<f64>>, Vec<usize>) {
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for _ in 0..count {
        for _ in 0..dice.below(14) {
            vertices.push(point(dice));
        }
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

#[test]
fn folds_have_the_bits_of_one_path_at_a_time() {
    let mut dice = Dice(1);
    // More than one piece of work.
    let (vertices, offsets) = rings(&mut dice, 5000);
    let points: Vec<Vec2<f64>> = (0..5000).map(|_| point(&mut dice)).collect();
    let cpu = Cpu::new();
    let distances = cpu
        .fold(SignedDistancePointRing, &points, &vertices, &offsets)
        .unwrap();
    let moments = cpu
        .fold(SecondMomentsOfRing, One([]), &vertices, &offsets)
        .unwrap();
    for (i, ring) in offsets.windows(2).enumerate() {
        let ring = &vertices[ring[0]..ring[1]];
        let one = fold::<SignedDistancePointRing, f64>(points[i], ring);
        assert_eq!(distances[i].to_bits(), one.to_bits(), "{ring:?}");
        let (known, found) = (second_moments(&[ring]), moments[i]);
        assert_eq!(found, known, "{ring:?}");
    }
}

/// Rings of hundreds of vertices with a point each: round and jagged ones, ones in a raster with many ties and
/// points on edges and corners, tiny and huge ones, ones with edges of length zero, and ones too extreme
/// for squares.
pub(super) fn long_rings(dice: &mut Dice) -> (Vec<Vec2<f64>>, Vec<Vec2<f64>>, Vec<usize>) {
    let (mut points, mut vertices, mut offsets) = (Vec::new(), Vec::new(), vec![0]);
    for kind in 0..72 {
        let unit = [1.0, 1e-9, 1e12, 1e-25, 1e18, 0.0][kind / 12];
        let raster = kind % 4 == 0;
        let count = 17 + dice.below(500);
        for k in 0..count {
            let (at, radius) = (
                k as f64 * std::f64::consts::TAU / count as f64,
                dice.within(0.9, 1.1),
            );
            let v = Vec2::new(radius * at.cos(), radius * at.sin());
            let v = match raster {
                true => Vec2::new((4.0 * v.x).round() / 4.0, (4.0 * v.y).round() / 4.0),
                false => v,
            };
            vertices.push(v * unit);
        }
        offsets.push(vertices.len());
        let at = point(dice) * 0.5;
        points.push(match kind % 12 {
            0 => Vec2::zero(),
            1 => vertices[vertices.len() - 3],
            4 => Vec2::new(unit, 0.0),
            _ => at * unit,
        });
    }
    (points, vertices, offsets)
}

#[test]
fn folds_over_the_nearest_edges_alone_have_the_bits_of_those_over_all() {
    let mut dice = Dice(11);
    let (points, vertices, offsets) = long_rings(&mut dice);
    let narrow = |all: &[Vec2<f64>]| -> Vec<Vec2<f32>> {
        let narrow = |v: &Vec2<f64>| Vec2::new(v.x as f32, v.y as f32);
        all.iter().map(narrow).collect()
    };
    let (points_32, vertices_32) = (narrow(&points), narrow(&vertices));
    let cpu = Cpu::new();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        let wide = cpu.fold(SignedDistancePointRing, &points, &vertices, &offsets);
        let less = cpu.fold(SignedDistancePointRing, &points_32, &vertices_32, &offsets);
        let turns = cpu.fold(WindingOfRing, &points, &vertices, &offsets);
        let (wide, less, turns) = (wide.unwrap(), less.unwrap(), turns.unwrap());
        for (i, ring) in offsets.windows(2).enumerate() {
            let (own, own_32) = (&vertices[ring[0]..ring[1]], &vertices_32[ring[0]..ring[1]]);
            let one = fold::<SignedDistancePointRing, f64>(points[i], own);
            assert_eq!(wide[i].to_bits(), one.to_bits(), "{level:?} ring {i}");
            let one = fold::<SignedDistancePointRing, f32>(points_32[i], own_32);
            assert_eq!(
                less[i].to_bits(),
                one.to_bits(),
                "{level:?} ring {i} in f32"
            );
            let one = fold::<WindingOfRing, f64>(points[i], own);
            assert_eq!(turns[i], one, "{level:?} ring {i}");
        }
    }
    Simd::limit(None).unwrap();
    // Derivatives are those of one path at a time, too.
    let up: Vec<f64> = points.iter().map(|_| dice.within(-2.0, 2.0)).collect();
    let (by_point, by_vertex) = cpu
        .fold_vjp(SignedDistancePointRing, &points, &vertices, &offsets, &up)
        .unwrap();
    for (i, ring) in offsets.windows(2).enumerate() {
        let input = (points[i], vertices[ring[0]..ring[1]].to_vec());
        let (by_one, by_own) = Folded::<SignedDistancePointRing>::vjp(&input, up[i]);
        let found = std::iter::once(&by_point[i]).chain(&by_vertex[ring[0]..ring[1]]);
        for (found, one) in found.zip(std::iter::once(&by_one).chain(&by_own)) {
            assert!(
                (*found - *one).length() <= 1e-12,
                "ring {i}: {found:?} {one:?}"
            );
        }
    }
}

/// Both sides of a narrow way are equally far from its middle, but for rounding: which of them is nearer only the
/// fold itself can tell.
#[test]
fn what_rounding_decides_is_left_to_the_fold() {
    let mut dice = Dice(12);
    let (mut points, mut vertices, mut offsets) = (Vec::new(), Vec::new(), vec![0]);
    for _ in 0..400 {
        let (sin, cos) = dice.within(-3.0, 3.0).sin_cos();
        let half = dice.within(0.1, 1.0);
        let place =
            |x: f64, y: f64| Vec2::new((x * cos - y * sin) as f32, (x * sin + y * cos) as f32);
        vertices.extend((0..20).map(|i| place(100.0 * f64::from(i) - 950.0, -half)));
        vertices.extend((0..20).map(|i| place(950.0 - 100.0 * f64::from(i), half)));
        offsets.push(vertices.len());
        points.push(place(dice.within(-900.0, 900.0), 0.0));
    }
    let found = Cpu::new().fold(SignedDistancePointRing, &points, &vertices, &offsets);
    for (i, found) in found.unwrap().into_iter().enumerate() {
        let one =
            fold::<SignedDistancePointRing, f32>(points[i], &vertices[offsets[i]..offsets[i + 1]]);
        assert_eq!(found.to_bits(), one.to_bits(), "ring {i}: {found} {one}");
    }
}

#[test]
fn a_path_that_all_share_is_as_good_as_one_for_each() {
    let mut dice = Dice(12);
    let (_, vertices, offsets) = long_rings(&mut dice);
    let ring = &vertices[offsets[5]..offsets[6]];
    let points: Vec<Vec2<f64>> = (0..300).map(|_| point(&mut dice)).collect();
    let up: Vec<f64> = points.iter().map(|_| dice.within(-2.0, 2.0)).collect();
    let each: Vec<Vec2<f64>> = points.iter().flat_map(|_| ring.to_vec()).collect();
    let bounds: Vec<usize> = (0..=points.len()).map(|i| i * ring.len()).collect();
    let (cpu, op) = (Cpu::new(), SignedDistancePointRing);
    let known = cpu.fold(op, &points, &each, &bounds).unwrap();
    assert_eq!(cpu.fold_one(op, &points, ring).unwrap(), known);
    assert!(known.iter().any(|x| *x < 0.0) && known.iter().any(|x| *x > 0.0));
    let (by_point, by_each) = cpu.fold_vjp(op, &points, &each, &bounds, &up).unwrap();
    let (found, by_vertex) = cpu.fold_one_vjp(op, &points, ring, &up).unwrap();
    assert_eq!(found, by_point);
    for (k, found) in by_vertex.iter().enumerate() {
        let of_points = by_each.iter().skip(k).step_by(ring.len());
        let sum = of_points.fold(Vec2::zero(), |sum, bar| sum + *bar);
        assert!((*found - sum).length() < 1e-12, "{k}: {found:?} {sum:?}");
    }
    // A fold over all edges, too; and without points.
    let moments = cpu.fold_one(SecondMomentsOfRing, One([]), ring).unwrap();
    let known = cpu.fold(SecondMomentsOfRing, One([]), ring, &[0, ring.len()]);
    assert_eq!(moments, known.unwrap());
    assert!(cpu.fold_one(op, &points[..0], ring).unwrap().is_empty());
    let nan = [Vec2::new(0.0, f64::NAN)];
    let flaw = Flaw::NotFinite(Field::new("y"));
    let (argument, row) = (Argument::Vertices, 0);
    let refused = Error::Invalid {
        argument,
        item: row,
        flaw,
    };
    assert_eq!(cpu.fold_one(op, &points, &nan), Err(refused));
}

#[test]
fn adjoints_of_folds_are_derivatives() {
    let mut dice = Dice(2);
    let (vertices, offsets) = rings(&mut dice, 200);
    let points: Vec<Vec2<f64>> = (0..200).map(|_| point(&mut dice)).collect();
    let up: Vec<f64> = (0..200).map(|_| dice.within(-2.0, 2.0)).collect();
    let cpu = Cpu::new();
    let (by_point, by_vertex) = cpu
        .fold_vjp(SignedDistancePointRing, &points, &vertices, &offsets, &up)
        .unwrap();
    let total = |points: &[Vec2<f64>], vertices: &[Vec2<f64>]| -> f64 {
        let all = cpu
            .fold(SignedDistancePointRing, points, vertices, &offsets)
            .unwrap();
        let real = all.iter().zip(&up).filter(|(x, _)| **x < 1e300);
        real.map(|(x, up)| x * up).sum()
    };
    // Along a random direction of everything at once; kinks are rare.
    let (mut agreed, tries) = (0, 20);
    for _ in 0..tries {
        let step = 1e-7;
        let directions: Vec<Vec2<f64>> = (0..points.len()).map(|_| point(&mut dice)).collect();
        let turns: Vec<Vec2<f64>> = (0..vertices.len()).map(|_| point(&mut dice)).collect();
        let moved = |by: f64| {
            let p: Vec<_> = points
                .iter()
                .zip(&directions)
                .map(|(&p, &d)| p + d * by)
                .collect();
            let v: Vec<_> = vertices
                .iter()
                .zip(&turns)
                .map(|(&p, &d)| p + d * by)
                .collect();
            total(&p, &v)
        };
        let derivative = (moved(step) - moved(-step)) / (2.0 * step);
        let dots = |bars: &[Vec2<f64>], ways: &[Vec2<f64>]| -> f64 {
            bars.iter().zip(ways).map(|(bar, way)| bar.dot(*way)).sum()
        };
        let known = dots(&by_point, &directions) + dots(&by_vertex, &turns);
        agreed += usize::from((derivative - known).abs() <= 1e-5 * (1.0 + known.abs()));
    }
    assert!(agreed >= tries - 2, "{agreed} of {tries}");
}

#[test]
fn moments_pull_on_vertices() {
    let ring = [(0.0, 0.0), (3.0, 0.5), (2.0, 2.5), (0.5, 2.0)].map(|(x, y)| Vec2::new(x, y));
    let up = AreaMoments {
        xx: 1.0,
        yy: -0.5,
        xy: 0.25,
    };
    let (_, bars) = Cpu::new()
        .fold_vjp(SecondMomentsOfRing, One([]), &ring, &[0, 4], &[up])
        .unwrap();
    let value = |ring: &[Vec2<f64>]| {
        let m = second_moments(&[ring]);
        m.xx - 0.5 * m.yy + 0.25 * m.xy
    };
    for k in 0..4 {
        let (mut more, mut less) = (ring, ring);
        more[k].x += 1e-6;
        less[k].x -= 1e-6;
        let derivative = (value(&more) - value(&less)) / 2e-6;
        assert!(
            (derivative - bars[k].x).abs() < 1e-7,
            "{derivative} {:?}",
            bars[k]
        );
    }
}

#[test]
fn folds_refuse_what_is_wrong() {
    let cpu = Cpu::new();
    let ring = [
        Vec2::new(0.0, 0.0),
        Vec2::new(1.0, 0.0),
        Vec2::new(0.0, 1.0),
    ];
    let one = [Vec2::new(0.5, 0.5)];
    assert_eq!(
        cpu.fold(SignedDistancePointRing, &one, &ring, &[0, 2]),
        Err(Error::Offsets { item: 1 })
    );
    assert_eq!(
        cpu.fold(SignedDistancePointRing, &one, &ring, &[0, 1, 3]),
        Err(Error::Length {
            argument: Argument::Named("point"),
            expected: 2,
            found: 1
        })
    );
    let nan = [Vec2::new(f64::NAN, 0.0)];
    assert_eq!(
        cpu.fold(SignedDistancePointRing, &nan, &ring, &[0, 3]),
        Err(Error::Invalid {
            argument: Argument::Named("point"),
            item: 0,
            flaw: Flaw::NotFinite(Field::new("x"))
        })
    );
    let wild = cpu.fold_vjp(
        SignedDistancePointRing,
        &one,
        &ring,
        &[0, 3],
        &[f64::INFINITY],
    );
    assert!(matches!(
        wild,
        Err(Error::Invalid {
            argument: Argument::Upstream,
            item: 0,
            ..
        })
    ));
    let nothing: [Vec2<f64>; 0] = [];
    assert_eq!(
        cpu.fold(SignedDistancePointRing, &nothing, &nothing, &[0]),
        Ok(vec![])
    );
}

#[test]
fn searches_are_decided_and_replayed() {
    let kite = [(0.0, 0.0), (1.0, -0.5), (3.0, 0.0), (1.0, 0.5)].map(|(x, y)| Vec2::new(x, y));
    let triangle = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| Vec2::new(x, y));
    let polygons: [ConvexPolygon<f64, 6>; 2] =
        [&kite[..], &triangle].map(|ring| ConvexPolygon::try_new(ring).unwrap());
    let cpu = Cpu::new();
    assert_eq!(cpu.aligned(Diameter, &polygons).unwrap(), [3.0, 5.0]);
    let (values, bars) = cpu.aligned(Diameter.value_grad(), &polygons).unwrap();
    assert_eq!(values, [3.0, 5.0]);
    assert_eq!(bars[0].vertices[2], Vec2::new(1.0, 0.0));
    assert_eq!(bars[0].vertices[0], Vec2::new(-1.0, 0.0));
    assert!((bars[1].vertices[1] - Vec2::new(0.8, -0.6)).length() < 1e-15);
    // Places behind the last vertex have no derivatives.
    assert_eq!(bars[0].vertices[4], Vec2::new(0.0, 0.0));
    let up = [2.0, -1.0];
    let pulled = cpu.aligned(Diameter.vjp(), (&polygons, &up)).unwrap();
    assert_eq!(pulled[0].vertices[2], Vec2::new(2.0, 0.0));
    let mut flat = polygons;
    flat[1].count = 2;
    assert!(matches!(
        cpu.aligned(Diameter, &flat),
        Err(Error::Invalid {
            argument: Argument::Named("polygon"),
            item: 1,
            ..
        })
    ));
}

/// Codes stand between the scalars of two shapes.
#[test]
fn searches_of_two_shapes() {
    let ring = |n: u32, x: f64| {
        let corner = |k: u32| {
            let (sin, cos) = (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
            Vec2::new(x + cos, sin)
        };
        ConvexPolygon::<f64, 6>::try_new(&(0..n).map(corner).collect::<Vec<_>>()).unwrap()
    };
    let a: Vec<_> = (0..40).map(|i| ring(3 + i % 4, 0.0)).collect();
    let b: Vec<_> = (0..40)
        .map(|i| ring(3 + i % 3, 0.02 * f64::from(i)))
        .collect();
    let cpu = Cpu::new();
    let (values, (by_a, by_b)) = cpu.aligned(Iou.value_grad(), (&a, &b)).unwrap();
    assert_eq!(cpu.aligned(Iou, (&a, &b)).unwrap(), values);
    for i in 0..40 {
        assert_eq!(values[i], a[i].iou(&b[i]), "{i}");
        assert_eq!((by_a[i].count, by_b[i].count), (a[i].count, b[i].count));
        // Nothing happens when both move.
        let sum = by_a[i].vertices.iter().chain(&by_b[i].vertices);
        let sum = sum.fold(Vec2::zero(), |sum, &bar| sum + bar);
        assert!(sum.length() < 1e-12, "{i}: {sum:?}");
    }
}

#[test]
fn rings_of_three_have_as_much_of_a_segment_as_triangles() {
    let mut dice = Dice(29);
    let mut spot = || point(&mut dice);
    let ways: Vec<Segment2<f64>> = (0..400).map(|_| Segment2::new(spot(), spot())).collect();
    let triangles: Vec<Triangle2<f64>> = (0..400)
        .map(|_| Triangle2::new(spot(), spot(), spot()))
        .collect();
    let vertices: Vec<Vec2<f64>> = triangles.iter().flat_map(|t| t.corners()).collect();
    let offsets: Vec<usize> = (0..=400).map(|k| 3 * k).collect();
    let cpu = Cpu::new();
    let by_rings = cpu
        .fold(LengthInsideRing, &ways, &vertices, &offsets)
        .unwrap();
    let by_triangles = cpu.aligned(LengthInside, (&ways, &triangles)).unwrap();
    let within = by_triangles.iter().filter(|&&length| length > 0.1).count();
    assert!((100..300).contains(&within), "{within} segments meet");
    let up = vec![1.0; 400];
    let (by_way, by_vertex) = cpu
        .fold_vjp(LengthInsideRing, &ways, &vertices, &offsets, &up)
        .unwrap();
    let (way_bars, triangle_bars) = cpu
        .aligned(LengthInside.vjp(), ((&ways, &triangles), &up))
        .unwrap();
    for i in 0..400 {
        let (found, known) = (by_rings[i], by_triangles[i]);
        assert!((found - known).abs() <= 1e-13, "item {i}: {found} {known}");
        let by_corners = by_vertex[3 * i..3 * i + 3].iter().flat_map(Pack::scalars);
        let found: Vec<f64> = by_way[i].scalars().into_iter().chain(by_corners).collect();
        let known = [way_bars[i].scalars(), triangle_bars[i].scalars()].concat();
        let size = known.iter().fold(1.0, |most: f64, by| most.max(by.abs()));
        for (found, known) in found.iter().zip(&known) {
            assert!(
                (found - known).abs() <= 1e-11 * size,
                "item {i}: {found} {known}"
            );
        }
    }
}

//! The nearest of many: the bits of a search through all pairs, for every row with a lower bound.
use geograd::ad::check::sample::Draw;
use geograd::distance::Convex;
use geograd::error::{Argument, Error};
use geograd::kernels::dynamic::{self, Function, Operation, Rows};
use geograd::kernels::machine::Least;
use geograd::kernels::op::LowerBound;
use geograd::kernels::reduce::{Best, Found};
use geograd::kernels::{Cpu, Distance, Groups, Iou, One, SignedDistance, at_least, function};
use geograd::{
    Aabb2, Capsule3, Circle, ConvexPolygon, Obb2, Obb3, Real, Rotation3, Scalar, Shape, Vec2, Vec3,
    operation,
};
use geograd_tests::{Dice, list};

/// Lists of numbers, with the offsets of their groups.
struct Lists<T> {
    numbers: [Vec<T>; 2],
    fields: [usize; 2],
    offsets: [Vec<usize>; 2],
}

impl<T: Real> Lists<T> {
    fn rows(&self, k: usize) -> Rows<'_, T> {
        Rows::new(&self.numbers[k], self.fields[k])
    }
    fn groups(&self) -> Groups<'_> {
        Groups::new(&self.offsets[0], &self.offsets[1])
    }
    fn counts(&self) -> [usize; 2] {
        [0, 1].map(|k| self.numbers[k].len() / self.fields[k])
    }
    /// The group of a row or column.
    fn group(&self, k: usize, i: usize) -> usize {
        self.offsets[k].partition_point(|&start| start <= i) - 1
    }
}

/// A pair as bits; zeros have no sign.
fn bits<T: Real + Into<f64>>(pair: &Found<T>) -> (usize, usize, u64) {
    (pair.row, pair.column, (pair.value.into() + 0.0).to_bits())
}

/// The results of a search, as bits.
type Bits = Vec<Option<(usize, usize, u64)>>;

fn all_bits<T: Real + Into<f64>>(found: &[Option<Found<T>>]) -> Bits {
    found.iter().map(|pair| pair.as_ref().map(bits)).collect()
}

/// Searches all pairs of a matrix for the least, one after another.
fn brute<T: Real + Into<f64>>(
    matrix: &[T],
    lists: &Lists<T>,
    is_grouped: bool,
    wanted: Least<T>,
) -> Bits {
    let [rows, columns] = lists.counts();
    let slots = match wanted {
        Least::Rows(_) => rows,
        Least::Columns(_) => columns,
        Least::Groups(_) if is_grouped => lists.offsets[0].len() - 1,
        Least::Groups(_) => 1,
        Least::Below(_) => 0,
    };
    let mut best: Vec<Option<Found<T>>> = vec![None; slots];
    let mut below = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let value = matrix[row * columns + column];
            let groups = [lists.group(0, row), lists.group(1, column)];
            if is_grouped && groups[0] != groups[1] || !value.finite() {
                continue;
            }
            let slot = match wanted {
                Least::Rows(_) => row,
                Least::Columns(_) => column,
                Least::Groups(_) if is_grouped => groups[0],
                Least::Groups(_) => 0,
                Least::Below(limit) => {
                    if value < limit {
                        below.push(Some(Found { row, column, value }));
                    }
                    continue;
                }
            };
            let (Least::Rows(cap) | Least::Columns(cap) | Least::Groups(cap) | Least::Below(cap)) =
                wanted;
            if value <= cap && best[slot].is_none_or(|best| value < best.value) {
                best[slot] = Some(Found { row, column, value });
            }
        }
    }
    match wanted {
        Least::Below(_) => all_bits(&below),
        _ => all_bits(&best),
    }
}

/// Compares every search with one through all pairs.
fn agrees<T: Real + Into<f64>>(name: &str, of: &Function<T>, lists: &Lists<T>) {
    let (a, b) = (lists.rows(0), lists.rows(1));
    let matrix = of.all_pairs(a, b).expect(name);
    let mut sorted: Vec<f64> = matrix.iter().map(|&x| x.into()).collect();
    sorted.retain(|x| x.is_finite());
    sorted.sort_by(f64::total_cmp);
    let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share) as usize];
    let infinite = f64::INFINITY;
    for cap in [infinite, -infinite, 0.0, -0.1, at(0.0), at(0.05), at(0.5)].map(T::lit) {
        for is_grouped in [false, true] {
            let groups = is_grouped.then(|| lists.groups());
            for wanted in [
                Least::Rows(cap),
                Least::Columns(cap),
                Least::Groups(cap),
                Least::Below(cap),
            ] {
                if matches!(wanted, Least::Below(_)) && !cap.finite() {
                    continue;
                }
                let found = of.least(a, b, groups, wanted).expect(name);
                let found = match wanted {
                    Least::Below(_) => found.pairs.into_iter().map(Some).collect(),
                    _ => found.best,
                };
                let expected = brute(&matrix, lists, is_grouped, wanted);
                assert_eq!(
                    all_bits(&found),
                    expected,
                    "{name}: {wanted:?} {is_grouped}"
                );
            }
        }
    }
}

/// Lists of a row's hard and random shapes; some occur several times.
fn drawn<T: Real>(operation: &Operation, seed: u64) -> Lists<T> {
    let samplers = operation.samplers();
    let mut draw = Draw::new(seed);
    let counts = [23, 61];
    let mut fields = [0; 2];
    let numbers = [0, 1].map(|k| {
        let (sampler, layout) = (&samplers[k], &operation.layouts::<T>()[k]);
        fields[k] = layout.fields();
        let hard = sampler.hard();
        let mut all: Vec<Vec<f64>> = Vec::new();
        while all.len() < counts[k] {
            let next = match draw.below(6) {
                0 if !all.is_empty() => all[draw.below(all.len())].clone(),
                1 | 2 => hard[draw.below(hard.len())].clone(),
                _ => sampler.draw(&mut draw),
            };
            all.push(next);
        }
        all.into_iter().flatten().map(T::nearest).collect()
    });
    Lists {
        numbers,
        fields,
        // An empty group on either side, and on both.
        offsets: [vec![0, 9, 9, 20, 20, 23], vec![0, 30, 31, 31, 31, 61]],
    }
}

fn rows_agree<T: Real + Into<f64>>() {
    let bounded = dynamic::operations()
        .iter()
        .filter(|operation| operation.lower != LowerBound::Unknown)
        .filter_map(|operation| Some((operation, operation.value::<T>()?)));
    let bounded: Vec<_> = bounded.collect();
    assert!(bounded.len() > 100, "{}", bounded.len());
    for (operation, of) in list::share_of(bounded, 12) {
        for seed in [1, 2] {
            let lists = drawn::<T>(operation, seed);
            // A drawn number may be invalid in the narrower format.
            match of.all_pairs(lists.rows(0), lists.rows(1)) {
                Ok(_) => agrees(operation.name, &of, &lists),
                Err(error) => assert!(matches!(error, Error::Invalid { .. }), "{error}"),
            }
        }
    }
}

#[test]
fn every_row_with_a_bound_finds_what_all_pairs_have() {
    rows_agree::<f64>();
    rows_agree::<f32>();
}

fn capsules(dice: &mut Dice, count: usize, size: f64) -> Vec<Capsule3<f64>> {
    let mut at = |far: f64| {
        let mut one = || dice.within(-far, far);
        Vec3::new(one(), one(), one())
    };
    let mut one = || {
        let start = at(4.0);
        Capsule3::new(start, start + at(size), size / 4.0)
    };
    (0..count).map(|_| one()).collect()
}

fn boxes(dice: &mut Dice, count: usize, size: f64) -> Vec<Obb3<f64>> {
    let mut one = |_| {
        let mut within = |low: f64, high: f64| dice.within(low, high);
        let center = Vec3::new(within(-4.0, 4.0), within(-4.0, 4.0), within(-4.0, 4.0));
        let sides = Vec3::new(within(0.0, size), within(0.0, size), within(0.0, size));
        let turn = Rotation3::new(
            within(0.1, 1.0),
            within(-1.0, 1.0),
            within(-1.0, 1.0),
            within(-1.0, 1.0),
        );
        Obb3::new(center, sides, turn)
    };
    (0..count).map(&mut one).collect()
}

/// Long lists are sorted; the order of equal results is that of the lists.
#[test]
fn long_lists_find_what_all_pairs_have() {
    let mut dice = Dice(3);
    let cpu = Cpu::new();
    for size in [0.05, 3.0] {
        let links = capsules(&mut dice, 40, size);
        let mut cubes = boxes(&mut dice, 700, size);
        cubes.extend_from_within(..500);
        let all = cpu.all_pairs(SignedDistance, &links, &cubes).unwrap();
        let of_row = |i: usize| {
            let row = (0..cubes.len()).map(|j| (j, all.at(i, j)));
            let (index, value) = row.reduce(|a, b| if b.1 < a.1 { b } else { a }).unwrap();
            Best { value, index }
        };
        let rows: Vec<_> = (0..links.len()).map(of_row).collect();
        assert_eq!(cpu.row_min(SignedDistance, &links, &cubes).unwrap(), rows);
        let of_column = |j: usize| {
            let column = (0..links.len()).map(|i| (i, all.at(i, j)));
            let (index, value) = column.reduce(|a, b| if b.1 < a.1 { b } else { a }).unwrap();
            Best { value, index }
        };
        let columns: Vec<_> = (0..cubes.len()).map(of_column).collect();
        assert_eq!(
            cpu.column_min(SignedDistance, &links, &cubes).unwrap(),
            columns
        );
        let below = cpu.below(SignedDistance, &links, &cubes, 0.1).unwrap();
        let expected = (0..links.len()).flat_map(|i| (0..cubes.len()).map(move |j| (i, j)));
        let expected: Vec<_> = expected.filter(|&(i, j)| all.at(i, j) < 0.1).collect();
        let places: Vec<_> = below.iter().map(|pair| (pair.row, pair.column)).collect();
        assert_eq!(places, expected);
        assert_eq!(
            cpu.count_below(SignedDistance, &links, &cubes, 0.1)
                .unwrap(),
            expected.len() as u64
        );
        let nearest = cpu
            .nearest(SignedDistance, &links, &cubes, f64::INFINITY)
            .unwrap()
            .unwrap();
        let least = rows
            .iter()
            .map(|best| best.value)
            .fold(f64::INFINITY, f64::min);
        assert_eq!((nearest.value, rows[nearest.row].value), (least, least));
        assert_eq!(rows[nearest.row].index, nearest.column);
    }
}

/// Threads and lower bounds change no bit.
#[test]
fn threads_and_bounds_change_nothing() {
    let mut dice = Dice(5);
    let (links, cubes) = (capsules(&mut dice, 300, 0.5), boxes(&mut dice, 300, 0.5));
    let run = |cpu: Cpu| {
        let cap = f64::INFINITY;
        (
            cpu.row_min_grad(SignedDistance, &links, &cubes, cap)
                .unwrap(),
            cpu.column_min_grad(SignedDistance, &links, &cubes, 0.2)
                .unwrap(),
            cpu.nearest_grad(SignedDistance, &links, &cubes, cap)
                .unwrap(),
            cpu.below(SignedDistance, &links, &cubes, 0.3).unwrap(),
        )
    };
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    let five = rayon::ThreadPoolBuilder::new()
        .num_threads(5)
        .build()
        .unwrap();
    let alone = one.install(|| run(Cpu::new()));
    assert!(alone == five.install(|| run(Cpu::new())));
    assert!(alone == run(Cpu::new().culled(false)));
}

/// A list on the machine keeps boxes around its shapes for each function, until it is updated.
#[test]
fn held_lists_find_what_lists_in_memory_do() {
    let mut dice = Dice(9);
    let links = capsules(&mut dice, 20, 0.5);
    let lists = [
        boxes(&mut dice, 700, 0.5),
        boxes(&mut dice, 700, 0.5),
        boxes(&mut dice, 700, 2.0),
    ];
    let cpu = Cpu::new();
    let mut held = cpu.upload(&lists[0]).unwrap();
    let cap = f64::INFINITY;
    for cubes in &lists {
        held.update(cubes).unwrap();
        for _ in 0..2 {
            for part in [&links[..1], &links[3..], &links] {
                let here = cpu.nearest_grad(SignedDistance, part, cubes, cap);
                let there = cpu.nearest_grad(SignedDistance, part, &held, cap);
                assert!(here.unwrap() == there.unwrap());
                let here = cpu.row_min(Distance, part, cubes).unwrap();
                assert_eq!(here, cpu.row_min(Distance, part, &held).unwrap());
                let all = cpu.culled(false).row_min(Distance, part, &held).unwrap();
                assert_eq!(here, all);
            }
            let ends = ([0, 5, 20], [0, 600, 700]);
            let groups = || Groups::new(&ends.0, &ends.1);
            let here = cpu.nearest_grouped(SignedDistance, &links, cubes, groups(), cap);
            let there = cpu.nearest_grouped(SignedDistance, &links, &held, groups(), cap);
            assert_eq!(here.unwrap(), there.unwrap());
        }
    }
    let fault = held.update(
        &[Obb3::new(
            Vec3::zero(),
            Vec3::new(-1.0, 1.0, 1.0),
            lists[0][0].rotation,
        ); 700],
    );
    assert!(matches!(fault, Err(Error::Invalid { item: 0, .. })));
    let here = cpu.nearest(SignedDistance, &links, &lists[2], cap).unwrap();
    assert_eq!(
        here,
        cpu.nearest(SignedDistance, &links, &held, cap).unwrap()
    );
}

fn less<S: Scalar>(a: Vec2<S>, b: Vec2<S>) -> S {
    -(a - b).length()
}
fn squares<S: Scalar>(a: Vec2<S>, b: Vec2<S>) -> S {
    (a - b).length_squared()
}

/// A bound that does not hold shows that pairs are skipped, and how many.
#[test]
fn pairs_above_the_least_or_the_cap_are_not_computed() {
    let from = [Vec2::new(0.0, 0.0)];
    let to: Vec<_> = (1..=100).map(|i| Vec2::new(f64::from(i), 0.0)).collect();
    let cpu = Cpu::new();
    // All pairs: the farthest has the least result.
    assert_eq!(
        cpu.row_min(function(less), &from, &to).unwrap()[0].index,
        99
    );
    let wrong = at_least(LowerBound::Distance, function(less));
    let best = cpu.row_min(wrong, &from, &to).unwrap()[0];
    // The nearest by its bound is among the few that are computed.
    assert!(best.value <= -1.0 && best.index < 50, "{best:?}");
    let all = cpu.below(wrong, &from, &to, 10.5).unwrap();
    assert_eq!(all.len(), 10);
    assert_eq!(cpu.row_min_within(wrong, &from, &to, 0.5).unwrap(), [None]);
    let squared = at_least(LowerBound::SquaredDistance, function(squares));
    assert_eq!(cpu.below(squared, &from, &to, 100.5).unwrap().len(), 10);
    // A bound says nothing of a derivative.
    let grads = cpu.all_pairs(
        at_least(LowerBound::Distance, function(squares)),
        &from,
        &to,
    );
    assert_eq!(grads.unwrap().at(0, 9), 100.0);
}

#[test]
fn equal_pairs_share_the_gradient() {
    let carts = [Vec2::new(0.0, 0.0), Vec2::new(9.0, 0.0)];
    let mast = |x, y| Circle::new(Vec2::new(x, y), 1.0);
    let masts = [
        mast(3.0, 0.0),
        mast(0.0, 3.0),
        mast(0.0, -3.0),
        mast(-4.0, 0.0),
        mast(3.0, 0.0),
    ];
    let cpu = Cpu::new();
    let infinite = f64::INFINITY;
    let (near, by_carts, by_masts) = cpu
        .row_min_grad(Distance, &carts, &masts, infinite)
        .unwrap();
    assert_eq!(
        near[0],
        Some(Best {
            value: 2.0,
            index: 0
        })
    );
    assert_eq!(
        near[1],
        Some(Best {
            value: 5.0,
            index: 0
        })
    );
    // Four masts are equally near to the first cart: 0, 1, 2 and 4. Two are to the second: 0 and 4.
    assert_eq!(by_carts, [Vec2::new(-0.5, 0.0), Vec2::new(1.0, 0.0)]);
    let radii = by_masts.iter().map(|by| by.radius).collect::<Vec<_>>();
    assert_eq!(radii, [-0.75, -0.25, -0.25, 0.0, -0.75]);
    // Without a bound it is the same.
    let all = cpu
        .culled(false)
        .row_min_grad(Distance, &carts, &masts, infinite)
        .unwrap();
    assert!(all == (near, by_carts.clone(), by_masts.clone()));
    // The adjoint weighs rows; a row beyond the cap and one of weight zero have no share.
    let (by, _) = cpu
        .row_min_vjp(Distance, &carts, &masts, infinite, &[0.0, 2.0])
        .unwrap();
    assert_eq!(by, [Vec2::new(0.0, 0.0), Vec2::new(2.0, 0.0)]);
    let (by, _) = cpu
        .row_min_vjp(Distance, &carts, &masts, 3.0, &[1.0, 1.0])
        .unwrap();
    assert_eq!(by, [Vec2::new(-0.5, 0.0), Vec2::new(0.0, 0.0)]);
    let (pair, by, _) = cpu
        .nearest_grad(Distance, &carts, &masts, infinite)
        .unwrap();
    assert_eq!((pair.unwrap().value, by[0]), (2.0, by_carts[0]));
    let groups = Groups::new(&[0, 1, 2], &[0, 4, 5]);
    let (by, by_masts) = cpu
        .nearest_grouped_vjp(Distance, &carts, &masts, groups, infinite, &[1.0, 3.0])
        .unwrap();
    assert_eq!(by[1], Vec2::new(3.0, 0.0));
    assert_eq!(by_masts[4].radius, -3.0);
    assert!(by_masts[..3].iter().all(|by| by.radius == -1.0 / 3.0));
    let by = cpu.column_min_vjp(
        Distance,
        &carts,
        &masts,
        infinite,
        &[0.0, 0.0, 0.0, 1.0, 0.0],
    );
    assert_eq!(by.unwrap().0, [Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)]);
}

#[test]
fn nothing_is_nearest_to_nothing() {
    let cpu = Cpu::new();
    let (some, none): (_, [Vec2<f64>; 0]) = ([Vec2::new(0.0, 0.0)], []);
    let refused = cpu.row_min(Distance, &some, &none).unwrap_err();
    assert_eq!(
        refused,
        Error::NoLargest {
            argument: Argument::B
        }
    );
    assert_eq!(cpu.row_min(Distance, &none, &none), Ok(vec![]));
    let infinite = f64::INFINITY;
    assert_eq!(
        cpu.row_min_within(Distance, &some, &none, infinite),
        Ok(vec![None])
    );
    assert_eq!(
        cpu.column_min_within(Distance, &none, &some, infinite),
        Ok(vec![None])
    );
    assert_eq!(cpu.nearest(Distance, &some, &none, infinite), Ok(None));
    assert_eq!(cpu.below(Distance, &some, &none, 1.0), Ok(vec![]));
    let (near, by, _) = cpu.row_min_grad(Distance, &some, &none, infinite).unwrap();
    assert_eq!((near, by[0]), (vec![None], Vec2::new(0.0, 0.0)));
    // A distance of zero is at most a cap of zero, and not below a limit of zero.
    assert!(cpu.row_min_within(Distance, &some, &some, 0.0).unwrap()[0].is_some());
    assert_eq!(cpu.below(Distance, &some, &some, 0.0), Ok(vec![]));
}

#[test]
fn bad_arguments_are_named() {
    let cpu = Cpu::new();
    let some = [Vec2::new(0.0, 0.0)];
    let bad = [Vec2::new(0.0, 0.0), Vec2::new(f64::NAN, 0.0)];
    let argument = |error: Error| match error {
        Error::Invalid { argument, item, .. } => (argument, item),
        other => panic!("{other}"),
    };
    let refused = cpu.row_min(Distance, &some, &bad).unwrap_err();
    assert_eq!(argument(refused), (Argument::B, 1));
    let refused = cpu
        .row_min_within(Distance, &some, &some, f64::NAN)
        .unwrap_err();
    assert_eq!(argument(refused), (Argument::Threshold, 0));
    let refused = cpu
        .below(Distance, &some, &some, f64::INFINITY)
        .unwrap_err();
    assert_eq!(argument(refused), (Argument::Threshold, 0));
    let refused = cpu
        .row_min_vjp(Distance, &some, &some, 1.0, &[f64::NAN])
        .unwrap_err();
    assert_eq!(argument(refused), (Argument::Upstream, 0));
    assert!(matches!(
        cpu.row_min_vjp(Distance, &some, &some, 1.0, &[]),
        Err(Error::Length { .. })
    ));
    assert!(matches!(
        cpu.row_min_grouped(Distance, &some, &some, Groups::new(&[0, 2], &[0, 1]), 1.0),
        Err(Error::GroupsOf { .. })
    ));
}

/// A tree whose bounds are known to batches.
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(bounding)]
struct Tree<S> {
    foot: Vec2<S>,
    #[shape(positive)]
    radius: S,
}

impl<S: Scalar> Tree<S> {
    fn bounding(self) -> Aabb2<S> {
        Circle::new(self.foot, self.radius).bounding()
    }
}

operation! {
    /// From a vehicle to a tree.
    Distance: (car: Obb2<S>, tree: Tree<S>) -> S {
        (car.signed_distance(tree.foot) - tree.radius).most(S::zero())
    }
    invariances [TranslationX Stays, TranslationY Stays, Rotation Stays, Scaling Power(1)]
    lower Distance
    jumps Never
    derivative Reverse
}

/// Shapes of one's own have bounds, too; overlaps and searches have none and compute all pairs.
#[test]
fn own_shapes_overlaps_and_searches() {
    let mut dice = Dice(8);
    let cpu = Cpu::new();
    let cars: Vec<_> = (0..30).map(|_| dice.obb()).collect();
    let trees: Vec<_> = (0..50)
        .map(|_| Tree {
            foot: Vec2::new(dice.within(-9.0, 9.0), dice.within(-9.0, 9.0)),
            radius: dice.within(0.1, 0.6),
        })
        .collect();
    let all = cpu.all_pairs(Distance, &cars, &trees).unwrap();
    for (i, best) in cpu
        .row_min(Distance, &cars, &trees)
        .unwrap()
        .iter()
        .enumerate()
    {
        let row = (0..trees.len()).map(|j| all.at(i, j));
        assert_eq!(best.value, row.fold(f64::INFINITY, f64::min));
        assert_eq!(all.at(i, best.index), best.value);
    }
    let all = cpu.all_pairs(Iou, &cars, &cars).unwrap();
    for (i, best) in cpu.row_min(Iou, &cars, &cars).unwrap().iter().enumerate() {
        let row: Vec<_> = (0..cars.len()).map(|j| all.at(i, j)).collect();
        let least = row.iter().copied().fold(f64::INFINITY, f64::min);
        let first = row.iter().position(|&x| x == least);
        assert_eq!((best.value, Some(best.index)), (least, first));
    }
    let polygons: Vec<_> = cars
        .iter()
        .map(|car| ConvexPolygon::<f64, 4>::from_vertices(&car.corners()))
        .collect();
    let all = cpu.all_pairs(Distance, &polygons, &polygons[..9]).unwrap();
    for (j, best) in cpu
        .column_min(Distance, &polygons, &polygons[..9])
        .unwrap()
        .iter()
        .enumerate()
    {
        let column = (0..polygons.len()).map(|i| all.at(i, j));
        assert_eq!(best.value, column.fold(f64::INFINITY, f64::min));
    }
    // One shape stands for a list of one.
    let one = cpu.row_min(Distance, One(cars[0]), &trees).unwrap();
    assert_eq!(one, cpu.row_min(Distance, &cars[..1], &trees).unwrap());
}

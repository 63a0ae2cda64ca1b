//! Searches over shapes with codes (polygons, which count their vertices), all pairs.
use geograd::kernels::op::{Declared, Declares, Jumps};
use geograd::kernels::search::{HintedSearch, Search, search};
use geograd::kernels::{Cpu, Iou, MinimumCircle, MinimumRectangle, One, Width};
use geograd::{ConvexPolygon, Fixed, Pack, Scalar, Vec2};
use geograd_tests::Dice;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicU64, Ordering};

/// How often the search below decided.
static DECISIONS: AtomicU64 = AtomicU64::new(0);

/// The larger of two numbers.
#[derive(Clone, Copy, Debug, Default)]
struct Larger;

impl Declares for Larger {
    const DECLARED: Declared = Declared::new("larger", &[], Jumps::Never);
}

impl Search for Larger {
    type In<S: Scalar> = [S; 2];
    type Out<S: Scalar> = S;
    type Record = bool;
    fn decide<S: Scalar<Mask = bool>>([a, b]: [S; 2]) -> bool {
        DECISIONS.fetch_add(1, Ordering::Relaxed);
        a.above(b)
    }
    fn replay<S: Scalar>([a, b]: [S; 2], record: bool) -> S {
        if record { a } else { b }
    }
}

#[test]
fn an_item_is_decided_once() {
    let items = [
        [1.0, 2.0],
        [1.0, 2.0],
        [3.0, 2.0],
        [0.0, 0.5],
        [0.0, -0.0],
        [0.0, 0.0],
    ];
    let cpu = Cpu::new();
    let larger = search(Larger);
    let found: Vec<f64> = cpu.aligned(larger, &items).unwrap();
    assert_eq!(found, [2.0, 2.0, 3.0, 0.5, 0.0, 0.0]);
    // The first two are equal; zeros of two signs are not.
    assert_eq!(DECISIONS.swap(0, Ordering::Relaxed), 5);
    let (_, slopes) = cpu.aligned(larger.value_grad(), &items[2..4]).unwrap();
    assert_eq!(slopes, [[1.0, 0.0], [0.0, 1.0]]);
    assert_eq!(DECISIONS.swap(0, Ordering::Relaxed), 2);
    let along = cpu
        .aligned(larger.jvp(), (&items[..1], &[[5.0, 7.0]]))
        .unwrap();
    assert_eq!(along, (vec![2.0], vec![7.0]));
    assert_eq!(DECISIONS.swap(0, Ordering::Relaxed), 1);
}

/// The cube root of a positive number, from a hint.
#[derive(Clone, Copy, Debug, Default)]
struct CubeRoot;

impl Declares for CubeRoot {
    const DECLARED: Declared = Declared::new("cube_root", &[], Jumps::Never);
}

/// Newton's step to the cube root.
fn step<S: Scalar>(x: S, root: S) -> S {
    root - (root * root * root - x).over(S::lit(3.0) * root * root)
}

impl HintedSearch for CubeRoot {
    type In<S: Scalar> = S;
    type Out<S: Scalar> = [S; 2];
    type Record = ();
    type Hints<S: Scalar> = [S; 1];
    fn decide_with_hints<S: Scalar<Mask = bool>>(x: S) -> ((), [S; 1]) {
        (
            (),
            [(0..100).fold(x.most(S::one()), |root, _| step(x, root))],
        )
    }
    /// The root, and its square. A second step makes second derivatives right.
    fn replay_with_hints<S: Scalar>(x: S, (): (), [root]: [S; 1]) -> [S; 2] {
        let root = step(x, step(x, root));
        [root, root * root]
    }
}

/// The cube root alone.
#[derive(Clone, Copy, Debug, Default)]
struct Root;

impl Declares for Root {
    const DECLARED: Declared = Declared::new("root", &[], Jumps::Never);
}

impl HintedSearch for Root {
    type In<S: Scalar> = S;
    type Out<S: Scalar> = S;
    type Record = ();
    type Hints<S: Scalar> = [S; 1];
    fn decide_with_hints<S: Scalar<Mask = bool>>(x: S) -> ((), [S; 1]) {
        CubeRoot::decide_with_hints(x)
    }
    fn replay_with_hints<S: Scalar>(x: S, (): (), hints: [S; 1]) -> S {
        CubeRoot::replay_with_hints(x, (), hints)[0]
    }
}

#[test]
fn hints_are_constants_of_every_derivative() {
    let close = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    };
    let (cpu, x) = (Cpu::new(), [8.0, 27.0]);
    let (roots, by) = cpu.aligned(search(CubeRoot).jacobian(), &x).unwrap();
    assert_eq!(roots, [[2.0, 4.0], [3.0, 9.0]]);
    close(by[0][0], 1.0 / 12.0);
    close(by[1][1], 2.0 / 9.0);
    let bars: Vec<f64> = cpu
        .aligned(search(CubeRoot).vjp(), (&x, &[[1.0, 0.0], [0.0, 3.0]]))
        .unwrap();
    close(bars[0], 1.0 / 12.0);
    close(bars[1], 2.0 / 3.0);
    let root = search(Root);
    let (roots, along): (Vec<f64>, Vec<f64>) =
        cpu.aligned(root.jvp(), (&x, &[12.0, 27.0])).unwrap();
    assert_eq!(roots, [2.0, 3.0]);
    close(along[0], 1.0);
    close(along[1], 1.0);
    // The second derivative is −2/9 x^(−5/3).
    let bends: Vec<f64> = cpu.aligned(root.hvp(), (&x, &[1.0, 2.0])).unwrap();
    close(bends[0], -2.0 / 9.0 / 32.0);
    close(bends[1], -4.0 / 9.0 / 243.0);
}

/// Regular polygons of three to five corners.
fn polygons(dice: &mut Dice, count: usize) -> Vec<ConvexPolygon<f64, 5>> {
    let mut one = || {
        let corners = 3 + dice.below(3);
        let center = Vec2::new(dice.within(-2.0, 2.0), dice.within(-2.0, 2.0));
        let radius = dice.within(0.5, 2.0);
        let corner = |k: usize| {
            let at = TAU * k as f64 / corners as f64;
            center + Vec2::new(radius * at.cos(), radius * at.sin())
        };
        ConvexPolygon::try_new(&(0..corners).map(corner).collect::<Vec<_>>()).unwrap()
    };
    std::iter::repeat_with(&mut one).take(count).collect()
}

#[test]
fn all_pairs_of_polygons_are_those_of_aligned_pairs() {
    let mut dice = Dice(5);
    let (a, b) = (polygons(&mut dice, 11), polygons(&mut dice, 19));
    let run = Iou;
    let cpu = Cpu::new();
    let table = cpu.all_pairs(run, &a, &b).unwrap();
    let derivatives = cpu.all_pairs(run.value_grad(), &a, &b).unwrap();
    let upstream: Vec<f64> = (0..a.len() * b.len()).map(|k| k as f64 - 100.0).collect();
    let (a_bar, b_bar) = cpu.all_pairs_vjp(run, &a, &b, &upstream).unwrap();
    let mut sums = [vec![vec![0.0; 10]; a.len()], vec![vec![0.0; 10]; b.len()]];
    let mut meeting = 0;
    for i in 0..a.len() {
        for j in 0..b.len() {
            let (iou, (by_a, by_b)) = cpu
                .aligned(run.value_grad(), (&a[i..=i], &b[j..=j]))
                .unwrap();
            meeting += usize::from(iou[0] > 0.0);
            assert_eq!(table.at(i, j), iou[0]);
            assert_eq!(derivatives.at(i, j), (iou[0], (by_a[0], by_b[0])));
            let by = upstream[i * b.len() + j];
            for (list, at, derivative) in [(0, i, by_a[0]), (1, j, by_b[0])] {
                for (sum, x) in sums[list][at].iter_mut().zip(derivative.scalars()) {
                    *sum += by * x;
                }
            }
        }
    }
    assert!(meeting > 25, "{meeting}");
    for (list, bars, shapes) in [(0, &a_bar, &a), (1, &b_bar, &b)] {
        for (i, bar) in bars.iter().enumerate() {
            assert_eq!(
                bar.codes(),
                shapes[i].codes(),
                "a gradient has its shape's vertices"
            );
            for (x, sum) in bar.scalars().iter().zip(&sums[list][i]) {
                assert!((x - sum).abs() <= 1e-9 * (1.0 + sum.abs()), "{x} {sum}");
            }
        }
    }
    let best = cpu.row_max(run, &a, &b).unwrap();
    for (i, best) in best.iter().enumerate() {
        let row = (0..b.len()).map(|j| table.at(i, j)).fold(0.0, f64::max);
        assert_eq!(best.value, row);
    }
}

/// Polygons as far along a direction, a list of numbers in their shape, as a step says.
fn moved(
    shapes: &[ConvexPolygon<f64, 5>],
    along: &[ConvexPolygon<f64, 5>],
    step: f64,
) -> Vec<ConvexPolygon<f64, 5>> {
    let one = |(x, by): (&ConvexPolygon<f64, 5>, &ConvexPolygon<f64, 5>)| {
        let mut by = by.scalars().into_iter();
        x.remake(&mut |&x| x + step * by.next().unwrap())
    };
    shapes.iter().zip(along).map(one).collect()
}

/// Directions, whose number of vertices means nothing.
fn directions(dice: &mut Dice, count: usize) -> Vec<ConvexPolygon<f64, 5>> {
    let one = || {
        let mut number = || dice.within(-1.0, 1.0);
        ConvexPolygon {
            vertices: [(); 5].map(|()| Vec2::new(number(), number())),
            count: 0,
        }
    };
    std::iter::repeat_with(one).take(count).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[track_caller]
fn near(found: f64, expected: f64, tolerance: f64) {
    let bound = tolerance * (1.0 + expected.abs());
    assert!((found - expected).abs() <= bound, "{found} for {expected}");
}

/// A search of two arguments along directions: beside its gradient, its Hessian, and differences of both.
#[test]
fn a_search_along_directions() {
    const COUNT: usize = 60;
    const STEP: f64 = 1e-5;
    let mut dice = Dice(11);
    let (a, b) = (polygons(&mut dice, COUNT), polygons(&mut dice, COUNT));
    let (to_a, to_b) = (directions(&mut dice, COUNT), directions(&mut dice, COUNT));
    let columns = ((&a, &b), (&to_a, &to_b));
    let cpu = Cpu::new();
    let (values, (by_a, by_b)) = cpu.aligned(Iou.value_grad(), (&a, &b)).unwrap();
    let (again, slopes) = cpu.aligned(Iou.jvp(), columns).unwrap();
    let (curved_a, curved_b) = cpu.aligned(Iou.hvp(), columns).unwrap();
    let ((_, _), second) = cpu.aligned(Iou.hessian(), (&a, &b)).unwrap();
    let bars = (One(1.0), One(0.0));
    let (to_values, to_directions) = cpu.aligned(Iou.jvp().vjp(), (columns, bars)).unwrap();
    let beside = |step: f64| {
        let columns = (&moved(&a, &to_a, step), &moved(&b, &to_b, step));
        cpu.aligned(Iou.value_grad(), columns).unwrap()
    };
    let (before, after) = (beside(-STEP), beside(STEP));
    let (mut sloping, mut bent) = (0, 0);
    for i in 0..COUNT {
        let direction = [to_a[i].scalars(), to_b[i].scalars()].concat();
        let gradient = [by_a[i].scalars(), by_b[i].scalars()].concat();
        assert_eq!(again[i], values[i]);
        near(slopes[i], dot(&gradient, &direction), 1e-12);
        near(slopes[i], (after.0[i] - before.0[i]) / (2.0 * STEP), 1e-6);
        sloping += usize::from(slopes[i] != 0.0);
        let (own_a, own_b) = (&curved_a[i], &curved_b[i]);
        assert_eq!((own_a.codes(), own_b.codes()), (a[i].codes(), b[i].codes()));
        let product = [own_a.scalars(), own_b.scalars()].concat();
        let gradients =
            |all: &[ConvexPolygon<f64, 5>; 2]| all.each_ref().map(Pack::scalars).concat();
        let (low, high) = (
            gradients(&[before.1.0[i], before.1.1[i]]),
            gradients(&[after.1.0[i], after.1.1[i]]),
        );
        // The Hessian: in the place of every number of the gradient its own gradient.
        let (_, (of_a, of_b)) = &second[i];
        let rows: Vec<Vec<f64>> = [of_a.scalars(), of_b.scalars()]
            .concat()
            .iter()
            .map(Pack::scalars)
            .collect();
        for (k, &x) in product.iter().enumerate() {
            near(x, dot(&rows[k], &direction), 1e-10);
            near(x, (high[k] - low[k]) / (2.0 * STEP), 1e-4);
            bent += usize::from(x != 0.0);
        }
        // The value's own cotangent through the derivative along a direction: the gradient again.
        let pulled = [to_values.0[i].scalars(), to_values.1[i].scalars()].concat();
        for (&x, &expected) in pulled.iter().zip(&gradient) {
            near(x, expected, 1e-12);
        }
        assert!(to_directions.0[i].scalars().iter().all(|&x| x == 0.0));
    }
    assert!(sloping > COUNT / 3 && bent > 4 * COUNT, "{sloping} {bent}");
}

/// Searches of one argument whose results are shapes.
#[test]
fn shapes_around_polygons_along_directions() {
    const COUNT: usize = 40;
    let mut dice = Dice(13);
    let (all, along) = (polygons(&mut dice, COUNT), directions(&mut dice, COUNT));
    let cpu = Cpu::new();
    macro_rules! beside_the_jacobian {
        ($($Verb:ident)*) => { $({
            let (values, slopes) = cpu.aligned($Verb.jvp(), (&all, &along)).unwrap();
            let (own, jacobian) = cpu.aligned($Verb.jacobian(), &all).unwrap();
            for i in 0..COUNT {
                assert_eq!(values[i], own[i]);
                let rows = jacobian[i].scalars();
                for (slope, row) in slopes[i].scalars().iter().zip(&rows) {
                    near(*slope, dot(&row.scalars(), &along[i].scalars()), 1e-12);
                }
                assert!(slopes[i].scalars().iter().any(|&x| x != 0.0));
            }
        })* };
    }
    beside_the_jacobian!(MinimumCircle MinimumRectangle);
    let (widths, slopes) = cpu.aligned(Width.jvp(), (&all, &along)).unwrap();
    let (own, gradients) = cpu.aligned(Width.value_grad(), &all).unwrap();
    assert_eq!(widths, own);
    for i in 0..COUNT {
        near(
            slopes[i],
            dot(&gradients[i].scalars(), &along[i].scalars()),
            1e-12,
        );
    }
}

/// A tick of a scale on either side of zero.
#[derive(Clone, Copy, Debug, PartialEq, geograd::Shape)]
struct Tick<S> {
    step: S,
    #[shape(code)]
    place: i32,
}

#[test]
fn codes_have_signs() {
    let ticks: Vec<Tick<f32>> = [-2, 0, 7, -16_777_216]
        .map(|place| Tick { step: 0.5, place })
        .to_vec();
    let held = Cpu::new().upload(&ticks).unwrap();
    assert_eq!(held.download().unwrap(), ticks);
}

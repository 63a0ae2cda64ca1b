//! Same bits, signs of zeros included: of the scalar code, at every level of vector instructions, at
//! every position of a batch, for any number of threads, with the filter of all pairs and without.
use geograd::kernels::check::{Folded, Straight, WithAdjoint};
use geograd::kernels::cpu::program::measured::compile_after;
use geograd::kernels::cpu::simd::Simd;
use geograd::kernels::fold::fold;
use geograd::kernels::reduce::Matrix;
use geograd::{Aabb2, Aabb3, Obb2, Obb3, Pack, Rotation3, Scalar, Vec2, Vec3, YawBox3};
use geograd_tests::calls::OfRings;
use geograd_tests::calls::{self, Number, Pair, wide};
use geograd_tests::list::share_of;
use geograd_tests::rows::ring;
use geograd_tests::{Dice, with_threads};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Level and filter are one for the whole process; tests that change them take turns.
static SETTINGS: Mutex<()> = Mutex::new(());

/// Alone until the guard is dropped, which puts everything back.
pub struct Turn(#[expect(dead_code)] MutexGuard<'static, ()>);

impl Turn {
    pub fn take() -> Turn {
        Turn(SETTINGS.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        Simd::limit(None).unwrap();
        compile_after(64);
        calls::cull(true);
    }
}

/// At every level, with the filter and without.
fn in_every_way(mut run: impl FnMut(&str)) {
    let _turn = Turn::take();
    for level in Simd::available() {
        Simd::limit(Some(level)).unwrap();
        assert_eq!(Simd::current(), Ok(level));
        for filter in [true, false] {
            calls::cull(filter);
            run(&format!("{level:?}, filter {filter}"));
        }
    }
}

fn bits_of<'a, X: Pack + 'a>(shapes: impl IntoIterator<Item = &'a X>) -> Vec<u64>
where
    X::Scalar: Number,
{
    shapes
        .into_iter()
        .flat_map(Pack::scalars)
        .map(|x| wide(x).to_bits())
        .collect()
}

fn bits<T: Number>(numbers: &[T]) -> Vec<u64> {
    numbers.iter().map(|&x| wide(x).to_bits()).collect()
}

/// Shapes of a kind, ordinary and hard ones.
pub trait Drawn: Sized {
    fn draw(dice: &mut Dice, kind: usize) -> Self;
}

/// Kinds of shapes: so many, of which the last ones are extreme.
const KINDS: usize = 12;
pub const MILD: usize = 9;

impl<T: Number> Drawn for Obb2<T> {
    fn draw(dice: &mut Dice, kind: usize) -> Self {
        let b = dice.obb();
        let (x, y, w, h, r) = (b.center.x, b.center.y, b.size.x, b.size.y, b.heading);
        let (near, whole) = (|x: f64| 0.25 * x, |x: f64| x.trunc());
        let b = match kind {
            0 | 1 => Obb2::new(near(x), near(y), w, h, r),
            2 => Obb2::new(whole(near(x)), whole(near(y)), whole(w), whole(h), 0.0),
            3 => Obb2::new(0.0, -0.0, 2.0, 1.0, std::f64::consts::FRAC_PI_4 * whole(r)),
            4 => Obb2::new(1.0, 0.5, whole(w), 0.0, r),
            5 => Obb2::new(0.0, 0.0, 0.0, 0.0, r),
            6 => Obb2::new(near(x), near(y), w * 1e-3, h, r * 1e3),
            7 => Obb2::new(x * 20.0, y * 20.0, w, h, r),
            8 => Obb2::new(near(x), near(y), w, h, -0.0),
            9 => Obb2::new(x * 1e-20, y * 1e-20, w * 1e-20, h * 1e-24, r * 1e7),
            10 => Obb2::new(x * 1e18, y, w * 1e19, h * 1e-12, r),
            _ => Obb2::new(x, y, w * 1e-30, h * 1e30, r * 1e30),
        };
        b.remake(&mut |&x| T::lit(x))
    }
}

impl<T: Number> Drawn for Aabb2<T> {
    fn draw(dice: &mut Dice, kind: usize) -> Self {
        let b = dice.obb();
        let (x, y, w, h) = (b.center.x, b.center.y, b.size.x, b.size.y);
        let (x, y, w, h) = match kind {
            0 | 1 => (0.25 * x, 0.25 * y, w, h),
            2 | 3 => (x.trunc(), y.trunc(), w.trunc(), h.trunc()),
            4 => (0.0, 0.0, 0.0, h.trunc()),
            5 => (0.0, -0.0, 0.0, 0.0),
            6 => (0.1 * x, 0.1 * y, w * 1e-6, h),
            7 => (x * 20.0, y * 20.0, w, h),
            8 => (-w, -h, w, h),
            9 => (x * 1e-30, y * 1e-30, w * 1e-30, h * 1e-36),
            10 => (x * 1e18, y, w * 1e19, h * 1e-12),
            _ => (x, y, w * 1e-30, h * 1e30),
        };
        let [left, bottom, right, top] = [x, y, x + w, y + h].map(|x| T::lit(x));
        Aabb2::new(left, bottom, right, top)
    }
}

impl<T: Number> Drawn for YawBox3<T> {
    fn draw(dice: &mut Dice, kind: usize) -> Self {
        let x: Obb2<T> = Drawn::draw(dice, kind);
        let (z, dz) = (dice.within(-2.0, 2.0), dice.within(0.0, 3.0));
        let (z, dz) = match dice.below(6) {
            0 => (z.trunc(), dz.trunc()),
            1 => (0.25 * z, 0.0),
            2 if kind >= MILD => (z * 1e20, dz * 1e-20),
            3 if kind >= MILD => (z * 1e-30, dz * 1e25),
            _ => (0.25 * z, dz),
        };
        let (z, dz) = (T::lit(z), T::lit(dz));
        YawBox3::new(
            Vec3::new(x.center.x, x.center.y, z),
            Vec3::new(x.size.x, x.size.y, dz),
            x.heading,
        )
    }
}

impl<T: Number> Drawn for Obb3<T> {
    fn draw(dice: &mut Dice, kind: usize) -> Self {
        let x: YawBox3<T> = Drawn::draw(dice, kind);
        let mut number = || T::lit(dice.within(-1.0, 1.0));
        let turn = match kind {
            2 | 5 => x.rotation(),
            3 => Rotation3::new(T::one(), T::one(), T::default(), T::default()),
            _ => Rotation3::new(number(), number(), number(), number()),
        };
        Obb3::new(x.center, x.size, turn)
    }
}

impl<T: Number> Drawn for Aabb3<T> {
    fn draw(dice: &mut Dice, kind: usize) -> Self {
        let x: Aabb2<T> = Drawn::draw(dice, kind);
        let (z, dz) = (dice.within(-2.0, 2.0).trunc(), dice.within(0.0, 3.0));
        Aabb3::new(
            Vec3::new(x.min.x, x.min.y, T::lit(z)),
            Vec3::new(x.max.x, x.max.y, T::lit(z + dz)),
        )
    }
}

pub fn list<A: Drawn>(count: usize, kinds: usize, seed: u64) -> Vec<A> {
    let mut dice = Dice(seed);
    (0..count)
        .map(|_| {
            let kind = dice.below(kinds);
            A::draw(&mut dice, kind)
        })
        .collect()
}

type A<O, T> = <O as Pair<T>>::A;
type B<O, T> = <O as Pair<T>>::B;

/// Upstream derivatives of aligned pairs, by turns.
const UPSTREAM: [f64; 7] = [1.0, -0.5, 0.0, 3.0, -0.0, 1e20, -3e38];

/// The results of the scalar code for all pairs of two lists.
struct Known<O: Pair<T>, T: Number> {
    a: Vec<A<O, T>>,
    b: Vec<B<O, T>>,
    /// The value of each pair, then its derivatives.
    pairs: Vec<Vec<u64>>,
    /// The upstream derivative times the derivatives, for pairs of shapes with equal indices.
    aligned: Vec<Vec<u64>>,
}

impl<O: Pair<T>, T: Number> Known<O, T> {
    fn new(a: Vec<A<O, T>>, b: Vec<B<O, T>>) -> Self {
        let derivatives = |i: usize, j: usize, up: T| {
            let (p, q) = Straight::<O>::vjp::<T>(&(a[i], b[j]), up);
            bits_of([&p]).into_iter().chain(bits_of([&q]))
        };
        let pair = |i: usize, j: usize| {
            let mut all = bits(&[O::eval::<T>((a[i], b[j]))]);
            all.extend(derivatives(i, j, T::one()));
            all
        };
        let places = (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j)));
        let pairs = places.map(|(i, j)| pair(i, j)).collect();
        let aligned = (0..a.len().min(b.len()))
            .map(|i| derivatives(i, i, T::lit(UPSTREAM[i % 7])).collect())
            .collect();
        Known {
            a,
            b,
            pairs,
            aligned,
        }
    }

    /// All forms of a batch of some rows and some columns.
    fn check(&self, rows: Range<usize>, columns: Range<usize>, way: &str) {
        let (a, b) = (&self.a[rows.clone()], &self.b[columns.clone()]);
        let matrix = calls::all_pairs::<O, T>(a, b).unwrap();
        let grads = calls::all_pairs_grad::<O, T>(a, b).unwrap();
        for (i, row) in rows.clone().enumerate() {
            for (j, column) in columns.clone().enumerate() {
                let known = &self.pairs[row * self.b.len() + column];
                let at = i * b.len() + j;
                let (_, (p, q)) = grads.at(i, j);
                let mut here = bits(&[grads.values()[at]]);
                here.extend(bits_of([&p]).into_iter().chain(bits_of([&q])));
                assert!(
                    here == *known && bits(&matrix[at..=at]) == known[..1],
                    "{}, {way}, rows {rows:?}, columns {columns:?}: {:?} {:?}",
                    O::DECLARED.name,
                    a[i].scalars(),
                    b[j].scalars()
                );
            }
        }
        if rows.start != columns.start {
            return;
        }
        let count = a.len().min(b.len());
        let (a, b) = (&a[..count], &b[..count]);
        let values = calls::aligned::<O, T>(a, b).unwrap();
        let (same, by_a, by_b) = calls::aligned_grad::<O, T>(a, b).unwrap();
        let up: Vec<T> = rows.clone().map(|i| T::lit(UPSTREAM[i % 7])).collect();
        let (up_a, up_b) = calls::aligned_vjp::<O, T>(a, b, &up[..count]).unwrap();
        for (i, at) in rows.take(count).enumerate() {
            let mut here = bits(&[same[i]]);
            here.extend(bits_of([&by_a[i]]).into_iter().chain(bits_of([&by_b[i]])));
            let mut up = bits_of([&up_a[i]]);
            up.extend(bits_of([&up_b[i]]));
            let known = &self.pairs[at * self.b.len() + at];
            assert!(
                here == *known && bits(&values[i..=i]) == known[..1] && up == self.aligned[at],
                "{}, {way}, aligned from {at} on, pair {i}: {:?} {:?}",
                O::DECLARED.name,
                a[i].scalars(),
                b[i].scalars()
            );
        }
    }
}

fn positions<O, T>()
where
    O: Pair<T>,
    T: Number,
    O::A: Drawn,
    O::B: Drawn,
{
    let known =
        [MILD, KINDS].map(|kinds| Known::<O, T>::new(list(30, kinds, 1), list(70, kinds, 2)));
    in_every_way(|way| {
        for known in &known {
            // The same pairs at different places of a tile, and beside different neighbours.
            for start in [0, 1, 6, 15] {
                for count in [1, 5, 16, 37] {
                    known.check(start..start + count.min(15), start..start + count, way);
                }
            }
            known.check(0..3, 0..70, way);
            known.check(0..30, 0..30, way);
        }
    });
}

/// Everything that is summed or sought in a matrix, as bits.
pub fn results<O: Pair<T>, T: Number>(a: &[O::A], b: &[O::B]) -> Vec<u64> {
    let values: Vec<T> = calls::all_pairs::<O, T>(a, b).unwrap();
    let mut all = bits(&values);
    let matrix = Matrix::new(a.len(), b.len(), values).unwrap();
    let upstream: Vec<T> = (0..a.len() * b.len())
        .map(|i| T::lit((i % 11) as f64 * 0.37 - 1.9))
        .collect();
    let (p, q) = calls::all_pairs_vjp::<O, T>(a, b, &upstream).unwrap();
    all.extend(bits_of(&p).into_iter().chain(bits_of(&q)));
    let rows = calls::row_max::<O, T>(a, b).unwrap();
    assert_eq!(rows, matrix.row_max().unwrap());
    all.extend(
        rows.iter()
            .flat_map(|x| [wide(x.value).to_bits(), x.index as u64]),
    );
    let columns = calls::column_max::<O, T>(a, b).unwrap();
    assert_eq!(columns, matrix.column_max().unwrap());
    all.extend(
        columns
            .iter()
            .flat_map(|x| [wide(x.value).to_bits(), x.index as u64]),
    );
    for threshold in [0.0, 0.1] {
        let found = calls::above::<O, T>(a, b, T::lit(threshold)).unwrap();
        all.extend(
            found
                .iter()
                .flat_map(|x| [x.row as u64, x.column as u64, wide(x.value).to_bits()]),
        );
    }
    let (loss, p, q) = calls::mean_grad::<O, T>(a, b).unwrap();
    all.push(loss.to_bits());
    all.extend(bits_of(&p).into_iter().chain(bits_of(&q)));
    all.push(calls::mean::<O, T>(a, b).unwrap().to_bits());
    all
}

/// Long sparse lists, as along a street, long dense ones, and long ones with extreme shapes.
fn scenes<O, T>()
where
    O: Pair<T>,
    T: Number,
    O::A: Drawn,
    O::B: Drawn,
{
    let near = |count, seed| list::<O::A>(count, 3, seed);
    let lists: [(Vec<O::A>, Vec<O::B>); 3] = [
        (far_apart(list(40, MILD, 3)), far_apart(list(1100, MILD, 4))),
        (near(33, 5), list(1030, 3, 6)),
        (list(8, KINDS, 7), list(530, KINDS, 8)),
    ];
    const THREADS: [usize; 4] = [1, 2, 3, 7];
    for (a, b) in &lists {
        let mut expected = None;
        let mut ways = 0;
        in_every_way(|way| {
            // All numbers of threads in one way; then one each, for all have to be like the first.
            let turn = ways % THREADS.len();
            let counts = if ways == 0 {
                &THREADS[..]
            } else {
                &THREADS[turn..=turn]
            };
            ways += 1;
            for &threads in counts {
                let here = with_threads(threads, || results::<O, T>(a, b));
                let first = expected.get_or_insert_with(|| here.clone());
                assert!(
                    here == *first,
                    "{}, {way}, {threads} threads",
                    O::DECLARED.name
                );
            }
        });
    }
}

/// Moves shapes along a line, each some way from the one before.
pub fn far_apart<X: Pack>(mut shapes: Vec<X>) -> Vec<X>
where
    X::Scalar: Number,
{
    for (i, shape) in shapes.iter_mut().enumerate() {
        // Places of a box: x, y, … or min x, min y, max x, max y.
        let fields = shape.scalars().len();
        let mut k = 0;
        shape.each(&mut |x| {
            if k == 0 || fields == 4 && k == 2 || fields == 6 && k == 3 {
                *x += X::Scalar::lit(i as f64 * 1.5);
            }
            k += 1;
        });
    }
    shapes
}

type Ring<T> = Vec<Vec2<T>>;

/// Rings of all small sizes, and some long ones, against the scalar code.
fn rings<O: OfRings<T>, T: Number>(
    eval: fn(&[Vec2<T>]) -> O::Out<T>,
    vjp: fn(&Ring<T>, O::Out<T>) -> Ring<T>,
) {
    let mut dice = Dice(11);
    let mut vertices: Vec<Vec2<T>> = Vec::new();
    let mut offsets = vec![0];
    for i in 0..400 {
        let count = if i % 40 == 39 { 700 } else { i % 13 };
        let unit = [1.0, 1.0, 1e-3, 1e15, 1e-22][i / 7 % 5];
        for k in 0..count {
            let (x, y) = (dice.within(-2.0, 2.0), dice.within(-2.0, 2.0));
            let point = match i % 5 {
                0 => Vec2::new(x.trunc(), y.trunc()),
                1 => Vec2::new(k as f64, 0.0),
                2 => Vec2::new(1e3 + x, -1e3 + y),
                _ => Vec2::new(x, y),
            };
            vertices.push((point * unit).remake(&mut |&x| T::lit(x)));
        }
        offsets.push(vertices.len());
    }
    in_every_way(|way| {
        for threads in [1, 3] {
            let (values, derivatives) = with_threads(threads, || {
                let values = calls::ragged::<O, T>(&vertices, &offsets).unwrap();
                let bars = calls::ragged_vjp::<O, T>(&vertices, &offsets, &values).unwrap();
                (values, bars)
            });
            for (i, at) in offsets.windows(2).enumerate() {
                let ring = vertices[at[0]..at[1]].to_vec();
                let value = eval(&ring);
                let place = || format!("{}, {way}, ring {i}: {ring:?}", O::DECLARED.name);
                assert_eq!(bits_of([&values[i]]), bits_of([&value]), "{}", place());
                let bars = vjp(&ring, value);
                assert_eq!(
                    bits_of(&derivatives[at[0]..at[1]]),
                    bits_of(&bars),
                    "{}",
                    place()
                );
            }
        }
    });
}

/// A row whose batches have kernels or a filter of their own.
struct Compiled {
    name: &'static str,
    /// Everywhere in a batch, and of long lists; in `f32` and in `f64`.
    positions: [fn(); 2],
    scenes: [fn(); 2],
}

impl Compiled {
    const fn of<O>() -> Self
    where
        O: Pair<f32, A: Drawn, B: Drawn> + Pair<f64, A: Drawn, B: Drawn>,
    {
        Compiled {
            name: O::DECLARED.name,
            positions: [positions::<O, f32>, positions::<O, f64>],
            scenes: [scenes::<O, f32>, scenes::<O, f64>],
        }
    }
    /// In both formats, or in `f32` alone where kernels and filters of `f64` are those of other rows.
    fn formats(&self) -> usize {
        // The kernels of the last one are compiled for x86-64 only; elsewhere its program runs, the longest of all.
        let shared = ["iof_yaw", "iou_birds_eye", "iou_aabb3"];
        let long = cfg!(geograd_portable) && self.name == "iou_obb3";
        if shared.contains(&self.name) || long {
            1
        } else {
            2
        }
    }
}

const COMPILED: [Compiled; 13] = {
    use geograd_tests::rows::*;
    [
        Compiled::of::<IntersectionAreaObb2>(),
        Compiled::of::<IouObb2>(),
        Compiled::of::<IofObb2>(),
        Compiled::of::<IntersectionAreaAabb2>(),
        Compiled::of::<IouAabb2>(),
        Compiled::of::<IofAabb2>(),
        Compiled::of::<GiouObb2>(),
        Compiled::of::<IntersectionVolumeYaw>(),
        Compiled::of::<IouYaw>(),
        Compiled::of::<IofYaw>(),
        Compiled::of::<IouBirdsEye>(),
        Compiled::of::<IouAabb3>(),
        Compiled::of::<IouObb3>(),
    ]
};

#[test]
fn anywhere_in_a_batch() {
    for row in share_of(COMPILED.iter().collect(), 3) {
        eprintln!("{}", row.name);
        row.positions[..row.formats()].iter().for_each(|run| run());
    }
}

#[test]
fn of_long_lists() {
    for row in share_of(COMPILED.iter().collect(), 3) {
        eprintln!("{}", row.name);
        row.scenes[..row.formats()].iter().for_each(|run| run());
    }
}

#[test]
fn of_rings() {
    fn of<F: OfRings<f32> + OfRings<f64>>() {
        fn alone<F: OfRings<T>, T: Number>() {
            rings::<F, T>(
                |ring| fold::<F, T>([], ring),
                |ring, out_bar| <Folded<F> as WithAdjoint>::vjp(&([], ring.clone()), out_bar).1,
            );
        }
        alone::<F, f32>();
        alone::<F, f64>();
    }
    of::<ring::SignedArea>();
    of::<ring::Area>();
    of::<ring::Perimeter>();
    of::<ring::Centroid>();
}

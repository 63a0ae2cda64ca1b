//! Batches with all that they take, on any machine.
use geograd::ad::check::sample::{Draw, Sample};
use geograd::kernels::gpu::GpuRing;
use geograd::kernels::resident::{Held, Matrix, Resident, RingBars, RingValues, Rings};
use geograd::kernels::{Backend, Fold, Item, Runs, Single};
use geograd::{Error, Fixed, Pack, Vec2};

/// Corners of the paths.
pub const CORNERS: usize = 16;
/// Different shapes; more items repeat them.
const DIFFERENT: usize = 4096;

/// A batch with all that it takes where it is computed.
pub trait Ready {
    fn run(&mut self) -> Result<(), Error>;
    /// What the last run gave, a list for every shape of a result.
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error>;
    /// A number of a list, computed on the processor of inputs that are moved by a few last digits in many ways:
    /// beside a kink or a jump these differ. `None` of paths.
    fn beside(&self, _list: usize, _at: usize) -> Result<Option<Vec<f32>>, Error> {
        Ok(None)
    }
}

/// In so many ways items are moved.
const WAYS: usize = 64;

/// A row moved in many ways by up to sixteen last digits of its largest number. No number changes its sign, so
/// that sizes stay sizes; where the row would not be valid any more, it stays as it is.
fn moved<R: Item<Scalar = f32>>(row: &R, draw: &mut Draw) -> Vec<R> {
    let numbers = row.scalars();
    let largest = numbers.iter().fold(0.0_f32, |most, x| most.max(x.abs()));
    let mut way = |way: usize| {
        let digit = f32::EPSILON * largest * [1.0, 4.0, 16.0][way % 3];
        let numbers: Vec<f32> = numbers
            .iter()
            .map(|&x| {
                let there = x + digit * (2.0 * draw.unit() - 1.0) as f32;
                if there * x < 0.0 { x } else { there }
            })
            .collect();
        let there = R::load(&numbers).load_codes(&row.codes());
        let is_valid = Backend::Cpu.resident().upload(&[there]).is_ok();
        if is_valid { there } else { *row }
    };
    (0..WAYS).map(&mut way).collect()
}

/// A shape in single precision.
fn single<P: Fixed<Scalar = f64>, Q: Fixed<Scalar = f32>>(shape: P) -> Q {
    let numbers: Vec<f32> = shape.scalars().iter().map(|&x| x as f32).collect();
    Q::load(&numbers).load_codes(&shape.codes())
}

/// So many shapes that are inside of what an operation takes.
pub fn shapes<P: Sample + Fixed<Scalar = f64>, Q: Fixed<Scalar = f32>>(count: usize) -> Vec<Q> {
    let mut draw = Draw::new(1);
    let mut drawn = Vec::new();
    while drawn.len() < count.min(DIFFERENT) {
        let shape = P::ordinary(&mut draw);
        if shape.inside() {
            drawn.push(single(shape));
        }
    }
    (0..count).map(|i| drawn[i % DIFFERENT]).collect()
}

struct Aligned<'a, R: Item<Scalar = f32>, F: Runs<R>> {
    here: Resident<'a>,
    run: F,
    rows: Vec<R>,
    held: Held<R>,
    found: Held<F::Out>,
}

impl<R: Item<Scalar = f32>, F: Runs<R, Out: Item<Scalar = f32>> + Copy> Ready
    for Aligned<'_, R, F>
{
    fn run(&mut self) -> Result<(), Error> {
        self.here
            .aligned_into(self.run, &self.held, &mut self.found)
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        self.found.numbers()
    }
    fn beside(&self, list: usize, at: usize) -> Result<Option<Vec<f32>>, Error> {
        let width = self.numbers()?[list].len() / self.rows.len();
        let there = moved(&self.rows[at / width], &mut Draw::new(at as u64));
        let here = Backend::Cpu.resident();
        let found = &here.aligned(self.run, &here.upload(&there)?)?.numbers()?[list];
        Ok(Some(
            (0..WAYS)
                .map(|way| found[way * width + at % width])
                .collect(),
        ))
    }
}

pub fn aligned<'a, R, F>(
    backend: Backend<'a>,
    run: F,
    rows: &[R],
) -> Result<Box<dyn Ready + 'a>, Error>
where
    R: Item<Scalar = f32> + 'a,
    F: Runs<R, Out: Item<Scalar = f32>> + Copy + 'a,
{
    let here = backend.resident();
    let held = here.upload(rows)?;
    let found = here.aligned(run, &held)?;
    Ok(Box::new(Aligned {
        here,
        run,
        rows: rows.to_vec(),
        held,
        found,
    }))
}

struct Pairs<'a, A, B, F> {
    here: Resident<'a>,
    run: F,
    rows: Vec<(A, B)>,
    a: Held<A>,
    b: Held<B>,
    matrix: Matrix,
    derivatives: Option<(Held<A>, Held<B>)>,
}

impl<A: Single<Scalar = f32>, B: Single<Scalar = f32>, F> Pairs<'_, A, B, F>
where
    F: Runs<(A, B), Out = f32> + Copy,
{
    /// Derivatives of every row of a matrix of moved shapes, and of every column.
    fn sums(&self, a: &[A], b: &[B]) -> Result<[Vec<f32>; 2], Error> {
        let here = Backend::Cpu.resident();
        let (a, b) = (here.upload(a)?, here.upload(b)?);
        let matrix = here.all_pairs(self.run, &a, &b)?;
        let (a, b) = here.all_pairs_vjp(self.run, &a, &b, &matrix)?;
        Ok([a.numbers()?.concat(), b.numbers()?.concat()])
    }
}

impl<A: Single<Scalar = f32>, B: Single<Scalar = f32>, F> Ready for Pairs<'_, A, B, F>
where
    F: Runs<(A, B), Out = f32> + Copy,
{
    fn run(&mut self) -> Result<(), Error> {
        let (run, a, b) = (self.run, &self.a, &self.b);
        match &mut self.derivatives {
            None => self.here.all_pairs_into(run, a, b, &mut self.matrix),
            Some(derivatives) => {
                *derivatives = self.here.all_pairs_vjp(run, a, b, &self.matrix)?;
                Ok(())
            }
        }
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        match &self.derivatives {
            None => Ok(vec![self.matrix.download()?]),
            Some((a, b)) => Ok([a.numbers()?, b.numbers()?].concat()),
        }
    }
    fn beside(&self, list: usize, at: usize) -> Result<Option<Vec<f32>>, Error> {
        let mut draw = Draw::new(at as u64);
        let side = self.rows.len();
        if self.derivatives.is_none() {
            let there = moved(&(self.rows[at / side].0, self.rows[at % side].1), &mut draw);
            let here = Backend::Cpu.resident();
            let mut found = here.aligned(self.run, &here.upload(&there)?)?.numbers()?;
            return Ok(Some(found.swap_remove(0)));
        }
        // A sum over all of the others, each of which is moved, too.
        let width = self.numbers()?[list].len() / side;
        let all: Vec<Vec<(A, B)>> = self.rows.iter().map(|x| moved(x, &mut draw)).collect();
        let way = |way: usize| {
            let mine = all[at / width][way];
            let others = all.iter().map(|x| x[way]);
            let (a, b): (Vec<A>, Vec<B>) = match list {
                0 => (vec![mine.0], others.map(|x| x.1).collect()),
                _ => (others.map(|x| x.0).collect(), vec![mine.1]),
            };
            Ok(self.sums(&a, &b)?[list][at % width])
        };
        (0..WAYS).map(way).collect::<Result<_, _>>().map(Some)
    }
}

/// Of a square of so many pairs.
pub fn pairs<'a, A, B, F>(
    backend: Backend<'a>,
    run: F,
    rows: &[(A, B)],
    derivatives: bool,
) -> Result<Box<dyn Ready + 'a>, Error>
where
    A: Single<Scalar = f32> + 'a,
    B: Single<Scalar = f32> + 'a,
    F: Runs<(A, B), Out = f32> + Copy + 'a,
{
    let here = backend.resident();
    let (a, b): (Vec<A>, Vec<B>) = rows.iter().copied().unzip();
    let (a, b) = (here.upload(&a)?, here.upload(&b)?);
    let matrix = here.all_pairs(run, &a, &b)?;
    let derivatives = match derivatives {
        true => Some(here.all_pairs_vjp(run, &a, &b, &matrix)?),
        false => None,
    };
    Ok(Box::new(Pairs {
        here,
        run,
        rows: rows.to_vec(),
        a,
        b,
        matrix,
        derivatives,
    }))
}

/// Stars, one after another.
fn paths(count: usize) -> (Vec<Vec2<f32>>, Vec<usize>) {
    let mut draw = Draw::new(2);
    let corner = |k: usize| {
        let (radius, angle) = (
            0.5 + draw.unit(),
            k as f64 * std::f64::consts::TAU / CORNERS as f64,
        );
        Vec2::new((radius * angle.cos()) as f32, (radius * angle.sin()) as f32)
    };
    let different: Vec<_> = (0..CORNERS * DIFFERENT).map(corner).collect();
    let vertices = (0..CORNERS * count).map(|k| different[k % different.len()]);
    (
        vertices.collect(),
        (0..=count).map(|i| i * CORNERS).collect(),
    )
}

struct Ring<O: GpuRing> {
    rings: Rings,
    values: Option<RingValues<O::Out<f32>>>,
    ups: Vec<O::Out<f32>>,
    derivatives: Option<RingBars>,
}

impl<O: GpuRing> Ready for Ring<O> {
    fn run(&mut self) -> Result<(), Error> {
        match self.ups.is_empty() {
            true => self.values = Some(self.rings.ragged(O::default())?),
            false => self.derivatives = Some(self.rings.ragged_vjp(O::default(), &self.ups)?),
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        let mut all = Vec::new();
        if let Some(values) = &self.values {
            all.push(values.download()?.iter().flat_map(Pack::scalars).collect());
        }
        if let Some(derivatives) = &self.derivatives {
            all.push(
                derivatives
                    .download()?
                    .iter()
                    .flat_map(Pack::scalars)
                    .collect(),
            );
        }
        Ok(all)
    }
}

pub fn ring<'a, O: GpuRing>(
    backend: Backend<'a>,
    count: usize,
    derivatives: bool,
) -> Result<Box<dyn Ready + 'a>, Error> {
    let (vertices, offsets) = paths(count);
    let ups = if derivatives { count } else { 0 };
    let mut ready = Ring::<O> {
        rings: backend.resident().upload_rings(&vertices, &offsets)?,
        values: None,
        ups: vec![Fixed::filled(1.0); ups],
        derivatives: None,
    };
    ready.run()?;
    Ok(Box::new(ready))
}

struct Folded<'a, F: Fold> {
    backend: Backend<'a>,
    contexts: Vec<F::Context<f32>>,
    vertices: Vec<Vec2<f32>>,
    offsets: Vec<usize>,
    values: Vec<F::Out<f32>>,
    ups: Vec<F::Out<f32>>,
    derivatives: (Vec<F::Context<f32>>, Vec<Vec2<f32>>),
}

impl<F: Fold<Context<f32>: Item<Scalar = f32>>> Ready for Folded<'_, F> {
    fn run(&mut self) -> Result<(), Error> {
        let (contexts, vertices, offsets) = (&self.contexts, &self.vertices, &self.offsets);
        let (backend, run) = (self.backend, F::default());
        match self.ups.is_empty() {
            true => self.values = backend.fold(run, contexts, vertices, offsets)?,
            false => {
                self.derivatives = backend.fold_vjp(run, contexts, vertices, offsets, &self.ups)?
            }
        }
        Ok(())
    }
    fn numbers(&self) -> Result<Vec<Vec<f32>>, Error> {
        Ok(vec![
            self.values.iter().flat_map(Pack::scalars).collect(),
            self.derivatives.0.iter().flat_map(Pack::scalars).collect(),
            self.derivatives.1.iter().flat_map(Pack::scalars).collect(),
        ])
    }
}

pub fn folded<'a, F>(
    backend: Backend<'a>,
    count: usize,
    derivatives: bool,
) -> Result<Box<dyn Ready + 'a>, Error>
where
    F: Fold<Context<f32>: Item<Scalar = f32>, Context<f64>: Sample>,
{
    let (vertices, offsets) = paths(count);
    let ups = if derivatives { count } else { 0 };
    let mut ready = Folded::<F> {
        backend,
        contexts: shapes::<F::Context<f64>, _>(count),
        vertices,
        offsets,
        values: Vec::new(),
        ups: vec![Fixed::filled(1.0); ups],
        derivatives: (Vec::new(), Vec::new()),
    };
    ready.run()?;
    Ok(Box::new(ready))
}

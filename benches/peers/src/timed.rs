//! Functions that are timed by turns, and the lines and ratios of a table.
use geograd::kernels::op::ValueGrad;
use geograd::kernels::{Cpu, Function, Item, Single};
use std::time::Instant;

/// Rows and columns of all pairs: short enough to run without interruption now and then.
pub const PART: usize = 200;

/// Something that is timed again and again.
pub struct Timed<'a> {
    pub items: usize,
    run: Box<dyn FnMut() + Send + 'a>,
    pub best: f64,
}

impl<'a> Timed<'a> {
    pub fn new(pairs: usize, run: impl FnMut() + Send + 'a) -> Self {
        Timed {
            items: pairs,
            run: Box::new(run),
            best: f64::INFINITY,
        }
    }
    /// At least a few milliseconds of runs.
    pub fn turn(&mut self) {
        let start = Instant::now();
        let mut now = start;
        loop {
            (self.run)();
            let end = Instant::now();
            self.best = self.best.min((end - now).as_secs_f64());
            now = end;
            if (end - start).as_secs_f64() > 0.01 {
                return;
            }
        }
    }
    /// The fastest run in microseconds.
    pub fn microseconds(&self) -> f64 {
        self.best * 1e6
    }
    /// Million pairs a second.
    pub fn rate(&self) -> f64 {
        self.items as f64 / self.best / 1e6
    }
}

/// One line of the table: its name, and its timing at the level in use.
pub struct Line<'a> {
    pub name: &'static str,
    pub timed: Timed<'a>,
}

/// A ratio of two lines: its name, the numerator, the denominator.
pub struct Ratio(pub &'static str, pub &'static str, pub &'static str);

/// Aligned items of an operation, as values.
pub fn aligned<'a, O, A, B, T>(name: &'static str, op: O, a: &'a [A], b: &'a [B]) -> Line<'a>
where
    O: Function<(A, B), Out = T> + Copy + Send + 'a,
    A: Single<Scalar = T>,
    B: Single<Scalar = T>,
    T: geograd::Real + Single<Scalar = T>,
    (A, B): Item<Scalar = T>,
{
    let (cpu, mut values) = (Cpu::new(), vec![T::default(); a.len()]);
    let timed = Timed::new(a.len(), move || {
        cpu.aligned_into(op, (a, b), &mut values[..]).unwrap();
    });
    Line { name, timed }
}

/// The same with derivatives.
pub fn derivatives<'a, O, A, B, T>(name: &'static str, op: O, a: &'a [A], b: &'a [B]) -> Line<'a>
where
    O: Function<(A, B), Out = T> + Copy + Send + 'a,
    A: Single<Scalar = T>,
    B: Single<Scalar = T>,
    T: geograd::Real + Single<Scalar = T>,
    (A, B): Item<Scalar = T>,
{
    let (cpu, mut values) = (Cpu::new(), vec![T::default(); a.len()]);
    let (mut p, mut q) = (a.to_vec(), b.to_vec());
    let timed = Timed::new(a.len(), move || {
        let into = (&mut values[..], (&mut p[..], &mut q[..]));
        cpu.aligned_into(ValueGrad::of(op), (a, b), into).unwrap();
    });
    Line { name, timed }
}

/// All pairs of an operation, as values.
pub fn matrix<'a, O, A>(name: &'static str, cpu: Cpu, op: O, a: &'a [A], b: &'a [A]) -> Line<'a>
where
    O: Function<(A, A), Out = f32> + Copy + Send + 'a,
    A: Single<Scalar = f32>,
    (A, A): Item<Scalar = f32>,
{
    let mut values = vec![0.0; a.len() * b.len()];
    let timed = Timed::new(values.len(), move || {
        cpu.all_pairs_planes(op, a, b, &mut values).unwrap();
    });
    Line { name, timed }
}

//! The drawing of inputs.
use super::arguments::InputColumns;
use super::families::{Family, is_angle_within, limited, limits_of, power};
use super::job::Job;
use super::property::{Finding, Property};
use crate::Real;
use crate::ad::declared::Kind;
use crate::ad::sample::Draw;
use crate::kernels::row::op::Finite;

/// The largest number of draws from the harness for one valid input within limits.
const ATTEMPTS: usize = 100;

/// The number of inputs made by stretching one input of the harness.
const GROUP: usize = 16;

/// The largest number of vertices of a path.
const MOST: usize = 8;

impl<T: Real> InputColumns<T> {
    /// Returns all numbers of an input, its vertices last.
    pub fn item(&self, job: &Job<T>, i: usize) -> Vec<T> {
        let mut numbers = Vec::with_capacity(job.kinds.len());
        for (column, shape) in self.columns.iter().zip(&job.shapes) {
            let n = shape.leaf.fields;
            numbers.extend_from_slice(&column[i * n..][..n]);
        }
        if !job.vertex.is_empty() {
            let n = job.vertex.len();
            numbers.extend_from_slice(&self.vertices[n * self.offsets[i]..n * self.offsets[i + 1]]);
        }
        numbers
    }
    /// Returns `count` copies of an input.
    pub fn repeated(job: &Job<T>, numbers: &[T], count: usize) -> Self {
        let (mut columns, mut rest) = (Vec::new(), numbers);
        for shape in &job.shapes {
            let (own, others) = rest.split_at(shape.leaf.fields);
            columns.push(own.repeat(count));
            rest = others;
        }
        let vertices = rest.len() / job.vertex.len().max(1);
        InputColumns {
            columns,
            vertices: rest.repeat(count),
            offsets: (0..=count).map(|i| i * vertices).collect(),
            count,
            outside: 0,
        }
    }
    /// Replaces the numbers of input `i`, which has fixed size.
    pub fn put(&mut self, job: &Job<T>, i: usize, numbers: &[T]) {
        let mut rest = numbers;
        for (shape, column) in job.shapes.iter().zip(&mut self.columns) {
            let n = shape.leaf.fields;
            let (own, others) = rest.split_at(n);
            rest = others;
            column[i * n..][..n].copy_from_slice(own);
        }
    }
    /// Keeps the inputs of fixed size at some indices, which ascend.
    pub fn keep(&mut self, job: &Job<T>, places: &[usize]) {
        for (shape, column) in job.shapes.iter().zip(&mut self.columns) {
            let n = shape.leaf.fields;
            for (to, &from) in places.iter().enumerate() {
                column.copy_within(from * n..(from + 1) * n, to * n);
            }
            column.truncate(places.len() * n);
        }
        self.count = places.len();
    }
}

/// Returns `true` if numbers are valid shapes.
pub(super) fn is_valid<T: Real>(job: &Job<T>, numbers: &[T]) -> bool {
    let mut rest = numbers;
    job.shapes.iter().all(|shape| {
        let (own, others) = rest.split_at(shape.leaf.fields);
        rest = others;
        (shape.leaf.check)(own).is_ok()
    }) && rest.iter().all(|x| x.finite())
        && is_inside(job, numbers)
}

/// Returns `true` if numbers are inside the domain.
pub(super) fn is_inside<T: Real>(job: &Job<T>, numbers: &[T]) -> bool {
    job.declared.domain.is_none_or(|inside| {
        let numbers: Vec<f64> = numbers.iter().map(|x| x.widen()).collect();
        inside(&numbers)
    })
}

/// The distribution of families over the numbers of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mix {
    /// One family for all numbers.
    One,
    /// One family per field, for all inputs.
    ByField,
    /// One family per number.
    ByNumber,
}

impl<T: Real> Job<T> {
    /// Draws inputs, all of them inside the domain, if it contains any.
    pub(super) fn draw(
        &self,
        draw: &mut Draw,
        inputs: &mut InputColumns<T>,
        count: usize,
    ) -> Result<(), Finding> {
        let limits = limits_of::<T>(self.declared.finite);
        (inputs.count, inputs.outside) = (count, 0);
        let mix = match draw.below(4) {
            0 | 1 => Mix::One,
            2 => Mix::ByField,
            _ => Mix::ByNumber,
        };
        let any = |draw: &mut Draw| match (self.declared.finite, mix) {
            // Inputs far from ordinary use the scalar code, which is ten times slower.
            (Finite::Always, Mix::One) if !draw.once_in(6) => Family::quick(draw),
            _ => Family::any::<T>(draw),
        };
        let family = any(draw);
        inputs.columns.resize_with(self.shapes.len(), Vec::new);
        for (shape, column) in self.shapes.iter().zip(&mut inputs.columns) {
            let n = shape.leaf.fields;
            column.resize(count * n, T::zero());
            for (k, &kind) in shape.kinds.iter().enumerate() {
                let own = if mix == Mix::One { family } else { any(draw) };
                for x in column.iter_mut().skip(k).step_by(n) {
                    let own = match mix {
                        Mix::ByNumber => Family::any::<T>(draw),
                        _ => own,
                    };
                    *x = own.number(kind, draw);
                }
            }
        }
        if !self.vertex.is_empty() {
            self.draw_paths(draw, inputs, |draw| match mix {
                Mix::One => family,
                _ => Family::any::<T>(draw),
            });
        }
        if draw.once_in(3) {
            self.mingle(draw, inputs);
        }
        if let Some(limits) = limits {
            for (shape, column) in self.shapes.iter().zip(&mut inputs.columns) {
                for numbers in column.chunks_exact_mut(shape.leaf.fields) {
                    for (x, &kind) in numbers.iter_mut().zip(&shape.kinds) {
                        *x = limited(*x, kind, limits);
                    }
                }
            }
            for (x, &kind) in inputs.vertices.iter_mut().zip(self.vertex.iter().cycle()) {
                *x = limited(*x, kind, limits);
            }
        }
        self.mend(draw, inputs, limits);
        self.keep_inside(draw, inputs, limits)
    }

    /// Replaces inputs outside the domain by stretched inputs of the harness that are inside.
    fn keep_inside(
        &self,
        draw: &mut Draw,
        inputs: &mut InputColumns<T>,
        limits: Option<[i32; 2]>,
    ) -> Result<(), Finding> {
        if self.declared.domain.is_none() {
            return Ok(());
        }
        let mut base = Vec::new();
        for i in 0..inputs.count {
            if is_inside(self, &inputs.item(self, i)) {
                continue;
            }
            if inputs.outside.is_multiple_of(GROUP as u64) {
                base = self.sampled(draw, limits);
            }
            inputs.outside += 1;
            if base.is_empty() {
                let property = Property::Domain;
                return Err(Finding { property, at: i });
            }
            let stretched = self.stretched(draw, &base, limits);
            inputs.put(self, i, stretched.as_ref().unwrap_or(&base));
        }
        Ok(())
    }

    fn draw_paths(
        &self,
        draw: &mut Draw,
        inputs: &mut InputColumns<T>,
        family: impl Fn(&mut Draw) -> Family,
    ) {
        inputs.offsets.clear();
        inputs.offsets.push(0);
        let (mut end, mut bits) = (0, 0);
        for i in 0..inputs.count {
            // Four bits for each of sixteen inputs.
            bits = if i % 16 == 0 { draw.bits() } else { bits >> 4 };
            end += (bits & 15) as usize * (MOST + 1) / 16;
            inputs.offsets.push(end);
        }
        inputs.vertices.resize(end * self.vertex.len(), T::zero());
        for (x, &kind) in inputs.vertices.iter_mut().zip(self.vertex.iter().cycle()) {
            *x = family(draw).number(kind, draw);
        }
    }

    /// Copies some numbers to other places of their kind, so that shapes share coordinates, touch, or are flat.
    fn mingle(&self, draw: &mut Draw, inputs: &mut InputColumns<T>) {
        // Heights mix with sizes, and the numbers of a quaternion with each other.
        let drawn_as = |kind| match kind {
            Kind::Z => Kind::Length,
            Kind::QuaternionX | Kind::QuaternionY | Kind::QuaternionZ => Kind::QuaternionW,
            kind => kind,
        };
        let kinds: Vec<(usize, usize, Kind)> = self
            .shapes
            .iter()
            .enumerate()
            .flat_map(|(s, shape)| {
                shape
                    .kinds
                    .iter()
                    .enumerate()
                    .map(move |(k, &kind)| (s, k, drawn_as(kind)))
            })
            .collect();
        for i in 0..inputs.count {
            for &(s, k, kind) in &kinds {
                let bits = draw.bits();
                if bits & 3 != 0 {
                    continue;
                }
                let fields = self.shapes[s].leaf.fields;
                if kind == Kind::Length && bits & 12 == 0 {
                    inputs.columns[s][i * fields + k] = T::zero();
                    continue;
                }
                let (from, at, other) = kinds[(bits >> 33) as usize % kinds.len()];
                if other == kind {
                    let n = self.shapes[from].leaf.fields;
                    inputs.columns[s][i * fields + k] = inputs.columns[from][i * n + at];
                }
            }
        }
        let n = self.vertex.len();
        for i in 1..inputs.vertices.len() / n.max(1) {
            let bits = draw.bits();
            let from = i - 1 - (bits >> 8) as usize % i.min(MOST);
            for k in 0..n.min(4) {
                if (bits >> (2 * k)) & 3 == 0 {
                    inputs.vertices[n * i + k] = inputs.vertices[n * from + k];
                }
            }
        }
    }

    /// Turns numbers into valid shapes.
    fn mend(&self, draw: &mut Draw, inputs: &mut InputColumns<T>, limits: Option<[i32; 2]>) {
        for (shape, column) in self.shapes.iter().zip(&mut inputs.columns) {
            for numbers in column.chunks_exact_mut(shape.leaf.fields) {
                shape.rules.mend(numbers);
            }
        }
        if self.shapes.iter().all(|shape| shape.rules.known) {
            return;
        }
        // Shapes with rules of their own are drawn by the harness, and stretched.
        let mut base = Vec::new();
        for i in 0..inputs.count {
            if i % GROUP == 0 {
                base = self.sampled(draw, limits);
            }
            let stretched = self.stretched(draw, &base, limits);
            let mut rest = stretched.as_ref().unwrap_or(&base).as_slice();
            for (shape, column) in self.shapes.iter().zip(&mut inputs.columns) {
                let n = shape.leaf.fields;
                let (own, others) = rest.split_at(n);
                rest = others;
                if !shape.rules.known || draw.once_in(2) {
                    column[i * n..][..n].copy_from_slice(own);
                }
            }
        }
    }

    /// Returns an input of the harness that is valid, inside the domain, and within limits if one is found; an empty
    /// list if none is valid.
    fn sampled(&self, draw: &mut Draw, limits: Option<[i32; 2]>) -> Vec<T> {
        let mut last = Vec::new();
        for _ in 0..ATTEMPTS {
            let x: Vec<T> = (self.sample)(draw).into_iter().map(T::lit).collect();
            if is_valid(self, &x) {
                if self.fits(&x, limits) {
                    return x;
                }
                last = x;
            }
        }
        last
    }

    /// Returns an input stretched along x and y by powers of two; `None` if the result is not valid.
    fn stretched(&self, draw: &mut Draw, x: &[T], limits: Option<[i32; 2]>) -> Option<Vec<T>> {
        let [least, most] = limits.unwrap_or([-20, 20]);
        let power = |draw: &mut Draw| {
            let reach = (most - least) as usize / 4;
            T::lit(power(draw.below(2 * reach + 1) as i32 - reach as i32))
        };
        let along = power(draw);
        let across = if draw.once_in(2) { along } else { power(draw) };
        let stretch = |(&x, kind): (&T, &Kind)| match kind {
            Kind::X | Kind::Z | Kind::Length | Kind::Offset => x * along,
            Kind::Y => x * across,
            _ => x,
        };
        let x: Vec<T> = x.iter().zip(&self.kinds).map(stretch).collect();
        (self.fits(&x, limits) && is_valid(self, &x)).then_some(x)
    }

    /// Returns `true` if lengths and angles are within limits.
    fn fits(&self, x: &[T], limits: Option<[i32; 2]>) -> bool {
        let Some([least, most]) = limits else {
            return true;
        };
        let range = power(least)..=power(most);
        x.iter().zip(&self.kinds).all(|(&x, &kind)| {
            let size = x.widen().abs();
            match kind {
                kind if kind.is_angle() => is_angle_within(x),
                _ => !kind.is_length() || size == 0.0 || range.contains(&size),
            }
        })
    }
}

//! What is promised of operations of a ring.
use super::draw::Family;
use super::{Broken, Fuzzed, Outcome, Promise, SINGLE, not_finite, run, same};
use crate::ad::check::sample::Draw;
use crate::kernels::Cpu;
use crate::kernels::cpu::checked::{fill, numbers};
use crate::kernels::op::RingOp;
use crate::kernels::real::Real;
use crate::{Fixed, Vec2};

const CPU: Cpu = Cpu::new();

/// Rings of one batch: few enough for one thread.
const CHUNK: usize = 500;

/// Most vertices of a ring.
const MOST: usize = 8;

/// Fuzzes an operation of a ring on all cores; stops at the first thing that it finds.
#[must_use]
pub fn rings<O: RingOp, T: Real>(count: u64, seed: u64) -> Fuzzed {
    run::<T, _>(
        O::NAME,
        (count, seed),
        CHUNK,
        Lists::<O, T>::new,
        |lists, draw| {
            lists.draw(draw);
            lists.check()
        },
    )
}

/// Lists of one thread, used again and again.
struct Lists<O: RingOp, T: Real> {
    vertices: Vec<Vec2<T>>,
    offsets: Vec<usize>,
    ones: Vec<O::Out<T>>,
    upstream: Vec<O::Out<T>>,
    values: Vec<O::Out<T>>,
    bars: Vec<Vec2<T>>,
}

impl<O: RingOp, T: Real> Lists<O, T> {
    fn new() -> Self {
        let ones = vec![O::Out::<T>::filled(T::one()); CHUNK];
        Lists {
            vertices: Vec::new(),
            offsets: Vec::new(),
            upstream: ones.clone(),
            values: ones.clone(),
            ones,
            bars: Vec::new(),
        }
    }

    fn draw(&mut self, draw: &mut Draw) {
        self.offsets.clear();
        self.offsets.push(0);
        let mut end = 0;
        let mut bits = 0;
        for i in 0..CHUNK {
            // Sixteen times four bits.
            bits = if i % 16 == 0 { draw.bits() } else { bits >> 4 };
            end += (bits & 15) as usize * (MOST + 1) / 16;
            self.offsets.push(end);
        }
        let zero = Vec2::filled(T::default());
        self.vertices.resize(end, zero);
        self.bars.resize(end, zero);
        fill(&mut self.vertices, |numbers| {
            Family::any(draw).fill(draw, numbers)
        });
        fill(&mut self.upstream, |numbers| {
            Family::any(draw).fill(draw, numbers)
        });
    }

    fn ring(&self, i: usize) -> std::ops::Range<usize> {
        self.offsets[i]..self.offsets[i + 1]
    }

    fn broken(&self, promise: Promise, i: usize) -> Broken {
        let ring = self.vertices[self.ring(i)].iter();
        let input = ring.flat_map(|v| [v.x.widen(), v.y.widen()]).collect();
        Broken { promise, input }
    }

    fn unless(&self, promise: Promise, place: Option<usize>) -> Outcome {
        place.map_or(Ok(()), |i| Err(self.broken(promise, i)))
    }

    fn finite_slopes(&self) -> Outcome {
        let ring = |at: usize| self.offsets.partition_point(|&x| x <= at / 2) - 1;
        self.unless(Promise::Finite, not_finite(&numbers(&self.bars)).map(ring))
    }

    fn check(&mut self) -> Outcome {
        let (vertices, offsets) = (&self.vertices, &self.offsets);
        let done = CPU.ragged_into(O::default(), vertices, offsets, &mut self.values);
        let done = done.and_then(|()| {
            CPU.ragged_vjp_into(O::default(), vertices, offsets, &self.ones, &mut self.bars)
        });
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        let place = not_finite(&numbers(&self.values)).map(|at| at / O::Out::<T>::LEN);
        self.unless(Promise::Finite, place)?;
        self.finite_slopes()?;
        let mut slopes = [Vec2::filled(T::default()); MOST];
        let mut places = (0..CHUNK).step_by(SINGLE / 4);
        let place = places.find(|&i| {
            let ring = self.ring(i);
            let slopes = &mut slopes[..ring.len()];
            O::ring_vjp(&self.vertices[ring.clone()], self.ones[i], slopes);
            let value = <O as RingOp>::value(&self.vertices[ring.clone()]);
            !same(&numbers(&[value]), &numbers(&self.values[i..=i]))
                || !same(&numbers(slopes), &numbers(&self.bars[ring]))
        });
        self.unless(Promise::SameBits, place)?;
        // Upstream slopes of all sizes.
        let (vertices, offsets) = (&self.vertices, &self.offsets);
        let done = CPU.ragged_vjp_into(
            O::default(),
            vertices,
            offsets,
            &self.upstream,
            &mut self.bars,
        );
        self.unless(Promise::Accepted, done.err().map(|_| 0))?;
        self.finite_slopes()
    }
}

//! The core of an axis-aligned box: its bounds.
use super::beam::{Beam, Inside};
use super::cores::{BoxCore, Upright};
use super::corners::Core;
use super::edge::size_of;
use super::share::{Ahead, Best, Deepest, Nearest};
use crate::{Scalar, Vec2};

/// A box by its bounds.
///
/// The centre is computed in coordinates relative to a nearby anchor: far from the origin its rounding would exceed the
/// box's size.
#[derive(Clone, Copy, Debug)]
pub struct BoundsCore<S> {
    /// The corner with the least coordinates.
    pub min: Vec2<S>,
    /// The corner with the greatest coordinates.
    pub max: Vec2<S>,
}

impl<S: Scalar> BoundsCore<S> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn middle(&self) -> Vec2<S> {
        let middle = |min: S, max: S| min.halved() + max.halved();
        Vec2::new(
            middle(self.min.x, self.max.x),
            middle(self.min.y, self.max.y),
        )
    }
    /// Returns the box by its centre and half size, which the computations with faces use.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn centred(&self) -> BoxCore<S, Upright> {
        let half = |min: S, max: S| max.halved() - min.halved();
        BoxCore {
            center: self.middle(),
            half: Vec2::new(half(self.min.x, self.max.x), half(self.min.y, self.max.y)),
            turn: Upright,
        }
    }
}

impl<S: Scalar> Core<S> for BoundsCore<S> {
    type Corners = [Vec2<S>; 4];
    type Away = [Vec2<S>; 0];
    const DIMENSION: usize = 2;
    const SYMMETRIC: bool = true;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn anchor(&self) -> Vec2<S> {
        self.middle()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extent(&self, from: Vec2<S>) -> S::Primal {
        size_of(self.min - from).most(size_of(self.max - from))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn placed(self, from: Vec2<S>, scale: S) -> Self {
        BoundsCore {
            min: (self.min - from) * scale,
            max: (self.max - from) * scale,
        }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn corners(&self) -> [Vec2<S>; 4] {
        let (min, max) = (self.min, self.max);
        [min, Vec2::new(max.x, min.y), max, Vec2::new(min.x, max.y)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn away(&self) -> [Vec2<S>; 0] {
        []
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn near(&self, corners: &[Vec2<S>]) -> Best<S, Nearest<S>> {
        let beyond = |x: S, min: S, max: S| {
            let below = S::select(x.below(min), x - min, S::zero());
            S::select(x.above(max), x - max, below)
        };
        Best::least(corners.iter().map(|&corner| {
            let apart = Vec2::new(
                beyond(corner.x, self.min.x, self.max.x),
                beyond(corner.y, self.min.y, self.max.y),
            );
            Best::of(
                apart.length_squared(),
                Nearest {
                    apart,
                    on_a: corner - apart,
                    on_b: corner,
                },
            )
        }))
    }
    /// Returns the largest squared distance: the farthest corner is at the farther bound along both axes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn far(&self, corners: &[Vec2<S>]) -> Best<S, S> {
        Best::most_of(corners.iter().map(|&corner| {
            let square = (corner - self.min).most(self.max - corner).length_squared();
            Best::of(square, square)
        }))
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn inside(&self, beam: Beam<S>, radius: S) -> Inside<S> {
        self.centred().inside(beam, radius)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn deep<B: Core<S>>(&self, other: &B) -> Best<S, Deepest<S>> {
        self.centred().deep(other)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn lowest(&self, normal: Vec2<S>) -> Best<S, Ahead<S>> {
        self.centred().lowest(normal)
    }
}

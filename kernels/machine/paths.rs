//! Paths that are folded, as an engine takes them.
use super::Column;
use crate::Vec2;
use crate::ring::Measure;
use std::borrow::Cow;
use std::ops::Range;

/// The ranges of the vertices of paths.
#[derive(Clone, Copy, Debug)]
pub enum PathSpans<'a> {
    /// Path i has the vertices between two offsets.
    Ragged(&'a [usize]),
    /// So many paths have all of them.
    Shared(usize, usize),
}

impl<'a> PathSpans<'a> {
    /// Returns the offsets of paths, or of one path that is all that is shared, between its ends.
    pub(crate) const fn offsets(&self, ends: &'a [usize; 2]) -> &'a [usize] {
        match *self {
            PathSpans::Ragged(offsets) => offsets,
            PathSpans::Shared(..) => ends,
        }
    }
    /// Returns how many paths there are.
    pub(crate) fn count(&self) -> usize {
        match *self {
            PathSpans::Ragged(offsets) => offsets.len().saturating_sub(1),
            PathSpans::Shared(paths, _) => paths,
        }
    }
    /// Returns the vertices of a path.
    pub(crate) fn of(&self, path: usize) -> Range<usize> {
        match *self {
            PathSpans::Ragged(offsets) => offsets[path]..offsets[path + 1],
            PathSpans::Shared(_, vertices) => 0..vertices,
        }
    }
}

/// Paths and all that is asked of their types.
pub struct Input<'a, T: Clone> {
    pub(crate) contexts: Vec<Column<'a, T>>,
    /// The number of vertices.
    pub(crate) count: usize,
    /// The numbers of all vertices.
    pub(crate) vertices: Cow<'a, [T]>,
    /// The vertices as points of the plane, for a fold with a winding number.
    pub(crate) plane: &'a [Vec2<T>],
    pub(crate) spans: PathSpans<'a>,
    /// Writes the reference of a context and of some vertices.
    pub(crate) reference: &'a dyn Fn(&[T], Range<usize>, &mut [T]),
}

/// Cotangents of vertices.
#[derive(Debug)]
pub enum VertexBars<'a, T: 'static> {
    /// Their numbers.
    Numbers(&'a mut [T]),
    /// Points of the plane, of a measure of rings.
    Plane(Measure, &'a mut [Vec2<T>]),
}

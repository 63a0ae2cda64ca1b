//! Paths to fold, in the form that an engine takes.
use super::Column;
use crate::Vec2;
use crate::ring::Measure;
use std::borrow::Cow;
use std::ops::Range;

/// The ranges of the vertices of paths.
#[derive(Clone, Copy, Debug)]
pub enum PathSpans<'a> {
    /// Path i has the vertices between offsets i and i + 1.
    Ragged(&'a [usize]),
    /// All paths share one list of vertices: the number of paths, the number of vertices.
    Shared(usize, usize),
}

impl<'a> PathSpans<'a> {
    /// Returns the offsets of paths; `ends` holds the two offsets of a shared path.
    pub(crate) const fn offsets(&self, ends: &'a [usize; 2]) -> &'a [usize] {
        match *self {
            PathSpans::Ragged(offsets) => offsets,
            PathSpans::Shared(..) => ends,
        }
    }
    /// Returns the number of paths.
    pub(crate) fn count(&self) -> usize {
        match *self {
            PathSpans::Ragged(offsets) => offsets.len().saturating_sub(1),
            PathSpans::Shared(paths, _) => paths,
        }
    }
    /// Returns the range of a path's vertices.
    pub(crate) fn of(&self, path: usize) -> Range<usize> {
        match *self {
            PathSpans::Ragged(offsets) => offsets[path]..offsets[path + 1],
            PathSpans::Shared(_, vertices) => 0..vertices,
        }
    }
}

/// Untyped paths with their contexts.
pub struct Input<'a, T: Clone> {
    pub(crate) contexts: Vec<Column<'a, T>>,
    /// The number of vertices.
    pub(crate) count: usize,
    /// The numbers of all vertices.
    pub(crate) vertices: Cow<'a, [T]>,
    /// The vertices as points of the plane, for a fold with a winding number.
    pub(crate) plane: &'a [Vec2<T>],
    pub(crate) spans: PathSpans<'a>,
    /// A function that writes the reference vertex of a context and some vertices.
    pub(crate) reference: &'a dyn Fn(&[T], Range<usize>, &mut [T]),
}

/// Memory for the cotangents of vertices.
#[derive(Debug)]
pub enum VertexBars<'a, T: 'static> {
    /// As numbers.
    Numbers(&'a mut [T]),
    /// As points of the plane, for a measure of rings.
    Plane(Measure, &'a mut [Vec2<T>]),
}

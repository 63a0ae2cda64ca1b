//! Records of boolean operations.

/// A boolean operation of two polygons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BooleanOperation {
    /// The points in either.
    Union,
    /// The points in both.
    Intersection,
    /// The points in the first and not in the second.
    Difference,
    /// The points in exactly one.
    SymmetricDifference,
}

/// The input that a vertex or edge belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Owner {
    /// The first polygon.
    A,
    /// The second polygon.
    B,
}

/// A vertex of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexId {
    /// The input.
    pub owner: Owner,
    /// The ring, from zero.
    pub ring: usize,
    /// The vertex of that ring, from zero.
    pub vertex: usize,
}

/// An edge of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EdgeId {
    /// The input.
    pub owner: Owner,
    /// The ring, from zero.
    pub ring: usize,
    /// The vertex of that ring at which the edge starts, from zero.
    pub edge: usize,
}

/// The origin of a vertex of the result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Origin {
    /// A vertex of an input.
    Vertex(VertexId),
    /// The crossing of two edges: of both inputs, or of one that crosses itself.
    Cross(EdgeId, EdgeId),
    /// The point of an edge nearest to a vertex that lies on it, where the edges at that vertex begin or cease to lie
    /// along it.
    Foot {
        /// The vertex.
        of: VertexId,
        /// The edge.
        on: EdgeId,
    },
}

/// The record of a boolean operation: the origin of every vertex of the result. It holds no numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OverlayTrace {
    pub(super) origins: Vec<Origin>,
    /// The number of origins up to the end of each vertex.
    pub(super) vertices: Vec<usize>,
    /// The number of vertices up to the end of each ring.
    pub(super) rings: Vec<usize>,
    /// The number of rings up to the end of each part.
    pub(super) parts: Vec<usize>,
}

impl OverlayTrace {
    /// Returns the origins of each vertex of the result, one ring after the other. A vertex with several origins, which
    /// then coincide, is their mean.
    pub fn origins(&self) -> impl Iterator<Item = &[Origin]> {
        let starts = std::iter::once(&0).chain(&self.vertices);
        starts
            .zip(&self.vertices)
            .map(|(&from, &to)| &self.origins[from..to])
    }
    /// Returns the number of vertices of the result.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertices.len()
    }
    /// Returns the number of vertices up to the end of each ring of the result.
    #[must_use]
    pub fn ends(&self) -> &[usize] {
        &self.rings
    }
    /// Returns the parts of the result as numbers of rings: the first of each bounds the part, the others are its
    /// holes.
    pub fn parts(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let starts = std::iter::once(&0).chain(&self.parts);
        starts.zip(&self.parts).map(|(&from, &to)| from..to)
    }
}

/// The record of intersection over union.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct IouTrace {
    /// The polygon that both share.
    pub intersection: OverlayTrace,
    /// The polygon that they cover together.
    pub union: OverlayTrace,
}

/// The origin of a vertex of a valid result.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum ValidOrigin {
    /// A point.
    One(Origin),
    /// The mean of several points.
    Of(Vec<Origin>),
    /// A point at a fixed fraction of an edge.
    Along(EdgeId, f64),
}

/// The vertices of a result that is valid by the OGC's rules: their coordinates and the origin of each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ValidTrace {
    pub(super) places: Vec<[f64; 2]>,
    pub(crate) made: Vec<ValidOrigin>,
    /// The number of vertices up to the end of each ring.
    pub(super) rings: Vec<usize>,
    /// The number of rings up to the end of each part.
    pub(super) parts: Vec<usize>,
}

impl ValidTrace {
    /// Returns the number of parts of the result.
    #[must_use]
    pub fn part_count(&self) -> usize {
        self.parts.len()
    }
    /// Returns the number of vertices of the result.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.places.len()
    }
}

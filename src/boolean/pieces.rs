//! The pieces of edges that bound the result.
use super::corner::{Border, corner};
use super::cut::{Numbered, cut, may_grow};
use super::grid::{Grid, Steps, Tag, invalid, squares};
use super::snap::Squares;
use super::walked::walked_trace;
use super::{BooleanOperation, OverlayTrace, Owner};
use crate::Scalar;
use crate::contain::Location;
use crate::error::Error;
use crate::polygon::{Fill, Rings};
use i_overlay::core::edge_data::{EdgeDataMerge, OverlayEdgeData};
use i_overlay::core::edge_overlay::{EdgeOverlay, InputEdge};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::ShapeType;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::segm::boolean::ShapeCountBoolean;
use i_overlay::vector::edge::{
    CLIP_LEFT, CLIP_RIGHT, DataVectorEdge, DataVectorShape, SUBJ_LEFT, SUBJ_RIGHT,
};

impl OverlayEdgeData for Tag {
    type Store = Vec<[Tag; 2]>;

    fn merge(both: EdgeDataMerge<ShapeCountBoolean, Self>, sets: &mut Self::Store) -> Self {
        Tag::joined(both.lhs_data, both.rhs_data, sets)
    }
}

/// Returns both polygons on a grid.
fn grid<S: Scalar<Mask = bool>>(inputs: [Rings<'_, S>; 2], steps: Steps) -> Result<Grid, Error> {
    for (owner, rings) in [Owner::A, Owner::B].into_iter().zip(inputs) {
        rings.validate().map_err(|flaw| invalid(owner, flaw))?;
    }
    Grid::new(inputs, steps)
}

/// Two polygons cut into pieces that meet at their ends only.
pub(super) struct Pieces {
    pub grid: Grid,
    overlay: EdgeOverlay<i64, Tag>,
    fill: FillRule,
}

impl Pieces {
    pub fn new<S: Scalar<Mask = bool>>(
        inputs: [Rings<'_, S>; 2],
        fill: Fill,
    ) -> Result<Self, Error> {
        let mut grid = grid(inputs, Steps::Fine)?;
        let edges = grid.edges.iter().map(|edge| edge.ends).enumerate();
        let mut edges: Numbered = edges.collect();
        if may_grow(&edges) {
            let of_second = |k: usize| grid.edges[k].id.owner == Owner::B;
            edges = cut(&edges, of_second).unwrap_or_else(|| grid.snap(Squares { bits: 1 }));
        }
        Ok(Pieces::of(grid, edges, fill))
    }
    /// Returns the pieces of polygons whose edges are rounded to numbers of the format.
    pub fn snapped<S: Scalar<Mask = bool>>(
        inputs: [Rings<'_, S>; 2],
        fill: Fill,
    ) -> Result<Self, Error> {
        let mut grid = grid(inputs, Steps::Exact)?;
        let edges = grid.snap(squares::<S>());
        Ok(Pieces::of(grid, edges, fill))
    }
    /// Takes pieces of edges, each with the number of its edge.
    fn of(grid: Grid, edges: Numbered, fill: Fill) -> Self {
        let mut overlay = EdgeOverlay::new(edges.len());
        for (k, [a, b]) in edges {
            let data = Tag::edge(k);
            let shape = match grid.edges[k].id.owner {
                Owner::A => ShapeType::Subject,
                Owner::B => ShapeType::Clip,
            };
            overlay.add_edge(InputEdge { a, b, data }, shape);
        }
        let fill = match fill {
            Fill::NonZero => FillRule::NonZero,
            Fill::EvenOdd => FillRule::EvenOdd,
        };
        Pieces {
            grid,
            overlay,
            fill,
        }
    }
    /// Returns the border of the result: the inside is left of every piece.
    pub fn parts(&mut self, operation: BooleanOperation) -> Vec<DataVectorShape<i64, Tag>> {
        let rule = match operation {
            BooleanOperation::Union => OverlayRule::Union,
            BooleanOperation::Intersection => OverlayRule::Intersect,
            BooleanOperation::Difference => OverlayRule::Difference,
            BooleanOperation::SymmetricDifference => OverlayRule::Xor,
        };
        self.overlay.build_vector_shapes(rule, self.fill)
    }
    pub fn trace(&mut self, operation: BooleanOperation) -> OverlayTrace {
        let parts = self.parts(operation);
        let mut trace = OverlayTrace::default();
        for part in parts {
            for ring in part {
                self.add_ring(&ring, &mut trace);
            }
            if trace.parts.last().copied().unwrap_or(0) < trace.rings.len() {
                trace.parts.push(trace.rings.len());
            }
        }
        trace
    }
    /// Adds the vertices of a ring, unless it has no corner.
    fn add_ring(&self, ring: &[DataVectorEdge<i64, Tag>], trace: &mut OverlayTrace) {
        let borders: Vec<_> = ring.iter().map(|piece| self.border(piece)).collect();
        let before = trace.vertices.len();
        for (k, border) in borders.iter().enumerate() {
            let next = &borders[(k + 1) % borders.len()];
            if border.edges != next.edges {
                corner(&self.grid, border, next, trace);
            }
        }
        if trace.vertices.len() > before {
            trace.rings.push(trace.vertices.len());
        }
    }
    /// Returns the edges that a piece lies on, of inputs that it bounds.
    pub fn border(&self, piece: &DataVectorEdge<i64, Tag>) -> Border {
        let mut edges = Vec::new();
        piece.data.edges(self.overlay.data_store(), &mut edges);
        let bounds = |left: u8, right: u8| (piece.fill & left == 0) != (piece.fill & right == 0);
        let bounds = [bounds(SUBJ_LEFT, SUBJ_RIGHT), bounds(CLIP_LEFT, CLIP_RIGHT)];
        edges.retain(|&k| bounds[self.grid.edges[k].id.owner as usize]);
        edges.sort_unstable();
        Border {
            edges,
            end: piece.b,
        }
    }
}

/// Cuts the edges of two polygons by this library and by i_overlay alone. Returns `true` if both give one border, piece
/// by piece with the edges that each lies on; `None` where i_overlay alone cuts them in any case.
///
/// # Errors
///
/// As [`overlay_search`].
#[doc(hidden)]
pub fn is_cut_alike<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: BooleanOperation,
    fill: Fill,
) -> Result<Option<bool>, Error> {
    let inputs = [a.into(), b.into()];
    let own = grid(inputs, Steps::Fine)?;
    let edges: Numbered = own.edges.iter().map(|edge| edge.ends).enumerate().collect();
    let of_second = |k: usize| own.edges[k].id.owner == Owner::B;
    let Some(pieces) = may_grow(&edges).then(|| cut(&edges, of_second)).flatten() else {
        return Ok(None);
    };
    let border = |grid: Grid, edges: Numbered| {
        let mut pieces = Pieces::of(grid, edges, fill);
        let all = pieces.parts(operation).into_iter().flatten().flatten();
        let all = all.map(|piece| (piece.a, piece.b, pieces.border(&piece).edges));
        all.collect::<Vec<_>>()
    };
    let whole = grid(inputs, Steps::Fine)?;
    Ok(Some(border(own, pieces) == border(whole, edges)))
}

/// Returns the origin of every vertex of the result of a boolean operation. See the [module](super).
///
/// # Errors
///
/// [`Error::Invalid`] with the input and [`Flaw::Ring`](crate::Flaw::Ring) for a coordinate that is not
/// finite, and for a ring of fewer than three distinct vertices.
pub fn overlay_search<'a, S: Scalar<Mask = bool>>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    operation: BooleanOperation,
    fill: Fill,
) -> Result<OverlayTrace, Error> {
    let inputs = [a.into(), b.into()];
    if operation == BooleanOperation::Union && inputs[1].count() == 0 {
        let flaw = |flaw| invalid(Owner::A, flaw);
        inputs[0].validate().map_err(flaw)?;
        let own = (Owner::A, 0);
        if let Some(trace) = walked_trace(inputs[0], own, 0, |winding| {
            Location::Off(winding).is_inside(fill)
        }) {
            return Ok(trace);
        }
    }
    let mut pieces = Pieces::new(inputs, fill)?;
    Ok(pieces.trace(operation))
}

/// Returns the record of the part of a frame that no ring covers: of the difference of the frame and, second, of the same
/// frame with rings inside of it, by the non-zero rule.
pub(crate) fn framed_search<S: Scalar<Mask = bool>>(
    frame: Rings<'_, S>,
    all: Rings<'_, S>,
) -> Result<OverlayTrace, Error> {
    let inner: Vec<_> = all.iter().skip(1).collect();
    match walked_trace(Rings::from(&inner[..]), (Owner::B, 1), 1, |winding| {
        winding == 0
    }) {
        Some(trace) => Ok(trace),
        None => overlay_search(frame, all, BooleanOperation::Difference, Fill::NonZero),
    }
}

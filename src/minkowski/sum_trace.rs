//! Records of Minkowski sums, and their replays.
use crate::boolean::{OverlayTrace, ValidTrace, overlay_replay, valid_replay};
use crate::offset::Before;
use crate::polygon::Rings;
use crate::{Polygon, Scalar};

/// Rings of sums: of each vertex the numbers of the vertices of both polygons.
pub(crate) type SumRings = Vec<Vec<[u32; 2]>>;

/// The decisions up to the union: both polygons, the convolution of their rings, and the copies at vertices of holes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SumLaid {
    pub before: [Before; 2],
    /// The second polygon is mirrored at the origin.
    pub is_mirrored: bool,
    pub rings: [SumRings; 2],
}

impl SumLaid {
    /// Returns both inputs of the union from both polygons.
    pub fn inputs<S: Scalar>(&self, polygons: &[Polygon<S>; 2]) -> [Polygon<S>; 2] {
        let [a, b] = [polygons[0].vertices(), polygons[1].vertices()];
        let vertex = |&[i, j]: &[u32; 2]| {
            let (p, q) = (a[i as usize], b[j as usize]);
            if self.is_mirrored { p - q } else { p + q }
        };
        [0, 1].map(|k| {
            let mut made = Polygon::new();
            for ring in &self.rings[k] {
                made.push(ring.iter().map(vertex));
            }
            made
        })
    }
    /// Returns both polygons that are summed.
    pub fn polygons<S: Scalar>(&self, inputs: [Rings<'_, S>; 2]) -> [Polygon<S>; 2] {
        [0, 1].map(|k| self.before[k].polygon(inputs[k]))
    }
}

/// The record of a Minkowski sum: where each vertex of the result is from. It holds no numbers of the inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct MinkowskiTrace {
    pub(crate) laid: SumLaid,
    pub(crate) result: OverlayTrace,
}

impl MinkowskiTrace {
    /// Returns the number of vertices of the result.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.result.vertex_count()
    }
    /// Returns the parts of the result as numbers of rings: the first of each bounds the part, the others are its
    /// holes.
    pub fn parts(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        self.result.parts()
    }
}

/// The record of a Minkowski sum that is valid by the OGC's rules: the vertices of the result and where each is from.
#[derive(Clone, Debug, PartialEq)]
pub struct ValidMinkowskiTrace {
    pub(crate) laid: SumLaid,
    pub(crate) result: ValidTrace,
}

impl ValidMinkowskiTrace {
    /// Returns the number of parts of the result.
    #[must_use]
    pub fn part_count(&self) -> usize {
        self.result.part_count()
    }
    /// Returns the number of vertices of the result.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.result.vertex_count()
    }
}

/// Returns a Minkowski sum from both inputs and the record of `minkowski_search` or `no_fit_search`: parts
/// counter-clockwise, holes clockwise. Edges may cross by an ulp; see [`valid_minkowski_replay`].
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of other inputs.
#[must_use]
pub fn minkowski_replay<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &MinkowskiTrace,
) -> Polygon<S> {
    let polygons = trace.laid.polygons([a.into(), b.into()]);
    let [a, b] = trace.laid.inputs(&polygons);
    overlay_replay(&a, &b, &trace.result)
}

/// Returns a Minkowski sum as polygons that are valid by the OGC's rules, one per part, from both inputs and the record of
/// `valid_minkowski_search` or `valid_no_fit_search`. Values are those of the record; derivatives are those of the origin
/// of each vertex.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of other inputs.
#[must_use]
pub fn valid_minkowski_replay<'a, S: Scalar>(
    a: impl Into<Rings<'a, S>>,
    b: impl Into<Rings<'a, S>>,
    trace: &ValidMinkowskiTrace,
) -> Vec<Polygon<S>> {
    let polygons = trace.laid.polygons([a.into(), b.into()]);
    let [a, b] = trace.laid.inputs(&polygons);
    valid_replay(&a, &b, &trace.result)
}

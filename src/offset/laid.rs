//! Records of offsets, and their replays.
use super::raw::Plan;
use crate::boolean::{OverlayTrace, ValidTrace, overlay_replay, valid_replay};
use crate::polygon::Rings;
use crate::{Polygon, Scalar, Vec2};

/// The polygon that is offset, from the input.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum Before {
    /// The input itself.
    Given,
    /// Its union, of vertices of the input alone.
    United(OverlayTrace),
    /// Its union, valid by the OGC's rules.
    Valid(ValidTrace),
}

/// The decisions up to the raw rings.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Laid {
    pub before: Before,
    pub plan: Plan,
}

impl Before {
    /// Returns the polygon that is offset.
    pub fn polygon<S: Scalar>(&self, rings: Rings<'_, S>) -> Polygon<S> {
        let nothing = Rings::flat(&[], &[]);
        match self {
            Before::Given => rings.to_polygon(),
            Before::United(trace) => overlay_replay(rings, nothing, trace),
            Before::Valid(trace) => {
                let parts = valid_replay(rings, nothing, trace);
                let mut made = Polygon::new();
                for ring in parts
                    .iter()
                    .flat_map(|part| (0..part.ends().len()).map(|k| part.ring(k)))
                {
                    made.push(ring.iter().copied());
                }
                made
            }
        }
    }
}

impl Laid {
    /// Returns the polygon that is offset.
    pub fn polygon<S: Scalar>(&self, rings: Rings<'_, S>) -> Polygon<S> {
        self.before.polygon(rings)
    }
    /// Returns both inputs of the boolean operation that makes the result: the raw rings and nothing, whose union it
    /// is; or a frame, and the same frame with the raw rings, whose difference it is.
    pub fn inputs<S: Scalar>(&self, polygon: &Polygon<S>, d: S) -> [Polygon<S>; 2] {
        let raw = self.plan.raw(polygon.vertices(), d);
        if !self.plan.is_inward {
            return [raw, Polygon::new()];
        }
        let frame = frame(&raw);
        let mut around = Polygon::from_rings([&frame[..]]);
        for ring in raw.rings().iter() {
            around.push(ring.iter().copied());
        }
        [Polygon::from_rings([&frame[..]]), around]
    }
}

/// Returns the corners of a box beyond all rings, without derivatives. It bounds no result.
fn frame<S: Scalar>(rings: &Polygon<S>) -> [Vec2<S>; 4] {
    let zero = Vec2::zero();
    let (low, high) = rings
        .rings()
        .bounds()
        .map_or((zero, zero), |bounds| (bounds.min, bounds.max));
    let beyond = |from: S, to: S| to + (to - from) * S::lit(0.125);
    let (low, high) = (
        Vec2::new(beyond(high.x, low.x), beyond(high.y, low.y)),
        Vec2::new(beyond(low.x, high.x), beyond(low.y, high.y)),
    );
    crate::Aabb2 {
        min: low,
        max: high,
    }
    .corners()
}

/// The record of an offset: where each vertex of the result is from. It holds no numbers of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct OffsetTrace {
    pub(crate) laid: Laid,
    pub(crate) result: OverlayTrace,
}

impl OffsetTrace {
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

/// The record of an offset that is valid by the OGC's rules: the vertices of the result and where each is from.
#[derive(Clone, Debug, PartialEq)]
pub struct ValidOffsetTrace {
    pub(crate) laid: Laid,
    pub(crate) result: ValidTrace,
}

impl ValidOffsetTrace {
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

/// Returns an offset from the input, the distance and the record of `offset_search` or `path_offset_search`: parts
/// counter-clockwise, holes clockwise. Edges may cross by an ulp; see [`valid_offset_replay`].
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of another input.
#[must_use]
pub fn offset_replay<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &OffsetTrace,
) -> Polygon<S> {
    let polygon = trace.laid.polygon(rings.into());
    let [a, b] = trace.laid.inputs(&polygon, d);
    overlay_replay(&a, &b, &trace.result)
}

/// Returns an offset as polygons that are valid by the OGC's rules, one per part, from the input, the distance and the
/// record of `valid_offset_search` or `valid_path_offset_search`: the outer ring first, counter-clockwise, then the
/// holes, clockwise. Values are those of the record; derivatives are those of the origin of each vertex.
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of another input.
#[must_use]
pub fn valid_offset_replay<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &ValidOffsetTrace,
) -> Vec<Polygon<S>> {
    let polygon = trace.laid.polygon(rings.into());
    let [a, b] = trace.laid.inputs(&polygon, d);
    valid_replay(&a, &b, &trace.result)
}

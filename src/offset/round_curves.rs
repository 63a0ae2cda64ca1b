//! The border of an offset as contours of lines and arcs.
use super::round_border::{RoundBorder, sweep};
use super::round_trace::{OffsetCurve, RoundWay};
use super::{RoundOffsetTrace, offset_replay};
use crate::curve::CurvePath;
use crate::polygon::Rings;
use crate::{Scalar, Vec2};

/// Returns the border of an offset with round corners and ends as closed contours of lines and arcs, from the input, the
/// distance and the record of `round_offset_search` or `round_path_offset_search`; `None` where nothing is left. The offset
/// is on the left of them. The last piece of a contour is a line that closes it, unless all are arcs. A record of chords has
/// lines alone.
///
/// ```
/// # #[cfg(feature = "boolean")] {
/// use geograd::{Aabb2, offset::{OffsetStyle, round_offset_curves, round_offset_search}};
/// let square = Aabb2::new(0.0_f64, 0.0, 4.0, 4.0).corners();
/// let trace = round_offset_search(&square, 1.0, &OffsetStyle::default())?;
/// let border = round_offset_curves(&square, 1.0, &trace).expect("it grows");
/// assert_eq!(border.pieces().count(), 8);
/// assert!((border.signed_area() - (32.0 + std::f64::consts::PI)).abs() < 1e-13);
/// # }
/// # Ok::<(), geograd::Error>(())
/// ```
///
/// # Panics
///
/// When the record names a ring or a vertex that is not there: it is of another input.
#[must_use]
pub fn round_offset_curves<'a, S: Scalar>(
    rings: impl Into<Rings<'a, S>>,
    d: S,
    trace: &RoundOffsetTrace,
) -> Option<CurvePath<S>> {
    let rings = rings.into();
    let mut made = None;
    let mut add = |mut contour: Vec<(Vec2<S>, Option<S>)>| {
        // The step that closes a contour is a line.
        let line = contour.iter().position(|(_, bulge)| bulge.is_none());
        if let Some(line) = line {
            contour.rotate_left(line + 1);
        }
        let Some(&(start, _)) = contour.first() else {
            return;
        };
        let mut path = match made.take() {
            None => CurvePath::at(start),
            Some(path) => CurvePath::move_to(path, start),
        };
        let steps = contour.len() - usize::from(line.is_some());
        for (k, &(_, bulge)) in contour[..steps].iter().enumerate() {
            let to = contour[(k + 1) % contour.len()].0;
            path = match bulge {
                None => path.line_to(to),
                Some(bulge) => path.arc_to(to, bulge),
            };
        }
        made = Some(if line.is_some() { path.close() } else { path });
    };
    match &trace.way {
        RoundWay::Arcs(before, all) => {
            let polygon = before.polygon(rings);
            let border = RoundBorder::new(polygon.vertices(), d, all);
            let mut first = 0;
            for &end in &all.contours {
                let mut contour = Vec::new();
                for piece in &all.pieces[first..end as usize] {
                    let [p, q] = border.ends(piece);
                    let bulge = match piece.curve {
                        OffsetCurve::Side(_) => None,
                        OffsetCurve::Arc(_) => Some((sweep(p.way, q.way) * S::lit(0.25)).tan()),
                    };
                    contour.push((border.seen.outer_place(p.at), bulge));
                }
                if all.is_inward {
                    // Backwards: the piece to the vertex before, turned over.
                    let n = contour.len();
                    let back = |k: usize| {
                        let bulge = contour[(2 * n - k - 1) % n].1.map(|bulge| -bulge);
                        (contour[(n - k) % n].0, bulge)
                    };
                    contour = (0..n).map(back).collect();
                }
                add(contour);
                first = end as usize;
            }
        }
        RoundWay::Chords(trace) => {
            for ring in offset_replay(rings, d, trace).rings().iter() {
                add(ring.iter().map(|&at| (at, None)).collect());
            }
        }
    }
    made
}

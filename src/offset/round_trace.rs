//! Records of offsets with exact arcs: what is left of each side and each arc of the raw offset.
use super::{Before, OffsetTrace};

/// A curve of the raw offset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum OffsetCurve {
    /// An edge moved to its right: twice its number, plus one for the edge run backwards.
    Side(u32),
    /// The arc of this number about a vertex, counter-clockwise.
    Arc(u32),
}

/// An end of a piece of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum PieceEnd {
    /// The end of the curve itself.
    Own,
    /// The crossing with another curve.
    At(OffsetCurve),
}

/// A piece of the border, with the offset on its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct OffsetPiece {
    pub curve: OffsetCurve,
    pub from: PieceEnd,
    pub to: PieceEnd,
}

/// An arc from the end of one side to the start of the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct OffsetArc {
    pub sides: [u32; 2],
    /// Its center is the mean of these vertices, which coincide: a range of [`RoundPieces::centers`].
    pub centers: [u32; 2],
}

/// The border of an offset by the names of its curves. A crossing is the one at which the first curve ends and the second
/// one starts, which distinguishes the two crossings of a line and a circle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct RoundPieces {
    /// The numbers of the vertices at both ends of each edge.
    pub edges: Vec<[u32; 2]>,
    pub arcs: Vec<OffsetArc>,
    pub centers: Vec<u32>,
    /// In the order of the border, one contour after the other.
    pub pieces: Vec<OffsetPiece>,
    /// The number of pieces up to the end of each contour.
    pub contours: Vec<u32>,
    /// The border is that of the offset of all that is outside.
    pub is_inward: bool,
}

/// The ways to the measures of an offset.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    not(feature = "boolean"),
    expect(dead_code, reason = "a replay needs no feature, its record does")
)]
pub(crate) enum RoundWay {
    Arcs(Before, RoundPieces),
    Chords(OffsetTrace),
}

/// The record of the measures of an offset with round corners and ends: which curves bound it and where each ends. It
/// holds no numbers of the input.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundOffsetTrace {
    pub(crate) way: RoundWay,
}

impl RoundOffsetTrace {
    /// Returns `true` if arcs are exact; `false` if chords stand for them. See
    /// [`round_offset_search`](super::round_offset_search).
    #[must_use]
    pub fn is_exact(&self) -> bool {
        matches!(self.way, RoundWay::Arcs(..))
    }
    /// Returns the number of straight pieces and of arcs of the border; chords are straight pieces.
    #[must_use]
    pub fn piece_counts(&self) -> [usize; 2] {
        match &self.way {
            RoundWay::Arcs(_, all) => {
                let is_arc = |piece: &&OffsetPiece| matches!(piece.curve, OffsetCurve::Arc(_));
                let arcs = all.pieces.iter().filter(is_arc).count();
                [all.pieces.len() - arcs, arcs]
            }
            RoundWay::Chords(trace) => [trace.vertex_count(), 0],
        }
    }
}

//! The record of a search: how the surface of an intersection is made of two bodies' corners.
use super::cutting_planes::CutPlane;
use super::volume_search::{Decisions, Piece};

/// The codes of a record for each corner of the larger capacity; two cubes need at most a third.
const CODES: usize = 160;

/// The decisions of a search for the volume that two bodies share, of up to `N` corners each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VolumeRecord<const N: usize> {
    codes: [[u16; CODES]; N],
}

/// Bits of the first code.
const EXCHANGED: u16 = 1;
const SAME: u16 = 2;
const TWICE: u16 = 4;
const BEYOND: u16 = 8;

impl<const N: usize> VolumeRecord<N> {
    /// Returns the record of decisions.
    pub(super) fn of(mut found: Decisions) -> Self {
        let mut codes = encoded(&found);
        if codes.len() > CODES * N && found.twice {
            found.leave_second();
            codes = encoded(&found);
        }
        if codes.len() > CODES * N {
            codes = vec![BEYOND];
        }
        let mut record = VolumeRecord {
            codes: [[0; CODES]; N],
        };
        for (place, code) in record.codes.as_flattened_mut().iter_mut().zip(codes) {
            *place = code;
        }
        record
    }
    /// Returns the decisions; `None` where they do not fit.
    pub(super) fn decisions(&self) -> Option<Decisions> {
        let mut codes = self
            .codes
            .as_flattened()
            .iter()
            .map(|&code| usize::from(code));
        let mut next = || codes.next().unwrap_or(0);
        let flags = next() as u16;
        if flags & BEYOND != 0 {
            return None;
        }
        let mut found = Decisions {
            exchanged: flags & EXCHANGED != 0,
            same: flags & SAME != 0,
            twice: flags & TWICE != 0,
            corners: next(),
            ..Decisions::default()
        };
        for triangles in &mut found.triangles {
            *triangles = (0..next()).map(|_| [next(), next(), next()]).collect();
        }
        for _ in 0..next() {
            let (kind, [a, b, c]) = (next(), [next(), next(), next()]);
            found.planes.push(match kind {
                0 => CutPlane::Face([a, b, c]),
                1 => CutPlane::Across([a, b], c),
                _ => CutPlane::HalfSpace,
            });
        }
        found.points = (0..next()).map(|_| [next(), next(), next()]).collect();
        for _ in 0..next() {
            let (on, of_other, count) = (next(), next() == 1, next());
            let triangles = &found.triangles[usize::from(of_other)];
            found.pieces.push(Piece {
                on: on.checked_sub(1).map(|on| triangles[on]),
                of_other,
                ring: (0..count).map(|_| next()).collect(),
            });
        }
        Some(found)
    }
}

/// Returns decisions as numbers: lists with their lengths before them.
fn encoded(found: &Decisions) -> Vec<u16> {
    let flag = |bit: u16, set: bool| if set { bit } else { 0 };
    let flags =
        flag(EXCHANGED, found.exchanged) | flag(SAME, found.same) | flag(TWICE, found.twice);
    let mut codes = vec![usize::from(flags), found.corners];
    for triangles in &found.triangles {
        codes.push(triangles.len());
        codes.extend(triangles.iter().flatten());
    }
    codes.push(found.planes.len());
    for &plane in &found.planes {
        codes.extend(match plane {
            CutPlane::Face([a, b, c]) => [0, a, b, c],
            CutPlane::Across([a, b], c) => [1, a, b, c],
            CutPlane::HalfSpace => [2, 0, 0, 0],
        });
    }
    codes.push(found.points.len());
    codes.extend(found.points.iter().flatten());
    codes.push(found.pieces.len());
    for piece in &found.pieces {
        let triangles = &found.triangles[usize::from(piece.of_other)];
        let on = piece
            .on
            .and_then(|on| triangles.iter().position(|&other| other == on));
        codes.extend([
            on.map_or(0, |on| on + 1),
            usize::from(piece.of_other),
            piece.ring.len(),
        ]);
        codes.extend(&piece.ring);
    }
    // Bodies have up to 256 corners; a number beyond 16 bits makes the record too long anyway.
    codes
        .iter()
        .map(|&code| code.min(usize::from(u16::MAX)) as u16)
        .collect()
}

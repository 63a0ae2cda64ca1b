//! The record of a search for the faces of a hull, of a size that its capacity gives.
use super::surface::Surface;
use super::{HullFaces, hull_search};
use crate::scalar::noted;
use crate::{Scalar, Vec3};

/// The most entries of rings per vertex: the rings of n corners have two for each of at most 3n − 6 edges.
const ENTRIES: usize = 6;
/// The bit of the last corner of a ring.
const LAST: u16 = 1 << 15;

/// The faces of a hull of up to `N` vertices, by their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HullFacesRecord<const N: usize> {
    /// The rings one after another; of a point or a segment its ends. The first `count` entries matter.
    entries: [[u16; ENTRIES]; N],
    count: u16,
    /// The number of independent directions.
    dimension: u8,
}

impl<const N: usize> HullFacesRecord<N> {
    fn of(HullFaces(surface): &HullFaces) -> Self {
        const {
            assert!(
                N * ENTRIES < LAST as usize,
                "records have fifteen bits for a corner"
            );
        }
        let ends: &[usize] = match surface.dimension {
            0 | 1 => &surface.corners,
            _ => &[],
        };
        let rings = std::iter::once(ends).chain(surface.facets());
        let coded = rings.flat_map(|ring| {
            let last = ring.len().wrapping_sub(1);
            let code = move |(k, &corner): (usize, &usize)| {
                corner as u16 | if k == last { LAST } else { 0 }
            };
            ring.iter().enumerate().map(code)
        });
        let mut record = HullFacesRecord {
            entries: [[0; ENTRIES]; N],
            count: 0,
            dimension: surface.dimension as u8,
        };
        for (place, code) in record.entries.as_flattened_mut().iter_mut().zip(coded) {
            *place = code;
            record.count += 1;
        }
        record
    }
    /// Returns the record of the faces of some points.
    pub fn search<S: Scalar<Mask = bool>>(points: &[Vec3<S>]) -> Self {
        let record = Self::of(&hull_search(points));
        noted::<S::Primal>(16, record.entries().iter().map(|&code| code.into()));
        record
    }
    fn entries(&self) -> &[u16] {
        &self.entries.as_flattened()[..usize::from(self.count)]
    }
    /// Returns the faces.
    pub fn faces(&self) -> HullFaces {
        let corner = |&code: &u16| usize::from(code & !LAST);
        let mut surface = Surface::default();
        surface.dimension = usize::from(self.dimension);
        surface.corners = self.entries().iter().map(corner).collect();
        if surface.dimension > 1 {
            for ring in self.entries().split_inclusive(|code| code & LAST != 0) {
                surface.add_ring(ring.iter().map(corner));
            }
            surface.corners.sort_unstable();
            surface.corners.dedup();
        }
        HullFaces(surface)
    }
    /// Returns `true` if a vertex is a corner.
    pub fn has(&self, vertex: usize) -> bool {
        self.entries()
            .iter()
            .any(|code| usize::from(code & !LAST) == vertex)
    }
}

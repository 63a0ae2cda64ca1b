//! The record of a diagram: what bounds each cell.

/// The line that bounds a cell along one of its sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CellBorder {
    /// The bisector with another site.
    Site(usize),
    /// An edge of the domain from one vertex to another, with the domain on its left. Vertices of all rings are
    /// numbered one ring after the other.
    Edge([usize; 2]),
}

/// The record of a [search](super::PowerDiagram::search): the borders around each cell, without numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CellTrace {
    /// The borders of all rings of all cells.
    pub(super) borders: Vec<CellBorder>,
    /// The number of borders up to the end of each ring.
    pub(super) rings: Vec<usize>,
    /// The number of rings up to the end of each cell.
    pub(super) cells: Vec<usize>,
    /// The first site at the same place with the same weight, which has the cell.
    pub(super) first: Vec<usize>,
}

impl CellTrace {
    /// Returns the number of sites.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cells.len()
    }
    /// Returns `true` if there are no sites.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }
    /// Returns the site whose cell a site shares: the first one at its place with its weight, in most cases itself.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    #[must_use]
    pub fn first(&self, site: usize) -> usize {
        self.first[site]
    }
    /// Returns `true` if other sites cover a site's cell, or it lies outside of the domain.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    #[must_use]
    pub fn is_hidden(&self, site: usize) -> bool {
        self.rings(site).next().is_none()
    }
    /// Returns the borders around a cell, counter-clockwise, for each of its rings.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    pub fn rings(&self, site: usize) -> impl Iterator<Item = &[CellBorder]> {
        self.own_rings(self.first[site])
    }
    /// Returns the rings of a cell where its record is; none for a site that shares the cell of another.
    pub(super) fn own_rings(&self, site: usize) -> impl Iterator<Item = &[CellBorder]> {
        let from = site.checked_sub(1).map_or(0, |before| self.cells[before]);
        (from..self.cells[site]).map(|ring| {
            let start = ring.checked_sub(1).map_or(0, |before| self.rings[before]);
            &self.borders[start..self.rings[ring]]
        })
    }
    /// Returns the sites whose cells share a side with a cell, once each, in the order of their numbers. Of sites that
    /// share a cell the first is named.
    ///
    /// # Panics
    ///
    /// When there is no such site.
    #[must_use]
    pub fn neighbours(&self, site: usize) -> Vec<usize> {
        let borders = self.rings(site).flatten();
        let mut found: Vec<usize> = borders
            .filter_map(|border| match border {
                CellBorder::Site(other) => Some(*other),
                CellBorder::Edge(_) => None,
            })
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }
    /// Appends a ring of the cell that is being written.
    pub(super) fn push_ring(&mut self, ring: impl IntoIterator<Item = CellBorder>) {
        self.borders.extend(ring);
        self.rings.push(self.borders.len());
    }
}

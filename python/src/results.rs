//! Polygons that a function of items gives, with the records of its decisions.
use crate::polygons::{Format, Layout, Polygons, is_ring};
use geograd::Vec2;
use geograd::polygon::Polygon;
use std::ops::Range;
use std::sync::Arc;

/// The record of an item, and the vertices of it that the result has.
struct Kept<R> {
    record: R,
    vertices: Vec<Range<usize>>,
}

/// The records of items, in their order.
pub struct Records<R> {
    items: Vec<Kept<R>>,
    /// The number of vertices of results up to the start of each item, and of all.
    firsts: Vec<usize>,
}

/// The results of some items.
pub struct Results<T, R> {
    vertices: Vec<Vec2<T>>,
    layout: Layout,
    records: Records<R>,
    keeps: bool,
    /// The vertices of the present item's record that the result has, and the number of all before.
    kept: Vec<Range<usize>>,
    start: usize,
}

impl<T: Format, R> Results<T, R> {
    /// Creates the results of no items. Without derivatives no records are kept.
    pub fn new(keeps: bool) -> Self {
        Results {
            vertices: Vec::new(),
            layout: Layout::empty(),
            records: Records {
                items: Vec::new(),
                firsts: vec![0],
            },
            keeps,
            kept: Vec::new(),
            start: 0,
        }
    }
    /// Adds a part of the present item without its rings of fewer than three distinct vertices, which have no area.
    fn add_part<'r>(&mut self, rings: impl Iterator<Item = &'r [Vec2<T>]>) {
        let mut is_solid = true;
        for (k, ring) in rings.enumerate() {
            let is_kept = is_solid && is_ring(ring);
            // The first ring bounds the part: without it there are no holes.
            is_solid &= is_kept || k > 0;
            let end = self.start + ring.len();
            if is_kept {
                self.vertices.extend_from_slice(ring);
                self.layout.add_ring(ring.len());
                self.kept.push(self.start..end);
            }
            self.start = end;
        }
        self.layout.end_part();
    }
    /// Adds the parts of a valid result.
    pub fn add_valid(&mut self, parts: &[Polygon<T>]) {
        for part in parts {
            self.add_part(part.rings().iter());
        }
    }
    /// Adds the parts of a result, each by the numbers of its rings.
    pub fn add_plain(&mut self, shape: &Polygon<T>, parts: impl Iterator<Item = Range<usize>>) {
        for part in parts {
            self.add_part(part.map(|ring| shape.ring(ring)));
        }
    }
    /// Ends the present item, whose decisions are recorded.
    pub fn end(&mut self, record: R) {
        self.layout.end_polygon();
        if self.keeps {
            self.records.items.push(Kept {
                record,
                vertices: self.kept.clone(),
            });
            self.records.firsts.push(self.vertices.len());
        }
        self.kept.clear();
        self.start = 0;
    }
    /// Adds the results of further items.
    pub fn add(&mut self, next: Self) {
        let before = self.vertices.len();
        self.vertices.extend(next.vertices);
        self.layout.add_all(&next.layout);
        self.records.items.extend(next.records.items);
        let firsts = next.records.firsts[1..].iter();
        self.records.firsts.extend(firsts.map(|&end| before + end));
    }
    /// Returns the column of all results, and their records if they are kept.
    pub fn column(self) -> (Polygons, Option<Records<R>>) {
        let made = Polygons::of(Arc::new(self.layout), T::kept(self.vertices));
        (made, self.keeps.then_some(self.records))
    }
}

impl<R> Records<R> {
    /// Returns the number of items.
    pub fn len(&self) -> usize {
        self.items.len()
    }
    /// Returns the number of vertices of all results.
    pub fn vertex_count(&self) -> usize {
        self.firsts.last().copied().unwrap_or(0)
    }
    /// Returns an item's record, and writes the cotangents of all its vertices from those of the vertices of all results:
    /// zero for those that its result has not.
    pub fn bars<T: Format>(
        &self,
        item: usize,
        upstream: &[Vec2<T>],
        count: impl Fn(&R) -> usize,
        bars: &mut Vec<Vec2<T>>,
    ) -> &R {
        let Kept { record, vertices } = &self.items[item];
        bars.clear();
        bars.resize(count(record), Vec2::zero());
        let mut own = &upstream[self.firsts[item]..self.firsts[item + 1]];
        for range in vertices {
            let (these, others) = own.split_at(range.len());
            bars[range.clone()].copy_from_slice(these);
            own = others;
        }
        record
    }
}

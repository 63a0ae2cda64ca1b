//! A tree over points, and the queries that it answers.
use super::cloud_fault::CloudFault;
use super::cloud_search::{Reach, collect, widened};
use crate::mesh::{FAR, Mesh, MeshTree, SearchRoom, margin, nearest, plain};
use crate::{Lanes, Scalar, Vec3};
use std::collections::BinaryHeap;

/// The vectors of queries.
type Four = Lanes<f32, 4>;

/// A tree over points of space. It keeps no reference, so threads and calls share it.
#[derive(Clone, Debug)]
pub struct CloudTree {
    tree: MeshTree,
    /// Triangles with one point as all corners.
    faces: Vec<[u32; 3]>,
}

/// Points of space with their tree, which answers queries. [`CloudTree::on`] makes it.
///
/// Queries that are not finite have the record of point 0 and distances that are NaN.
#[derive(Clone, Copy, Debug)]
pub struct Cloud<'a, S> {
    points: &'a [Vec3<S>],
    tree: &'a CloudTree,
}

/// Returns the first fault of some points.
fn check<S: Scalar<Mask = bool>>(points: &[Vec3<S>]) -> Result<(), CloudFault> {
    if points.is_empty() {
        return Err(CloudFault::Empty);
    }
    if points.len() > i32::MAX as usize {
        return Err(CloudFault::TooLarge);
    }
    match points.iter().position(|point| !point.is_finite()) {
        Some(point) => Err(CloudFault::NotFinite { point }),
        None => Ok(()),
    }
}

impl CloudTree {
    /// Builds a tree over points. Takes `O(n log n)` steps.
    ///
    /// # Errors
    ///
    /// A [`CloudFault`] for a cloud without points and for the first point that is not finite.
    pub fn new<S: Scalar<Mask = bool>>(points: &[Vec3<S>]) -> Result<Self, CloudFault> {
        check(points)?;
        let faces: Vec<[u32; 3]> = (0..points.len() as u32).map(|k| [k; 3]).collect();
        let tree = MeshTree::new(&Mesh::unchecked(points, &faces));
        Ok(CloudTree { tree, faces })
    }
    /// Returns points with this tree, ready for queries. The tree must have been built over these points, or over the same
    /// numbers in another format.
    ///
    /// # Errors
    ///
    /// A [`CloudFault`] for another number of points and for the first point that is not finite.
    pub fn on<'a, S: Scalar<Mask = bool>>(
        &'a self,
        points: &'a [Vec3<S>],
    ) -> Result<Cloud<'a, S>, CloudFault> {
        check(points)?;
        if points.len() != self.faces.len() {
            return Err(CloudFault::OtherTree {
                expected: points.len(),
                found: self.faces.len(),
            });
        }
        Ok(self.over(points))
    }
    /// Returns the points with this tree, which was built over them.
    #[inline]
    pub(super) fn over<'a, S: Copy>(&'a self, points: &'a [Vec3<S>]) -> Cloud<'a, S> {
        Cloud { points, tree: self }
    }
}

impl<'a, S: Copy> Cloud<'a, S> {
    /// Returns the points.
    #[must_use]
    #[inline]
    pub fn points(&self) -> &'a [Vec3<S>] {
        self.points
    }
}

impl<S: Scalar<Mask = bool>> Cloud<'_, S> {
    /// Returns the index of the point that is nearest to a query, among equal ones the lowest.
    #[must_use]
    pub fn nearest(&self, query: Vec3<S>) -> u32 {
        let mesh = Mesh::unchecked(self.points, &self.tree.faces);
        let mut room = SearchRoom::default();
        let found = nearest::<Four, S>(&mesh, &self.tree.tree, plain(query), None, &mut room);
        found.map_or(0, |record| record.face)
    }
    /// Returns the distance of a query from the cloud, at least 0. Kinks: the points themselves, where the derivative is
    /// zero, and places with two nearest points, where it is that of the lower one.
    #[must_use]
    pub fn distance(&self, query: Vec3<S>) -> S {
        (query - self.points[self.nearest(query) as usize]).length()
    }
    /// Returns the squared distance of a query from the cloud; smooth also at the points. Kinks: places with two nearest
    /// points.
    #[must_use]
    pub fn squared_distance(&self, query: Vec3<S>) -> S {
        (query - self.points[self.nearest(query) as usize]).length_squared()
    }
    /// Returns the indices of so many nearest points, or of all if there are fewer, in the order of their distances, at
    /// equal ones of the indices; none for a query that is not finite.
    #[must_use]
    pub fn nearest_some(&self, query: Vec3<S>, count: usize) -> Vec<u32> {
        let count = count.min(self.points.len());
        let query = plain(query);
        if count == 0 || !query.is_finite() {
            return Vec::new();
        }
        let reach = Reach::Nearest(count, BinaryHeap::with_capacity(count + 1));
        let mut all = self.candidates(query, reach);
        all.sort_unstable_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        all.truncate(count);
        all.into_iter().map(|found| found.1).collect()
    }
    /// Returns the indices of the points whose squared distance is at most the radius squared, in their order; none for a
    /// query that is not finite or a radius below zero.
    #[must_use]
    pub fn within(&self, query: Vec3<S>, radius: S) -> Vec<u32> {
        let (query, radius) = (plain(query), radius.widened().unwrap_or(f64::NAN));
        if !query.is_finite() || !(0.0..).contains(&radius) {
            return Vec::new();
        }
        let frame = self.tree.tree.frame();
        let local = frame.local(query);
        let place = [local.x as f32, local.y as f32, local.z as f32];
        let reach = widened((radius * frame.scale) as f32, margin(place));
        let mut all = self.candidates(query, Reach::Within(reach));
        all.retain(|found| found.0 <= radius * radius);
        let mut all: Vec<u32> = all.into_iter().map(|found| found.1).collect();
        all.sort_unstable();
        all
    }
    /// Returns candidates with their squared distances.
    fn candidates(&self, query: Vec3<f64>, reach: Reach) -> Vec<(f64, u32)> {
        let local = self.tree.tree.frame().local(query);
        let square = |k: u32| ((plain(self.points[k as usize]) - query).length_squared(), k);
        if local.x.abs().max(local.y.abs()).max(local.z.abs()) > FAR {
            return (0..self.points.len() as u32).map(square).collect();
        }
        let place = [local.x as f32, local.y as f32, local.z as f32];
        let mut room = SearchRoom::default();
        collect::<Four>(&self.tree.tree, place, reach, &mut room);
        room.candidates
            .iter()
            .map(|found| square(found.1))
            .collect()
    }
}

//! A cloud that owns its points and their tree.
use super::cloud_fault::CloudFault;
use super::cloud_tree::{Cloud, CloudTree};
use crate::{Scalar, Vec3};

/// Points of space and their tree, owned and checked once: [`cloud`](OwnedCloud::cloud) lends them without another pass
/// over the points.
///
/// ```
/// use geograd::Vec3;
/// use geograd::cloud::OwnedCloud;
/// let owned = OwnedCloud::new(vec![Vec3::new(0.0, 0.0, 0.0), Vec3::new(3.0, 0.0, 0.0)])?;
/// assert_eq!(owned.cloud().nearest(Vec3::new(2.0, 0.0, 0.0)), 1);
/// # Ok::<(), geograd::cloud::CloudFault>(())
/// ```
#[derive(Clone, Debug)]
pub struct OwnedCloud<S> {
    points: Vec<Vec3<S>>,
    tree: CloudTree,
}

impl<S: Scalar<Mask = bool>> OwnedCloud<S> {
    /// Builds the tree over points. Takes `O(n log n)` steps.
    ///
    /// # Errors
    ///
    /// As [`CloudTree::new`].
    pub fn new(points: Vec<Vec3<S>>) -> Result<Self, CloudFault> {
        let tree = CloudTree::new(&points)?;
        Ok(OwnedCloud { points, tree })
    }
}

impl<S: Copy> OwnedCloud<S> {
    /// Returns the points with their tree, ready for queries.
    #[must_use]
    #[inline]
    pub fn cloud(&self) -> Cloud<'_, S> {
        self.tree.over(&self.points)
    }
}

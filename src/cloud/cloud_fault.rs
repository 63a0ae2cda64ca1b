//! Reasons why a cloud is refused.
use std::fmt;

/// The reason why a cloud is refused. Points count from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum CloudFault {
    /// There are no points.
    Empty,
    /// There are more points than 32-bit indices can count.
    TooLarge,
    /// A point has a coordinate that is NaN or infinite.
    NotFinite {
        /// The point.
        point: usize,
    },
    /// A tree was built over another number of points.
    OtherTree {
        /// The number of points of the cloud.
        expected: usize,
        /// The number of points that the tree was built over.
        found: usize,
    },
}

impl fmt::Display for CloudFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CloudFault::Empty => f.write_str("the cloud has no points"),
            CloudFault::TooLarge => f.write_str("the cloud has more points than 2³¹ − 1"),
            CloudFault::NotFinite { point } => write!(
                f,
                "point {point} has a coordinate that is not a finite number"
            ),
            CloudFault::OtherTree { expected, found } => {
                write!(f, "the tree is of {found} points, the cloud has {expected}")
            }
        }
    }
}

impl std::error::Error for CloudFault {}

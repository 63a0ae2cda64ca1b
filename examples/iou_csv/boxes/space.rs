//! Boxes of space: every score is a row of the library.
use super::{Boxes, Pairs, Scores, of_row, row};
use crate::metric::{Enclosing, Metric};
use crate::number::Number;
use common::cli::{Failure, Machine};
use geograd::{Obb3, YawBox3};

impl<T: Number> Boxes for YawBox3<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "heading"];
    const DERIVATIVE: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "r"];

    fn derivatives(self, by: Self, show: &mut dyn FnMut(T)) {
        let (center, size) = (by.center, by.size);
        let all = [center.x, center.y, center.z, size.x, size.y, size.z];
        all.into_iter().chain([by.heading]).for_each(show);
    }

    fn scores(
        metric: Metric,
        machine: &Machine,
        pairs: &Pairs<'_, T>,
        grad: bool,
    ) -> Result<Scores<Self>, Failure> {
        let row = match metric {
            Metric::Iou => row!(Iou, YawBox3),
            Metric::Iof => row!(Iof, YawBox3),
            Metric::Giou(Enclosing::Hull) => row!(Giou, YawBox3),
            Metric::Giou(Enclosing::Rect) => row!(GiouRectangle, YawBox3),
            Metric::Giou(Enclosing::Aabb) => row!(GiouAabb, YawBox3),
            Metric::Diou(Enclosing::Hull) => row!(Diou, YawBox3),
            Metric::Diou(Enclosing::Rect) => row!(DiouRectangle, YawBox3),
            Metric::Diou(Enclosing::Aabb) | Metric::DiouBox => row!(DiouAabb, YawBox3),
            Metric::Ciou(Enclosing::Hull) => row!(Ciou, YawBox3),
            Metric::Ciou(Enclosing::Rect) => row!(CiouRectangle, YawBox3),
            Metric::Ciou(Enclosing::Aabb) => row!(CiouAabb, YawBox3),
            Metric::Eiou(Enclosing::Hull) => row!(Eiou, YawBox3),
            Metric::Eiou(Enclosing::Rect) => row!(EiouRectangle, YawBox3),
            Metric::Eiou(Enclosing::Aabb) => row!(EiouAabb, YawBox3),
        };
        of_row(&row, machine, pairs, grad)
    }
}

impl<T: Number> Boxes for Obb3<T> {
    const COLUMNS: &'static [&'static str] =
        &["x", "y", "z", "dx", "dy", "dz", "qw", "qx", "qy", "qz"];
    const DERIVATIVE: &'static [&'static str] =
        &["x", "y", "z", "dx", "dy", "dz", "rx", "ry", "rz"];

    fn check(self) -> Result<(), String> {
        let q = self.rotation;
        match [q.w, q.x, q.y, q.z].iter().all(|&x| x == T::zero()) {
            true => Err("qw, qx, qy and qz are all zero, which is no rotation".into()),
            false => Ok(()),
        }
    }

    fn derivatives(self, by: Self, show: &mut dyn FnMut(T)) {
        let (center, size) = (by.center, by.size);
        // Derivatives are smaller the longer the quaternion is; turning is not.
        let turn = self.rotation.tangent_gradient(by.rotation);
        let all = [center.x, center.y, center.z, size.x, size.y, size.z];
        let all = all.into_iter().chain([turn.x, turn.y, turn.z]);
        all.for_each(show);
    }

    fn scores(
        metric: Metric,
        machine: &Machine,
        pairs: &Pairs<'_, T>,
        grad: bool,
    ) -> Result<Scores<Self>, Failure> {
        // The command line has no hull for these.
        let row = match metric {
            Metric::Iou => row!(Iou, Obb3),
            Metric::Iof => row!(Iof, Obb3),
            Metric::Giou(Enclosing::Hull | Enclosing::Rect) => row!(Giou, Obb3),
            Metric::Giou(Enclosing::Aabb) => row!(GiouAabb, Obb3),
            Metric::Diou(Enclosing::Hull | Enclosing::Rect) => row!(Diou, Obb3),
            Metric::Diou(Enclosing::Aabb) | Metric::DiouBox => row!(DiouAabb, Obb3),
            Metric::Ciou(Enclosing::Hull | Enclosing::Rect) => row!(Ciou, Obb3),
            Metric::Ciou(Enclosing::Aabb) => row!(CiouAabb, Obb3),
            Metric::Eiou(Enclosing::Hull | Enclosing::Rect) => row!(Eiou, Obb3),
            Metric::Eiou(Enclosing::Aabb) => row!(EiouAabb, Obb3),
        };
        of_row(&row, machine, pairs, grad)
    }
}

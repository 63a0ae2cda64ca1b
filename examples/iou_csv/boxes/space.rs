//! Boxes of space.
//!
//! IoU and IoF are the library's operations; the other scores are recorded as what they add to IoU.
use super::{Boxes, Pairs, Scores, on_cpu, on_scores};
use crate::known::known;
use crate::metric::Metric;
use crate::number::Number;
use geograd::iou3::{Enclosing, ciou, diou, giou};
use geograd::kernels::{Backend, IofObb3, IofYaw, IouObb3, IouYaw};
use geograd::shape::{Obb3, YawBox3};
use geograd::{Error, Scalar, Vec3, operation};

/// The square of the distance of the centres over that of the two points of both boxes that are farthest
/// from each other; zero where all points are one.
///
/// These are corners. Seen from the middle of `a`, along its axes, the corner of `a` farthest from a
/// point `p` is at `|p| + size/2` from it, number by number: so eight corners of `b` and the boxes' own
/// diagonals tell.
fn apart<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let seen = |p: Vec3<S>| a.rotation.inverse() * p;
    let between = b.center - a.center;
    let moved = Obb3 {
        center: between,
        ..b
    };
    let half = a.size * S::lit(0.5);
    let mut diameter = a.size.length().most(b.size.length());
    for corner in moved.corners() {
        let p = seen(corner);
        let reach = Vec3::new(p.x.magnitude(), p.y.magnitude(), p.z.magnitude()) + half;
        diameter = diameter.most(reach.length());
    }
    let point = diameter.at_most(S::zero());
    let share = between.length().over(S::select(point, S::one(), diameter));
    S::select(point, S::zero(), share.squared())
}

/// The scores of a kind of box that are made of its IoU: the macro lists them.
macro_rules! scores {
    ($Shape:ident, $Giou:ident, $Diou:ident, $DiouBox:ident, $Ciou:ident) => {
        operation! {
            $Giou = "giou": (a: $Shape<S>, b: $Shape<S>, iou: S) -> S {
                let [a, b] = known(a, b, iou);
                giou(a, b, Enclosing::Aabb)
            }
            promises []
            jumps Anywhere
            slopes Reverse

            $Diou = "diou": (a: $Shape<S>, b: $Shape<S>, iou: S) -> S {
                iou - apart(a.into(), b.into())
            }
            promises []
            jumps Anywhere
            slopes Reverse

            $DiouBox = "diou_box": (a: $Shape<S>, b: $Shape<S>, iou: S) -> S {
                let [a, b] = known(a, b, iou);
                diou(a, b, Enclosing::Aabb)
            }
            promises []
            jumps Anywhere
            slopes Reverse

            $Ciou = "ciou": (a: $Shape<S>, b: $Shape<S>, iou: S) -> S {
                let [a, b] = known(a, b, iou);
                ciou(a, b, Enclosing::Aabb)
            }
            promises []
            jumps Anywhere
            slopes Reverse
        }
    };
}
scores!(YawBox3, GiouOfYaw, DiouOfYaw, DiouBoxOfYaw, CiouOfYaw);
scores!(Obb3, GiouOfObb, DiouOfObb, DiouBoxOfObb, CiouOfObb);

impl<T: Number> Boxes for YawBox3<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "heading"];
    const SLOPES: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "r"];

    fn slopes(self, by: Self, show: &mut dyn FnMut(T)) {
        let (center, size) = (by.center, by.size);
        let all = [center.x, center.y, center.z, size.x, size.y, size.z];
        all.into_iter().chain([by.heading]).for_each(show);
    }

    fn scores(
        metric: Metric,
        _backend: Backend<'_>,
        pairs: Pairs<'_, Self>,
        grad: bool,
    ) -> Result<Scores<Self>, Error> {
        let iou = || on_cpu(IouYaw, pairs, grad);
        match metric {
            Metric::Iou => iou(),
            Metric::Iof => on_cpu(IofYaw, pairs, grad),
            Metric::Giou => on_scores(GiouOfYaw, pairs, iou()?),
            Metric::Diou => on_scores(DiouOfYaw, pairs, iou()?),
            Metric::DiouBox => on_scores(DiouBoxOfYaw, pairs, iou()?),
            Metric::Ciou => on_scores(CiouOfYaw, pairs, iou()?),
        }
    }
}

impl<T: Number> Boxes for Obb3<T> {
    const COLUMNS: &'static [&'static str] =
        &["x", "y", "z", "dx", "dy", "dz", "qw", "qx", "qy", "qz"];
    const SLOPES: &'static [&'static str] = &["x", "y", "z", "dx", "dy", "dz", "rx", "ry", "rz"];

    fn check(self) -> Result<(), String> {
        let q = self.rotation;
        match [q.w, q.x, q.y, q.z].iter().all(|&x| x == T::zero()) {
            true => Err("qw, qx, qy and qz are all zero, which is no rotation".into()),
            false => Ok(()),
        }
    }

    fn slopes(self, by: Self, show: &mut dyn FnMut(T)) {
        let (center, size) = (by.center, by.size);
        // Slopes are smaller the longer the quaternion is; turning is not.
        let turn = self.rotation.tangent_gradient(by.rotation);
        let all = [center.x, center.y, center.z, size.x, size.y, size.z];
        all.into_iter()
            .chain([turn.x, turn.y, turn.z])
            .for_each(show);
    }

    fn scores(
        metric: Metric,
        _backend: Backend<'_>,
        pairs: Pairs<'_, Self>,
        grad: bool,
    ) -> Result<Scores<Self>, Error> {
        let iou = || on_cpu(IouObb3, pairs, grad);
        match metric {
            Metric::Iou => iou(),
            Metric::Iof => on_cpu(IofObb3, pairs, grad),
            Metric::Giou => on_scores(GiouOfObb, pairs, iou()?),
            Metric::Diou => on_scores(DiouOfObb, pairs, iou()?),
            Metric::DiouBox => on_scores(DiouBoxOfObb, pairs, iou()?),
            Metric::Ciou => on_scores(CiouOfObb, pairs, iou()?),
        }
    }
}

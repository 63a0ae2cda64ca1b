//! Boxes of space.
//!
//! IoU and IoF are the library's operations; the other scores are recorded as what they add to IoU.
use super::plane::giou_in;
use super::{Boxes, Pairs, Scores, on_cpu, on_scores};
use crate::metric::{Enclosing, Metric};
use crate::number::Number;
use common::known::known;
use geograd::ad::program::Plain;
use geograd::iou::hull_area_obb2;
use geograd::iou3::{self, Solid};
use geograd::kernels::{Backend, IofObb3, IofYaw, IouObb3, IouYaw};
use geograd::shape::{Obb3, YawBox3};
use geograd::{Error, Fixed, Program, Scalar, Sym, Vec3};

/// The square of the distance of the centres over that of the two points of both boxes that are farthest
/// from each other; zero where all points are one.
///
/// These are corners. Seen from the middle of `a`, along its axes, the corner of `a` farthest from a
/// point `p` is at `|p| + size/2` from it, number by number: so eight corners of `b` and the boxes' own
/// diagonals tell.
fn apart<S: Scalar>(a: Obb3<S>, b: Obb3<S>) -> S {
    let back = a.rotation.inverse();
    let between = b.center - a.center;
    let moved = Obb3 {
        center: between,
        ..b
    };
    let half = a.size * S::lit(0.5);
    let mut diameter = a.size.length().most(b.size.length());
    for corner in moved.corners() {
        let p = back * corner;
        let reach = Vec3::new(p.x.magnitude(), p.y.magnitude(), p.z.magnitude()) + half;
        diameter = diameter.most(reach.length());
    }
    let point = diameter.at_most(S::zero());
    let share = between.length().over(S::select(point, S::one(), diameter));
    S::select(point, S::zero(), share.squared().least(S::one()))
}

/// GIoU of upright boxes with the convex hull of their grounds times the height of both, from their IoU.
fn giou_in_prism<S: Scalar>(a: YawBox3<S>, b: YawBox3<S>, iou: S) -> S {
    // From the middle of a.
    let up = b.center.z - a.center.z;
    let (half_a, half_b) = (a.size.z.halved(), b.size.z.halved());
    let height = half_a.most(up + half_b) + half_a.most(half_b - up);
    let ground = hull_area_obb2(a.birds_eye(), b.birds_eye());
    giou_in(a.volume(), b.volume(), ground * height, iou)
}

/// What the scores of two boxes add to their IoU.
fn program<T, P, Q>(metric: Metric) -> Result<Program<(P, P, T), T>, Error>
where
    T: Number + Plain,
    P: Boxes<Scalar = T> + Fixed<Of<Sym<T>> = Q>,
    Q: Fixed<Scalar = Sym<T>, Of<T> = P> + Solid<Sym<T>>,
{
    type Known<Q> = (Q, Q, <Q as geograd::Pack>::Scalar);
    let around = match metric {
        Metric::Giou(Enclosing::Rect) => iou3::Enclosing::Rectangle,
        _ => iou3::Enclosing::Aabb,
    };
    match metric {
        Metric::Iou | Metric::Iof => Program::trace(|(_, _, iou): Known<Q>| iou),
        Metric::Giou(_) => Program::trace(|(a, b, iou): Known<Q>| {
            let [a, b] = known(a, b, iou);
            iou3::giou(a, b, around)
        }),
        Metric::Diou => Program::trace(|(a, b, iou): Known<Q>| iou - apart(a.into(), b.into())),
        Metric::DiouBox => Program::trace(|(a, b, iou): Known<Q>| {
            let [a, b] = known(a, b, iou);
            iou3::diou(a, b, around)
        }),
        Metric::Ciou => Program::trace(|(a, b, iou): Known<Q>| {
            let [a, b] = known(a, b, iou);
            iou3::ciou(a, b, around)
        }),
    }
}

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
        type Known<T> = (YawBox3<Sym<T>>, YawBox3<Sym<T>>, Sym<T>);
        let added = match metric {
            Metric::Iou => return on_cpu(IouYaw, pairs, grad),
            Metric::Iof => return on_cpu(IofYaw, pairs, grad),
            Metric::Giou(Enclosing::Hull) => {
                Program::trace(|(a, b, iou): Known<T>| giou_in_prism(a, b, iou))?
            }
            _ => program::<T, Self, YawBox3<Sym<T>>>(metric)?,
        };
        on_scores(&added, pairs, on_cpu(IouYaw, pairs, grad)?)
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
        let all = all.into_iter().chain([turn.x, turn.y, turn.z]);
        all.for_each(show);
    }

    fn scores(
        metric: Metric,
        _backend: Backend<'_>,
        pairs: Pairs<'_, Self>,
        grad: bool,
    ) -> Result<Scores<Self>, Error> {
        match metric {
            Metric::Iou => on_cpu(IouObb3, pairs, grad),
            Metric::Iof => on_cpu(IofObb3, pairs, grad),
            _ => {
                let added = program::<T, Self, Obb3<Sym<T>>>(metric)?;
                on_scores(&added, pairs, on_cpu(IouObb3, pairs, grad)?)
            }
        }
    }
}

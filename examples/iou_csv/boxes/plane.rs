//! Rotated boxes of the plane.
use super::{Boxes, Pairs, Scores, on_cpu, on_scores};
use crate::metric::{Enclosing, Metric};
use crate::number::Number;
use geograd::iou3::smallest_rectangle;
use geograd::kernels::{Backend, Ciou, CiouAabb, Diou, DiouAabb, Eiou, EiouAabb, Giou, GiouAabb};
use geograd::{Error, Obb2, Program, Scalar, Sym};

/// GIoU with the rectangle of least area around both, from their IoU.
fn giou_in_rectangle<S: Scalar>(a: Obb2<S>, b: Obb2<S>, iou: S) -> S {
    let around = smallest_rectangle(a, b);
    giou_in(
        a.size.x * a.size.y,
        b.size.x * b.size.y,
        around.x * around.y,
        iou,
    )
}

/// GIoU from the sizes of two boxes and of what is around them, and their IoU.
fn giou_in<S: Scalar>(a: S, b: S, around: S, iou: S) -> S {
    let point = around.at_most(S::zero());
    let union = (a + b).over(S::one() + iou);
    let covered = union.over(S::select(point, S::one(), around));
    // Rounding can leave what is around both a little smaller than both.
    S::select(point, iou, iou - (S::one() - covered).most(S::zero()))
}

impl<T: Number> Boxes for Obb2<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "w", "h", "r"];
    const DERIVATIVE: &'static [&'static str] = Self::COLUMNS;

    fn derivatives(self, by: Self, show: &mut dyn FnMut(T)) {
        let all = [by.center.x, by.center.y, by.size.x, by.size.y, by.heading];
        all.into_iter().for_each(show);
    }

    fn scores(
        metric: Metric,
        backend: Backend<'_>,
        pairs: Pairs<'_, Self>,
        grad: bool,
    ) -> Result<Scores<Self>, Error> {
        match metric {
            Metric::Iou => T::iou(backend, pairs, grad),
            Metric::Iof => T::iof(backend, pairs, grad),
            Metric::Giou(Enclosing::Hull) => on_cpu(Giou, pairs, grad),
            Metric::Giou(Enclosing::Aabb) => on_cpu(GiouAabb, pairs, grad),
            Metric::Giou(Enclosing::Rect) => {
                let ious = T::iou(Backend::Cpu, pairs, grad)?;
                type Known<T> = (Obb2<Sym<T>>, Obb2<Sym<T>>, Sym<T>);
                let giou = |(a, b, iou): Known<T>| giou_in_rectangle(a, b, iou);
                on_scores(&Program::trace(giou)?, pairs, ious)
            }
            // The command line has no rectangle for these.
            Metric::Diou(Enclosing::Hull | Enclosing::Rect) => on_cpu(Diou, pairs, grad),
            Metric::Diou(Enclosing::Aabb) | Metric::DiouBox => on_cpu(DiouAabb, pairs, grad),
            Metric::Ciou(Enclosing::Hull | Enclosing::Rect) => on_cpu(Ciou, pairs, grad),
            Metric::Ciou(Enclosing::Aabb) => on_cpu(CiouAabb, pairs, grad),
            Metric::Eiou(Enclosing::Hull | Enclosing::Rect) => on_cpu(Eiou, pairs, grad),
            Metric::Eiou(Enclosing::Aabb) => on_cpu(EiouAabb, pairs, grad),
        }
    }
}

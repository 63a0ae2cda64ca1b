//! Rotated boxes of the plane.
use super::{Boxes, Pairs, Scores, of_row, on_scores, row};
use crate::metric::{Enclosing, Metric};
use crate::number::Number;
use common::cli::{Failure, Machine};
use geograd::iou3::smallest_rectangle;
use geograd::{Obb2, Program, Scalar, Sym};

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
        machine: &Machine,
        pairs: &Pairs<'_, T>,
        grad: bool,
    ) -> Result<Scores<Self>, Failure> {
        let row = match metric {
            Metric::Iou => row!(Iou, Obb2),
            Metric::Iof => row!(Iof, Obb2),
            Metric::Giou(Enclosing::Hull) => row!(Giou, Obb2),
            Metric::Giou(Enclosing::Aabb) => row!(GiouAabb, Obb2),
            Metric::Giou(Enclosing::Rect) => {
                let ious = of_row(&row!(Iou, Obb2), machine, pairs, grad)?;
                type Known<T> = (Obb2<Sym<T>>, Obb2<Sym<T>>, Sym<T>);
                let giou = |(a, b, iou): Known<T>| giou_in_rectangle(a, b, iou);
                return on_scores(&Program::trace(giou)?, pairs, ious);
            }
            // The command line has no rectangle for these.
            Metric::Diou(Enclosing::Hull | Enclosing::Rect) => row!(Diou, Obb2),
            Metric::Diou(Enclosing::Aabb) | Metric::DiouBox => row!(DiouAabb, Obb2),
            Metric::Ciou(Enclosing::Hull | Enclosing::Rect) => row!(Ciou, Obb2),
            Metric::Ciou(Enclosing::Aabb) => row!(CiouAabb, Obb2),
            Metric::Eiou(Enclosing::Hull | Enclosing::Rect) => row!(Eiou, Obb2),
            Metric::Eiou(Enclosing::Aabb) => row!(EiouAabb, Obb2),
        };
        of_row(&row, machine, pairs, grad)
    }
}

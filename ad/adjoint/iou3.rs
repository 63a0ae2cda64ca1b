//! Adjoints of the IoU family of boxes of any orientation.
//!
//! Such a score is a formula of the boxes' IoU and of their numbers. The IoU has derivatives by hand, which keep their
//! digits where edges are parallel to faces and cost twice its value; the formula is short and is differentiated
//! forwards.
use super::overlap3::iou_obb3_vjp;
use crate::iou3::{Enclosing, Score, score_with_iou};
use crate::shape::Obb3;
use crate::{Fixed, Jet, Scalar};

/// Numbers of a box.
const OBB3: usize = 10;
/// The number of variables: the IoU, then the numbers of both boxes.
const ALL: usize = 1 + 2 * OBB3;

/// Returns the derivatives of a score by the IoU and by the numbers of both boxes. It is not inlined: there is one
/// function for each kind of number, for all scores.
#[inline(never)]
fn derivatives_of<S: Scalar>(
    (score, kind): (Score, Enclosing),
    iou: S,
    a: Obb3<S>,
    b: Obb3<S>,
) -> Jet<S, ALL> {
    let mut numbers = [S::zero(); 2 * OBB3];
    (a, b).store(&mut numbers);
    let mut moving = [Jet::variable(iou, 0); 2 * OBB3];
    for (k, &x) in numbers.iter().enumerate() {
        moving[k] = Jet::variable(x, 1 + k);
    }
    let (a, b) = Fixed::load(&moving);
    score_with_iou(score, kind, Jet::variable(iou, 0), a, b)
}

/// Returns a score of two boxes and `out_bar` times its derivatives by both; those by a rotation are by its quaternion.
pub(crate) fn score_obb3_vjp<S: Scalar>(
    score: (Score, Enclosing),
    a: Obb3<S>,
    b: Obb3<S>,
    out_bar: S,
) -> (S, (Obb3<S>, Obb3<S>)) {
    // The derivatives by the IoU are known before the derivatives of it.
    let iou = crate::overlap3::iou_obb3(a, b);
    let found = derivatives_of(score, iou, a, b);
    let (_, bars) = iou_obb3_vjp(a, b, found.derivative[0] * out_bar);
    let mut numbers = [S::zero(); 2 * OBB3];
    bars.store(&mut numbers);
    for (k, x) in numbers.iter_mut().enumerate() {
        *x = (*x + found.derivative[1 + k] * out_bar).canonical();
    }
    (found.value.canonical(), Fixed::load(&numbers))
}

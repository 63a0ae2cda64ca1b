//! Boxes of space.
//!
//! IoU and IoF are the library's operations; the other scores are recorded as what they add to IoU.
use super::{Boxes, Pairs, Scores, of_row, on_scores, row};
use crate::metric::{Enclosing, Metric};
use crate::number::Number;
use common::cli::{Failure, Machine};
use common::known::known;
use geograd::ad::program::Plain;
use geograd::iou3::{self, Solid};
use geograd::{Error, Fixed, Obb3, Program, Sym, YawBox3};

/// The recorded score of two boxes, with their IoU as an argument.
fn program<T, P, Q>(metric: Metric) -> Result<Program<(P, P, T), T>, Error>
where
    T: Number + Plain,
    P: Boxes<Scalar = T> + Fixed<Of<Sym<T>> = Q>,
    Q: Fixed<Scalar = Sym<T>, Of<T> = P> + Solid<Sym<T>>,
{
    type Known<Q> = (Q, Q, <Q as geograd::Pack>::Scalar);
    let around = |around: Enclosing| match around {
        Enclosing::Aabb => iou3::Enclosing::Aabb,
        Enclosing::Rect => iou3::Enclosing::Rectangle,
        Enclosing::Hull => iou3::Enclosing::Hull,
    };
    let pair = |(a, b, iou): Known<Q>| known(a, b, iou);
    match metric {
        Metric::Iou | Metric::Iof => Program::trace(|(_, _, iou): Known<Q>| iou),
        Metric::Giou(kind) => Program::trace(|x: Known<Q>| {
            let [a, b] = pair(x);
            iou3::giou(a, b, around(kind))
        }),
        Metric::Diou(kind) => Program::trace(|x: Known<Q>| {
            let [a, b] = pair(x);
            iou3::diou(a, b, around(kind))
        }),
        Metric::DiouBox => Program::trace(|x: Known<Q>| {
            let [a, b] = pair(x);
            iou3::diou(a, b, iou3::Enclosing::Aabb)
        }),
        Metric::Ciou(kind) => Program::trace(|x: Known<Q>| {
            let [a, b] = pair(x);
            iou3::ciou(a, b, around(kind))
        }),
        Metric::Eiou(kind) => Program::trace(|x: Known<Q>| {
            let [a, b] = pair(x);
            iou3::eiou(a, b, around(kind))
        }),
    }
}

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
        let of = |row| of_row(&row, machine, pairs, grad);
        match metric {
            Metric::Iou => of(row!(Iou, YawBox3)),
            Metric::Iof => of(row!(Iof, YawBox3)),
            _ => {
                let added = program::<T, Self, YawBox3<Sym<T>>>(metric)?;
                on_scores(&added, pairs, of(row!(Iou, YawBox3))?)
            }
        }
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
        let of = |row| of_row(&row, machine, pairs, grad);
        match metric {
            Metric::Iou => of(row!(Iou, Obb3)),
            Metric::Iof => of(row!(Iof, Obb3)),
            _ => {
                let added = program::<T, Self, Obb3<Sym<T>>>(metric)?;
                on_scores(&added, pairs, of(row!(Iou, Obb3))?)
            }
        }
    }
}

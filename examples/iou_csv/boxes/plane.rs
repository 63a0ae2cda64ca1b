//! Rotated boxes of the plane.
use super::{Boxes, Pairs, Scores, on_cpu};
use crate::metric::Metric;
use crate::number::Number;
use geograd::kernels::{Backend, CiouObb2, DiouBoxObb2, DiouObb2, GiouObb2};
use geograd::{Error, Obb2};

impl<T: Number> Boxes for Obb2<T> {
    const COLUMNS: &'static [&'static str] = &["x", "y", "w", "h", "r"];
    const SLOPES: &'static [&'static str] = Self::COLUMNS;

    fn slopes(self, by: Self, show: &mut dyn FnMut(T)) {
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
            Metric::Giou => on_cpu(GiouObb2, pairs, grad),
            Metric::Diou => on_cpu(DiouObb2, pairs, grad),
            Metric::DiouBox => on_cpu(DiouBoxObb2, pairs, grad),
            Metric::Ciou => on_cpu(CiouObb2, pairs, grad),
        }
    }
}

//! Barycentric coordinates of places in triangles, for linear interpolation.
use super::Delaunay;
use crate::distance::edge::scale_of;
use crate::{Scalar, Vec2};

/// A place in a triangle of a triangulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrianglePlace<S> {
    /// The number of the triangle.
    pub triangle: u32,
    /// The shares of its corners in the place, from 0 to 1, which add up to 1: the place's barycentric coordinates.
    pub weights: [S; 3],
}

/// Returns twice the areas of the triangles of each side and a place, none below zero, the sides turned inward, and the power of
/// two by which all lengths were multiplied.
fn parts<S: Scalar<Mask = bool>>(corners: [Vec2<S>; 3], at: Vec2<S>) -> ([S; 3], [Vec2<S>; 3], S) {
    let arms = corners.map(|corner| corner - at);
    let sizes = arms.map(|arm| arm.x.unsigned().most(arm.y.unsigned()).primal());
    // Products neither over- nor underflow.
    let scale = scale_of::<S>(sizes[0].most(sizes[1]).most(sizes[2]));
    let [a, b, c] = arms.map(|arm| arm * scale);
    let whole = |area: S| {
        let value = area.primal();
        area.with_primal(value.most(S::Primal::zero()).primal())
    };
    let areas = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)].map(whole);
    (areas, [c - b, a - c, b - a].map(Vec2::perp), scale)
}

impl Delaunay {
    /// Returns for every place its triangle, that of [`locate`](Self::locate), and its barycentric coordinates there; `None`
    /// outside of all triangles, and for places that are not finite. `points` are those of the triangulation.
    ///
    /// The mean of numbers at the corners by these weights is their linear interpolation. Kinks: it is continuous across edges,
    /// where its derivatives are those of the lower triangle. At the edge of the hull it ends.
    ///
    /// ```
    /// use geograd::{Vec2, delaunay::Delaunay};
    /// let points = [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)].map(|(x, y)| Vec2::new(x, y));
    /// let mesh = Delaunay::search(&points)?;
    /// let found = mesh.barycentric(&points, &[Vec2::new(1.0, 2.0)])[0].expect("it is inside");
    /// let corners = mesh.triangles()[found.triangle as usize];
    /// let heights = [10.0, 20.0, 30.0];
    /// let mean: f64 = corners.iter().zip(found.weights).map(|(&k, part)| heights[k as usize] * part).sum();
    /// assert_eq!(mean, 22.5);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// When a triangle has a point beyond the last one.
    #[must_use]
    pub fn barycentric<S: Scalar<Mask = bool>>(
        &self,
        points: &[Vec2<S>],
        places: &[Vec2<S>],
    ) -> Vec<Option<TrianglePlace<S>>> {
        let found = self.locate(points, places);
        let of = |(triangle, &at): (Option<u32>, &Vec2<S>)| {
            let triangle = triangle?;
            let corners = self.triangles()[triangle as usize].map(|k| points[k as usize]);
            let (areas, ..) = parts(corners, at);
            let whole = areas[0] + areas[1] + areas[2];
            // A triangle may be flatter than its roundings.
            let weights = match whole.above(S::zero()) {
                true => areas.map(|area| area.over(whole).canonical()),
                false => [S::lit(1.0 / 3.0); 3],
            };
            Some(TrianglePlace { triangle, weights })
        };
        found.into_iter().zip(places).map(of).collect()
    }
    /// Returns the adjoint of [`barycentric`](Self::barycentric): cotangents of the points and of the places from those of the
    /// weights. `found` is its result; places outside have none.
    ///
    /// A place that moves by `dp` changes the weight of a corner by `dp` times a slope, the side opposite the corner, turned
    /// inward, over twice the area. A corner with the weight `w` that moves by `dp` does as a place that moves by `−w dp`.
    ///
    /// # Panics
    ///
    /// When a triangle has a point beyond the last one.
    #[must_use]
    pub fn barycentric_vjp<S: Scalar<Mask = bool>>(
        &self,
        points: &[Vec2<S>],
        places: &[Vec2<S>],
        found: &[Option<TrianglePlace<S>>],
        upstream: &[[S; 3]],
    ) -> [Vec<Vec2<S>>; 2] {
        let mut by_points = vec![Vec2::zero(); points.len()];
        let mut by_places = vec![Vec2::zero(); places.len()];
        for (i, (own, bars)) in found.iter().zip(upstream).enumerate() {
            let Some(own) = own else { continue };
            let numbers = self.triangles()[own.triangle as usize];
            let (areas, sides, scale) = parts(numbers.map(|k| points[k as usize]), places[i]);
            let whole = areas[0] + areas[1] + areas[2];
            if !whole.above(S::zero()) {
                continue;
            }
            let sum = (0..3).fold(Vec2::zero(), |sum, k| sum + sides[k] * bars[k]);
            let by_place = sum * scale.over(whole);
            by_places[i] = by_place;
            for (&k, weight) in numbers.iter().zip(own.weights) {
                by_points[k as usize] -= by_place * weight;
            }
        }
        [by_points, by_places]
    }
}

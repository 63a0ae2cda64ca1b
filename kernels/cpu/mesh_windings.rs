//! Winding numbers of one mesh around many points, with derivatives for the points and for the border's vertices.
//!
//! Cotangents of vertices are added edge by edge, each over the points in their order, in double precision, so that bits
//! are equal for any number of threads.
use crate::error::{Argument, Error};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::mesh_batches::{MeshBars, check, each, rounded};
use crate::kernels::row::item::counts::expect;
use crate::mesh::{BorderEdge, WoundSurface, edge_slopes, plain};
use crate::{Real, Vec3};
use std::f64::consts::PI;

impl Cpu {
    /// Returns the winding number of a mesh around each point, each with the bits of
    /// [`WoundSurface::winding_number`].
    ///
    /// ```
    /// use geograd::Vec3;
    /// use geograd::kernels::Cpu;
    /// use geograd::mesh::{Mesh, MeshBorder, MeshTree};
    /// let vertices = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
    /// let mesh = Mesh::new(&vertices, &[[0, 1, 2]])?;
    /// let (tree, border) = (MeshTree::new(&mesh), MeshBorder::new(&mesh));
    /// let wound = border.of(&tree.on(&mesh)?)?;
    /// // Close to a face, from both sides: half of all directions.
    /// let points = [-1e-9, 1e-9].map(|z| Vec3::new(0.5, 0.5, z));
    /// let found = Cpu::new().winding_numbers(&wound, &points)?;
    /// assert!((found[0] - 0.5_f64).abs() < 1e-8 && (found[1] + 0.5).abs() < 1e-8);
    /// // The derivative is that of the border: the same on both sides.
    /// let bars = Cpu::new().winding_numbers_vjp(&wound, &points, &[1.0, 1.0])?;
    /// assert!((bars.queries[0].z - bars.queries[1].z).abs() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a point that is not finite, [`Error::TooLarge`] for more than 2³² points, [`Error::Simd`].
    pub fn winding_numbers<T: Real>(
        &self,
        wound: &WoundSurface<'_, T>,
        points: &[Vec3<T>],
    ) -> Result<Vec<T>, Error> {
        check("points", points)?;
        Ok(each(points.len(), T::zero(), |i| {
            T::nearest(wound.plain_winding_number(plain(points[i])))
        }))
    }

    /// Returns the cotangents of points and vertices from those of [`winding_numbers`](Cpu::winding_numbers): zero for a
    /// closed mesh, and for vertices that are not on the border.
    ///
    /// # Errors
    ///
    /// As [`winding_numbers`](Cpu::winding_numbers), and [`Error::Length`] unless there is one cotangent per point,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn winding_numbers_vjp<T: Real>(
        &self,
        wound: &WoundSurface<'_, T>,
        points: &[Vec3<T>],
        upstream: &[T],
    ) -> Result<MeshBars<Vec3<T>, T>, Error> {
        check("points", points)?;
        expect(Argument::Upstream, points.len(), upstream.len())?;
        check_upstream(upstream, 1)?;
        let (vertices, edges) = (wound.surface().mesh().vertices(), wound.border().edges());
        let slopes = |edge: &BorderEdge, i: usize| {
            let point = plain(points[i]);
            let [start, end] = [edge.from, edge.to].map(|k| plain(vertices[k as usize]) - point);
            let bar = upstream[i].widen() * f64::from(edge.times) / (4.0 * PI);
            edge_slopes(start, end).map(|slope| slope * bar)
        };
        let queries = each(points.len(), Vec3::zero(), |i| {
            let mut sum = Vec3::zero();
            for edge in edges {
                let [by_start, by_end] = slopes(edge, i);
                sum -= by_start + by_end;
            }
            rounded(sum)
        });
        let ends = each(edges.len(), [Vec3::zero(); 2], |k| {
            let mut sums = [Vec3::zero(); 2];
            for i in 0..points.len() {
                let [by_start, by_end] = slopes(&edges[k], i);
                sums[0] += by_start;
                sums[1] += by_end;
            }
            sums
        });
        let mut sums = vec![Vec3::zero(); vertices.len()];
        for (edge, [by_start, by_end]) in edges.iter().zip(ends) {
            sums[edge.from as usize] += by_start;
            sums[edge.to as usize] += by_end;
        }
        Ok(MeshBars {
            queries,
            vertices: sums.into_iter().map(rounded).collect(),
        })
    }
}

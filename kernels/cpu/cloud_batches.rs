//! Queries of many points in one cloud, and distances of two clouds, with derivatives for all points.
//!
//! Cotangents are added in the order of the queries, in double precision, so that bits are equal for any number of threads.
//! Each query has the bits of the [`Cloud`]'s function for one.
//!
//! ```
//! use geograd::Vec3;
//! use geograd::cloud::CloudTree;
//! use geograd::kernels::Cpu;
//! use geograd::kernels::cpu::cloud_batches::PointDistance;
//! let first = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let second = [(0.0, 0.0, 2.0), (1.0, 0.0, 1.0)].map(|(x, y, z)| Vec3::new(x, y, z));
//! let trees = (CloudTree::new(&first)?, CloudTree::new(&second)?);
//! let (a, b) = (trees.0.on(&first)?, trees.1.on(&second)?);
//! let cpu = Cpu::new();
//! // Squares are 2 and 1 from the first cloud, 4 and 1 from the second one.
//! assert_eq!(cpu.chamfer(PointDistance::Squared, &a, &b)?, 4.0);
//! let farthest = cpu.hausdorff(&a, &b)?;
//! assert_eq!((farthest.distance, farthest.from_second, farthest.point, farthest.nearest), (2.0, true, 0, 0));
//! assert_eq!(cpu.f_score(&a, &b, 1.0)?, 0.5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
use crate::cloud::Cloud;
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::checked::check_upstream;
use crate::kernels::cpu::mesh_batches::{check, each, rounded};
use crate::kernels::row::item::counts::expect;
use crate::mesh::plain;
use crate::{Real, Vec3};

/// A distance of a point from another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointDistance {
    /// The distance, at least 0. Kink: zero, with derivative zero.
    Plain,
    /// Its square.
    Squared,
}

impl PointDistance {
    fn value<T: Real>(self, from: Vec3<T>, to: Vec3<T>) -> T {
        match self {
            PointDistance::Plain => (from - to).length(),
            PointDistance::Squared => (from - to).length_squared(),
        }
    }
    /// Returns the derivative by the first point; by the second one it is the opposite.
    fn slope(self, from: Vec3<f64>, to: Vec3<f64>) -> Vec3<f64> {
        match self {
            PointDistance::Plain => (from - to).normalize_or_zero(),
            PointDistance::Squared => (from - to) * 2.0,
        }
    }
}

/// Cotangents of queries and of the points of a cloud.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudBars<T> {
    /// One per query.
    pub queries: Vec<Vec3<T>>,
    /// One per point.
    pub points: Vec<Vec3<T>>,
}

/// The point of two clouds that is farthest from the other one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarthestPair<T> {
    /// Its distance: the Hausdorff distance of the clouds.
    pub distance: T,
    /// `true` for a point of the second cloud.
    pub from_second: bool,
    /// The point, of equally far ones the lowest, of the first cloud before the second one.
    pub point: u32,
    /// The nearest point of the other cloud.
    pub nearest: u32,
}

impl Cpu {
    /// Returns the point of a cloud that is nearest to each query, among equal ones the lowest.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a query that is not finite, [`Error::TooLarge`] for more than 2³² queries, [`Error::Simd`].
    pub fn nearest_points<T: Real>(
        &self,
        cloud: &Cloud<'_, T>,
        queries: &[Vec3<T>],
    ) -> Result<Vec<u32>, Error> {
        check("queries", queries)?;
        Ok(each(queries.len(), 0, |i| cloud.nearest(queries[i])))
    }

    /// Returns so many points that are nearest to each query, in the order of their distances: see
    /// [`Cloud::nearest_some`].
    ///
    /// # Errors
    ///
    /// As [`nearest_points`](Cpu::nearest_points).
    pub fn nearest_some_points<T: Real>(
        &self,
        cloud: &Cloud<'_, T>,
        queries: &[Vec3<T>],
        count: usize,
    ) -> Result<Vec<Vec<u32>>, Error> {
        check("queries", queries)?;
        Ok(each(queries.len(), Vec::new(), |i| {
            cloud.nearest_some(queries[i], count)
        }))
    }

    /// Returns the points within a radius of each query, in their order: see [`Cloud::within`].
    ///
    /// # Errors
    ///
    /// As [`nearest_points`](Cpu::nearest_points).
    pub fn points_within<T: Real>(
        &self,
        cloud: &Cloud<'_, T>,
        queries: &[Vec3<T>],
        radius: T,
    ) -> Result<Vec<Vec<u32>>, Error> {
        check("queries", queries)?;
        Ok(each(queries.len(), Vec::new(), |i| {
            cloud.within(queries[i], radius)
        }))
    }

    /// Returns the distance of each query from a point of the cloud, such as the nearest one that a search gave.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a query that is not finite and for a point that the cloud does not have, [`Error::Length`]
    /// unless there is one point per query.
    pub fn point_distances<T: Real>(
        &self,
        kind: PointDistance,
        cloud: &Cloud<'_, T>,
        queries: &[Vec3<T>],
        found: &[u32],
    ) -> Result<Vec<T>, Error> {
        check_found(cloud, queries, found)?;
        Ok(each(queries.len(), T::zero(), |i| {
            kind.value(queries[i], cloud.points()[found[i] as usize])
        }))
    }

    /// Returns the cotangents of queries and points from those of [`point_distances`](Cpu::point_distances).
    ///
    /// # Errors
    ///
    /// As [`point_distances`](Cpu::point_distances), and [`Error::Length`] unless there is one cotangent per query,
    /// [`Error::Invalid`] for one that is not finite.
    pub fn point_distances_vjp<T: Real>(
        &self,
        kind: PointDistance,
        cloud: &Cloud<'_, T>,
        queries: &[Vec3<T>],
        found: &[u32],
        upstream: &[T],
    ) -> Result<CloudBars<T>, Error> {
        check_found(cloud, queries, found)?;
        expect(Argument::Upstream, queries.len(), upstream.len())?;
        check_upstream(upstream, 1)?;
        let bars = each(queries.len(), Vec3::zero(), |i| {
            let to = plain(cloud.points()[found[i] as usize]);
            kind.slope(plain(queries[i]), to) * upstream[i].widen()
        });
        let mut points = vec![Vec3::zero(); cloud.points().len()];
        for (&bar, &k) in bars.iter().zip(found) {
            points[k as usize] -= bar;
        }
        Ok(CloudBars {
            queries: bars.into_iter().map(rounded).collect(),
            points: points.into_iter().map(rounded).collect(),
        })
    }

    /// Returns the Chamfer distance of two clouds, at least 0: the mean over the first one of the distances from the second
    /// one, plus the mean over the second one. Kinks are those of nearest points.
    ///
    /// # Errors
    ///
    /// [`Error::Simd`].
    pub fn chamfer<T: Real>(
        &self,
        kind: PointDistance,
        first: &Cloud<'_, T>,
        second: &Cloud<'_, T>,
    ) -> Result<T, Error> {
        let half = |from: &Cloud<'_, T>, to: &Cloud<'_, T>| -> Result<f64, Error> {
            let found = self.nearest_points(to, from.points())?;
            let all = each(found.len(), 0.0, |i| {
                let (p, q) = (from.points()[i], to.points()[found[i] as usize]);
                kind.value(plain(p), plain(q))
            });
            Ok(all.iter().sum::<f64>() / all.len() as f64)
        };
        Ok(T::nearest(half(first, second)? + half(second, first)?))
    }

    /// Returns the cotangents of the points of both clouds from that of their [Chamfer distance](Cpu::chamfer).
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a cotangent that is not finite, [`Error::Simd`].
    pub fn chamfer_vjp<T: Real>(
        &self,
        kind: PointDistance,
        [first, second]: [&Cloud<'_, T>; 2],
        upstream: T,
    ) -> Result<[Vec<Vec3<T>>; 2], Error> {
        check_upstream(&[upstream], 1)?;
        let clouds = [first, second];
        let mut sums = clouds.map(|cloud| vec![Vec3::zero(); cloud.points().len()]);
        for (own, other) in [(0, 1), (1, 0)] {
            let (from, to) = (clouds[own], clouds[other]);
            let found = self.nearest_points(to, from.points())?;
            let bar = upstream.widen() / found.len() as f64;
            let bars = each(found.len(), Vec3::zero(), |i| {
                let (p, q) = (from.points()[i], to.points()[found[i] as usize]);
                kind.slope(plain(p), plain(q)) * bar
            });
            for (i, (&bar, &k)) in bars.iter().zip(&found).enumerate() {
                sums[own][i] += bar;
                sums[other][k as usize] -= bar;
            }
        }
        Ok(sums.map(|sums| sums.into_iter().map(rounded).collect()))
    }

    /// Returns the point of two clouds that is farthest from the other cloud; its distance is the Hausdorff distance.
    ///
    /// The derivative of that is the unit vector from the nearest point to this one, by this point, and the opposite by the
    /// nearest one. Kinks: two equally far points, where it is that of the first one; distance zero, where it is zero.
    ///
    /// # Errors
    ///
    /// [`Error::Simd`].
    pub fn hausdorff<T: Real>(
        &self,
        first: &Cloud<'_, T>,
        second: &Cloud<'_, T>,
    ) -> Result<FarthestPair<T>, Error> {
        let mut best = (-1.0, false, 0, 0);
        for (from, to, from_second) in [(first, second, false), (second, first, true)] {
            let found = self.nearest_points(to, from.points())?;
            for (i, &k) in found.iter().enumerate() {
                let (p, q) = (plain(from.points()[i]), plain(to.points()[k as usize]));
                let square = (p - q).length_squared();
                if square > best.0 {
                    best = (square, from_second, i as u32, k);
                }
            }
        }
        let (_, from_second, point, nearest) = best;
        let (from, to) = match from_second {
            true => (second, first),
            false => (first, second),
        };
        let apart = from.points()[point as usize] - to.points()[nearest as usize];
        Ok(FarthestPair {
            distance: apart.length(),
            from_second,
            point,
            nearest,
        })
    }

    /// Returns the F-score of two clouds at a threshold, from 0 to 1: the harmonic mean of the share of the first cloud that
    /// is as near to the second one, and of the share of the second one; 0 if both are. Its derivative is zero.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a threshold below zero or not finite, [`Error::Simd`].
    pub fn f_score<T: Real>(
        &self,
        first: &Cloud<'_, T>,
        second: &Cloud<'_, T>,
        threshold: T,
    ) -> Result<T, Error> {
        let most = threshold.widen();
        if !(0.0..f64::INFINITY).contains(&most) {
            return Err(Error::Invalid {
                argument: Argument::Named("threshold"),
                item: 0,
                flaw: Flaw::Broken(Field::VALUE, "is negative or not finite"),
            });
        }
        let share = |from: &Cloud<'_, T>, to: &Cloud<'_, T>| -> Result<f64, Error> {
            let found = self.nearest_points(to, from.points())?;
            let near = found.iter().zip(from.points()).filter(|&(&k, &p)| {
                let apart = plain(p) - plain(to.points()[k as usize]);
                apart.length_squared() <= most * most
            });
            Ok(near.count() as f64 / found.len() as f64)
        };
        let (p, q) = (share(first, second)?, share(second, first)?);
        let score = if p + q > 0.0 {
            2.0 * p * q / (p + q)
        } else {
            0.0
        };
        Ok(T::nearest(score))
    }
}

fn check_found<T: Real>(
    cloud: &Cloud<'_, T>,
    queries: &[Vec3<T>],
    found: &[u32],
) -> Result<(), Error> {
    check("queries", queries)?;
    expect(Argument::Named("found"), queries.len(), found.len())?;
    let count = cloud.points().len();
    match found.iter().position(|&k| k as usize >= count) {
        Some(item) => Err(Error::Invalid {
            argument: Argument::Named("found"),
            item,
            flaw: Flaw::Broken(Field::VALUE, "is not a point of the cloud"),
        }),
        None => Ok(()),
    }
}

//! The triangles of a set of points, their neighbours and measures.
use super::divide_and_conquer::{divide, triangulated};
use super::half_edges::{HalfEdges, back};
use crate::error::{Argument, Error, Field, Flaw};
use crate::shape::circumcircle;
use crate::{Circle, Scalar, Vec2};
use robust::Coord;

/// The most points: edges have numbers of 32 bits, six for each point.
const MOST: usize = (u32::MAX / 6) as usize;

/// The Delaunay triangulation of points of the plane: the record of a search, without coordinates.
///
/// Points are named by their numbers from zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Delaunay {
    triangles: Vec<[u32; 3]>,
    neighbours: Vec<[Option<u32>; 3]>,
    hull: Vec<u32>,
    firsts: Vec<u32>,
}

impl Delaunay {
    /// Returns the triangulation of points, in time `n log n`.
    ///
    /// # Errors
    ///
    /// [`Error::Invalid`] for a point that is not finite; [`Error::TooLarge`] for more than 715,827,882 points.
    pub fn search<S: Scalar<Mask = bool>>(points: &[Vec2<S>]) -> Result<Self, Error> {
        if points.len() > MOST {
            return Err(Error::TooLarge);
        }
        let mut places = Vec::with_capacity(points.len());
        for (number, point) in points.iter().enumerate() {
            let wide = |x: S| x.widened().unwrap_or(f64::NAN);
            let (x, y) = (wide(point.x), wide(point.y));
            for (value, name) in [(x, "x"), (y, "y")] {
                if !value.is_finite() {
                    return Err(Error::Invalid {
                        argument: Argument::Named("points"),
                        item: number,
                        flaw: Flaw::NotFinite(Field::new(name)),
                    });
                }
            }
            // Both zeros are one place.
            places.push((x + 0.0, y + 0.0, number as u32));
        }
        Ok(Self::of_places(places))
    }
    /// Returns the triangulation of finite places with their numbers, from zero.
    fn of_places(mut sorted: Vec<(f64, f64, u32)>) -> Self {
        sorted.sort_unstable_by(|a, b| {
            let by_place = a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
            by_place.then(a.2.cmp(&b.2))
        });
        let mut firsts = vec![0; sorted.len()];
        for k in 0..sorted.len() {
            let (x, y, number) = sorted[k];
            let is_repeated = k > 0 && (sorted[k - 1].0, sorted[k - 1].1) == (x, y);
            firsts[number as usize] = match is_repeated {
                true => firsts[sorted[k - 1].2 as usize],
                false => number,
            };
        }
        sorted.dedup_by(|b, a| (a.0, a.1) == (b.0, b.1));
        // A power of two leaves all digits, and no product leaves the format.
        let largest = sorted
            .iter()
            .fold(0.0_f64, |most, p| most.max(p.0.abs()).max(p.1.abs()));
        let unit = if largest > 0.0 { largest.binade() } else { 1.0 };
        let in_order: Vec<u32> = sorted.iter().map(|p| p.2).collect();
        let mut parts: Vec<(Coord<f64>, u32)> = sorted
            .into_iter()
            .map(|(x, y, number)| {
                let place = Coord {
                    x: x * unit,
                    y: y * unit,
                };
                (place, number)
            })
            .collect();
        divide(&mut parts);
        let (places, numbers): (Vec<_>, Vec<_>) = parts.into_iter().unzip();
        let (edges, border) = triangulated(&places);
        drop(places);
        let mut made = Delaunay {
            triangles: Vec::new(),
            neighbours: Vec::new(),
            hull: Vec::new(),
            firsts,
        };
        if let Some(border) = border {
            made.read(&edges, border, &numbers);
        }
        if made.triangles.is_empty() {
            made.hull = in_order;
        }
        made
    }
    /// Reads hull and triangles from the edges.
    fn read(&mut self, edges: &HalfEdges, outer: u32, numbers: &[u32]) {
        const OUTSIDE: u32 = u32::MAX;
        const UNSEEN: u32 = u32::MAX - 1;
        let mut faces = vec![UNSEEN; edges.len()];
        let mut e = outer;
        loop {
            faces[e as usize] = OUTSIDE;
            self.hull.push(numbers[edges.to(e) as usize]);
            e = edges.after(e);
            if e == outer {
                break;
            }
        }
        // It was seen clockwise; from the lowest number on.
        self.hull.reverse();
        let count = edges.len() as u32;
        for first in (0..count).filter(|&e| edges.is_present(e)) {
            if faces[first as usize] != UNSEEN {
                continue;
            }
            let second = edges.after(first);
            let around = [first, second, edges.after(second)];
            let number = self.triangles.len() as u32;
            for e in around {
                faces[e as usize] = number;
            }
            self.triangles
                .push(around.map(|e| numbers[edges.from(e) as usize]));
            // Each side is opposite the corner that it leaves out; for now its edge back.
            self.neighbours
                .push([around[1], around[2], around[0]].map(|e| Some(back(e))));
        }
        for side in self.neighbours.iter_mut().flatten() {
            *side = side.map(|e| faces[e as usize]).filter(|&f| f != OUTSIDE);
        }
        let lowest = (0..self.hull.len()).min_by_key(|&k| self.hull[k]);
        self.hull.rotate_left(lowest.unwrap_or(0));
    }
    /// Returns the corners of every triangle, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
    /// Returns the neighbours of every triangle: the one opposite each of its corners, `None` at the hull.
    #[must_use]
    pub fn neighbours(&self) -> &[[Option<u32>; 3]] {
        &self.neighbours
    }
    /// Returns the points of the convex hull, counter-clockwise from the lowest number, those on its edges included. For points
    /// on one line it is all of them along the line.
    #[must_use]
    pub fn hull(&self) -> &[u32] {
        &self.hull
    }
    /// Returns for every point the lowest number of a point at its place: its own, unless it is repeated. Only these are in
    /// triangles.
    #[must_use]
    pub fn firsts(&self) -> &[u32] {
        &self.firsts
    }
    /// Returns the edges, each once: from the lower to the higher number, in order.
    #[must_use]
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let mut all = Vec::with_capacity(3 * self.firsts.len());
        for &[a, b, c] in &self.triangles {
            all.extend([[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)]));
        }
        if self.triangles.is_empty() {
            let pairs = self.hull.windows(2);
            all.extend(pairs.map(|ab| [ab[0].min(ab[1]), ab[0].max(ab[1])]));
        }
        all.sort_unstable();
        all.dedup();
        all
    }
    /// Returns the area of every triangle, positive where they are triangles of these points.
    ///
    /// # Panics
    ///
    /// When a triangle has a point beyond the last one.
    #[must_use]
    pub fn areas<S: Scalar>(&self, points: &[Vec2<S>]) -> Vec<S> {
        let of = |&corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|k| points[k as usize]);
            (b - a).perp_dot(c - a).halved().canonical()
        };
        self.triangles.iter().map(of).collect()
    }
    /// Returns the circle around every triangle, in whose inside there is no point. The centres are the vertices of the Voronoi
    /// diagram. Kinks and flat triangles as for [`circumcircle`].
    ///
    /// # Panics
    ///
    /// When a triangle has a point beyond the last one.
    #[must_use]
    pub fn circumcircles<S: Scalar>(&self, points: &[Vec2<S>]) -> Vec<Circle<S>> {
        let of = |&corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|k| points[k as usize]);
            circumcircle(a, b, c)
        };
        self.triangles.iter().map(of).collect()
    }
}

//! The triangle around a place, by a walk from a triangle near it.
use super::Delaunay;
use crate::predicate::{Turn, turn, wide_place};
use crate::{Scalar, Vec2};

/// Triangles near the cells of a grid.
struct Starts {
    low: Vec2<f64>,
    /// Cells per unit of length along x and y.
    scale: Vec2<f64>,
    /// The number of cells along x and along y.
    side: usize,
    triangles: Vec<u32>,
}

impl Starts {
    fn new<S: Scalar<Mask = bool>>(mesh: &Delaunay, points: &[Vec2<S>]) -> Self {
        const NONE: u32 = u32::MAX;
        let hull = mesh.hull().iter().map(|&k| wide_place(points[k as usize]));
        let none = Vec2::new(f64::INFINITY, f64::INFINITY);
        let (low, high) = hull.fold((none, -none), |(low, high), at| {
            (
                Vec2::new(low.x.min(at.x), low.y.min(at.y)),
                Vec2::new(high.x.max(at.x), high.y.max(at.y)),
            )
        });
        // About four triangles to a cell.
        let side = ((mesh.triangles().len() as f64).sqrt() * 0.5)
            .ceil()
            .max(1.0) as usize;
        let along = |low: f64, high: f64| side as f64 / (high - low);
        let mut made = Starts {
            low,
            scale: Vec2::new(along(low.x, high.x), along(low.y, high.y)),
            side,
            triangles: vec![NONE; side * side],
        };
        for (number, corners) in mesh.triangles().iter().enumerate() {
            let cell = made.cell(wide_place(points[corners[0] as usize]));
            made.triangles[cell] = number as u32;
        }
        let mut last = 0;
        for own in &mut made.triangles {
            match *own {
                NONE => *own = last,
                known => last = known,
            }
        }
        made
    }
    fn cell(&self, at: Vec2<f64>) -> usize {
        // A number below zero and one that is none are 0.
        let number = |x: f64| (x as usize).min(self.side - 1);
        let seen = at - self.low;
        number(seen.y * self.scale.y) * self.side + number(seen.x * self.scale.x)
    }
}

impl Delaunay {
    /// Returns for every place the number of the triangle that contains it: the lowest one of several, at an edge or a corner.
    /// `None` outside of all triangles, and for places that are not finite. `points` are those of the triangulation. Signs are
    /// exact, as those of the search.
    ///
    /// ```
    /// use geograd::{Vec2, delaunay::Delaunay};
    /// let points = [(0.0, 0.0), (4.0, 0.0), (0.0, 2.0), (1.0, 0.5)].map(|(x, y)| Vec2::new(x, y));
    /// let mesh = Delaunay::search(&points)?;
    /// let found = mesh.locate(&points, &[Vec2::new(1.0, 0.25), Vec2::new(3.0, 1.0)]);
    /// let [inside, outside] = found[..] else { unreachable!() };
    /// let corners = mesh.triangles()[inside.expect("it is in the hull") as usize];
    /// assert!(corners.contains(&0) && corners.contains(&1) && corners.contains(&3));
    /// assert_eq!(outside, None);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    ///
    /// # Panics
    ///
    /// When a triangle has a point beyond the last one.
    #[must_use]
    pub fn locate<S: Scalar<Mask = bool>>(
        &self,
        points: &[Vec2<S>],
        places: &[Vec2<S>],
    ) -> Vec<Option<u32>> {
        if self.triangles().is_empty() {
            return vec![None; places.len()];
        }
        let starts = Starts::new(self, points);
        let of = |&at: &Vec2<S>| {
            if !at.is_finite() {
                return None;
            }
            let first = starts.triangles[starts.cell(wide_place(at))];
            let found = self.walked(points, at, first)?;
            Some(self.lowest(points, at, found))
        };
        places.iter().map(of).collect()
    }
    /// Returns the turn from each side of a triangle, opposite its corners, to a place.
    fn turns<S: Scalar<Mask = bool>>(
        &self,
        points: &[Vec2<S>],
        at: Vec2<S>,
        triangle: u32,
    ) -> [Turn; 3] {
        let [a, b, c] = self.triangles()[triangle as usize].map(|k| points[k as usize]);
        [turn(b, c, at), turn(c, a, at), turn(a, b, at)]
    }
    /// Returns a triangle that contains a place, by a walk through sides that have it beyond them. Such a walk ends in a Delaunay
    /// triangulation and comes to no triangle twice (De Floriani, Falcidieno, Nagy and Pienovi 1991).
    fn walked<S: Scalar<Mask = bool>>(
        &self,
        points: &[Vec2<S>],
        at: Vec2<S>,
        mut triangle: u32,
    ) -> Option<u32> {
        for _ in 0..self.triangles().len() {
            let turns = self.turns(points, at, triangle);
            let Some(side) = turns.iter().position(|&own| own == Turn::Right) else {
                return Some(triangle);
            };
            // The hull is convex: beyond one of its sides there is no triangle.
            triangle = self.neighbours()[triangle as usize][side]?;
        }
        // The points are not those of the search, and the walk has gone in circles.
        let contains = |&own: &u32| !self.turns(points, at, own).contains(&Turn::Right);
        (0..self.triangles().len() as u32).find(contains)
    }
    /// Returns the lowest number of a triangle that contains a place, from one that does. Those at an edge are two, and those at
    /// a corner follow each other around it.
    fn lowest<S: Scalar<Mask = bool>>(&self, points: &[Vec2<S>], at: Vec2<S>, found: u32) -> u32 {
        let beside = |own: u32| {
            let turns = self.turns(points, at, own);
            let sides = self.neighbours()[own as usize].into_iter().zip(turns);
            sides.filter_map(|(side, turn)| side.filter(|_| turn == Turn::Straight))
        };
        let mut least = found;
        for first in beside(found) {
            let (mut before, mut here) = (found, first);
            for _ in 0..self.triangles().len() {
                least = least.min(here);
                let next = beside(here).find(|&next| next != before);
                let Some(next) = next.filter(|&next| next != found) else {
                    break;
                };
                (before, here) = (here, next);
            }
        }
        least
    }
}

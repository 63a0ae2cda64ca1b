//! Simple polygons: rows of tables, and what they are as shapes.
use crate::input::{self, Shape};
use common::compute::Number;
use geograd::predicate::{Turn, turn};
use geograd::{Aabb2, Vec2, ring};

/// A simple polygon, convex or not.
#[derive(Clone, Debug)]
pub struct Polygon<T> {
    /// The vertices, counter-clockwise.
    pub vertices: Vec<Vec2<T>>,
    /// `true` if they were given clockwise.
    turned: bool,
    pub area: T,
    pub bounds: Aabb2<T>,
}

impl<T: Number> Polygon<T> {
    /// From at least one vertex.
    fn new(mut vertices: Vec<Vec2<T>>) -> Self {
        let own = unit(bounds_of(&vertices));
        let scaled: Vec<_> = vertices.iter().map(|&at| at * own).collect();
        let turned = ring::signed_area(&scaled) < T::zero();
        if turned {
            vertices.reverse();
        }
        Self::counter_clockwise(vertices, turned)
    }

    fn counter_clockwise(vertices: Vec<Vec2<T>>, turned: bool) -> Self {
        Polygon {
            turned,
            area: ring::signed_area(&vertices),
            bounds: bounds_of(&vertices),
            vertices,
        }
    }

    /// In another unit.
    pub fn scaled(&self, by: T) -> Self {
        let vertices = self.vertices.iter().map(|&at| at * by).collect();
        Self::counter_clockwise(vertices, self.turned)
    }

    /// The number of vertices.
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Something for every vertex, in the order in which they were given.
    pub fn given(&self, of_vertices: &[Vec2<T>]) -> Vec<Vec2<T>> {
        let mut all = of_vertices.to_vec();
        if self.turned {
            all.reverse();
        }
        all
    }

    /// Two edges that cross, by the numbers of the vertices they start at as they were given.
    fn crossing(vertices: &[Vec2<T>]) -> Option<(usize, usize)> {
        let n = vertices.len();
        let edge = |k: usize| [vertices[k], vertices[(k + 1) % n]];
        let parts = |[p, q]: [Vec2<T>; 2], [r, s]: [Vec2<T>; 2]| {
            let (first, second) = (turn(p, q, r), turn(p, q, s));
            first != Turn::Straight && first.mirrored() == second
        };
        let apart = |[p, q]: [Vec2<T>; 2], [r, s]: [Vec2<T>; 2]| {
            p.most(q).x < r.least(s).x
                || r.most(s).x < p.least(q).x
                || p.most(q).y < r.least(s).y
                || r.most(s).y < p.least(q).y
        };
        (0..n).find_map(|j| {
            let later = edge(j);
            let cross = |&i: &usize| {
                let e = edge(i);
                !apart(e, later) && parts(e, later) && parts(later, e)
            };
            (0..j).find(cross).map(|i| (i, j))
        })
    }
}

fn bounds_of<T: Number>(vertices: &[Vec2<T>]) -> Aabb2<T> {
    Aabb2::around(vertices).unwrap_or(Aabb2 {
        min: Vec2::zero(),
        max: Vec2::zero(),
    })
}

/// The factor of lengths that keeps areas and their squares finite and above zero: a power of two,
/// and one for all ordinary sizes.
pub fn unit<T: Number>(bounds: Aabb2<T>) -> T {
    let half = bounds.max * T::lit(0.5) - bounds.min * T::lit(0.5);
    let extent = half.x.most(half.y);
    let most = T::lit(T::format().largest().powf(0.2));
    match extent > T::zero() && (extent > most || extent < T::one() / most) {
        true => extent.binade(),
        false => T::one(),
    }
}

impl<T: Number> Shape for Polygon<T> {
    fn is_header(names: &[String]) -> Result<bool, String> {
        let count = names.len().div_ceil(2);
        let columns: Vec<String> = (1..=count)
            .flat_map(|k| [format!("x{k}"), format!("y{k}")])
            .collect();
        let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
        // How long a header is says nothing about the rows.
        match names.len() == columns.len() {
            true => input::names_columns(names, &columns),
            false => Ok(true),
        }
    }

    fn parse(fields: &[&str]) -> Result<Self, String> {
        // Spreadsheets fill short rows up with empty fields.
        let end = fields.iter().rposition(|field| !field.is_empty());
        let fields = &fields[..end.map_or(0, |last| last + 1)];
        let mut numbers = Vec::with_capacity(fields.len());
        for (i, field) in fields.iter().enumerate() {
            let axis = if i % 2 == 0 { "x" } else { "y" };
            let column = format!("{axis}{}", i / 2 + 1);
            numbers.push(input::number::<T>(field, &column)?);
        }
        if numbers.len() % 2 == 1 {
            let last = numbers.len() / 2 + 1;
            return Err(format!("x{last} has no y{last}"));
        }
        if numbers.len() < 6 {
            let found = numbers.len() / 2;
            return Err(format!(
                "{found} vertices where a polygon has three or more"
            ));
        }
        let vertices: Vec<_> = numbers
            .chunks_exact(2)
            .map(|at| Vec2::new(at[0], at[1]))
            .collect();
        if let Some((i, j)) = Self::crossing(&vertices) {
            return Err(format!(
                "the edges after vertices {} and {} cross each other",
                i + 1,
                j + 1
            ));
        }
        Ok(Polygon::new(vertices))
    }
}

//! The nearest edges of two columns of figures of the plane, item by item, and which areas hold which rings.
use crate::arrays::offsets;
use crate::lent::array_of;
use crate::polygon_calls::{in_format, in_runs, listed, place, together};
use crate::polygons::{Format, Polygons, vectors};
use geograd::Vec2;
use geograd::polygon::{DistanceRoom, EdgeBoxes, Fill, Rings};
use geograd::shape::edges;
use numpy::{PyArray1, PyArrayDyn};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use std::ops::Range;

type Object<'py> = Bound<'py, PyAny>;

/// Edges of figures: the vertices, for each one the vertex after it, and the number of vertices up to each figure.
#[derive(FromPyObject)]
pub struct EdgeColumn<'py>(Object<'py>, Object<'py>, Object<'py>);

impl<'py> EdgeColumn<'py> {
    pub fn vertices(&self) -> &Object<'py> {
        &self.0
    }
}

/// The numbers of such a column.
pub struct EdgeLists<T> {
    pub vertices: Vec<Vec2<T>>,
    pub following: Vec<usize>,
    ends: Vec<usize>,
}

/// Reads two columns, each of so many items or of one that stands for all.
pub fn columns<T: Format>(
    py: Python<'_>,
    a: &EdgeColumn<'_>,
    b: &EdgeColumn<'_>,
    count: usize,
) -> PyResult<[EdgeLists<T>; 2]> {
    let both = [EdgeLists::<T>::new(py, a)?, EdgeLists::<T>::new(py, b)?];
    match both.iter().find(|own| own.len() != count && own.len() != 1) {
        None => Ok(both),
        Some(own) => {
            let why = format!("{} items where {count} are needed", own.len());
            Err(PyIndexError::new_err(why))
        }
    }
}

impl<T: Format> EdgeLists<T> {
    fn new(py: Python<'_>, of: &EdgeColumn<'_>) -> PyResult<Self> {
        let vertices = vectors::<T>(&of.0)?;
        let following = offsets(py, &of.1, "following")?;
        let ends = offsets(py, &of.2, "ends")?;
        let is_known = following.len() == vertices.len()
            && following.iter().all(|&next| next < vertices.len())
            && ends.is_sorted()
            && ends.last() == Some(&vertices.len());
        match is_known {
            true => Ok(EdgeLists {
                vertices,
                following,
                ends,
            }),
            false => Err(PyIndexError::new_err("an edge without a vertex")),
        }
    }
    pub fn len(&self) -> usize {
        self.ends.len() - 1
    }
    /// The places of an item's vertices.
    pub fn places(&self, item: usize) -> Range<usize> {
        self.ends[item]..self.ends[item + 1]
    }
    fn edges(&self, item: usize) -> impl Iterator<Item = [Vec2<T>; 2]> {
        self.places(item)
            .map(|k| [self.vertices[k], self.vertices[self.following[k]]])
    }
}

/// For each item the distance of its nearest edges, infinite without edges, the first vertex of each of both, and whether
/// the boxes around both have a point in common.
#[pyfunction]
pub fn nearest_edges<'py>(
    py: Python<'py>,
    a: EdgeColumn<'py>,
    b: EdgeColumn<'py>,
    count: usize,
) -> PyResult<Object<'py>> {
    let is_double = a.vertices().cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(is_double, nearest(py, &a, &b, count))
}

fn nearest<'py, T: Format>(
    py: Python<'py>,
    a: &EdgeColumn<'py>,
    b: &EdgeColumn<'py>,
    count: usize,
) -> PyResult<Object<'py>> {
    let both = columns::<T>(py, a, b, count)?;
    // One item that stands for all is sorted once.
    let shared = both
        .each_ref()
        .map(|own| match own.len() == 1 && count != 1 {
            true => Some(EdgeBoxes::of_edges(own.edges(0))),
            false => None,
        });
    let work = both.iter().map(|own| own.vertices.len().max(count)).sum();
    let runs = in_runs(py, count, work, |run: Range<usize>| {
        let mut found = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let mut rooms = [EdgeBoxes::default(), EdgeBoxes::default()];
        for item in run {
            for ((room, own), shared) in rooms.iter_mut().zip(&both).zip(&shared) {
                if shared.is_none() {
                    room.replace(own.edges(item));
                }
            }
            let [p, q] = [0, 1].map(|k| shared[k].as_ref().unwrap_or(&rooms[k]));
            let nearest = p.nearest(q);
            found
                .0
                .push(nearest.map_or(T::narrowed(f64::INFINITY), |own| own.distance));
            let [of_a, of_b] = nearest.map_or([0; 2], |own| {
                [0, 1].map(|k| (both[k].ends[place(both[k].len(), item)] + own.edges[k]) as i64)
            });
            found.1.push(of_a);
            found.2.push(of_b);
            found.3.push(p.is_near(q));
        }
        found
    })?;
    let (mut distances, mut of_a, mut of_b) = (Vec::new(), Vec::new(), Vec::new());
    let mut are_near = Vec::new();
    for (distance, a, b, is_near) in runs {
        distances.extend(distance);
        of_a.extend(a);
        of_b.extend(b);
        are_near.extend(is_near);
    }
    let arrays = (
        PyArray1::from_vec(py, distances),
        PyArray1::from_vec(py, of_a),
        PyArray1::from_vec(py, of_b),
        PyArray1::from_vec(py, are_near),
    );
    Ok(arrays.into_pyobject(py)?.into_any())
}

/// The distances of two columns of polygons, item by item: 0 where they meet or one holds the other, the largest number where
/// one has no edges.
#[pyfunction]
pub fn polygons_apart<'py>(py: Python<'py>, a: &Polygons, b: &Polygons) -> PyResult<Object<'py>> {
    in_format!(a.is_double() || b.is_double(), apart(py, a, b))
}

fn apart<'py, T: Format>(py: Python<'py>, a: &Polygons, b: &Polygons) -> PyResult<Object<'py>> {
    let both = [a, b];
    let counts = both.map(|own| own.layout.len());
    let count = together(("a", counts[0]), ("b", counts[1]))?;
    let vertices = both.map(|own| T::of(&own.vertices));
    let at = |k: usize, item: usize| {
        let item = place(counts[k], item);
        both[k].layout.item(&vertices[k], item)
    };
    // One polygon that stands for all is sorted once.
    let is_shared = counts.map(|own| own == 1 && count != 1);
    let shared = [0, 1].map(|k| is_shared[k].then(|| EdgeBoxes::of(at(k, 0))));
    let work = vertices.iter().map(|own| own.len().max(count)).sum();
    let distances = listed(py, count, work, |run: Range<usize>, found| {
        if shared.iter().all(Option::is_none) {
            let mut room = DistanceRoom::default();
            found.extend(run.map(|item| room.distance(at(0, item), at(1, item))));
            return;
        }
        let mut rooms = [EdgeBoxes::default(), EdgeBoxes::default()];
        let distance = |item: usize| {
            let rings = [0, 1].map(|k| at(k, item));
            for ((room, own), shared) in rooms.iter_mut().zip(&rings).zip(&shared) {
                if shared.is_none() {
                    room.replace(own.iter().flat_map(edges));
                }
            }
            let [p, q] = [0, 1].map(|k| shared[k].as_ref().unwrap_or(&rooms[k]));
            // One vertex decides sooner than edges do.
            let is_held =
                || p.is_near(q) && (holds(rings[0], rings[1]) || holds(rings[1], rings[0]));
            if is_held() {
                return T::zero();
            }
            p.nearest(q)
                .map_or(T::largest(), |nearest| nearest.distance)
        };
        found.extend(run.map(distance));
    })?;
    Ok(array_of(py, distances).into_any())
}

/// Returns `true` if a polygon has the first vertex of a ring of another one inside.
fn holds<T: Format>(area: Rings<'_, T>, other: Rings<'_, T>) -> bool {
    let firsts = other.iter().filter_map(|ring| ring.first());
    firsts.copied().any(|v| {
        let is_near = area.iter().any(|ring| is_near(ring, v));
        is_near && area.contains(v, Fill::EvenOdd)
    })
}

/// For some items whether a polygon has the first vertex of a ring of another figure inside: `firsts` are these vertices,
/// `rings` the number of rings up to each figure.
#[pyfunction]
pub fn polygons_hold<'py>(
    py: Python<'py>,
    polygons: &Polygons,
    firsts: &Object<'py>,
    rings: &Object<'py>,
    items: &Object<'py>,
) -> PyResult<Object<'py>> {
    let is_double = polygons.is_double() || firsts.cast::<PyArrayDyn<f64>>().is_ok();
    in_format!(is_double, held(py, polygons, firsts, rings, items))
}

fn held<'py, T: Format>(
    py: Python<'py>,
    own: &Polygons,
    firsts: &Object<'py>,
    rings: &Object<'py>,
    items: &Object<'py>,
) -> PyResult<Object<'py>> {
    let (vertices, firsts) = (T::of(&own.vertices), vectors::<T>(firsts)?);
    let rings = offsets(py, rings, "rings")?;
    let items = offsets(py, items, "items")?;
    let (areas, others) = (own.layout.len(), rings.len().saturating_sub(1));
    let most = items.iter().max().map_or(0, |most| most + 1);
    let is_known = [areas, others]
        .iter()
        .all(|&count| count == 1 || count >= most)
        && rings.is_sorted()
        && rings.last() == Some(&firsts.len());
    if !is_known {
        return Err(PyIndexError::new_err("a ring without an item"));
    }
    let work = vertices.len().max(items.len());
    let runs = in_runs(py, items.len(), work, |run| {
        let inside = items[run].iter().map(|&item| {
            let area = own.layout.item(&vertices, place(areas, item));
            let other = place(others, item);
            let firsts = &firsts[rings[other]..rings[other + 1]];
            firsts.iter().any(|&v| {
                is_near(&vertices[own.layout.vertices(place(areas, item))], v)
                    && area.contains(v, Fill::EvenOdd)
            })
        });
        inside.collect::<Vec<bool>>()
    })?;
    Ok(PyArray1::from_vec(py, runs.concat()).into_any())
}

/// Returns `true` where a point is within the bounds of vertices.
fn is_near<T: Format>(vertices: &[Vec2<T>], at: Vec2<T>) -> bool {
    let sides = vertices
        .iter()
        .fold([false; 4], |[left, right, below, above], v| {
            [
                left | (v.x <= at.x),
                right | (v.x >= at.x),
                below | (v.y <= at.y),
                above | (v.y >= at.y),
            ]
        });
    sides == [true; 4]
}

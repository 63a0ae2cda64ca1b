//! Paths of curves: measures, distances and winding numbers of points, chords, with derivatives.
use crate::cell_calls::{in_plane, vectors};
use crate::polygon_calls::{in_watched_runs, numbers};
use crate::raised;
use geograd::ad::adjoint::curve_bars::{distances_vjp, length_grad, lengths_vjp, signed_area_grad};
use geograd::curve::{CurveBoxes, CurveElement, CurvePath, CurvePlace};
use geograd::{Pack, Validate, Vec2};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::OnceLock;

type Object<'py> = Bound<'py, PyAny>;
type Numbers<'py> = Bound<'py, PyArray1<f64>>;

/// A path of curves.
#[pyclass(frozen, module = "geograd._core")]
pub struct CurveCore {
    path: CurvePath<f64>,
    boxes: OnceLock<CurveBoxes>,
}

/// Returns a step by its letter, with the numbers that it takes from the front of a list.
fn element(letter: char, from: &mut &[f64]) -> PyResult<CurveElement<f64>> {
    let wrong = |text: String| PyValueError::new_err(text);
    let count = match letter {
        'M' | 'L' => 2,
        'A' => 3,
        'Q' => 4,
        'C' => 6,
        'Z' => 0,
        other => {
            return Err(wrong(format!(
                "steps: letters of MLQCAZ are needed, not {other:?}"
            )));
        }
    };
    let Some((own, rest)) = from.split_at_checked(count) else {
        return Err(wrong("numbers: there are too few for the steps".to_owned()));
    };
    *from = rest;
    let at = |k: usize| Vec2::new(own[2 * k], own[2 * k + 1]);
    Ok(match letter {
        'M' => CurveElement::MoveTo(at(0)),
        'L' => CurveElement::LineTo(at(0)),
        'A' => CurveElement::ArcTo(at(0), own[2]),
        'Q' => CurveElement::QuadTo(at(0), at(1)),
        'C' => CurveElement::CurveTo(at(0), at(1), at(2)),
        _ => CurveElement::Close,
    })
}

/// Returns the letters of a path's steps.
pub fn letters(path: &CurvePath<f64>) -> String {
    let letter = |element: &CurveElement<f64>| match element {
        CurveElement::MoveTo(_) => 'M',
        CurveElement::LineTo(_) => 'L',
        CurveElement::ArcTo(..) => 'A',
        CurveElement::QuadTo(..) => 'Q',
        CurveElement::CurveTo(..) => 'C',
        CurveElement::Close => 'Z',
    };
    path.elements().iter().map(letter).collect()
}

impl CurveCore {
    /// Returns the result for every point, in order, and the searches' places.
    fn of_points<R: Send + Copy>(
        &self,
        py: Python<'_>,
        points: &[Vec2<f64>],
        of: impl Fn(Vec2<f64>) -> R + Send + Sync,
    ) -> PyResult<Vec<R>> {
        let work = points.len() * 64;
        let runs = in_watched_runs(py, points.len(), work, |run, interruption| {
            let until = run.take_while(|_| !interruption.is_due());
            until.map(|k| of(points[k])).collect::<Vec<_>>()
        })?;
        Ok(runs.concat())
    }
    /// Returns the boxes around the pieces, made at their first use.
    fn boxes(&self) -> &CurveBoxes {
        self.boxes.get_or_init(|| CurveBoxes::of(&self.path))
    }
    fn places(&self, py: Python<'_>, points: &[Vec2<f64>]) -> PyResult<Vec<CurvePlace>> {
        let found = self.of_points(py, points, |point| self.boxes().closest(point))?;
        let all: Option<Vec<_>> = found.into_iter().collect();
        all.ok_or_else(|| PyValueError::new_err("the path has no pieces"))
    }
}

#[pymethods]
impl CurveCore {
    #[new]
    fn new(steps: &str, numbers_of_steps: &Object<'_>) -> PyResult<Self> {
        let all = numbers::<f64>(numbers_of_steps)?;
        let mut rest = &all[..];
        let elements = steps
            .chars()
            .map(|letter| element(letter, &mut rest))
            .collect::<PyResult<Vec<_>>>()?;
        if !rest.is_empty() {
            let text = format!("numbers: {} more than the steps take", rest.len());
            return Err(PyValueError::new_err(text));
        }
        let wrong = |flaw: geograd::Flaw| PyValueError::new_err(flaw.to_string());
        let path = CurvePath::from_elements(elements).map_err(wrong)?;
        path.validate().map_err(wrong)?;
        let boxes = OnceLock::new();
        Ok(CurveCore { path, boxes })
    }
    fn numbers<'py>(&self, py: Python<'py>) -> Numbers<'py> {
        PyArray1::from_vec(py, self.path.scalars())
    }
    fn length(&self) -> f64 {
        self.path.length()
    }
    fn lengths<'py>(&self, py: Python<'py>) -> Numbers<'py> {
        PyArray1::from_vec(py, py.detach(|| self.path.lengths()))
    }
    fn lengths_vjp<'py>(
        &self,
        py: Python<'py>,
        upstream: &Object<'py>,
    ) -> PyResult<(Numbers<'py>, Numbers<'py>)> {
        let upstream = numbers::<f64>(upstream)?;
        let count = self.path.pieces().count();
        if upstream.len() != count {
            let text = format!(
                "upstream: {} numbers where there are {count} pieces",
                upstream.len()
            );
            return Err(PyValueError::new_err(text));
        }
        let (lengths, by) = py.detach(|| lengths_vjp(&self.path, &upstream));
        Ok((
            PyArray1::from_vec(py, lengths),
            PyArray1::from_vec(py, by.scalars()),
        ))
    }
    fn area(&self) -> f64 {
        self.path.signed_area()
    }
    fn bounds(&self) -> Option<[f64; 4]> {
        let found = self.path.bounding()?;
        Some([found.min.x, found.min.y, found.max.x, found.max.y])
    }
    fn length_grad<'py>(&self, py: Python<'py>) -> (f64, Numbers<'py>) {
        let (length, by) = length_grad(&self.path);
        (length, PyArray1::from_vec(py, by.scalars()))
    }
    fn area_grad<'py>(&self, py: Python<'py>) -> (f64, Numbers<'py>) {
        let (area, by) = signed_area_grad(&self.path);
        (area, PyArray1::from_vec(py, by.scalars()))
    }
    fn reversed(&self) -> (String, Vec<f64>) {
        let back = self.path.reversed();
        let letter = |element: &CurveElement<f64>| match element {
            CurveElement::MoveTo(..) => 'M',
            CurveElement::LineTo(..) => 'L',
            CurveElement::QuadTo(..) => 'Q',
            CurveElement::CurveTo(..) => 'C',
            CurveElement::ArcTo(..) => 'A',
            CurveElement::Close => 'Z',
        };
        (back.elements().iter().map(letter).collect(), back.scalars())
    }
    fn distance<'py>(&self, py: Python<'py>, points: &Object<'py>) -> PyResult<Numbers<'py>> {
        let points = vectors(points)?;
        let found = self.of_points(py, &points, |point| {
            let boxes = self.boxes();
            let of = |place: CurvePlace| boxes.pieces()[place.piece].distance_replay(point, place);
            boxes.closest(point).map_or(f64::NAN, of)
        })?;
        Ok(PyArray1::from_vec(py, found))
    }
    fn closest<'py>(&self, py: Python<'py>, points: &Object<'py>) -> PyResult<Object<'py>> {
        let points = vectors(points)?;
        let places = self.places(py, &points)?;
        let both = points.iter().zip(places);
        let pieces = self.boxes().pieces();
        in_plane(
            py,
            both.map(|(&p, place)| pieces[place.piece].closest_replay(p, place)),
        )
    }
    fn winding_number<'py>(
        &self,
        py: Python<'py>,
        points: &Object<'py>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let points = vectors(points)?;
        let found = self.of_points(py, &points, |point| self.boxes().winding_number(point))?;
        Ok(PyArray1::from_iter(py, found.into_iter().map(i64::from)))
    }
    fn distance_vjp<'py>(
        &self,
        py: Python<'py>,
        points: &Object<'py>,
        upstream: &Object<'py>,
    ) -> PyResult<(Numbers<'py>, Object<'py>)> {
        let (points, upstream) = (vectors(points)?, numbers::<f64>(upstream)?);
        let places = self.places(py, &points)?;
        let (by_path, by_points) =
            py.detach(|| distances_vjp(&self.path, &points, &places, &upstream));
        let by_path = PyArray1::from_vec(py, by_path.scalars());
        Ok((by_path, in_plane(py, by_points.into_iter())?))
    }
    fn flatten<'py>(&self, py: Python<'py>, tolerance: f64) -> PyResult<Vec<Object<'py>>> {
        let all = self.path.flatten(tolerance).map_err(raised)?;
        let arrays = all.into_iter().map(|own| in_plane(py, own.into_iter()));
        arrays.collect()
    }
}

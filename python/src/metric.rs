//! Matches of detections and truths, and metrics of detections.
use crate::grouped::both;
use crate::raised;
use crate::threads::on_threads;
use geograd::assignment;
use geograd::kernels::dynamic::Interruption;
use geograd::kernels::{Cpu, Groups};
use geograd::metric::nuscenes::{self, Object, TruePositive};
use geograd::metric::{self, Frame, Outcome, Point, Recalls, kitti};
use geograd::suppression::Pair;
use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

pub type Numbers<'py> = PyReadonlyArray1<'py, f64>;
pub type Places<'py> = PyReadonlyArray1<'py, i64>;
pub type Array<'py, T> = Bound<'py, PyArray1<T>>;
type Triple<'py> = (Array<'py, i64>, Array<'py, i64>, Array<'py, f64>);

/// The numbers that mark a detection as wrong, and as one that does not count.
const WRONG: i64 = -1;
const IGNORED: i64 = -2;

fn place(name: &str, item: usize, x: i64) -> PyResult<usize> {
    let negative = || PyValueError::new_err(format!("`{name}` item {item}: is negative"));
    usize::try_from(x).map_err(|_| negative())
}

pub fn pairs(
    first: &Places<'_>,
    second: &Places<'_>,
    overlap: &Numbers<'_>,
) -> PyResult<Vec<Pair<f64>>> {
    let (first, second, overlap) = (first.as_slice()?, second.as_slice()?, overlap.as_slice()?);
    if first.len() != second.len() || first.len() != overlap.len() {
        return Err(PyValueError::new_err(format!(
            "pairs: {} first places, {} second ones and {} overlaps",
            first.len(),
            second.len(),
            overlap.len()
        )));
    }
    let all = first.iter().zip(second).zip(overlap).enumerate();
    all.map(|(i, ((&first, &second), &overlap))| {
        Ok(Pair {
            first: place("pairs", i, first)?,
            second: place("pairs", i, second)?,
            overlap,
        })
    })
    .collect()
}

fn triple<'py>(py: Python<'py>, pairs: &[Pair<f64>]) -> Triple<'py> {
    (
        PyArray1::from_iter(py, pairs.iter().map(|pair| pair.first as i64)),
        PyArray1::from_iter(py, pairs.iter().map(|pair| pair.second as i64)),
        PyArray1::from_iter(py, pairs.iter().map(|pair| pair.overlap)),
    )
}

/// Returns the offsets of both lists, if there are groups.
fn offsets(py: Python<'_>, groups: Option<&Bound<'_, PyAny>>) -> PyResult<Option<[Vec<usize>; 2]>> {
    groups.map(|groups| both(py, groups)).transpose()
}

/// One-to-one pairs: greedy, or of the largest sum; of every group, where there are groups.
#[pyfunction]
#[pyo3(signature = (first, second, overlap, is_greedy, groups=None))]
pub fn assigned<'py>(
    py: Python<'py>,
    first: Places<'py>,
    second: Places<'py>,
    overlap: Numbers<'py>,
    is_greedy: bool,
    groups: Option<Bound<'py, PyAny>>,
) -> PyResult<Triple<'py>> {
    let pairs = pairs(&first, &second, &overlap)?;
    let groups = offsets(py, groups.as_ref())?;
    let chosen = on_threads(py, pairs.len(), || {
        let own = groups.as_ref().map(|[a, b]| Groups::new(a, b));
        let interruption = Interruption::current();
        match (own, is_greedy) {
            (None, true) => Ok(assignment::greedy(&pairs)),
            (None, false) => assignment::largest_until(&pairs, &|| interruption.is_due()),
            (Some(own), true) => Cpu::new().greedy_grouped(&pairs, own),
            (Some(own), false) => Cpu::new().largest_grouped(&pairs, own),
        }
    })?;
    Ok(triple(py, &chosen.map_err(raised)?))
}

/// The outcome of every detection: the truth that it found, -1 if it is wrong, -2 if it does not count.
#[pyfunction]
#[pyo3(signature = (scores, truths, first, second, overlap, threshold, ignored_truths, ignored_detections, groups=None))]
#[allow(clippy::too_many_arguments)] // The wrapper in Python has a pair in place of three.
pub fn outcomes<'py>(
    py: Python<'py>,
    scores: Numbers<'py>,
    truths: usize,
    first: Places<'py>,
    second: Places<'py>,
    overlap: Numbers<'py>,
    threshold: f64,
    ignored_truths: Vec<bool>,
    ignored_detections: Vec<bool>,
    groups: Option<Bound<'py, PyAny>>,
) -> PyResult<Array<'py, i64>> {
    let pairs = pairs(&first, &second, &overlap)?;
    let groups = offsets(py, groups.as_ref())?;
    let scores = scores.as_slice()?;
    let found = on_threads(py, pairs.len(), || {
        let frame = Frame {
            scores,
            truths,
            pairs: &pairs,
            ignored_truths: &ignored_truths,
            ignored_detections: &ignored_detections,
        };
        match &groups {
            None => metric::outcomes(&frame, threshold),
            Some([a, b]) => Cpu::new().outcomes_grouped(&frame, Groups::new(a, b), threshold),
        }
    })?;
    let number = |outcome: Outcome| match outcome {
        Outcome::Right(truth) => truth as i64,
        Outcome::Wrong => WRONG,
        Outcome::Ignored => IGNORED,
    };
    let found = found.map_err(raised)?.into_iter().map(number);
    Ok(PyArray1::from_iter(py, found))
}

type Curve<'py> = (Array<'py, f64>, Array<'py, f64>, Array<'py, f64>);

fn curve_of<'py>(py: Python<'py>, points: &[Point]) -> Curve<'py> {
    (
        PyArray1::from_iter(py, points.iter().map(|point| point.score)),
        PyArray1::from_iter(py, points.iter().map(|point| point.precision)),
        PyArray1::from_iter(py, points.iter().map(|point| point.recall)),
    )
}

/// Scores, precisions and recalls, the highest score first.
#[pyfunction]
pub fn curve<'py>(
    py: Python<'py>,
    scores: Numbers<'py>,
    outcomes: Places<'py>,
    truths: usize,
) -> PyResult<Curve<'py>> {
    let outcome = |&x: &i64| match x {
        IGNORED => Outcome::Ignored,
        x => usize::try_from(x).map_or(Outcome::Wrong, Outcome::Right),
    };
    let outcomes: Vec<Outcome> = outcomes.as_slice()?.iter().map(outcome).collect();
    let points = metric::curve(scores.as_slice()?, &outcomes, truths).map_err(raised)?;
    Ok(curve_of(py, &points))
}

fn recalls(name: &str) -> PyResult<Recalls> {
    match name {
        "eleven" => Ok(Recalls::Eleven),
        "forty" => Ok(Recalls::Forty),
        "all" => Ok(Recalls::All),
        other => Err(PyValueError::new_err(format!(
            "recalls: \"eleven\", \"forty\" or \"all\" is needed, not {other:?}"
        ))),
    }
}

/// Average precision of a curve.
#[pyfunction]
pub fn average_precision(precision: Numbers<'_>, recall: Numbers<'_>, at: &str) -> PyResult<f64> {
    let (precision, recall) = (precision.as_slice()?, recall.as_slice()?);
    if precision.len() != recall.len() {
        return Err(PyValueError::new_err(
            "curve: as many recalls as precisions are needed",
        ));
    }
    let point = |(&precision, &recall): (&f64, &f64)| Point {
        score: 0.0,
        precision,
        recall,
    };
    let points: Vec<Point> = precision.iter().zip(recall).map(point).collect();
    Ok(metric::average_precision(&points, recalls(at)?))
}

fn counts(name: &str, codes: &[i64]) -> PyResult<Vec<kitti::Counts>> {
    let one = |(item, &code): (usize, &i64)| match code {
        0 => Ok(kitti::Counts::Fully),
        1 => Ok(kitti::Counts::Ignored),
        2 => Ok(kitti::Counts::Not),
        other => Err(PyValueError::new_err(format!(
            "`{name}` item {item}: 0 (fully), 1 (ignored) or 2 (not) is needed, not {other}"
        ))),
    };
    codes.iter().enumerate().map(one).collect()
}

/// KITTI's rules over all frames: average precision and orientation similarity, the curve, and the truths that counted.
#[pyfunction]
#[pyo3(signature = (truths, scores, detections, first, second, overlap, unlabelled, angles, threshold, at))]
#[allow(clippy::too_many_arguments)] // The wrapper in Python has names for them.
pub fn judge_kitti<'py>(
    py: Python<'py>,
    truths: Places<'py>,
    scores: Numbers<'py>,
    detections: Places<'py>,
    first: Places<'py>,
    second: Places<'py>,
    overlap: Numbers<'py>,
    unlabelled: Numbers<'py>,
    angles: Option<(Numbers<'py>, Numbers<'py>)>,
    threshold: f64,
    at: &str,
) -> PyResult<(f64, f64, Curve<'py>, usize)> {
    let pairs = pairs(&first, &second, &overlap)?;
    let truths = counts("truths", truths.as_slice()?)?;
    let detections = counts("detections", detections.as_slice()?)?;
    let at = recalls(at)?;
    let frame = kitti::Frame {
        truths: &truths,
        scores: scores.as_slice()?,
        detections: &detections,
        pairs: &pairs,
        unlabelled: unlabelled.as_slice()?,
    };
    let own = match &angles {
        None => None,
        Some((truths, detections)) => Some(kitti::Angles {
            truths: truths.as_slice()?,
            detections: detections.as_slice()?,
        }),
    };
    let judged = on_threads(py, pairs.len(), || {
        let own = own.as_ref().map(std::slice::from_ref);
        Cpu::new().judge_kitti(&[frame], own, threshold)
    })?;
    let judged = judged.map_err(raised)?;
    Ok((
        judged.average_precision(at),
        judged.average_orientation_similarity(at),
        curve_of(py, &judged.curve),
        judged.truths,
    ))
}

/// Returns objects from rows of x, y, width, length, height, yaw, vx, vy. An unknown velocity is NaN, no attribute -1.
fn objects(rows: &PyReadonlyArray2<'_, f64>, attributes: &Places<'_>) -> PyResult<Vec<Object>> {
    let (rows, attributes) = (rows.as_array(), attributes.as_slice()?);
    if rows.shape()[1] != 8 || rows.shape()[0] != attributes.len() {
        return Err(PyValueError::new_err(
            "objects: rows of 8 numbers and an attribute for each are needed",
        ));
    }
    let one = |(row, &attribute): (numpy::ndarray::ArrayView1<'_, f64>, &i64)| {
        let velocity = [row[6], row[7]];
        Object {
            velocity: (!velocity[0].is_nan() && !velocity[1].is_nan()).then_some(velocity),
            attribute: u32::try_from(attribute).ok(),
            ..Object::new([row[0], row[1]], [row[2], row[3], row[4]], row[5])
        }
    };
    Ok(rows.rows().into_iter().zip(attributes).map(one).collect())
}

/// nuScenes' rules over all frames at some thresholds: average precision and the five errors at each.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // The wrapper in Python has names for them.
pub fn judge_nuscenes<'py>(
    py: Python<'py>,
    detections: (PyReadonlyArray2<'py, f64>, Places<'py>),
    scores: Numbers<'py>,
    truths: (PyReadonlyArray2<'py, f64>, Places<'py>),
    groups: (Vec<usize>, Vec<usize>),
    thresholds: Vec<f64>,
    period: f64,
) -> PyResult<Vec<(f64, [f64; 5])>> {
    let (detections, truths) = (
        objects(&detections.0, &detections.1)?,
        objects(&truths.0, &truths.1)?,
    );
    let frames = nuscenes::Frames {
        detections: &detections,
        scores: scores.as_slice()?,
        detection_offsets: &groups.0,
        truths: &truths,
        truth_offsets: &groups.1,
        period,
    };
    let judged = on_threads(py, detections.len(), || {
        Cpu::new().judge_nuscenes(&frames, &thresholds)
    })?;
    let one = |judged: &nuscenes::Judged| {
        let errors = TruePositive::ALL.map(|which| judged.error(which));
        (judged.average_precision(), errors)
    };
    Ok(judged.map_err(raised)?.iter().map(one).collect())
}

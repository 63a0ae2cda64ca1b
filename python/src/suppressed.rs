//! Suppression of pairs whose overlaps are known, and assignment of a whole matrix.
use crate::metric::{Array, Numbers, Places, pairs};
use crate::raised;
use crate::threads::on_threads;
use geograd::ad::adjoint::suppression::soft_vjp;
use geograd::assignment;
use geograd::kernels::dynamic::Interruption;
use geograd::suppression::{Decay, Kept, Rules, cluster, matrix, soft_search};
use numpy::{PyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;

/// The rules of a suppression: threshold, least score, the most that are kept, classes.
type RuleNumbers = (f64, Option<f64>, Option<usize>, Option<Vec<u32>>);

fn rules((overlap, score, most, classes): &RuleNumbers) -> Rules<'_, f64> {
    let all = Rules::above(*overlap);
    Rules {
        classes: classes.as_deref(),
        score: score.unwrap_or(all.score),
        most: most.unwrap_or(usize::MAX),
        ..all
    }
}

fn decay(sigma: Option<f64>) -> Decay<f64> {
    sigma.map_or(Decay::Linear, |sigma| Decay::Gaussian { sigma })
}

/// The detections that a suppression keeps and their scores after it, the best first; with cotangents of these those of
/// all scores and overlaps.
#[pyfunction]
#[pyo3(signature = (method, scores, first, second, overlap, numbers, sigma=None, upstream=None))]
#[allow(clippy::too_many_arguments)] // The wrapper in Python has a pair in place of three.
pub fn suppressed<'py>(
    py: Python<'py>,
    method: &str,
    scores: Numbers<'py>,
    first: Places<'py>,
    second: Places<'py>,
    overlap: Numbers<'py>,
    numbers: RuleNumbers,
    sigma: Option<f64>,
    upstream: Option<Vec<f64>>,
) -> PyResult<(Array<'py, i64>, Array<'py, f64>)> {
    let pairs = pairs(&first, &second, &overlap)?;
    let scores = scores.as_slice()?;
    if let Some(upstream) = upstream {
        let back = on_threads(py, pairs.len(), || {
            let (kept, record) = soft_search(scores, &pairs, decay(sigma), rules(&numbers))?;
            let by = soft_vjp(scores, &pairs, decay(sigma), numbers.0, &record, &upstream);
            Ok((kept.len(), by))
        })?;
        let (kept, (by_scores, by_overlaps)) = back.map_err(raised)?;
        if kept != upstream.len() {
            return Err(PyValueError::new_err(format!(
                "upstream: cotangents of {kept} scores are needed, not of {}",
                upstream.len()
            )));
        }
        let places = PyArray1::from_vec(py, Vec::new());
        return Ok((
            places,
            PyArray1::from_vec(py, [by_scores, by_overlaps].concat()),
        ));
    }
    let found = on_threads(py, pairs.len(), || match method {
        "soft" => Ok(soft_search(scores, &pairs, decay(sigma), rules(&numbers))?.0),
        "matrix" => matrix(scores, &pairs, decay(sigma), rules(&numbers)),
        _ => {
            let (kept, _) = cluster(scores, &pairs, rules(&numbers))?;
            let kept = kept.into_iter().map(|index| Kept {
                index,
                score: scores[index],
            });
            Ok(kept.collect())
        }
    })?;
    if !matches!(method, "soft" | "matrix" | "cluster") {
        return Err(PyKeyError::new_err(method.to_owned()));
    }
    let kept: Vec<Kept<f64>> = found.map_err(raised)?;
    Ok((
        PyArray1::from_iter(py, kept.iter().map(|one| one.index as i64)),
        PyArray1::from_iter(py, kept.iter().map(|one| one.score)),
    ))
}

/// The rows and columns of the one-to-one pairs with the largest sum of gains: as many as the shorter side has.
#[pyfunction]
pub fn assigned_matrix<'py>(
    py: Python<'py>,
    gains: PyReadonlyArray2<'py, f64>,
) -> PyResult<(Array<'py, i64>, Array<'py, i64>)> {
    let (rows, columns) = (gains.shape()[0], gains.shape()[1]);
    let numbers = gains.as_slice()?;
    let found = on_threads(py, numbers.len(), || {
        let interruption = Interruption::current();
        assignment::optimal_until(numbers, rows, columns, &|| interruption.is_due())
    })?;
    let found = found.map_err(raised)?;
    Ok((
        PyArray1::from_iter(py, found.iter().map(|pair| pair.0 as i64)),
        PyArray1::from_iter(py, found.iter().map(|pair| pair.1 as i64)),
    ))
}

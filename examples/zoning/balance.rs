//! Weights by Newton's method, and moves of stations to the centroids of their districts.
use crate::city::City;
use geograd::cells::PowerDiagram;
use geograd::{Error, Polygon, Vec2};

/// Areas this near to their capacities are equal to them.
const NEAR: f64 = 1e-12;
/// Steps of Newton's method at most: beyond, areas are as near as roundings let them.
const STEPS: usize = 60;

/// The state after a move of the stations and the balance of their districts.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// Steps of Newton's method.
    pub steps: usize,
    /// The largest difference of an area and its capacity, relative to the capacity.
    pub error: f64,
    /// The root of the mean squared way to a station.
    pub way: f64,
}

/// The found stations and weights, with what led there.
pub struct Plan {
    pub stations: Vec<Vec2<f64>>,
    pub weights: Vec<f64>,
    /// Areas over capacities of districts that go by the nearest station.
    pub loads: Vec<f64>,
    /// Errors of the first balance, before and after every step.
    pub errors: Vec<f64>,
    pub rounds: Vec<Round>,
}

/// The matrix of derivatives of areas by weights: `(row, column, number)`.
type Slopes = [(usize, usize, f64)];

/// Solves `slopes · x = right` by conjugate gradients, for a right side with the sum zero: the matrix is symmetric,
/// positive on all `x` that are not constant, and zero on those.
fn solved(slopes: &Slopes, right: &[f64]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut diagonal = vec![1.0; right.len()];
    for &(i, j, slope) in slopes {
        if i == j && slope > 0.0 {
            diagonal[i] = slope;
        }
    }
    let eased = |rest: &[f64]| -> Vec<f64> {
        let way: Vec<_> = rest.iter().zip(&diagonal).map(|(r, d)| r / d).collect();
        let mean = way.iter().sum::<f64>() / way.len() as f64;
        way.into_iter().map(|x| x - mean).collect()
    };
    let mut found = vec![0.0; right.len()];
    let mut rest = right.to_vec();
    let mut way = eased(&rest);
    let mut size = dot(&rest, &way);
    let small = 1e-30 * size;
    for _ in 0..10 * right.len() {
        if size <= small {
            break;
        }
        let mut image = vec![0.0; right.len()];
        for &(i, j, slope) in slopes {
            image[i] += slope * way[j];
        }
        let length = size / dot(&way, &image);
        for (k, along) in way.iter().enumerate() {
            found[k] += length * along;
            rest[k] -= length * image[k];
        }
        let next = eased(&rest);
        let grown = dot(&rest, &next);
        for (along, fresh) in way.iter_mut().zip(next) {
            *along = fresh + grown / size * *along;
        }
        size = grown;
    }
    found
}

/// Areas and capacities, and how far they are from each other.
struct Balance<'a> {
    domain: &'a Polygon<f64>,
    capacities: &'a [f64],
}

impl Balance<'_> {
    /// The areas of districts.
    fn areas(&self, stations: &[Vec2<f64>], weights: &[f64]) -> Result<Vec<f64>, Error> {
        let diagram = PowerDiagram::new(stations, weights, self.domain)?;
        Ok(diagram.cells(&diagram.search()).areas())
    }

    /// The largest error relative to a capacity.
    fn error(&self, areas: &[f64]) -> f64 {
        let errors = areas.iter().zip(self.capacities);
        errors.map(|(a, c)| (a - c).abs() / c).fold(0.0, f64::max)
    }

    /// Newton's method with shorter steps where a district would vanish or the error would not shrink (Kitagawa, Mérigot
    /// and Thibert 2019). Returns the errors before and after every step.
    fn solve(&self, stations: &[Vec2<f64>], weights: &mut Vec<f64>) -> Result<Vec<f64>, Error> {
        let least = |areas: &[f64]| areas.iter().copied().fold(f64::INFINITY, f64::min);
        let mut errors = Vec::new();
        let mut floor = None;
        for _ in 0..STEPS {
            let diagram = PowerDiagram::new(stations, weights, self.domain)?;
            let trace = diagram.search();
            let cells = diagram.cells(&trace);
            let areas = cells.areas();
            let error = self.error(&areas);
            errors.push(error);
            if error <= NEAR {
                break;
            }
            let floor = *floor.get_or_insert(0.5 * least(&areas).min(least(self.capacities)));
            let missing: Vec<f64> = (areas.iter().zip(self.capacities))
                .map(|(a, c)| c - a)
                .collect();
            let norm = |all: &[f64]| {
                let parts = all
                    .iter()
                    .zip(self.capacities)
                    .map(|(a, c)| (a - c).powi(2));
                parts.sum::<f64>().sqrt()
            };
            let step = solved(&cells.area_slopes(), &missing);
            let mut share = 1.0;
            let next = loop {
                let next: Vec<f64> = (weights.iter().zip(&step))
                    .map(|(w, s)| w + share * s)
                    .collect();
                let found = self.areas(stations, &next)?;
                let is_less = norm(&found) <= (1.0 - 0.5 * share) * norm(&areas);
                if (least(&found) >= floor && is_less) || share < 1e-3 {
                    break next;
                }
                share *= 0.5;
            };
            // Roundings are left.
            if share < 1e-3 {
                break;
            }
            *weights = next;
        }
        Ok(errors)
    }
}

impl Plan {
    /// Balances the districts, and moves the stations so many times; `tick` is called after each.
    pub fn run(city: &City, rounds: usize, tick: impl Fn()) -> Result<Self, Error> {
        let balance = Balance {
            domain: &city.domain,
            capacities: &city.capacities,
        };
        let areas = balance.areas(&city.stations, &[])?;
        let mut plan = Plan {
            stations: city.stations.clone(),
            weights: vec![0.0; city.stations.len()],
            loads: (areas.iter().zip(&city.capacities))
                .map(|(a, c)| a / c)
                .collect(),
            errors: Vec::new(),
            rounds: Vec::with_capacity(rounds + 1),
        };
        for round in 0..=rounds {
            let errors = balance.solve(&plan.stations, &mut plan.weights)?;
            let diagram = PowerDiagram::new(&plan.stations, &plan.weights, balance.domain)?;
            let trace = diagram.search();
            let cells = diagram.cells(&trace);
            let moments = cells.moments();
            let squares = moments.iter().map(|own| own.second).sum::<f64>();
            plan.rounds.push(Round {
                steps: errors.len() - 1,
                error: balance.error(&cells.areas()),
                way: (squares / city.area()).sqrt(),
            });
            if round == 0 {
                plan.errors = errors;
            }
            if round < rounds {
                plan.stations = moved(&balance, &plan, &cells.centroids())?;
                tick();
            }
        }
        Ok(plan)
    }
}

/// The stations nearer to the centroids: as near as every district keeps half of its capacity by the present weights, so
/// that Newton's method has a start.
fn moved(
    balance: &Balance<'_>,
    plan: &Plan,
    centroids: &[Vec2<f64>],
) -> Result<Vec<Vec2<f64>>, Error> {
    let mut share = 1.0;
    loop {
        let ways = plan.stations.iter().zip(centroids);
        let next: Vec<_> = ways
            .map(|(&from, &to)| from + (to - from) * share)
            .collect();
        let areas = balance.areas(&next, &plan.weights)?;
        let mut pairs = areas.iter().zip(balance.capacities);
        if pairs.all(|(a, c)| *a >= 0.5 * c) || share < 1e-6 {
            return Ok(next);
        }
        share *= 0.5;
    }
}

//! The descent.
use crate::forms::{CONTAINER, Form, Kind, Place, Step};
use crate::judge::Judge;
use common::random::Draw;
use geograd::Error;
use geograd::kernels::Backend;

/// How long the first step is, in units of length and in radians.
const STEP: f64 = 0.08;

/// Shapes with their places before and after, and every step between.
pub struct Layout {
    pub forms: Vec<Form>,
    pub start: Vec<Place<f64>>,
    pub found: Vec<Place<f64>>,
    pub steps: Vec<Step>,
}

impl Layout {
    /// Shapes and a start of a seed, moved so many steps; `tick` is called after each.
    pub fn run(
        backend: Backend<'_>,
        seed: u64,
        iterations: usize,
        tick: impl Fn(),
    ) -> Result<Self, Error> {
        let mut draw = Draw::new(&[seed]);
        let forms: Vec<Form> = (0..12)
            .map(|k| Form::random(Kind::ALL[k % 4], &mut draw))
            .collect();
        let start: Vec<Place<f64>> = (forms.iter())
            .map(|_| {
                let mut within = |reach: f64| reach * (2.0 * f64::from(draw.uniform()) - 1.0);
                [within(1.5), within(1.0), within(3.0)]
            })
            .collect();
        let mut layout = Layout {
            found: start.clone(),
            start,
            forms,
            steps: Vec::with_capacity(iterations + 1),
        };
        let mut judge = Judge::new(backend, &layout.forms)?;
        // Adam (Kingma and Ba 2015), with steps that get shorter.
        let mut mean = vec![[0.0; 3]; layout.forms.len()];
        let mut square = mean.clone();
        for t in 0..iterations {
            let (step, derivatives) = judge.judge(&layout.found)?;
            layout.steps.push(step);
            let share = t as f64 / iterations as f64;
            let length = STEP * (1.0 - share).powi(2);
            let turns = (t + 1) as i32;
            let (first, second) = (1.0 - 0.9_f64.powi(turns), 1.0 - 0.99_f64.powi(turns));
            for (i, derivative) in derivatives.iter().enumerate() {
                for (k, s) in derivative.iter().enumerate() {
                    mean[i][k] = 0.9 * mean[i][k] + 0.1 * s;
                    square[i][k] = 0.99 * square[i][k] + 0.01 * s * s;
                    let along = mean[i][k] / first / ((square[i][k] / second).sqrt() + 1e-9);
                    layout.found[i][k] -= length * along;
                }
            }
            // A stuck layout is shaken, less and less, in the first half.
            if t % 40 == 39 && share < 0.5 && step.penetration > 1e-2 {
                for place in &mut layout.found {
                    for x in place {
                        *x += 0.15 * (1.0 - 2.0 * share) * f64::from(draw.normal());
                    }
                }
            }
            tick();
        }
        layout.steps.push(judge.judge(&layout.found)?.0);
        Ok(layout)
    }

    /// The share of the container that shapes take.
    pub fn filled(&self) -> f64 {
        let area: f64 = self.forms.iter().map(|form| form.area()).sum();
        area / (4.0 * CONTAINER[0] * CONTAINER[1])
    }
}

//! Faults, made of right gradients: operators on the result, on the formula, and on the rules of differentiation.
use crate::corpus::function::Function;
use crate::corpus::inputs::{Inputs, NEAR};
use crate::corpus::kind::Kind;
use crate::corpus::mutant::{Mistake, Mutant, Place, mistaken};
use std::sync::{Arc, Mutex};

/// A gradient, right or wrong.
pub type Gradient = Box<dyn Fn(&[f64]) -> Vec<f64>>;

/// A wrong gradient.
pub struct Fault {
    /// The kind of mistake.
    pub kind: Kind,
    /// The mistake in words.
    pub what: String,
    fresh: Box<dyn Fn() -> Gradient + Send + Sync>,
}

impl Fault {
    /// A fresh copy of the gradient, without any earlier call.
    #[must_use]
    pub fn gradient(&self) -> Gradient {
        (self.fresh)()
    }
    fn new(
        kind: Kind,
        what: String,
        f: impl Fn(&[f64]) -> Vec<f64> + Send + Sync + 'static,
    ) -> Self {
        let f = Arc::new(f);
        let fresh = Box::new(move || -> Gradient {
            let f = Arc::clone(&f);
            Box::new(move |x| f(x))
        });
        Fault { kind, what, fresh }
    }
}

/// All faults of a function. Some change nothing at the inputs, or nothing but rounding:
/// [`Inputs::error`] tells.
#[must_use]
pub fn faults(function: &'static Function, inputs: &Inputs) -> Vec<Fault> {
    let mut all = Vec::new();
    for &(what, wrong) in function.wrong {
        all.push(Fault::new(Kind::ByHand, what.to_owned(), wrong));
    }
    mistakes(function, inputs, &mut all);
    single_derivatives(function, inputs, &mut all);
    whole_gradients(function, &mut all);
    places(function, inputs, &mut all);
    all
}

/// One step of the formula, and one rule of differentiation.
fn mistakes(function: &'static Function, inputs: &Inputs, all: &mut Vec<Fault>) {
    let constant = |&value: &f64| Mutant {
        value,
        derivative: 0.0,
    };
    let (mut steps, mut rules) = (0, 0);
    for x in &inputs.points {
        let x: Vec<Mutant> = x.iter().map(constant).collect();
        steps = steps.max(mistaken(None, || (function.gradient_mutant)(&x)).1);
        rules = rules.max(mistaken(None, || (function.value_mutant)(&x)).1);
    }
    for (second, at) in [false, true]
        .into_iter()
        .flat_map(|s| (0..steps).map(move |at| (s, at)))
    {
        let mistake = Mistake {
            place: Place::Value,
            at,
            second,
        };
        all.push(Fault::new(
            Kind::Formula,
            format!("step {at}, {}", u8::from(second)),
            move |x| {
                let x: Vec<Mutant> = x.iter().map(constant).collect();
                let (g, _) = mistaken(Some(mistake), || (function.gradient_mutant)(&x));
                g.iter().map(|g| g.value).collect()
            },
        ));
    }
    for (second, at) in [false, true]
        .into_iter()
        .flat_map(|s| (0..rules).map(move |at| (s, at)))
    {
        let mistake = Mistake {
            place: Place::Derivative,
            at,
            second,
        };
        all.push(Fault::new(
            Kind::Rule,
            format!("step {at}, {}", u8::from(second)),
            move |x| {
                let derivative = |i: usize| {
                    let seed = |(k, &value): (usize, &f64)| Mutant {
                        value,
                        derivative: f64::from(k == i),
                    };
                    let x: Vec<Mutant> = x.iter().enumerate().map(seed).collect();
                    mistaken(Some(mistake), || (function.value_mutant)(&x))
                        .0
                        .derivative
                };
                (0..x.len()).map(derivative).collect()
            },
        ));
    }
}

/// Adds the faults of one derivative.
fn single_derivatives(function: &'static Function, inputs: &Inputs, all: &mut Vec<Fault>) {
    let n = function.domain.len();
    let right = function.gradient;
    for i in 0..n {
        let mut one = |kind, what: String, f: Box<dyn Fn(&[f64], &[f64]) -> f64 + Send + Sync>| {
            all.push(Fault::new(
                kind,
                format!("derivative {i} {what}"),
                move |x| {
                    let mut g = right(x);
                    g[i] = f(x, &g);
                    g
                },
            ));
        };
        one(Kind::Sign, "negated".into(), Box::new(move |_, g| -g[i]));
        one(Kind::Dropped, "zero".into(), Box::new(|_, _| 0.0));
        for factor in [2.0, 0.5] {
            one(
                Kind::Factor,
                format!("times {factor}"),
                Box::new(move |_, g| factor * g[i]),
            );
        }
        for power in 1..=6 {
            let factor = 1.0 + 0.1_f64.powi(i32::from(power));
            one(
                Kind::Off(power),
                format!("times {factor}"),
                Box::new(move |_, g| factor * g[i]),
            );
        }
        one(
            Kind::Neighbour,
            "of the next".into(),
            Box::new(move |_, g| g[(i + 1) % n]),
        );
        one(
            Kind::Power,
            "times its number".into(),
            Box::new(move |x, g| g[i] * x[i]),
        );
        one(
            Kind::Power,
            "over its number".into(),
            Box::new(move |x, g| g[i] / x[i]),
        );
        for share in [1e-1, 1e-3, 1e-5] {
            let more = share * inputs.usual[i].max(f64::MIN_POSITIVE);
            one(
                Kind::Added,
                format!("plus {more:.1e}"),
                Box::new(move |_, g| g[i] + more),
            );
        }
        let median = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let high = |[low, high]: [f64; 2]| low + 0.7 * (high - low);
        let places = if n > 1 { vec![i, (i + 1) % n] } else { vec![i] };
        for k in places {
            let (half, corner) = (median(function.domain[k]), high(function.domain[k]));
            let j = (k + 1) % n;
            let other = high(function.domain[j]);
            one(
                Kind::HalfDomain,
                format!("off where number {k} is large"),
                Box::new(move |x, g| if x[k] > half { 1.1 * g[i] } else { g[i] }),
            );
            if k == i && n > 1 {
                one(
                    Kind::Corner,
                    format!("off where numbers {k} and {j} are large"),
                    Box::new(move |x, g| {
                        if x[k] > corner && x[j] > other {
                            1.1 * g[i]
                        } else {
                            g[i]
                        }
                    }),
                );
            }
        }
    }
    for i in 0..n {
        for j in 0..i {
            all.push(Fault::new(
                Kind::Exchanged,
                format!("derivatives {j} and {i}"),
                move |x| {
                    let mut g = right(x);
                    g.swap(i, j);
                    g
                },
            ));
        }
    }
}

/// Adds the faults of all derivatives together.
fn whole_gradients(function: &'static Function, all: &mut Vec<Fault>) {
    let (value, right) = (function.value, function.gradient);
    let mut whole =
        |kind, what: &str, f: Box<dyn Fn(&[f64], Vec<f64>) -> Vec<f64> + Send + Sync>| {
            all.push(Fault::new(kind, what.to_owned(), move |x| f(x, right(x))));
        };
    let by =
        |factor: f64| move |g: Vec<f64>| -> Vec<f64> { g.iter().map(|g| factor * g).collect() };
    whole(Kind::Sign, "all negated", Box::new(move |_, g| by(-1.0)(g)));
    whole(Kind::Dropped, "all zero", Box::new(move |_, g| by(0.0)(g)));
    whole(
        Kind::Factor,
        "all doubled",
        Box::new(move |_, g| by(2.0)(g)),
    );
    whole(Kind::Factor, "all halved", Box::new(move |_, g| by(0.5)(g)));
    whole(
        Kind::Exchanged,
        "all one place on",
        Box::new(|_, mut g| {
            g.rotate_left(1);
            g
        }),
    );
    whole(
        Kind::Exchanged,
        "all in reverse",
        Box::new(|_, mut g| {
            g.reverse();
            g
        }),
    );
    whole(
        Kind::Outer,
        "of the square",
        Box::new(move |x, g| by(2.0 * value(x))(g)),
    );
    whole(
        Kind::Outer,
        "of the root",
        Box::new(move |x, g| by(0.5 / value(x).abs().sqrt())(g)),
    );
    whole(
        Kind::Outer,
        "of the logarithm",
        Box::new(move |x, g| by(1.0 / value(x))(g)),
    );
    whole(
        Kind::Outer,
        "of the exponential",
        Box::new(move |x, g| by(value(x).exp())(g)),
    );
    whole(
        Kind::Single,
        "rounded",
        Box::new(|_, g| g.iter().map(|&g| f64::from(g as f32)).collect()),
    );
    let single = function.gradient_single;
    all.push(Fault::new(Kind::Single, "computed".to_owned(), move |x| {
        let x: Vec<f32> = x.iter().map(|&x| x as f32).collect();
        single(&x).into_iter().map(f64::from).collect()
    }));
    for (what, step, central) in [
        ("ahead, 1e-6", 1e-6, false),
        ("ahead, 1e-3", 1e-3, false),
        ("both sides, 1e-3", 1e-3, true),
    ] {
        all.push(Fault::new(Kind::Difference, what.to_owned(), move |x| {
            let at = |i: usize, by: f64| {
                let mut x = x.to_vec();
                x[i] += by;
                value(&x)
            };
            let derivative = |i| {
                let behind = if central { step } else { 0.0 };
                (at(i, step) - at(i, -behind)) / (step + behind)
            };
            (0..x.len()).map(derivative).collect()
        }));
    }
    all.push(Fault {
        kind: Kind::Stale,
        what: "sum not cleared".to_owned(),
        fresh: Box::new(move || {
            let sum = Mutex::new(vec![0.0; function.domain.len()]);
            Box::new(move |x| {
                let mut sum = sum.lock().expect("nobody panics inside");
                sum.iter_mut().zip(right(x)).for_each(|(sum, g)| *sum += g);
                sum.clone()
            })
        }),
    });
}

/// Adds the faults in one place.
fn places(function: &'static Function, inputs: &Inputs, all: &mut Vec<Fault>) {
    let right = function.gradient;
    let widths: Vec<f64> = function
        .domain
        .iter()
        .map(|[low, high]| high - low)
        .collect();
    for (i, width) in widths.iter().enumerate() {
        for share in [1e-2, 1e-4, 1e-6] {
            let by = share * width;
            all.push(Fault::new(
                Kind::OtherPlace,
                format!("number {i} plus {by:.1e}"),
                move |x| {
                    let mut x = x.to_vec();
                    x[i] += by;
                    right(&x)
                },
            ));
        }
        // Some input among the random ones.
        let special = inputs.points[i % inputs.points.len()].clone();
        for factor in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
            let kind = if factor.is_finite() {
                Kind::OneInput
            } else {
                Kind::NotFinite
            };
            let special = special.clone();
            all.push(Fault::new(
                kind,
                format!("derivative {i} times {factor} at {special:?}"),
                move |x| {
                    let mut g = right(x);
                    if x == special {
                        g[i] *= factor;
                    }
                    g
                },
            ));
        }
    }
    for &kink in function.kinks {
        let (near, n) = (widths.clone(), kink.len());
        let mirrored =
            move |x: &[f64]| -> Vec<f64> { (0..n).map(|i| 2.0 * kink[i] - x[i]).collect() };
        all.push(Fault::new(
            Kind::OtherSide,
            format!("of {kink:?}"),
            move |x| {
                let close = (0..n).all(|i| (x[i] - kink[i]).abs() <= NEAR[0] * near[i]);
                if close && x != kink {
                    right(&mirrored(x))
                } else {
                    right(x)
                }
            },
        ));
        let beside = widths.clone();
        let around = move |side: f64| -> Vec<f64> {
            let x: Vec<f64> = (0..n)
                .map(|i| kink[i] + side * 1e-6 * beside[i] / (i + 1) as f64)
                .collect();
            right(&x)
        };
        let at: [(&str, Arc<dyn Fn() -> Vec<f64> + Send + Sync>); 4] = [
            ("sum of both sides", {
                let around = around.clone();
                Arc::new(move || {
                    around(1.0)
                        .iter()
                        .zip(around(-1.0))
                        .map(|(a, b)| a + b)
                        .collect()
                })
            }),
            ("beyond one side", {
                let around = around.clone();
                Arc::new(move || {
                    around(1.0)
                        .iter()
                        .zip(around(-1.0))
                        .map(|(a, b)| 2.0 * a - b)
                        .collect()
                })
            }),
            (
                "half of a side",
                Arc::new(move || around(1.0).iter().map(|g| 0.5 * g).collect()),
            ),
            ("not a number", Arc::new(move || vec![f64::NAN; n])),
        ];
        for (what, at) in at {
            let kind = match what {
                "not a number" => Kind::NotFinite,
                _ => Kind::AtKink,
            };
            all.push(Fault::new(kind, format!("{what}, {kink:?}"), move |x| {
                if x == kink { at() } else { right(x) }
            }));
        }
    }
}

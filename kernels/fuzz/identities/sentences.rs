//! The identities.
use super::operands::ArgumentRanges;

/// An input, and the result of the identity's own row.
pub(crate) struct Case<'a> {
    pub(super) parts: &'a ArgumentRanges,
    pub(super) input: &'a [f64],
    pub(super) value: Vec<f64>,
    /// The largest error of a length that rounding explains for this input.
    pub(super) slack: f64,
}

impl Case<'_> {
    /// Returns the numbers of an argument.
    pub(super) fn argument(&self, k: usize) -> Vec<f64> {
        self.input[self.parts.range(k)].to_vec()
    }
    /// Returns some numbers of the result.
    pub(super) fn value(&self, range: std::ops::Range<usize>) -> Vec<f64> {
        self.value[range].to_vec()
    }
    /// Returns the number of coordinates of a point.
    pub(super) fn dimension(&self) -> usize {
        self.parts.dimension
    }
    /// Returns `true` for numbers that differ by rounding only.
    pub(super) fn near(&self, x: f64, y: f64) -> bool {
        (x - y).abs() <= self.slack
    }
}

/// A shape that a row takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ShapeOf {
    /// The shape of an argument.
    Argument(usize),
    Point,
}

/// A result to compare with: of a row with some verb and arguments.
#[derive(Debug)]
pub(super) struct Question {
    /// Its verb; an empty name is the identity's own verb.
    pub verb: &'static str,
    /// Its shapes, in either order.
    pub of: [ShapeOf; 2],
    /// Its arguments' numbers; `None` where the comparison does not apply.
    pub arguments: fn(&Case<'_>) -> Option<[Vec<f64>; 2]>,
}

/// An identity between the results of some rows.
#[derive(Debug)]
pub(super) struct Sentence {
    pub name: &'static str,
    /// The verbs of the rows that it concerns.
    pub verbs: &'static [&'static str],
    pub asks: &'static [Question],
    /// The number of roundings of the largest coordinate by which results may differ, beside the error of searches.
    pub roundings: f64,
    /// The identity, given the first numbers of the results to compare with.
    pub holds: fn(&Case<'_>, &[f64]) -> bool,
}

const A: ShapeOf = ShapeOf::Argument(0);
const B: ShapeOf = ShapeOf::Argument(1);
const POINT: ShapeOf = ShapeOf::Point;

/// Returns the question for a verb with the arguments in order.
const fn same(verb: &'static str) -> Question {
    Question {
        verb,
        of: [A, B],
        arguments: |case| Some([case.argument(0), case.argument(1)]),
    }
}

const DISTANCES: &[&str] = &["distance", "signed_distance"];

/// All identities.
pub(super) const SENTENCES: &[Sentence] = &[
    Sentence {
        name: "exchange",
        verbs: &[
            "distance",
            "signed_distance",
            "squared_distance",
            "farthest_distance",
        ],
        asks: &[Question {
            verb: "",
            of: [B, A],
            arguments: |case| Some([case.argument(1), case.argument(0)]),
        }],
        roundings: 64.0,
        holds: |case, exchanged| case.near(case.value[0], exchanged[0]),
    },
    Sentence {
        name: "the distance is the signed one or zero",
        verbs: &["distance"],
        asks: &[same("signed_distance")],
        roundings: 64.0,
        holds: |case, signed| case.near(case.value[0], signed[0].max(0.0)),
    },
    Sentence {
        name: "the square is that of the distance",
        verbs: &["squared_distance"],
        asks: &[same("distance")],
        roundings: 64.0,
        holds: |case, distance| case.near(case.value[0].sqrt(), distance[0]),
    },
    Sentence {
        name: "closest points are as far apart as the distance",
        verbs: &["closest_points"],
        asks: &[same("distance")],
        roundings: 64.0,
        // Inside each other the points show the depth.
        holds: |case, distance| distance[0] == 0.0 || case.near(between(case), distance[0]),
    },
    Sentence {
        name: "closest points are as far apart as the signed distance says",
        verbs: &["closest_points"],
        asks: &[same("signed_distance")],
        roundings: 256.0,
        holds: |case, signed| case.near(between(case), signed[0].abs()),
    },
    Sentence {
        name: "the first of the closest points lies on its shape",
        verbs: &["closest_points"],
        asks: &[Question {
            verb: "distance",
            of: [POINT, A],
            arguments: |case| Some([case.value(0..case.dimension()), case.argument(0)]),
        }],
        roundings: 64.0,
        holds: |case, distance| distance[0] <= case.slack,
    },
    Sentence {
        name: "the second of the closest points lies on its shape",
        verbs: &["closest_points"],
        asks: &[Question {
            verb: "distance",
            of: [POINT, B],
            arguments: |case| {
                let n = case.dimension();
                Some([case.value(n..2 * n), case.argument(1)])
            },
        }],
        roundings: 64.0,
        holds: |case, distance| distance[0] <= case.slack,
    },
    Sentence {
        name: "the depth is minus the signed distance",
        verbs: &["penetration"],
        asks: &[same("signed_distance")],
        roundings: 64.0,
        holds: |case, signed| case.near(case.value[0], -signed[0].min(0.0)),
    },
    Sentence {
        name: "hits lie on the shape",
        verbs: &["first_hit"],
        asks: &[at_the_hit("distance")],
        roundings: 256.0,
        holds: |case, distance| distance[0] <= case.slack,
    },
    Sentence {
        name: "hits lie on the border",
        verbs: &["first_hit"],
        asks: &[at_the_hit("signed_distance")],
        roundings: 256.0,
        holds: |case, signed| signed[0].abs() <= case.slack,
    },
    Sentence {
        name: "what is hit is no distance away",
        verbs: &["first_hit"],
        asks: &[same("distance")],
        roundings: 256.0,
        holds: |case, distance| !is_hit(case) || distance[0] <= case.slack,
    },
    Sentence {
        name: "segments without distance meet",
        verbs: &["meeting"],
        asks: &[same("distance")],
        roundings: 64.0,
        holds: |case, distance| {
            let is_met = case.value[4] != 0.0;
            match shares_an_end(case) {
                true => is_met,
                false => !is_met || distance[0] <= case.slack,
            }
        },
    },
    Sentence {
        name: "what is inside is no distance away",
        verbs: &["length_inside"],
        asks: &[same("distance")],
        roundings: 256.0,
        holds: |case, distance| case.value[0] <= case.slack.sqrt() || distance[0] <= case.slack,
    },
    Sentence {
        name: "the middle of a span lies in the shape",
        verbs: &["span"],
        asks: &[Question {
            verb: "distance",
            of: [POINT, B],
            arguments: |case| {
                let (n, line) = (case.dimension(), case.argument(0));
                let middle = 0.5 * (case.value[0] + case.value[1]);
                let point = (0..n).map(|i| line[i] + middle * line[n + i]).collect();
                (case.value[2] != 0.0).then(|| [point, case.argument(1)])
            },
        }],
        roundings: 256.0,
        holds: |case, distance| distance[0] <= case.slack,
    },
    Sentence {
        name: "a shape's own points are no distance away",
        verbs: DISTANCES,
        asks: &[Question {
            verb: "",
            of: [POINT, B],
            arguments: |case| {
                let points = case.parts.own_points();
                // The input selects one of them.
                let bits = case
                    .input
                    .iter()
                    .fold(0, |bits: u64, x| bits.rotate_left(7) ^ x.to_bits());
                let point = points.get((bits % 61) as usize % points.len().max(1))?;
                Some([case.input[point.clone()].to_vec(), case.argument(1)])
            },
        }],
        roundings: 64.0,
        holds: |case, distance| distance[0] <= case.slack,
    },
    shrunk(
        "a second shape of no size is the point that it is",
        &[
            Question {
                verb: "",
                of: [A, B],
                arguments: |case| Some([case.argument(0), shrunk_shape(case, 1)?]),
            },
            Question {
                verb: "",
                of: [POINT, A],
                arguments: |case| Some([shrunk_point(case, 1)?, case.argument(0)]),
            },
        ],
    ),
    shrunk(
        "a first shape of no size is the point that it is",
        &[
            Question {
                verb: "",
                of: [A, B],
                arguments: |case| Some([shrunk_shape(case, 0)?, case.argument(1)]),
            },
            Question {
                verb: "",
                of: [POINT, B],
                arguments: |case| Some([shrunk_point(case, 0)?, case.argument(1)]),
            },
        ],
    ),
];

/// Returns the sentence that the distance from a shrunk shape is the distance from the point.
const fn shrunk(name: &'static str, asks: &'static [Question]) -> Sentence {
    Sentence {
        name,
        verbs: DISTANCES,
        asks,
        roundings: 64.0,
        holds: |case, found| case.near(found[0], found[1]),
    }
}

/// Returns the numbers of an argument that has shrunk to a point.
fn shrunk_shape(case: &Case<'_>, k: usize) -> Option<Vec<f64>> {
    Some(case.parts.shrunk(case.input, k)?.0)
}

/// Returns the point that an argument shrinks to.
fn shrunk_point(case: &Case<'_>, k: usize) -> Option<Vec<f64>> {
    Some(case.parts.shrunk(case.input, k)?.1)
}

/// Returns a verb of the point that a ray hits, and of the shape.
const fn at_the_hit(verb: &'static str) -> Question {
    Question {
        verb,
        of: [POINT, B],
        arguments: |case| {
            let point = case.value(1..1 + case.dimension());
            is_hit(case).then(|| [point, case.argument(1)])
        },
    }
}

/// Returns `true` if the result is a hit.
fn is_hit(case: &Case<'_>) -> bool {
    case.value[2 * case.dimension() + 1] != 0.0
}

/// Returns the distance of the two points with which a result begins.
fn between(case: &Case<'_>) -> f64 {
    let (n, points) = (case.dimension(), &case.value);
    let squares = (0..n).map(|i| (points[i] - points[n + i]).powi(2));
    squares.sum::<f64>().sqrt()
}

/// Returns `true` for two segments that share an end.
fn shares_an_end(case: &Case<'_>) -> bool {
    let (a, b) = (case.argument(0), case.argument(1));
    let mut ends = a
        .chunks(2)
        .flat_map(|end| b.chunks(2).map(move |other| (end, other)));
    ends.any(|(end, other)| end == other)
}

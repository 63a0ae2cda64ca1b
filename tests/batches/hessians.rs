//! Hessians of all rows of one number where shapes are aligned, parallel or concentric: beside differences of their
//! gradients.
use geograd::ad::sample::Draw;
use geograd::kernels::dynamic::{Layout, Operation, Sort, operations};
use geograd_tests::list::are_sampled;

/// Inputs of a row.
const COUNT: usize = 6;
/// The step of differences; gradients are right to rounding, so that these are to about 10⁻¹⁰.
const STEP: f64 = 1.0 / (1 << 17) as f64;
/// Differences of both sides and of two steps that are nearer to each other, of themselves and of one, are those of a
/// smooth function.
const SMOOTH: f64 = 1e-3;
/// Hessians and differences agree to this share of them and of one.
const NEAR: f64 = 5e-3;
/// How far the neighbours of an input are, and how far differences there may be from those here where no two formulas
/// meet: second derivatives jump between a face and its edge, though gradients do not.
const BESIDE: f64 = 1.0 / (1 << 12) as f64;
const PAIRS: usize = 6;
const ALIKE: f64 = 0.02;

/// Rows of which the second derivatives are most delicate where shapes are aligned.
const ALWAYS: &[&str] = &[
    "iou_obb2",
    "iou_obb3",
    "iof_obb3",
    "iou_yaw_obb3",
    "giou_obb3",
    "giou_rectangle_yaw",
    "kullback_leibler_obb3",
    "signed_distance_obb3",
    "signed_distance_tetrahedra",
    "signed_distance_capsules3",
    "distance_segments3",
];

/// How a number of a shape is drawn.
enum Part {
    /// A coordinate of a quaternion.
    Rotation,
    Angle,
    /// A coordinate of a place, along this axis.
    Place(usize),
    /// A coordinate of a direction.
    Direction,
    /// Sizes, radii, weights.
    Other,
}

fn part(name: &str, shape: &str) -> Part {
    let (of, last) = name.rsplit_once('.').unwrap_or(("", name));
    if shape == "Rotation3" || of == "rotation" || ["qw", "qx", "qy", "qz"].contains(&last) {
        return Part::Rotation;
    }
    if ["heading", "radians", "rotation_y"].contains(&last) || of == "heading" {
        return Part::Angle;
    }
    match (of, ["x", "y", "z"].iter().position(|axis| *axis == last)) {
        ("size", _) | (_, None) => Part::Other,
        ("direction" | "normal", Some(_)) => Part::Direction,
        (_, Some(axis)) => Part::Place(axis),
    }
}

/// A valid shape with axes of the world, but for one in four, which are quarter turns; directions and differences of
/// places are small multiples of a half. Half the centres are those of an earlier shape. No two shapes share more, nor
/// has any two equal sizes: formulas change where they do, and second derivatives jump.
fn drawn(layout: &Layout<f64>, draw: &mut Draw, earlier: &[(String, f64)]) -> Option<Vec<f64>> {
    let names: Vec<String> = layout
        .names()
        .iter()
        .map(|name| name.as_str().to_owned())
        .collect();
    for attempt in 0..200 {
        let mut row = vec![0.0; layout.fields()];
        let turned = draw.below(4) == 0;
        let (axis, alike) = (draw.below(3), draw.below(2) == 0);
        let mut beside = || (1 + draw.below(999)) as f64 / 4000.0;
        let places = [(); 3].map(|()| beside());
        let sizes = [(); 16].map(|()| beside());
        let mut of_rotation = 0;
        for (k, x) in row.iter_mut().enumerate() {
            let Some(name) = names.get(k) else {
                continue;
            };
            let number = draw.below(9) as f64 / 2.0 - 2.0;
            *x = match part(name, &layout.name()) {
                Part::Rotation => {
                    of_rotation += 1;
                    let is_on = of_rotation == 1 || turned && of_rotation == axis + 2;
                    f64::from(u8::from(is_on))
                }
                Part::Angle if turned => std::f64::consts::FRAC_PI_2,
                Part::Angle => 0.0,
                Part::Place(axis) => number + places[axis],
                Part::Direction => number,
                Part::Other if attempt % 4 == 3 => number + sizes[k % 16],
                Part::Other => number.abs() + sizes[k % 16],
            };
            let before = earlier.iter().find(|(other, _)| other == name);
            let is_center = matches!(name.as_str(), "x" | "y" | "z");
            if let (Some((_, before)), true) = (before, alike && is_center) {
                *x = *before;
            }
        }
        if layout.check(&row).is_ok() {
            return Some(row);
        }
    }
    None
}

/// An input of a row, shape after shape.
fn input(operation: &Operation, draw: &mut Draw) -> Option<Vec<f64>> {
    let (mut all, mut known) = (Vec::new(), Vec::new());
    for layout in operation.layouts::<f64>() {
        let row = drawn(&layout, draw, &known)?;
        let names = layout
            .names()
            .into_iter()
            .map(|name| name.as_str().to_owned());
        known.extend(names.zip(row.iter().copied()));
        all.extend(row);
    }
    operation.is_inside(&all).then_some(all)
}

/// `true` where every shape of an input is valid.
fn is_valid(operation: &Operation, x: &[f64]) -> bool {
    let mut rest = x;
    operation.layouts::<f64>().iter().all(|layout| {
        let (own, others) = rest.split_at(layout.fields());
        rest = others;
        layout.check(own).is_ok()
    })
}

/// The mean of differences of slope `j` by coordinate `i`, on both sides, if both are valid.
fn mean_difference(
    operation: &Operation,
    slopes: &impl Fn(&[f64]) -> Vec<f64>,
    x: &[f64],
    (i, j): (usize, usize),
) -> Option<f64> {
    let [before, behind] = [-STEP, STEP].map(|step| {
        let mut x = x.to_vec();
        x[i] += step;
        is_valid(operation, &x).then(|| slopes(&x)[j])
    });
    Some((behind? - before?) / (2.0 * STEP))
}

/// `true` where valid neighbours of an input, on both sides in random directions, have the same second derivative.
fn is_smooth(
    operation: &Operation,
    slopes: &impl Fn(&[f64]) -> Vec<f64>,
    x: &[f64],
    at: (usize, usize),
    mean: f64,
) -> bool {
    let mut draw = Draw::new(11);
    (0..PAIRS).all(|_| {
        let way: Vec<f64> = x
            .iter()
            .map(|_| BESIDE * (draw.below(2001) as f64 / 1000.0 - 1.0))
            .collect();
        [-1.0, 1.0].iter().all(|sign| {
            let beside: Vec<f64> = x.iter().zip(&way).map(|(x, way)| x + sign * way).collect();
            let there = mean_difference(operation, slopes, &beside, at);
            there.is_some_and(|there| (there - mean).abs() <= ALIKE * (1.0 + mean.abs()))
        })
    })
}

/// Quotients of differences of every slope by coordinate `i`, on both sides with two steps, if all are valid.
fn quotients(
    operation: &Operation,
    slopes: &impl Fn(&[f64]) -> Vec<f64>,
    x: &[f64],
    i: usize,
) -> Option<Vec<[f64; 4]>> {
    let here = slopes(x);
    let moved = |step: f64| {
        let mut x = x.to_vec();
        x[i] += step;
        is_valid(operation, &x).then(|| (slopes(&x), step))
    };
    let [Some(a), Some(b), Some(c), Some(d)] = [-STEP, STEP, -STEP / 2.0, STEP / 2.0].map(moved)
    else {
        return None;
    };
    let quotient = |(there, step): &(Vec<f64>, f64), j: usize| (there[j] - here[j]) / step;
    let of_slope = |j| [&a, &b, &c, &d].map(|there| quotient(there, j));
    Some((0..here.len()).map(of_slope).collect())
}

/// The entries of Hessians that were compared, and what is wrong with others. No Hessian exists at an input with a kink
/// in any direction: there, only numbers are asked for.
fn compare(operation: &Operation, seed: u64) -> (usize, Vec<String>) {
    let name = operation.name;
    let program = operation.program::<f64>().expect(name);
    let gradient = program.value_grad().expect(name);
    let (hvp, mut draw) = (program.hvp().expect(name), Draw::new(seed));
    let slopes = |x: &[f64]| gradient.eval(x).expect(name)[1..].to_vec();
    let (mut compared, mut wrong) = (0, Vec::new());
    for _ in 0..COUNT {
        let Some(x) = input(operation, &mut draw) else {
            continue;
        };
        let all: Vec<_> = (0..x.len())
            .map(|i| quotients(operation, &slopes, &x, i))
            .collect();
        let is_even = |all: &[f64; 4]| {
            let mean = (all[0] + all[1]) / 2.0;
            let is_near = |x: &f64| (x - mean).abs() <= SMOOTH * (1.0 + mean.abs());
            all.iter().all(is_near)
        };
        let smooth = all.iter().flatten().flatten().all(is_even);
        for (i, all) in all.iter().enumerate() {
            let mut direction = vec![0.0; x.len()];
            direction[i] = 1.0;
            let row = hvp.eval(&[&x[..], &direction].concat()).expect(name);
            let row = &row[row.len() - x.len()..];
            if let Some(bad) = row.iter().find(|x| !x.is_finite()) {
                wrong.push(format!("{name} at {x:?}: by {i} {bad}"));
            }
            for (j, all) in all.iter().flatten().enumerate().filter(|_| smooth) {
                let mean = (all[0] + all[1]) / 2.0;
                let differs = (row[j] - mean).abs() > NEAR * (1.0 + mean.abs());
                compared += 1;
                if differs && is_smooth(operation, &slopes, &x, (i, j), mean) {
                    wrong.push(format!(
                        "{name} at {x:?}: by {i}, {j} {}, differences {mean}",
                        row[j]
                    ));
                }
            }
        }
    }
    (compared, wrong)
}

#[test]
fn hessians_of_aligned_shapes_are_differences_of_gradients() {
    let (mut rows, mut seen, mut failed) = (0, 0, Vec::new());
    let is_asked = |operation: &&Operation| {
        // The gradient of a score with a fixed weight is not that of its value.
        let is_fixed = operation.name.contains("fixed_weight");
        let is_straight = operation.sort == Sort::Straight;
        is_straight && !is_fixed && operation.value_grad::<f64>().is_some()
    };
    let all: Vec<&Operation> = operations().iter().filter(is_asked).collect();
    let names = all.iter().map(|operation| operation.name).collect();
    let chosen = are_sampled(names, ALWAYS);
    for operation in all.into_iter().filter(|x| chosen.contains(x.name)) {
        let (compared, wrong) = compare(operation, 7);
        println!("{} {compared} {}", operation.name, wrong.len());
        rows += 1;
        seen += usize::from(compared > 0);
        if let Some(first) = wrong.first() {
            failed.push(format!("{} of {compared} entries: {first}", wrong.len()));
        }
    }
    assert!(
        failed.is_empty(),
        "{} rows:\n{}",
        failed.len(),
        failed.join("\n")
    );
    assert!(seen * 10 >= rows * 9, "{seen} of {rows} rows are compared");
}

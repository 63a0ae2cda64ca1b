//! Functions of which the harness sees nothing but values and a gradient, as bindings and tools give them: it accepts
//! the right derivatives of every row at hard cases, kinks included, and refuses wrong ones.
use geograd::check::{Conventions, Jumps, Report, Sampling};
use geograd::kernels::check::Inputs;
use geograd::kernels::dynamic::{Mode, Operation, Rows, Sort};
use geograd::kernels::tested::Tested;
use geograd_tests::list::{checked, each, sample};

/// The report of a check of a row by its values and by its derivatives after `other` has changed them.
fn given(
    row: &Operation,
    samples: usize,
    hard: usize,
    other: &dyn Fn(Vec<f64>) -> Vec<f64>,
) -> Report {
    let inputs = Inputs::new(row.samplers());
    let function = |mode| row.function::<f64>(mode).expect("is of fixed size");
    let (value, vjp) = (function(Mode::Value), function(Mode::Vjp));
    let widths: Vec<usize> = vjp
        .takes()
        .iter()
        .map(|(_, layout)| layout.fields())
        .collect();
    let run =
        |function: &geograd::kernels::dynamic::Function<f64>, numbers: &[f64], widths: &[usize]| {
            let mut rest = numbers;
            let rows: Vec<Rows<'_, f64>> = widths
                .iter()
                .map(|&width| {
                    let (own, others) = rest.split_at(width);
                    rest = others;
                    Rows::new(own, width)
                })
                .collect();
            function.aligned(&rows).expect("valid").concat()
        };
    let own = value.takes().len();
    let sampling = Sampling {
        hard,
        resolution: Some(row.resolution),
        ..Sampling::new(samples, 1)
    };
    let inside = |x: &[f64]| row.is_inside(x);
    let sampling = Sampling {
        inside: Some(&inside),
        ..sampling
    };
    let conventions = Conventions {
        jumps: row.jumps,
        ..Inputs::CONVENTIONS
    };
    let check = inputs
        .check::<f64>(row.name, &sampling)
        .value(|x: Vec<f64>| run(&value, &x, &widths[..own]))
        .adjoint(|x: Vec<f64>, bar: &[f64]| other(run(&vjp, &[&x[..], bar].concat(), &widths)))
        .conventions(conventions);
    check.run()
}

/// Rows that a judge without their source cannot accept at some hard cases: of a segment along the side of a box that it
/// enters or along an edge of a tetrahedron, where derivatives are shared otherwise than between both sides; of a line
/// through a corner, and of equal flat tetrahedra, whose distance is a rounding there and not 0. Rows of poses are left out,
/// too: derivatives by cosine and sine, or by a quaternion, are differences of terms that cancel.
const SHARED_OTHERWISE: [&str; 6] = [
    "signed_distance_segment_obb2",
    "signed_distance_obb2_segment",
    "signed_distance_capsule_tetrahedron",
    "signed_distance_tetrahedra",
    "distance_line_triangle3",
    "distance_line_tetrahedron",
];

/// A sample of the straight rows, since each is asked item by item.
fn rows() -> Vec<&'static Tested> {
    let straight = |row: &&Tested| {
        let name = row.name();
        row.operation.sort == Sort::Straight
            && !name.contains("obb3")
            && !name.starts_with("move_")
            && !SHARED_OTHERWISE.contains(&name)
    };
    sample(checked().into_iter().filter(straight).collect(), &[])
}

#[test]
fn right_derivatives_of_every_row_are_accepted() {
    let rows = rows();
    each(&rows, |row| {
        let report = given(&row.operation, 6, 13, &|x| x);
        assert!(report.passed(), "{report}");
    });
}

#[test]
fn wrong_derivatives_of_every_row_are_refused() {
    let rows: Vec<_> = rows()
        .into_iter()
        .filter(|row| row.operation.jumps != Jumps::Anywhere)
        // A refused input is made simple, which takes seconds a row.
        .step_by(4)
        .collect();
    each(&rows, |row| {
        // A part in a thousand off in the first number, and half of it where that is smallest, at every place.
        let report = given(&row.operation, 6, 29, &|mut x| {
            x[0] *= 1.001;
            x
        });
        let first_counts = given(&row.operation, 6, 29, &|mut x| {
            x[0] = -x[0];
            x
        });
        assert_eq!(report.passed(), first_counts.passed(), "{report}");
    });
}

#[test]
fn a_millionth_is_refused() {
    let inputs = Inputs::new(vec![geograd::kernels::dynamic::Sampler::number(); 4]);
    let sampling = Sampling::new(200, 1);
    let check = |fault: f64| {
        let gradient = move |x: Vec<f64>| -> Vec<f64> {
            let one = |x: f64| 2.0 * x * (1.0 + if x > 1.0 { fault } else { 0.0 });
            x.into_iter().map(one).collect()
        };
        let check = inputs.check::<f64>("squares", &sampling);
        let squares = |x: Vec<f64>| x.iter().map(|x| x * x).sum::<f64>();
        check.value(squares).gradient(gradient).run()
    };
    assert!(check(0.0).passed());
    assert!(!check(1e-6).passed());
}

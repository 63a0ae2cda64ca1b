//! Every row, checked by the harness: hard cases first, then random inputs, in both formats; in `f32` with batches on
//! a GPU as further witnesses where there is one.
use crate::witness::{self, HOT};
use geograd::ad::check::Sampling;
use geograd::kernels::Backend;
use geograd::kernels::dynamic::Sort;
use geograd_tests::list::{self, Tested};

/// Random inputs per operation and format. Hard cases come on top.
const SAMPLES: usize = 100;
const SEED: u64 = 1;

/// So many operations of a program take fewer inputs.
const LONG: usize = 5000;
/// A search of so many numbers takes fewer inputs: every derivative is a replay.
const MANY: usize = 24;

/// Optimised builds take all hard cases of hot rows and every fifth of others; unoptimised ones some, and fewer random
/// inputs.
fn plan(row: &Tested) -> Sampling<'static> {
    let program = row.operation.program::<f64>();
    let is_long = program.is_ok_and(|program| program.cost().total() > LONG);
    let layouts = row.operation.layouts::<f64>();
    let numbers: usize = layouts.iter().map(|layout| layout.fields()).sum();
    let is_wide = row.operation.sort == Sort::Search && numbers > MANY;
    let is_slow = row.operation.costly;
    let (hard, samples) = match (cfg!(debug_assertions), HOT.contains(&row.name()), is_long) {
        (true, ..) if is_slow => (6 * 149, 2),
        (true, true, _) => (13, 40),
        (true, _, true) => (3 * 149, 3),
        (true, ..) => (149, 10),
        (false, true, _) => (1, SAMPLES),
        (false, ..) if is_slow => (149, SAMPLES / 10),
        (false, ..) if is_wide => (25, SAMPLES / 4),
        (false, ..) => (5, SAMPLES),
    };
    Sampling {
        hard,
        shared_ties: true,
        ..Sampling::new(samples, SEED)
    }
}

/// Optimised builds check every row; unoptimised ones a sample, hot ones included.
fn rows() -> Vec<&'static Tested> {
    match cfg!(debug_assertions) {
        true => list::sample(list::checked(), &HOT),
        false => list::checked(),
    }
}

#[test]
fn double() {
    list::each(&rows(), |row| {
        let report = row.check::<f64>(&plan(row), None);
        let report = report.expect("no batch that could fail");
        assert!(report.passed(), "{report}");
    });
}

#[test]
fn single() {
    let gpu = witness::gpu();
    let backend = gpu.as_ref().map(Backend::Gpu);
    list::each(&rows(), |row| {
        let report = row.check::<f32>(&plan(row), backend).unwrap();
        assert!(report.passed(), "{report}");
    });
}

/// Inputs at which the harness once refused what is right.
mod alarms {
    use super::*;
    use geograd::ad::check::sample::Sample;
    use geograd::ad::check::{self, Report, examine};
    use geograd::kernels::check::{Folded, Straight, WithAdjoint};
    use geograd::kernels::check::{OpSubject, check_with};
    use geograd::{Aabb2, Obb2, Vec2};
    use geograd_tests::rows::ring::Centroid;
    use geograd_tests::rows::{IntersectionAreaObb2, IofAabb2, IofObb2, IouObb2};

    /// By the random directions of the sample at which it was refused.
    fn judged<O: WithAdjoint>(pair: O::In<f64>, sample: u64) -> Report
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        judged_from::<O>(pair, check::SEED, sample)
    }
    fn judged_from<O: WithAdjoint>(pair: O::In<f64>, seed: u64, sample: u64) -> Report
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        examine(
            O::DECLARED.name,
            &Sampling::new(1, seed ^ sample),
            &[pair],
            1,
            |x, judge| {
                judge(&OpSubject::<f64>::of::<O>(x, &[], None));
            },
        )
    }

    /// Edges a ten-millionth of a millionth from parallel: the recorded function differentiated backwards keeps three
    /// digits.
    #[test]
    fn backwards_along_nearly_parallel_edges() {
        let plan = Sampling {
            hard: 0,
            ..Sampling::new(1, 1_947_457_352_151_963_172)
        };
        let report = check_with::<IntersectionAreaObb2, f64>(&plan);
        assert!(report.passed(), "{report}");
    }

    #[test]
    fn thin_boxes_cross() {
        // The length of the crossing is the difference of coordinates a thousand times as large:
        // the derivative, exactly zero, is a unit in the last place of those.
        let pair = (
            Obb2::new(
                -0.42486146573920247,
                -1.0619874081697955,
                8.0,
                0.0014724316655195474,
                -2.888910144994646,
            ),
            Obb2::new(
                -0.421875,
                -0.03318524962798741,
                8.492170491538626,
                0.0014670495840883287,
                1.0368425661331484,
            ),
        );
        for report in [
            judged::<Straight<IntersectionAreaObb2>>(pair, 63022),
            judged::<Straight<IouObb2>>(pair, 63022),
            judged::<Straight<IofObb2>>(pair, 63022),
        ] {
            assert!(report.passed(), "{report}");
        }
    }

    #[test]
    fn a_thin_box_inside_a_wide_one() {
        // A tie of two sides beside a length that is the difference of coordinates.
        let (x, y, long, heading) = (
            0.4785649281707227,
            -0.4813306703086543,
            14.29304386814869,
            2.356194490192345,
        );
        let report = judged::<Straight<IofObb2>>(
            (
                Obb2::new(x, y, long, 0.02218365629001546, heading),
                Obb2::new(x, y, long, 1.0, heading),
            ),
            38548,
        );
        assert!(report.passed(), "{report}");
    }

    #[test]
    fn curvature_of_a_ring_of_hardly_any_area() {
        // In single precision differences of its derivatives are nothing but rounding.
        let ring = [
            (0.507064700126648, -0.84375),
            (-0.1, 0.9),
            (0.53125, 0.45932847261428833),
            (-0.875, 0.71875),
            (0.453125, -0.265625),
            (-0.6095760464668274, 0.5513638257980347),
            (0.44523853063583374, 0.26195603609085083),
            (0.25456100702285767, -0.9357003569602966),
        ];
        let ring: Vec<Vec2<f64>> = ring.iter().map(|&(x, y)| Vec2::new(x, y)).collect();
        let plan = Sampling::new(1, check::SEED ^ 23144);
        let report = examine("centroid", &plan, &[([0.0; 0], ring)], 1, |x, judge| {
            judge(&OpSubject::<f32>::of::<Folded<Centroid>>(x, &[], None));
        });
        assert!(report.passed(), "{report}");
    }

    #[test]
    fn duals_of_a_thin_box_along_a_direction() {
        // Along a direction the derivatives of two areas are sums of a large term, the same in both, and
        // a small one: their difference is a unit in the last place of the large one, divided by a
        // thin area. Inputs moved by their last digits leave that rounding as it is.
        let (left, right) = (0.5821051754596889, 9.865080533307342);
        let report = judged_from::<Straight<IofAabb2>>(
            (
                Aabb2::new(left, 0.1393645740513334, right, 0.14044768784172024),
                Aabb2::new(left, 0.0, right, 1.0),
            ),
            20261121,
            61066,
        );
        assert!(report.passed(), "{report}");
    }

    #[test]
    fn steps_that_rounding_bends() {
        // Ten billion away a centre moves by no less than the sides differ: along a random direction
        // the steps are rounded apart, and what that changes is no jump.
        let place = (10000111377.222559, -10000064717.0);
        let boxes = (
            Obb2::new(place.0, place.1, 1e5, 175813.66498580552, 4.71238898038469),
            Obb2::new(place.0, place.1, 2e5, 175813.66498584853, 4.712388980380156),
        );
        let report = judged_from::<Straight<IofObb2>>(boxes, 1, 45821);
        assert!(report.passed(), "{report}");
    }

    #[test]
    fn curvature_beside_a_tie() {
        // The sides of two boxes as thin as a wall of atoms are a few hundred last digits apart: in
        // the steps that change no branch hardly a coordinate moves as it was told.
        let (low, high) = (-9.999984294219056, -9.999983948961884);
        let report = judged_from::<Straight<IofAabb2>>(
            (
                Aabb2::new(0.0, low, 10.0, high),
                Aabb2::new(
                    1.0,
                    -9.999984294218695,
                    10.004191874420597,
                    -9.999983948961775,
                ),
            ),
            777,
            23541,
        );
        assert!(report.passed(), "{report}");
    }
}

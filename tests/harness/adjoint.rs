//! Every operation of the list, checked by the harness: hard cases first, then random inputs, in
//! both formats.
use geograd::ad::check::Sampling;
use geograd_tests::list;

/// Random inputs per operation and format. Hard cases come on top.
const SAMPLES: usize = 100;
const SEED: u64 = 1;
/// Of operations with kernels of their own optimised builds take all hard cases, unoptimised ones some, and fewer
/// random inputs.
const HOT: (usize, usize) = if cfg!(debug_assertions) {
    (13, 40)
} else {
    (1, SAMPLES)
};

fn plan() -> Sampling<'static> {
    let (hard, samples) = HOT;
    Sampling {
        hard,
        shared_ties: true,
        ..Sampling::new(samples, SEED)
    }
}

/// Of boxes of any turn in space, whose programs are the longest by far: a third of the inputs of others.
const LONGEST: [&str; 3] = ["intersection_volume_obb3", "iou_obb3", "iof_obb3"];

/// For what runs as a recorded program, of which there are many: unoptimised builds take fewer inputs.
fn plan_of_rows(name: &str) -> Sampling<'static> {
    let (hard, samples) = match (cfg!(debug_assertions), LONGEST.contains(&name)) {
        (true, true) => (3 * 149, 3),
        (true, false) => (149, 10),
        (false, _) => (5, SAMPLES),
    };
    Sampling {
        hard,
        shared_ties: true,
        ..Sampling::new(samples, SEED)
    }
}

/// An operation of the list in one format is checked.
fn checked(name: &str, wide: bool, plan: &Sampling<'_>) {
    let all = list::checks();
    let found = all.iter().find(|found| (found.0, found.1) == (name, wide));
    let (_, _, check) = found.expect("an operation of the list");
    let report = check(plan, None).expect("no batch that could fail");
    assert!(report.passed(), "{report}");
}

macro_rules! check_all {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        check_all! { @each
            hot { $($pair)* $($ring)* }
            rows { $($straight)* $($fold)* $($decided)* }
            further { $($more)* $($more_fold)* $($more_search)* }
            f64 true
        }
        check_all! { @each
            hot { $($pair)* $($ring)* }
            rows { $($straight)* $($fold)* $($decided)* }
            further { $($more)* $($more_fold)* $($more_search)* }
            f32 false
        }
    };
    (@each hot { $($hot:ident)* } rows { $($row:ident)* } further { $($more:ident)* } $format:ident $wide:literal) => {
        mod $format {
            use super::*;
            $(#[test] fn $hot() {
                checked(stringify!($hot), $wide, &plan());
            })*
            $(#[test] fn $row() {
                checked(stringify!($row), $wide, &plan_of_rows(stringify!($row)));
            })*
            $(#[test] #[cfg(not(debug_assertions))] fn $more() {
                checked(stringify!($more), $wide, &plan_of_rows(stringify!($more)));
            })*
        }
    };
}
geograd::for_each_op!(check_all);

/// Inputs at which the harness once refused what is right.
mod alarms {
    use super::*;
    use geograd::ad::check::sample::Sample;
    use geograd::ad::check::{self, Report, examine};
    use geograd::kernels::Centroid;
    use geograd::kernels::check::{OpSubject, check_with};
    use geograd::kernels::op::{Ringed, Source, Straight};
    use geograd::{Aabb2, Obb2, Vec2};
    use geograd_tests::rows::{IntersectionAreaObb2, IofAabb2, IofObb2, IouObb2};

    /// By the random directions of the sample at which it was refused.
    fn judged<O: Source>(pair: O::In<f64>, sample: u64) -> Report
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        judged_from::<O>(pair, check::SEED, sample)
    }
    fn judged_from<O: Source>(pair: O::In<f64>, seed: u64, sample: u64) -> Report
    where
        O::In<f64>: Sample,
        O::Out<f64>: Sample,
    {
        examine(
            O::NAME,
            &Sampling::new(1, seed ^ sample),
            &[pair],
            1,
            |x, judge| {
                judge(&OpSubject::<O, f64>::new(x, &[], None));
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
        let report = examine("centroid", &plan, &[ring], 1, |x, judge| {
            judge(&OpSubject::<Ringed<Centroid>, f32>::new(x, &[], None));
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

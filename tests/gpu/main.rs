//! Batches on the GPU against batches on the CPU, for every operation of the list.
//!
//! Without an adapter the tests say so and pass, unless `GEOGRAD_REQUIRE_GPU=1`. A driver in
//! software will do.
mod bounds;
mod committed;
mod context;
mod dynamic;
mod faults;
mod folds;
mod generated;
mod groups;
mod held;
mod indexed;
mod parity;
mod program;
mod replays;
mod resident;
mod rings;
mod shapes;
mod suppress;

use geograd::kernels::dynamic::Sort;
use geograd::kernels::gpu::{Gpu, Options, common_sources};
use geograd_tests::adapter::{any_gpu, validate};
use geograd_tests::calls::OfRings;
use geograd_tests::forms::agree;
use geograd_tests::list;
use geograd_tests::rows::overlap;
use geograd_tests::rows::ring::{Area, Centroid, Perimeter, SignedArea};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One context for all tests, one test at a time: drivers in software use all cores anyway.
fn gpu() -> Option<(MutexGuard<'static, ()>, &'static Gpu)> {
    static TURN: Mutex<()> = Mutex::new(());
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    any_gpu().map(|gpu| (turn, gpu))
}

/// A context whose buffers are so small that everything is split.
fn small() -> Gpu {
    let mut options = Options::default();
    options.most_bytes = Some(64 * 64);
    Gpu::with(&options).unwrap()
}

/// A row of two boxes in the plane, which has kernels by hand for all pairs.
struct Boxes {
    name: &'static str,
    hard_pairs: fn(),
    all_pairs: fn(),
    chains: fn(),
    bad_input: fn(),
}

impl Boxes {
    const fn of<O: shapes::Score>() -> Self {
        Boxes {
            name: O::DECLARED.name,
            hard_pairs: parity::hard_pairs_agree::<O>,
            all_pairs: || {
                let Some((_turn, gpu)) = gpu() else { return };
                parity::all_pairs_agree::<O>(gpu, 67, 300);
                parity::all_pairs_agree::<O>(gpu, 1, 1);
                parity::all_pairs_agree::<O>(&small(), 70, 150);
            },
            chains: resident::chains_agree::<O>,
            bad_input: || {
                faults::bad_input_is_refused::<O>();
                faults::empty_batches_are_valid::<O>();
            },
        }
    }
}

const BOXES: [Boxes; 6] = [
    Boxes::of::<overlap::IntersectionAreaObb2>(),
    Boxes::of::<overlap::IouObb2>(),
    Boxes::of::<overlap::IofObb2>(),
    Boxes::of::<overlap::IntersectionAreaAabb2>(),
    Boxes::of::<overlap::IouAabb2>(),
    Boxes::of::<overlap::IofAabb2>(),
];

/// Carries out a test of every row of boxes, and says which.
fn of_boxes(test: fn(&Boxes) -> fn()) {
    for boxes in &BOXES {
        eprintln!("{}", boxes.name);
        test(boxes)();
    }
}

#[test]
fn boxes_hard_pairs() {
    of_boxes(|boxes| boxes.hard_pairs);
}

#[test]
fn boxes_all_pairs() {
    of_boxes(|boxes| boxes.all_pairs);
}

#[test]
fn boxes_chains() {
    of_boxes(|boxes| boxes.chains);
}

#[test]
fn boxes_bad_input() {
    of_boxes(|boxes| boxes.bad_input);
}

#[test]
fn measures_of_rings() {
    fn of<O: OfRings<f32> + OfRings<f64>>() {
        if let Some((_turn, gpu)) = gpu() {
            rings::rings_agree::<O>(gpu);
            rings::rings_agree::<O>(&small());
        }
        rings::moved_rings_agree::<O>();
        rings::long_rings::<O>();
    }
    of::<SignedArea>();
    of::<Area>();
    of::<Perimeter>();
    of::<Centroid>();
}

/// Shader text needs no GPU to be judged. A row's templates are those of all rows, its bodies are its own. Rows with a
/// body by hand are those of boxes above.
#[test]
fn shaders_are_valid() {
    for (name, text) in common_sources() {
        validate(&name, &text);
    }
    let boxes = BOXES.map(|boxes| boxes.name);
    let always = [&EVERY_FORM[..], &boxes].concat();
    list::each(&list::sample(list::rows(), &always), |row| {
        let shaders = row.shaders().unwrap();
        for (name, text) in &shaders {
            validate(name, text);
        }
        let mut texts = shaders.iter().map(|(_, text)| text);
        let is_by_hand =
            row.operation.sort == Sort::Straight && texts.any(|text| text.contains("fn value_of("));
        assert_eq!(is_by_hand, boxes.contains(&row.name()), "{}", row.name());
    });
}

#[test]
fn searches_are_replayed() {
    list::each(&list::sample(list::rows(), &[]), replays::agrees);
}

/// Rows of which every form runs: by hand and generated, of shapes with and without angles, of two lists and of one. Forms
/// are templates, the same for all rows; every other row runs in one of them.
const EVERY_FORM: [&str; 9] = [
    "iou_obb2",
    "iou_aabb2",
    "giou_obb2",
    "iou_yaw",
    "iou_obb3",
    "distance_point_obb2",
    "distance_obb2",
    "closest_points_obb2",
    "wasserstein_obb2",
];

#[test]
fn all_pairs_of_every_row() {
    let rows = list::rows();
    let found = rows.iter().filter(|row| EVERY_FORM.contains(&row.name()));
    assert_eq!(found.count(), EVERY_FORM.len(), "a name that no row has");
    list::each(&list::sample(rows, &EVERY_FORM), |row| {
        if row.operation.sort == Sort::Straight {
            agree(row, EVERY_FORM.contains(&row.name()));
        }
    });
}

//! Rows of the library with all that judges them, compiled here once for tests and reports.
use crate::{hash, takes_all, turn};
use geograd::Real;
use geograd::ad::check::sample::Draw;
use geograd::kernels::dynamic::{self, Mode, named_rows};
use geograd::kernels::tested;
pub use geograd::kernels::tested::Tested;
use std::collections::{HashMap, HashSet};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex};

/// Rows of the plane that the harness refuses at more than some hard cases: gradients that are not the function's on
/// purpose, and quadrilaterals, which `tests/harness/quads.rs` judges apart from those at the border of their domain.
pub const REFUSED: [&str; 3] = [
    "ciou_fixed_weight_aabb2",
    "ciou_fixed_weight_obb2",
    "intersection_area_quads",
];

/// All rows; only those that the variable `GEOGRAD_OP` names, as `iou` or `iou(obb2,obb2)`, if it is set.
///
/// # Panics
///
/// If it names none.
#[must_use]
pub fn rows() -> Vec<&'static Tested> {
    let all = tested::rows().iter();
    match std::env::var("GEOGRAD_OP") {
        Ok(asked) => {
            let named = named_rows(&asked).unwrap_or_else(|error| panic!("GEOGRAD_OP: {error}"));
            all.filter(|row| named.contains(&row.name())).collect()
        }
        Err(_) => all.collect(),
    }
}

/// Rows that a slow test judges, of these: one of every verb that is not costly, rows that are wanted always, and a share
/// that the variable `GEOGRAD_SHARE` selects, such as the name of a commit; with that one of every third verb. All of
/// them with `GEOGRAD_ALL_ROWS=1`, or if `GEOGRAD_OP` names some.
///
/// A row is selected by its name, so that a new one changes nothing but its own verb's.
///
/// # Panics
///
/// If no row has a name that is wanted always.
#[must_use]
pub fn sample(rows: Vec<&'static Tested>, always: &[&str]) -> Vec<&'static Tested> {
    let names = rows.iter().map(|row| row.name()).collect();
    let chosen = are_sampled(names, always);
    rows.into_iter()
        .filter(|row| chosen.contains(row.name()))
        .collect()
}

/// The names of rows that a slow test judges, of these, as [`sample`] does.
///
/// # Panics
///
/// If no row has a name that is wanted always.
#[must_use]
pub fn are_sampled(names: Vec<&'static str>, always: &[&str]) -> HashSet<&'static str> {
    if takes_all() || std::env::var("GEOGRAD_OP").is_ok() {
        return names.into_iter().collect();
    }
    for name in always {
        assert!(names.contains(name), "no row is named {name}");
    }
    let share = std::env::var("GEOGRAD_SHARE").ok();
    let chosen = selected(names, always, share.as_deref());
    eprintln!("{} rows; GEOGRAD_ALL_ROWS=1 takes all", chosen.len());
    chosen
}

/// The names that [`sample`] selects.
///
/// # Panics
///
/// If one is no row's.
#[must_use]
pub fn selected(
    names: Vec<&'static str>,
    always: &[&str],
    share: Option<&str>,
) -> HashSet<&'static str> {
    static VERBS: LazyLock<HashMap<&'static str, String>> = LazyLock::new(|| {
        dynamic::names()
            .into_iter()
            .map(|x| (x.row, x.verb))
            .collect()
    });
    let mut first: HashMap<&str, &'static str> = HashMap::new();
    static COSTLY: LazyLock<HashSet<&'static str>> = LazyLock::new(|| {
        let costly = tested::rows().iter().filter(|row| row.operation.costly);
        costly.map(|row| row.name()).collect()
    });
    for &name in names.iter().filter(|name| !COSTLY.contains(*name)) {
        let least = first.entry(&VERBS[name]).or_insert(name);
        if hash("", name) < hash("", least) {
            *least = name;
        }
    }
    let is_turn =
        |verb: &str| share.is_none_or(|share| hash(share, verb).is_multiple_of(VERBS_SHARE));
    let turns = first.into_iter().filter(|(verb, _)| is_turn(verb));
    let mut chosen: HashSet<_> = turns.map(|(_, name)| name).collect();
    let is_wanted = |name: &str| {
        always.contains(&name) || share.is_some_and(|share| hash(share, name).is_multiple_of(SHARE))
    };
    chosen.extend(names.into_iter().filter(|name| is_wanted(name)));
    chosen
}

/// One of so many cases, others for every `GEOGRAD_SHARE`; all of them with `GEOGRAD_ALL_ROWS=1`.
#[must_use]
pub fn share_of<C>(cases: Vec<C>, one_of: usize) -> Vec<C> {
    let step = if takes_all() { 1 } else { one_of };
    let first = turn() as usize % step;
    cases.into_iter().skip(first).step_by(step).collect()
}

/// Rows that have compiled kernels.
pub const COMPILED: [&str; 18] = [
    "intersection_area_obb2",
    "intersection_area_aabb2",
    "intersection_area_quads",
    "iou_obb2",
    "iou_aabb2",
    "iof_obb2",
    "iof_aabb2",
    "giou_obb2",
    "intersection_volume_aabb3",
    "intersection_volume_yaw",
    "intersection_volume_obb3",
    "iou_aabb3",
    "iou_yaw",
    "iou_obb3",
    "iof_aabb3",
    "iof_yaw",
    "iof_obb3",
    "iou_birds_eye",
];

/// A share is one row of so many, and one verb's own row of so many.
const SHARE: u64 = 36;
const VERBS_SHARE: u64 = 3;

/// The rows that the harness checks.
#[must_use]
pub fn checked() -> Vec<&'static Tested> {
    let all = rows().into_iter();
    all.filter(|row| !REFUSED.contains(&row.name())).collect()
}

/// The row of a name.
///
/// # Panics
///
/// If there is none.
#[must_use]
pub fn row(name: &str) -> &'static Tested {
    let found = tested::rows().iter().find(|row| row.name() == name);
    found.unwrap_or_else(|| panic!("no row is named {name}"))
}

/// Carries out work for every row, on all cores.
///
/// # Panics
///
/// If it panics for a row; with the names of all such rows, after all of them.
pub fn each(rows: &[&'static Tested], work: impl Fn(&'static Tested) + Sync) {
    let (next, failed) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let turn = || {
        while let Some(row) = rows.get(next.fetch_add(1, Ordering::Relaxed)) {
            if catch_unwind(AssertUnwindSafe(|| work(row))).is_err() {
                failed.lock().unwrap().push(row.name());
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(turn);
        }
        turn();
    });
    let failed = failed.into_inner().unwrap();
    assert!(
        failed.is_empty(),
        "{} of {} rows fail, for reasons that are above: {}",
        failed.len(),
        rows.len(),
        failed.join(", ")
    );
}

/// Items as a column of numbers for every argument of a row.
#[must_use]
pub fn columns<T: Real>(row: &Tested, items: &[Vec<T>]) -> Vec<Vec<T>> {
    let mut from = 0;
    let layouts = row.operation.layouts::<T>().into_iter();
    let column = |fields: usize| {
        let own = from..from + fields;
        from = own.end;
        items.iter().flat_map(|x| x[own.clone()].to_vec()).collect()
    };
    layouts.map(|layout| layout.fields()).map(column).collect()
}

/// Inputs that a draw makes, in a format: those that are valid.
///
/// # Panics
///
/// If none is.
pub fn inputs<T: Real>(
    row: &Tested,
    count: usize,
    mut drawn: impl FnMut(&mut Draw) -> Vec<f64>,
) -> Vec<Vec<T>> {
    let (mut draw, layouts) = (Draw::new(5), row.operation.layouts::<T>());
    let mut all = Vec::new();
    for _ in 0..10 * count.max(20) {
        let item: Vec<T> = drawn(&mut draw).into_iter().map(T::lit).collect();
        let mut rest = &item[..];
        let is_valid = layouts.iter().all(|layout| {
            let (own, others) = rest.split_at(layout.fields());
            rest = others;
            layout.check(own).is_ok()
        });
        let plain: Vec<f64> = item.iter().map(|x| x.widen()).collect();
        if is_valid && row.operation.is_inside(&plain) {
            all.push(item);
        }
        if all.len() == count {
            break;
        }
    }
    assert!(!all.is_empty(), "no input of {} is valid", row.name());
    all
}

/// How many numbers a result has; of paths none.
#[must_use]
pub fn outputs(row: &Tested) -> usize {
    let function = row.operation.function::<f64>(Mode::Value);
    function.map_or(0, |function| function.gives().iter().sum())
}

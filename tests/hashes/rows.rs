//! Every row of the library in both formats, and the text of its shaders.
use crate::forms::{self, Batch, Format, Given, OfItem, flat, round};
use crate::{paths, print};
use geograd::ad::check::sample::Sample;
#[cfg(feature = "gpu")]
use geograd::ad::program::WGSL as PRELUDE;
use geograd::kernels::ops::walk::{Walk, Written};
use geograd::kernels::{Fold, HintedSearch, Item, Op, ops};
use geograd::{Fixed, Pack, Vec2};

/// A function that hashes the forms of a row.
type Run = Box<dyn Fn() -> Vec<(String, u64)> + Send>;

/// A costly row takes one of so many inputs.
const COSTLY: usize = 16;

/// A row in one format, and the function that hashes its forms.
pub struct Entry {
    pub row: &'static str,
    /// `f32`, `f64`, or `wgsl` for the text of shaders.
    pub format: &'static str,
    pub run: Run,
}

/// The format of shaders' text.
pub const WGSL: &str = "wgsl";

/// A row in one format by its inputs, the numbers of its result, and forms of one item and of batches.
fn entry<S: Format>(
    row: &'static str,
    inputs: fn() -> Vec<Vec<f64>>,
    outputs: usize,
    items: Vec<(&'static str, OfItem)>,
    batch: Batch,
) -> Entry {
    Entry {
        row,
        format: S::NAME,
        run: Box::new(move || Given::new(row, inputs(), outputs).forms(&items, batch)),
    }
}

fn operation<O: Op, S: Format>(row: &'static str) -> Entry
where
    O::In<f64>: Sample,
{
    entry::<S>(
        row,
        || print::inputs::<O::In<f64>>(round::<S>, flat),
        O::Out::<S>::LEN,
        vec![
            ("scalar", forms::scalar::<O, S>),
            ("duals", forms::duals::<O, S>),
            ("by_hand", forms::by_hand::<O, S>),
        ],
        forms::batches::<S>,
    )
}
fn search<D: HintedSearch, S: Format>(row: &'static str) -> Entry
where
    D::In<f64>: Sample,
{
    entry::<S>(
        row,
        || {
            let all = print::inputs::<D::In<f64>>(round::<S>, flat);
            let step = if D::DECLARED.costly { COSTLY } else { 1 };
            all.into_iter().step_by(step).collect()
        },
        D::Out::<S>::LEN,
        vec![
            ("scalar", forms::replayed::<D, S>),
            ("duals", forms::replayed_duals::<D, S>),
        ],
        forms::batches::<S>,
    )
}
fn fold<F: Fold, S: Format>(row: &'static str) -> Entry
where
    F::Context<f64>: Sample,
    F::Context<S>: Item<Scalar = S>,
{
    entry::<S>(
        row,
        || match F::MEASURE {
            Some(_) => print::inputs::<Vec<Vec2<f64>>>(round::<S>, Pack::scalars),
            None => print::inputs::<(F::Context<f64>, Vec<Vec2<f64>>)>(round::<S>, Pack::scalars),
        },
        F::Out::<S>::LEN,
        match F::MEASURE {
            Some(_) => paths::measure_items::<F, S>(),
            None => paths::fold_items::<F, S>(),
        },
        match F::MEASURE {
            Some(_) => paths::measure_batch::<F, S>(),
            None => paths::fold_batch::<F, S>(),
        },
    )
}

/// Names and texts of shaders.
#[cfg(feature = "gpu")]
type Sources = Result<Vec<(String, String)>, geograd::Error>;

/// Hashes of shaders by the name of their template.
#[cfg(feature = "gpu")]
fn shaders(operation: &str, sources: Sources) -> Vec<(String, u64)> {
    let sources = sources.unwrap_or_else(|error| vec![("refused".to_owned(), error.to_string())]);
    let form = |name: &str| {
        let words = |name: &str| {
            let words = name.split(|c: char| !c.is_alphanumeric());
            let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
            words.join("_").to_lowercase()
        };
        // By hand: a template, and whether shapes may be extreme; all else follows from both and the row.
        match name.split_once("kernel: ") {
            Some((_, rest)) => {
                let kernel = rest.split(", mirror").next().unwrap_or(rest);
                let extreme = rest.contains("extreme: true");
                let end = if extreme { "_extreme" } else { "" };
                format!("by_hand_{}{end}", words(kernel))
            }
            None if name == operation => "by_hand".to_owned(),
            None => words(name.strip_prefix(operation).unwrap_or(name)),
        }
    };
    // The functions that all of them begin with have a line of their own.
    let own = |text: &str| print::of_text(text.strip_prefix(PRELUDE).unwrap_or(text));
    let hash = |(name, text): (String, String)| (form(&name), own(&text));
    sources.into_iter().map(hash).collect()
}

/// All rows in both formats.
#[derive(Default)]
struct Rows(Vec<Entry>);

impl Walk for Rows {
    fn straight<O: Op>(&mut self, row: Written)
    where
        O::In<f32>: Item<Scalar = f32>,
        O::Out<f32>: Item<Scalar = f32>,
        O::In<f64>: Item<Scalar = f64> + Sample,
        O::Out<f64>: Item<Scalar = f64> + Sample,
    {
        let row = row.name;
        self.0
            .extend([operation::<O, f64>(row), operation::<O, f32>(row)]);
    }
    fn search<D: HintedSearch>(&mut self, row: Written)
    where
        D::In<f32>: Item<Scalar = f32>,
        D::Out<f32>: Item<Scalar = f32>,
        D::In<f64>: Item<Scalar = f64> + Sample,
        D::Out<f64>: Item<Scalar = f64> + Sample,
    {
        let row = row.name;
        self.0
            .extend([search::<D, f64>(row), search::<D, f32>(row)]);
    }
    fn fold<F: Fold>(&mut self, row: Written)
    where
        F::Context<f32>: Item<Scalar = f32>,
        F::Out<f32>: Item<Scalar = f32>,
        F::Context<f64>: Item<Scalar = f64> + Sample,
        F::Element<f64>: Sample,
        Vec<F::Element<f64>>: Sample,
        F::Out<f64>: Item<Scalar = f64> + Sample,
    {
        let row = row.name;
        self.0.extend([fold::<F, f64>(row), fold::<F, f32>(row)]);
        #[cfg(feature = "gpu")]
        self.shaders(row, || geograd::kernels::gpu::fold_sources(F::default()));
    }
}

#[cfg(feature = "gpu")]
impl Rows {
    fn shaders(&mut self, row: &'static str, sources: fn() -> Sources) {
        self.0.push(Entry {
            row,
            format: WGSL,
            run: Box::new(move || shaders(row, sources())),
        });
    }
}

/// Every row in both formats, and as shaders if this is built with the feature `gpu`.
pub fn all() -> Vec<Entry> {
    let mut all = Rows::default();
    ops::each(&mut all);
    #[cfg(feature = "gpu")]
    {
        use geograd::kernels::dynamic::{Sort, operations};
        use geograd::kernels::gpu::{common_sources, replay_source};
        for operation in operations() {
            if operation.sort == Sort::Straight {
                all.0.push(Entry {
                    row: operation.name,
                    format: WGSL,
                    run: Box::new(|| shaders(operation.name, operation.shaders())),
                });
            }
        }
        all.0.push(Entry {
            row: "all_shaders",
            format: WGSL,
            run: Box::new(|| {
                let mut sources = common_sources();
                sources.push(("replay".to_owned(), replay_source()));
                let mut all = shaders("", Ok(sources));
                all.push(("prelude".to_owned(), print::of_text(PRELUDE)));
                all
            }),
        });
    }
    all.0
}

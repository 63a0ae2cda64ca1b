//! Every row of the list in both formats, and the text of its shaders.
use crate::forms::{self, Format, Given, Gradients, Of, Pairs, flat, round};
use crate::{paths, print};
use geograd::ad::check::sample::Sample;
#[cfg(feature = "gpu")]
use geograd::ad::program::WGSL as PRELUDE;
use geograd::kernels::{Fold, Op, RingOp, Search};
use geograd::{Fixed, Pack, Vec2};

/// A row in one format, and what hashes its forms.
pub struct Entry {
    pub row: &'static str,
    /// `f32`, `f64`, or `wgsl` for the text of shaders.
    pub format: &'static str,
    pub run: fn() -> Vec<(String, u64)>,
}

/// The format of shaders' text.
pub const WGSL: &str = "wgsl";

fn operation<O: Op, S: Format>(batches: &[Option<forms::Batch>]) -> Vec<(String, u64)>
where
    O::In<f64>: Sample,
{
    let inputs = print::inputs::<O::In<f64>>(round::<S>, flat);
    Given::new(inputs, O::Out::<S>::LEN).forms(
        &[
            ("scalar", forms::scalar::<O, S>),
            ("duals", forms::duals::<O, S>),
            ("by_hand", forms::by_hand::<O, S>),
        ],
        &batches.iter().flatten().copied().collect::<Vec<_>>(),
    )
}
fn search<D: Search, S: Format>(batches: &[Option<forms::Batch>]) -> Vec<(String, u64)>
where
    D::In<f64>: Sample,
{
    let inputs = print::inputs::<D::In<f64>>(round::<S>, flat);
    Given::new(inputs, D::Out::<S>::LEN).forms(
        &[
            ("scalar", forms::replayed::<D, S>),
            ("duals", forms::replayed_duals::<D, S>),
        ],
        &batches.iter().flatten().copied().collect::<Vec<_>>(),
    )
}
fn ring<O: RingOp, S: Format>() -> Vec<(String, u64)> {
    let inputs = print::inputs::<Vec<Vec2<f64>>>(round::<S>, Pack::scalars);
    let items = paths::ring_items::<O, S>();
    Given::new(inputs, O::Out::<S>::LEN).forms(&items, &[paths::ring_batch::<O, S>])
}
fn fold<F: Fold, S: Format>(batch: forms::Batch) -> Vec<(String, u64)>
where
    F::Context<f64>: Sample,
{
    let inputs = print::inputs::<(F::Context<f64>, Vec<Vec2<f64>>)>(round::<S>, Pack::scalars);
    let items = paths::fold_items::<F, S>();
    Given::new(inputs, F::Out::<S>::LEN).forms(&items, &[batch])
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

macro_rules! entries {
    ($all:ident, $row:ident, $run:ident::<$op:ty> $(, $batches:ident)?) => {
        $all.extend([
            Entry {
                row: stringify!($row),
                format: f64::NAME,
                run: || $run::<$op, f64>($($batches!($op, f64))?),
            },
            Entry {
                row: stringify!($row),
                format: f32::NAME,
                run: || $run::<$op, f32>($($batches!($op, f32))?),
            },
        ]);
    };
    ($all:ident, $row:ident, |$operation:ident: $op:ty| $sources:expr) => {
        $all.extend([Entry {
            row: stringify!($row),
            format: WGSL,
            run: || {
                type $operation = $op;
                shaders($operation::NAME, $sources)
            },
        }]);
    };
}

/// Batches of what is of fixed size.
macro_rules! straight_batches {
    ($op:ty, $format:ty) => {
        batches!($op, <$op as Op>::In<$format>, <$op as Op>::Out<$format>)
    };
}
macro_rules! decided_batches {
    ($op:ty, $format:ty) => {
        batches!(
            $op,
            <$op as Search>::In<$format>,
            <$op as Search>::Out<$format>
        )
    };
}
macro_rules! batches {
    ($op:ty, $in:ty, $out:ty) => {
        &[
            Some(forms::items::<$op, $in, $out>),
            (&&Of::<$op, $in, $out>::NEW).gradients(),
            (&&&Of::<$op, $in, $out>::NEW).pairs(),
        ]
    };
}
macro_rules! fold_batches {
    ($op:ty, $format:ty) => {
        paths::fold_batch::<$op, $format>()
    };
}

macro_rules! list {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        /// Every row in both formats, and as shaders if this is built with the feature `gpu`.
        // Which implementation serves an operation is found by the references.
        #[allow(clippy::needless_borrow)]
        pub fn all() -> Vec<Entry> {
            let mut all = Vec::new();
            $(entries!(all, $pair, operation::<$pair_op>, straight_batches);)*
            $(entries!(all, $ring, ring::<$ring_op>);)*
            $(entries!(all, $straight, operation::<$straight_op>, straight_batches);)*
            $(entries!(all, $more, operation::<$more_op>, straight_batches);)*
            $(entries!(all, $fold, fold::<$fold_op>, fold_batches);)*
            $(entries!(all, $more_fold, fold::<$more_fold_op>, fold_batches);)*
            $(entries!(all, $decided, search::<$decided_op>, decided_batches);)*
            $(entries!(all, $more_search, search::<$more_decided_op>, decided_batches);)*
            #[cfg(feature = "gpu")]
            {
                use geograd::kernels::gpu::{fold_sources, op_sources, pair_sources, replay_source, ring_sources};
                $(entries!(all, $pair, |O: $pair_op| op_sources::<O>());)*
                $(entries!(all, $pair, |O: $pair_op| Ok(pair_sources::<O>()));)*
                $(entries!(all, $ring, |O: $ring_op| Ok(ring_sources::<O>()));)*
                $(entries!(all, $straight, |O: $straight_op| op_sources::<O>());)*
                $(entries!(all, $more, |O: $more_op| op_sources::<O>());)*
                $(entries!(all, $fold, |F: $fold_op| fold_sources(F::default()));)*
                $(entries!(all, $more_fold, |F: $more_fold_op| fold_sources(F::default()));)*
                all.push(Entry {
                    row: "all_shaders",
                    format: WGSL,
                    run: || {
                        let mut all = shaders("", Ok(vec![("replay".to_owned(), replay_source())]));
                        all.push(("prelude".to_owned(), print::of_text(PRELUDE)));
                        all
                    },
                });
            }
            all
        }
    };
}
geograd::for_each_op!(list);

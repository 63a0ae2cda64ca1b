//! The forms of rings and folds: values and derivatives alone, of paths in one list, and of one path for all.
use crate::forms::{Batch, Flat, Format, Found, Given, OfItem, flat, jacobian, load, load_all};
use geograd::ad::forward::First;
use geograd::kernels::check::Folded;
use geograd::kernels::check::WithAdjoint;
use geograd::kernels::fold::{by_hand, fold};
use geograd::kernels::{Cpu, Fold, Item};
use geograd::{Fixed, Pack, Scalar};

fn numbers<S: Format, V: Fixed<Scalar = S>>(vertices: &[V]) -> Vec<f64> {
    vertices.iter().flat_map(flat).collect()
}
/// Elements of numbers, and of their nearest in a format.
fn elements<S: Scalar, V: Fixed<Scalar = S>>(numbers: &[S]) -> Vec<V> {
    numbers.chunks_exact(V::LEN).map(V::load).collect()
}
fn elements_of<S: Scalar, V: Fixed<Scalar = S>>(numbers: &[f64]) -> Vec<V> {
    let numbers: Vec<S> = numbers.iter().map(|&x| S::lit(x)).collect();
    elements(&numbers)
}

/// Vertices of all inputs behind so many numbers, and where each path begins.
fn ragged<S: Format, V: Fixed<Scalar = S>>(given: &Given, behind: usize) -> (Vec<V>, Vec<usize>) {
    let (mut vertices, mut offsets) = (Vec::new(), vec![0]);
    for x in &given.inputs {
        vertices.extend(elements_of::<S, V>(&x[behind..]));
        offsets.push(vertices.len());
    }
    (vertices, offsets)
}

/// Those of a measure of rings, whose adjoint is by hand.
pub fn measure_items<F: Fold, S: Format>() -> Vec<(&'static str, OfItem)> {
    let mut items = fold_items::<F, S>();
    items.truncate(2);
    items.push(("by_hand", |x, bar| {
        let bars = by_hand::<F, S>(&elements_of::<S, F::Element<S>>(x), load(bar));
        bars.expect("is by hand")
            .iter()
            .map(|x| x.widen())
            .collect()
    }));
    items
}

/// The batches of a measure of rings by the names that its calls had when its hashes were recorded.
pub fn measure_batch<F: Fold, S: Format>() -> Batch
where
    F::Context<S>: Item<Scalar = S>,
{
    |given| {
        let all = fold_batch::<F, S>()(given);
        let named = [("fold", "ragged"), ("fold_vjp", "ragged_vjp")];
        let of = |(name, found): Found| {
            let name = named.iter().find(|own| own.0 == name)?.1;
            Some((name, found))
        };
        all.into_iter().filter_map(of).collect()
    }
}

pub fn fold_items<F: Fold, S: Format>() -> Vec<(&'static str, OfItem)> {
    vec![
        ("scalar", |x, _| {
            let (context, vertices) = x.split_at(F::Context::<S>::LEN);
            flat(&fold::<F, S>(
                load(context),
                &elements_of::<S, F::Element<S>>(vertices),
            ))
        }),
        ("duals", |x, _| {
            jacobian::<S>(x, &|x| {
                let (context, vertices) = x.split_at(F::Context::<S>::LEN);
                let path = elements::<First<S>, F::Element<First<S>>>(vertices);
                fold::<F, First<S>>(F::Context::load(context), &path).scalars()
            })
        }),
        ("vjp", |x, bar| {
            let (context, vertices) = x.split_at(F::Context::<S>::LEN);
            let path = elements_of::<S, F::Element<S>>(vertices);
            let input = (load::<F::Context<S>>(context), path);
            let (context, vertices) = Folded::<F>::vjp::<S>(&input, load(bar));
            [flat(&context), numbers(&vertices)].concat()
        }),
    ]
}

/// Contexts are one column per path. The longest path meets all contexts, too.
pub fn fold_batch<F: Fold, S: Format>() -> Batch
where
    F::Context<S>: Item<Scalar = S>,
{
    |given| {
        let own = F::Context::<S>::LEN;
        let (vertices, offsets) = ragged::<S, F::Element<S>>(given, own);
        let contexts = given.inputs.iter().map(|x| load(&x[..own]));
        let contexts: Vec<F::Context<S>> = contexts.collect();
        let bars: Vec<F::Out<S>> = load_all(&given.cotangents);
        let (run, cpu) = (F::default(), Cpu::new());
        let values = |all: Vec<F::Out<S>>| all.iter().flat_map(flat).collect();
        let derivatives = |(contexts, vertices): (Vec<F::Context<S>>, Vec<F::Element<S>>)| {
            let mut all = numbers(&vertices);
            contexts.flat(&mut all);
            all
        };
        let longest = given.inputs.iter().max_by_key(|x| x.len());
        let longest = longest.map_or(Vec::new(), |x| elements_of::<S, F::Element<S>>(&x[own..]));
        let met = if own == 0 { 1 } else { contexts.len() };
        let one = cpu.fold_one(run, &contexts, &longest);
        let pulled = cpu.fold_one_vjp(run, &contexts, &longest, &bars[..met]);
        vec![
            (
                "fold",
                cpu.fold(run, &contexts, &vertices, &offsets).map(values),
            ),
            (
                "fold_vjp",
                cpu.fold_vjp(run, &contexts, &vertices, &offsets, &bars)
                    .map(derivatives),
            ),
            ("fold_one", one.map(values)),
            ("fold_one_vjp", pulled.map(derivatives)),
        ]
    }
}

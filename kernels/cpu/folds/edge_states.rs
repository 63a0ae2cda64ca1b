//! States of the edges of paths, and results by them.
use super::paths::{Paths, told};
use crate::error::Field;
use crate::kernels::call::folding::{FoldPrograms, Folding, Sizes};
use crate::kernels::cpu::plan::{Plan, of_recorded};
use crate::kernels::cpu::stretches::{self, Aligned};
use crate::kernels::row::derivation::Mode;
use crate::kernels::row::item::{Leaf, Quick, Target};
use crate::kernels::row::once::Key;
use crate::{Error, Real};
use std::sync::Arc;

/// Returns the plan of the body of edges for batches.
pub(super) fn plan<T: Real>(
    sizes: &Sizes,
    programs: &FoldPrograms,
    mode: Mode,
) -> Result<Arc<Plan<T>>, Error> {
    let recorded = match mode {
        Mode::Vjp => &programs.edge_vjp,
        _ => &programs.edge,
    };
    programs.made.made(Key::Cpu(mode, false), &|| {
        let leaf = |fields| Leaf {
            shape: || "",
            fields,
            codes: 0,
            name: |_| Field::VALUE,
            check: |_: &[T]| Ok(()),
            quick: Quick::Always,
            rules: &[],
            axis_bounds: |_| Vec::new(),
        };
        let arguments = [sizes.wide, 2 * sizes.element]
            .into_iter()
            .filter(|&fields| fields > 0)
            .map(leaf);
        of_recorded(
            mode,
            arguments.collect(),
            vec![sizes.state],
            recorded,
            false,
        )
    })
}

/// Returns the states of all edges.
pub(super) fn states<T: Real>(
    sizes: &Sizes,
    programs: &FoldPrograms,
    paths: &Paths<'_, T>,
) -> Result<Vec<T>, Error> {
    let body = plan(sizes, programs, Mode::Value)?;
    let count = paths.edges.len();
    let mut states = vec![T::default(); count * sizes.state];
    let targets = vec![Some(Target::of_rows(&mut states, sizes.state))];
    stretches::compute(Aligned {
        unchecked: false,
        plan: &body,
        columns: &paths.columns(sizes.wide, None),
        rare: false,
        count,
        targets,
    });
    Ok(states)
}

/// Writes the results of paths from the one called `first` on, from the states of their edges.
pub(super) fn finished<T: Real>(
    folding: &Folding<T>,
    paths: &Paths<'_, T>,
    states: &[T],
    first: usize,
    out: &mut [T],
) {
    let sizes = &folding.sizes;
    let mut state = vec![T::default(); sizes.state];
    for (k, out) in out.chunks_exact_mut(sizes.out).enumerate() {
        let path = first + k;
        (folding.joined)(told(sizes, paths, states, path), &mut state);
        sizes.wind(&mut state, paths.windings[path]);
        let shared = &paths.shared[path * sizes.wide..][..sizes.wide];
        (folding.finish)(shared, &state, out);
        for x in out {
            *x = x.canonical();
        }
    }
}

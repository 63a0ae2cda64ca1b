//! Verbs with their rows, which are callables.
use crate::call::Callable;
use crate::column::Kind;
use crate::table::table;
use std::collections::HashMap;
use std::sync::OnceLock;

/// A row: a verb with certain shapes.
pub struct Row {
    pub takes: Vec<Kind>,
    pub call: Callable,
}

/// A verb with all its rows.
pub struct Verb {
    pub name: String,
    pub rows: Vec<Row>,
}

/// Returns all verbs, in the order of their first rows.
pub fn verbs() -> &'static [Verb] {
    static VERBS: OnceLock<Vec<Verb>> = OnceLock::new();
    VERBS.get_or_init(|| {
        let (mut verbs, mut places) = (Vec::new(), HashMap::new());
        for listed in &table().rows {
            let place = *places.entry(&listed.verb).or_insert_with(|| {
                verbs.push(Verb {
                    name: listed.verb.clone(),
                    rows: Vec::new(),
                });
                verbs.len() - 1
            });
            let columns = (listed.takes.clone(), listed.gives.clone());
            verbs[place].rows.push(Row {
                takes: listed.kinds.clone(),
                call: Callable::of_row(listed.operation, columns.0, columns.1),
            });
        }
        verbs
    })
}

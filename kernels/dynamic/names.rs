//! Names of rows on command lines: `iou` for all rows of a verb, `iou(obb2,obb2)` for one.
use super::described::verb_of;
use crate::kernels::ops::walk::Written;
use crate::kernels::ops::written;
use std::fmt;

/// The names of a row of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// Its name in reports, which is that of its function.
    pub row: &'static str,
    /// Its verb.
    pub verb: String,
    /// Its shapes: `Obb2`, `[Vec2;4]`, `number`; `ring` or `polyline` for a fold's path.
    pub shapes: Vec<String>,
    /// Its verb and its shapes: `iou(obb2,obb2)`.
    pub spelling: String,
}

/// The reason why no row has a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unnamed {
    /// The name is that of a function; a command line names the verb and the shapes.
    Function(Name),
    /// Neither a verb nor a row has this name.
    Unknown,
}

impl fmt::Display for Unnamed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unnamed::Function(name) => write!(
                f,
                "`{}` is spelled `{}`; `{}` is all its shapes",
                name.row, name.spelling, name.verb
            ),
            Unnamed::Unknown => {
                let mut verbs: Vec<String> = names().into_iter().map(|name| name.verb).collect();
                verbs.sort_unstable();
                verbs.dedup();
                write!(f, "no verb is called that; verbs are {}", verbs.join(", "))
            }
        }
    }
}

impl std::error::Error for Unnamed {}

/// Returns the names of all rows, in the order of [`operations`](super::operations).
#[must_use]
pub fn names() -> Vec<Name> {
    let name = |row: &Written| {
        let verb = verb_of(row.verb);
        let shapes: Vec<String> = row.shapes.iter().map(|shape| spelled(shape)).collect();
        Name {
            row: row.name,
            spelling: format!("{verb}({})", shapes.join(",")).to_lowercase(),
            verb,
            shapes,
        }
    };
    written().map(name).collect()
}

/// Returns the report names of the rows that a verb or a spelling names; of all rows for an empty text.
///
/// ```
/// use geograd::kernels::dynamic::{Unnamed, named_rows};
/// assert_eq!(named_rows("iou(obb2, obb2)"), Ok(vec!["iou_obb2"]));
/// assert!(named_rows("giou")?.contains(&"giou_aabb2"));
/// let old = named_rows("iou_obb2").unwrap_err();
/// assert_eq!(old.to_string(), "`iou_obb2` is spelled `iou(obb2,obb2)`; `iou` is all its shapes");
/// assert_eq!(named_rows("box_iou"), Err(Unnamed::Unknown));
/// # Ok::<(), Unnamed>(())
/// ```
///
/// # Errors
///
/// [`Unnamed`] if no row has this name.
pub fn named_rows(asked: &str) -> Result<Vec<&'static str>, Unnamed> {
    let asked: String = asked.to_lowercase();
    let asked: String = asked.chars().filter(|c| !c.is_whitespace()).collect();
    let all = names();
    let of = |name: &Name| asked.is_empty() || name.verb == asked || name.spelling == asked;
    let found: Vec<&'static str> = all.iter().filter(|x| of(x)).map(|x| x.row).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let function = all.into_iter().find(|name| name.row == asked);
    Err(function.map_or(Unnamed::Unknown, Unnamed::Function))
}

/// Returns a shape as the tables spell it.
fn spelled(shape: &str) -> String {
    match shape {
        "Number" => "number",
        "Quad" => "[Vec2;4]",
        shape => shape,
    }
    .to_owned()
}

//! Names of rows on command lines: `iou` for all rows of a verb, `iou(obb2,obb2)` for one.
use super::list::verb_of;
use std::fmt;

/// A row of the [list](crate::for_each_op) by its names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Name {
    /// Its name in reports: that of its function.
    pub row: &'static str,
    /// Its verb.
    pub verb: String,
    /// The shapes that it takes: `Obb2`, `[Vec2;4]`, `number`; of a fold `ring` or `polyline`.
    pub shapes: Vec<String>,
    /// Its verb and its shapes: `iou(obb2,obb2)`.
    pub spelling: String,
}

/// Why no row was found by a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unnamed {
    /// The name is that of a function; a command line says the verb and the shapes.
    Function(Name),
    /// Neither a verb nor a row has it.
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

macro_rules! all {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }
     straight { $($straight:ident: $straight_op:ty,)* }
     folds { $($fold:ident: $fold_op:ty,)* } decided { $($decided:ident: $decided_op:ty,)* }
     further {
         straight { $($more:ident: $more_op:ty,)* }
         folds { $($more_fold:ident: $more_fold_op:ty,)* }
         decided { $($more_search:ident: $more_decided_op:ty,)* }
     }) => {
        &[
            $((stringify!($pair), stringify!($pair_op)),)*
            $((stringify!($ring), stringify!($ring_op)),)*
            $((stringify!($straight), stringify!($straight_op)),)*
            $((stringify!($fold), stringify!($fold_op)),)*
            $((stringify!($decided), stringify!($decided_op)),)*
            $((stringify!($more), stringify!($more_op)),)*
            $((stringify!($more_fold), stringify!($more_fold_op)),)*
            $((stringify!($more_search), stringify!($more_decided_op)),)*
        ]
    };
}

/// Names of the rows and their types as the list writes them.
const ROWS: &[(&str, &str)] = crate::for_each_op!(all);

/// The names of all rows, in the order of the list.
#[must_use]
pub fn names() -> Vec<Name> {
    let name = |&(row, path)| {
        let verb = verb_of(path);
        let shapes = shapes(path);
        Name {
            row,
            spelling: format!("{verb}({})", shapes.join(",")).to_lowercase(),
            verb,
            shapes,
        }
    };
    ROWS.iter().map(name).collect()
}

/// The names of rows in reports that a verb or a spelling names; those of all rows for an empty one.
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
/// [`Unnamed`] where there is none.
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

/// The shapes that a row takes, from its type.
fn shapes(path: &str) -> Vec<String> {
    let path: String = path.chars().filter(|c| !c.is_whitespace()).collect();
    let Some((_, taken)) = path.split_once("Takes<") else {
        let over = if path.contains("OverPolyline") {
            "polyline"
        } else {
            "ring"
        };
        return vec![over.to_owned()];
    };
    let taken = taken.strip_suffix(">>::By").unwrap_or(taken);
    let inner = taken.strip_prefix('(').and_then(|x| x.strip_suffix(')'));
    let (mut all, mut depth) = (vec![String::new()], 0_i32);
    for c in inner.unwrap_or(taken).chars() {
        match c {
            '<' | '[' => depth += 1,
            '>' | ']' => depth -= 1,
            _ => {}
        }
        match all.last_mut() {
            Some(last) if depth > 0 || c != ',' => last.push(c),
            _ => all.push(String::new()),
        }
    }
    all.iter().map(|shape| short(shape)).collect()
}

/// `$crate::Obb2<f64>` as `Obb2`.
fn short(shape: &str) -> String {
    if shape == "f64" {
        return "number".to_owned();
    }
    if let Some((of, count)) = shape
        .strip_prefix('[')
        .and_then(|x| x.strip_suffix(']'))
        .and_then(|x| x.split_once(';'))
    {
        return format!("[{};{count}]", short(of));
    }
    let (path, of) = shape.split_once('<').unwrap_or((shape, ""));
    let name = path.rsplit(':').next().unwrap_or(path);
    // A polygon says how many corners it may have.
    match of.strip_suffix('>').and_then(|of| of.split_once(',')) {
        Some((_, corners)) => format!("{name}{corners}"),
        None => name.to_owned(),
    }
}

//! Names, summaries and shapes of operations, as text and values.
use super::rows::Layout;
use crate::ad::declared::Kind;
use crate::error::Field;
use crate::kernels::row::bounds::{Bound, bounds};
use crate::kernels::row::item::Leaf;

/// A shape in an operation's arguments or result.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// Its name: `Obb2`, `number`, `[Vec2; 4]`.
    pub name: String,
    /// Its numbers, in the order of fields.
    pub fields: Vec<Number>,
}

/// A scalar of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Its name; `value` for a lone number.
    pub name: Field,
    /// Its kind: length, coordinate, angle, number and others.
    pub kind: Kind,
    /// The bound of its values.
    pub bound: Bound,
}

/// Returns the verb of a type, in lower case: `signed_area` of `verbs::SignedArea`.
pub(super) fn verb_of(path: &str) -> String {
    let verb = path.split('<').next().unwrap_or(path);
    let verb = verb.rsplit("::").next().unwrap_or(verb).trim();
    let mut snake = String::new();
    for c in verb.chars() {
        if c.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(c.to_lowercase());
    }
    snake
}

/// Returns the first paragraph of a Markdown text as plain text.
pub(super) fn summary(doc: &str) -> String {
    let lines = doc.lines().map(str::trim);
    let lines: Vec<&str> = lines.take_while(|line| !line.is_empty()).collect();
    let text = lines.join(" ");
    let (mut plain, mut rest) = (String::new(), text.as_str());
    // The text of a link replaces the link.
    while let Some(at) = rest.find("](") {
        let (before, after) = rest.split_at(at);
        plain.push_str(before);
        // Names of functions have parentheses of their own.
        let end = after.find("())").map(|end| end + 3);
        let end = end.filter(|&end| after[..end].matches(')').count() == 2);
        let end = end.or_else(|| after.find(')').map(|end| end + 1));
        rest = &after[end.unwrap_or(after.len())..];
    }
    plain.push_str(rest);
    plain.replace(['`', '[', ']'], "")
}

/// Returns the shapes of leaves whose scalars are of these kinds.
pub(super) fn shapes(leaves: &[Leaf<f64>], kinds: &[Kind]) -> Vec<Shape> {
    let mut rest = kinds;
    let shape = |&leaf: &Leaf<f64>| {
        let scalars = leaf.fields - leaf.codes;
        let (own, others) = rest.split_at(scalars.min(rest.len()));
        rest = others;
        let kind = |i: usize| own.get(i).copied().unwrap_or(Kind::Number);
        let bounds = bounds(&leaf);
        let number = |i: usize| Number {
            name: match i < scalars {
                true => (leaf.name)(i),
                false => Field::VALUE.within_item(i - scalars).within("codes"),
            },
            kind: kind(i),
            bound: bounds[i],
        };
        Shape {
            name: Layout { leaf }.name(),
            fields: (0..leaf.fields).map(number).collect(),
        }
    };
    leaves.iter().map(shape).collect()
}

//! Rows that were read, and their groups.

/// The group of a row.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    Number(i64),
    Text(String),
}

/// Rows of a block.
pub struct Block<T> {
    /// The shapes, one after another.
    pub numbers: Vec<T>,
    /// The group of every row, where one is asked for.
    pub keys: Vec<Key>,
}

impl std::fmt::Display for Key {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Key::Number(x) => write!(f, "{x}"),
            Key::Text(text) => write!(f, "{text}"),
        }
    }
}

//! Groups of two lists, in the form that an engine takes.
use std::ops::Range;

/// The checked offsets of the groups of both lists: group `g` has the rows `a[g]..a[g + 1]` and the columns
/// `b[g]..b[g + 1]`.
#[derive(Clone, Copy, Debug)]
pub struct GroupSpans<'a> {
    /// Offsets of the first list.
    pub a: &'a [usize],
    /// Offsets of the second list.
    pub b: &'a [usize],
}

impl GroupSpans<'_> {
    /// Returns the number of groups.
    pub(crate) fn count(&self) -> usize {
        self.a.len().saturating_sub(1)
    }
    /// Returns the rows of a group.
    pub(crate) fn rows(&self, group: usize) -> Range<usize> {
        self.a[group]..self.a[group + 1]
    }
    /// Returns the columns of a group.
    pub(crate) fn columns(&self, group: usize) -> Range<usize> {
        self.b[group]..self.b[group + 1]
    }
    /// Returns the rows and the columns of some groups.
    pub(crate) fn of(&self, groups: &Range<usize>) -> [Range<usize>; 2] {
        [self.a, self.b].map(|offsets| offsets[groups.start]..offsets[groups.end])
    }
}

//! Boxes around stretches of a list, for searches among its items.
use super::box_ends::{Ends, NOWHERE, joined, squared_gap};
use crate::arrays::sort_few;
use std::ops::Range;

/// The number of items in a leaf, and of boxes in a larger one.
pub(crate) const FEW: usize = 4;

/// A box: its level, and its place among those of the level.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// The level; the leaves have zero.
    pub level: usize,
    /// The place among the boxes of the level.
    pub place: usize,
}

impl Node {
    /// Returns the items of a leaf, of so many in all.
    pub fn items(self, count: usize) -> Range<usize> {
        self.place * FEW..count.min((self.place + 1) * FEW)
    }
}

/// Boxes around four items each, around four of these, and so on. Neighbours in the list should be near each other.
#[derive(Clone, Debug, Default)]
pub(crate) struct BoxTree {
    /// The boxes of leaves, then those of every larger level; the last one has all items.
    boxes: Vec<Ends>,
    /// The place of the first box of every level.
    levels: Vec<usize>,
}

impl BoxTree {
    /// Boxes of nothing.
    pub const NONE: Self = BoxTree {
        boxes: Vec::new(),
        levels: Vec::new(),
    };
    /// Takes other leaves, each around [`FEW`] items, and keeps the memory.
    pub fn replace(&mut self, leaves: impl Iterator<Item = Ends>) {
        self.boxes.clear();
        self.levels.clear();
        self.boxes.extend(leaves);
        let mut from = 0;
        loop {
            let end = self.boxes.len();
            self.levels.push(from);
            if end - from <= 1 {
                return;
            }
            for first in (from..end).step_by(FEW) {
                let own = self.boxes[first..end.min(first + FEW)].iter();
                self.boxes.push(own.copied().fold(NOWHERE, joined));
            }
            from = end;
        }
    }
    /// Returns the box around all items; `None` where there are none.
    pub fn whole(&self) -> Option<Ends> {
        self.boxes.last().copied()
    }
    /// Returns the largest box, which has all items. There must be some.
    pub fn top(&self) -> Node {
        Node {
            level: self.levels.len() - 1,
            place: 0,
        }
    }
    /// Returns a box.
    pub fn at(&self, node: Node) -> Ends {
        self.boxes[self.levels[node.level] + node.place]
    }
    /// Pushes the boxes in a larger one that are within a squared gap of another box, the nearest one last.
    #[inline]
    pub fn push_near(&self, node: Node, at: Ends, limit: f64, left: &mut Vec<(f64, Node)>) {
        let first = left.len();
        for child in self.children(node) {
            let gap = squared_gap(self.at(child), at);
            if gap <= limit {
                left.push((gap, child));
            }
        }
        sort_few(&mut left[first..], |(one, _), (another, _)| {
            another.total_cmp(one).is_lt()
        });
    }
    /// Returns the boxes in a larger one.
    pub fn children(&self, node: Node) -> impl Iterator<Item = Node> + use<> {
        let level = node.level - 1;
        let count = self.levels[node.level] - self.levels[level];
        let first = node.place * FEW;
        (first..count.min(first + FEW)).map(move |place| Node { level, place })
    }
}

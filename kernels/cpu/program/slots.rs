//! Slot allocation by linear scan: a number takes the slot of one that is not needed any more.
use crate::ad::program::graph::Id;

/// Slots in use and free ones.
pub(crate) struct Slots {
    /// The slot of each node.
    of: Vec<Option<u32>>,
    /// The number of reads of each node that are still to come.
    left: Vec<u32>,
    free: Vec<u32>,
    /// The number of slots.
    pub(crate) count: u32,
}

impl Slots {
    /// Creates an allocator from the number of reads of each node.
    pub(crate) fn new(left: Vec<u32>) -> Self {
        Slots {
            of: vec![None; left.len()],
            left,
            free: Vec::new(),
            count: 0,
        }
    }
    /// Takes any free slot, permanently or until it is given back.
    pub(crate) fn any(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        })
    }
    /// Takes a slot for a node.
    pub(crate) fn take(&mut self, x: Id) -> u32 {
        let slot = self.any();
        self.of[x as usize] = Some(slot);
        slot
    }
    /// Returns the slot of a node.
    pub(crate) fn at(&self, x: Id) -> Option<u32> {
        self.of[x as usize]
    }
    /// Counts one read of a node; its slot is free after the last one.
    pub(crate) fn read(&mut self, x: Id) {
        let left = &mut self.left[x as usize];
        *left -= 1;
        if let (0, Some(slot)) = (*left, self.of[x as usize]) {
            self.free.push(slot);
        }
    }
}

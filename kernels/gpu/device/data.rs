//! Lists of numbers, split into buffers that fit one binding each.
use super::context::SharedContext;

/// A buffer and its number of items.
#[derive(Clone, Debug)]
pub(super) struct BufferPiece {
    pub buffer: wgpu::Buffer,
    pub items: usize,
}

impl SharedContext {
    /// Creates buffers for a list of items of one number each.
    pub fn pieces(&self, len: usize) -> Vec<BufferPiece> {
        self.counted(len)
            .into_iter()
            .map(|items| {
                let buffer = self.storage(items);
                BufferPiece { buffer, items }
            })
            .collect()
    }
}

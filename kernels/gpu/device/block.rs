//! The splitting of lists and matrices into buffers.
use super::context::SharedContext;

/// A part of a matrix that fits one buffer: rows of one piece of `a` by all columns of one piece
/// of `b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// The index of the piece of `a`, the first row in it, and that row's index in the list.
    pub row_piece: usize,
    pub row_start: usize,
    pub row_base: usize,
    pub rows: usize,
    /// The index of the piece of `b`, and the first column's index in the list.
    pub column_piece: usize,
    pub column_base: usize,
    pub columns: usize,
}

/// Splits a matrix into blocks of at most `most_pairs` pairs. `a` and `b` have the numbers of items of the pieces.
fn blocks(a: &[usize], b: &[usize], most_pairs: usize) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut base = 0;
    // The widest piece of columns sets the height of all blocks, so that all blocks of a band share their rows.
    let widest = b.iter().copied().max().unwrap_or(1);
    let most_rows = (most_pairs / widest).clamp(1, MOST_ROWS);
    for (row_piece, &items) in a.iter().enumerate() {
        let mut row_start = 0;
        while row_start < items {
            let rows = most_rows.min(items - row_start);
            let mut column_base = 0;
            for (column_piece, &columns) in b.iter().enumerate() {
                blocks.push(Block {
                    row_piece,
                    row_start,
                    row_base: base + row_start,
                    rows,
                    column_piece,
                    column_base,
                    columns,
                });
                column_base += columns;
            }
            row_start += rows;
        }
        base += items;
    }
    blocks
}

/// The largest number of rows in a block, from the limit of one dimension of a dispatch.
const MOST_ROWS: usize = super::work::MOST_GROUPS * super::written::STEP;

/// The largest number of pairs in a dispatch: an operating system resets a GPU after seconds of one dispatch.
const MOST_PAIRS: u64 = 1 << 30;

impl SharedContext {
    /// Splits a list. Returns the number of items of each piece.
    pub fn counted(&self, len: usize) -> Vec<usize> {
        (0..len.div_ceil(self.chunk))
            .map(|i| self.chunk.min(len - i * self.chunk))
            .collect()
    }

    /// Splits a matrix into blocks; `bytes` is the memory of one pair.
    pub fn cut(&self, rows: usize, columns: usize, bytes: u64) -> Vec<Block> {
        let most_pairs = (self.most_bytes / bytes).min(MOST_PAIRS) as usize;
        blocks(&self.counted(rows), &self.counted(columns), most_pairs)
    }
}

/// Returns the numbers of one block of a matrix in row-major order.
pub(super) fn block_of(block: &Block, columns: usize, values: &[f32]) -> Vec<f32> {
    let mut own = Vec::with_capacity(block.rows * block.columns);
    for row in block.row_base..block.row_base + block.rows {
        own.extend_from_slice(&values[row * columns + block.column_base..][..block.columns]);
    }
    own
}

/// Copies a block to its place in a row-major matrix of `columns` columns.
pub(super) fn place_block(block: &Block, columns: usize, from: &[f32], to: &mut [f32]) {
    for (i, row) in from.chunks_exact(block.columns).enumerate() {
        let at = (block.row_base + i) * columns + block.column_base;
        to[at..][..block.columns].copy_from_slice(row);
    }
}

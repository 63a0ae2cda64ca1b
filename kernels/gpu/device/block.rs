//! How lists and matrices are cut into buffers.
use super::context::Inner;

/// A part of a matrix that fits one buffer: rows of one piece of `a` by all columns of one piece
/// of `b`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// Which piece of `a`, where in it the rows begin, and the first one's index in the list.
    pub row_piece: usize,
    pub row_start: usize,
    pub row_base: usize,
    pub rows: usize,
    /// Which piece of `b`, and the first column's index in the list.
    pub column_piece: usize,
    pub column_base: usize,
    pub columns: usize,
}

/// Cuts a matrix into blocks of at most so many pairs. `a` and `b` are the items of each piece.
fn blocks(a: &[usize], b: &[usize], most_pairs: usize) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut base = 0;
    // The widest piece of columns sets the height of all blocks, so that blocks of a band have the
    // same rows.
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

/// Rows per block: what one dimension of a dispatch may hold.
const MOST_ROWS: usize = super::work::MOST_GROUPS * super::written::STEP;

/// Pairs per dispatch: drivers reset a GPU that is busy with one for seconds.
const MOST_PAIRS: u64 = 1 << 30;

impl Inner {
    /// How a list is cut: the items of each piece.
    pub fn counted(&self, len: usize) -> Vec<usize> {
        (0..len.div_ceil(self.chunk))
            .map(|i| self.chunk.min(len - i * self.chunk))
            .collect()
    }

    /// How a matrix is cut, of whose pairs each takes so many bytes.
    pub fn cut(&self, rows: usize, columns: usize, bytes: u64) -> Vec<Block> {
        let most_pairs = (self.most_bytes / bytes).min(MOST_PAIRS) as usize;
        blocks(&self.counted(rows), &self.counted(columns), most_pairs)
    }
}

/// Returns the numbers of one block of a matrix, row by row.
pub(super) fn block_of(block: &Block, columns: usize, values: &[f32]) -> Vec<f32> {
    let mut own = Vec::with_capacity(block.rows * block.columns);
    for row in block.row_base..block.row_base + block.rows {
        own.extend_from_slice(&values[row * columns + block.column_base..][..block.columns]);
    }
    own
}

/// Copies a block to its place in a matrix of so many columns.
pub(super) fn place_block(block: &Block, columns: usize, from: &[f32], to: &mut [f32]) {
    for (i, row) in from.chunks_exact(block.columns).enumerate() {
        let at = (block.row_base + i) * columns + block.column_base;
        to[at..][..block.columns].copy_from_slice(row);
    }
}

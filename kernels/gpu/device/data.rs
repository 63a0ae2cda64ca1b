//! Boxes as kernels by hand want them, and lists of numbers, in buffers that fit a binding each.
use super::Inner;
use super::written::{Kind, TILE};
use crate::kernels::cpu::work::spread;

/// A buffer and how many items it holds.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub buffer: wgpu::Buffer,
    pub items: usize,
}

/// Boxes on the GPU, checked and prepared. Clones are the same boxes.
#[derive(Clone, Debug)]
pub(super) struct Boxes {
    pub kind: Kind,
    pub pieces: Vec<Piece>,
    pub len: usize,
    /// `true` if plain products of their numbers stay far from over- and underflow.
    pub is_ordinary: bool,
}

impl Inner {
    /// Buffers for a list of items of so many numbers each.
    pub fn pieces(&self, len: usize, fields: usize) -> Vec<Piece> {
        self.counted(len)
            .into_iter()
            .map(|items| {
                let buffer = self.storage(items.next_multiple_of(TILE) * fields);
                Piece { buffer, items }
            })
            .collect()
    }

    /// Brings boxes up that were checked: their numbers, box by box. They go into the buffers of as many
    /// others where there are any: calls before used those, and keep their results.
    pub fn boxes(&self, kind: Kind, numbers: &[f32], over: Option<&Boxes>) -> Boxes {
        let len = numbers.len() / kind.fields();
        let mut made = Boxes {
            kind,
            pieces: match over {
                Some(there) => there.pieces.clone(),
                None => self.pieces(len, 4 * kind.quads()),
            },
            len,
            is_ordinary: true,
        };
        let lists = numbers.chunks(self.chunk * kind.fields());
        for (piece, numbers) in made.pieces.iter().zip(lists) {
            let (quads, is_ordinary) = quads(kind, numbers);
            made.is_ordinary &= is_ordinary;
            self.write(&piece.buffer, &quads);
        }
        made
    }
}

/// Prepared boxes in tiles, and whether all are ordinary.
fn quads(kind: Kind, numbers: &[f32]) -> (Vec<[f32; 4]>, bool) {
    let room = TILE * kind.quads();
    let tiles = numbers.chunks(TILE * kind.fields());
    let mut all = vec![[0.0; 4]; tiles.len() * room];
    let mut ordinary = vec![true; tiles.len()];
    let places = all.chunks_mut(room).zip(&mut ordinary);
    let fill = |(numbers, (tile, is_ordinary)): (&[f32], (&mut [[f32; 4]], &mut bool))| {
        for (i, own) in numbers.chunks_exact(kind.fields()).enumerate() {
            let (quads, is_so) = kind.prepared(own);
            *is_ordinary &= is_so;
            for (q, &quad) in quads[..kind.quads()].iter().enumerate() {
                tile[q * TILE + i] = quad;
            }
        }
    };
    spread(tiles.zip(places).collect(), fill);
    (all, ordinary.iter().all(|&is_so| is_so))
}

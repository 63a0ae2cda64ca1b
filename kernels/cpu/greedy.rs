//! Suppression that computes only the pairs with a kept shape.
use crate::Real;
use crate::kernels::cpu::arch::flat;
use crate::kernels::cpu::lane::Planes;
use crate::kernels::cpu::pairs::Pairs;
use crate::kernels::cpu::sweep::RowChoice;
use crate::kernels::machine::suppress::Greed;

/// The state of a suppression: which shapes are kept, and which are suppressed.
struct Suppression<'a, T> {
    rules: Greed<'a, T>,
    /// The kept shape whose pairs are computed now.
    row: usize,
    gone: Vec<bool>,
    kept: Vec<usize>,
}

impl<T: Real> RowChoice<T> for Suppression<'_, T> {
    fn next(&mut self) -> Option<usize> {
        let first = self.kept.last().map_or(0, |last| last + 1);
        if self.kept.len() == self.rules.most {
            return None;
        }
        let next = first + self.gone.get(first..)?.iter().position(|gone| !gone)?;
        self.row = next;
        self.kept.push(next);
        Some(next)
    }
    fn wants(&self, column: usize) -> bool {
        let classes = self.rules.classes;
        column > self.row
            && !self.gone[column]
            && classes.is_none_or(|classes| classes[column] == classes[self.row])
    }
    fn take(&mut self, columns: &[u32], results: Planes<'_, T>) {
        for (&column, value) in columns.iter().zip(flat(results.field(0))) {
            self.gone[column as usize] = value.above(self.rules.threshold);
        }
    }
}

/// Returns the shapes of a list, best first, that no better kept shape suppresses. The better shape of a pair is the
/// first argument.
pub fn suppress<T: Real>(pairs: &Pairs<'_, T>, rules: Greed<'_, T>) -> Vec<usize> {
    let [count, _] = pairs.counts();
    let mut kept = Suppression {
        rules,
        row: 0,
        gone: vec![false; count],
        kept: Vec::new(),
    };
    if count > 0 {
        pairs.chosen(&mut kept);
    }
    kept.kept
}

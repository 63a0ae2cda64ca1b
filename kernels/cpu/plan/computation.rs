//! The preparation of a shape and the maker of blocks of results: the same for every kind of maker.
use crate::error::{Argument, Flaw};
use crate::kernels::cpu::lane::{Lane, Results, Tiles};
use crate::kernels::cpu::program::Interpreted;
use crate::kernels::item::Leaf;
use crate::kernels::recording::Mode;
use std::sync::Arc;

/// Something that computes blocks of items from one or more arguments.
///
/// Compiled kernels and interpreted programs are makers. A maker does not depend on batches.
pub(crate) trait Maker<T>: Send + Sync {
    /// Computes as many tiles of results as are asked for. Each input has at least as many tiles, or
    /// one that stands for all.
    fn make(&self, inputs: &[Tiles<'_, T>], out: Results<'_, T>);
    /// The program that computes the same from rows of numbers, if it is one.
    fn program(&self) -> Option<&Interpreted> {
        None
    }
}

/// Something that is made of each of many shapes, as tiles of numbers.
pub type Prepare<T> = Arc<dyn Fn(Tiles<'_, T>, &mut [Lane<T>]) + Send + Sync>;

/// Something that is made of each of many shapes and of the same shapes prepared.
pub type Outline<T> = Arc<dyn Fn([Tiles<'_, T>; 2], &mut [Lane<T>]) + Send + Sync>;

/// The preparation of every shape of a column.
#[derive(Clone)]
pub struct Preparation<T> {
    /// The operation's name of the argument, if it has one.
    pub name: Option<&'static str>,
    /// Numbers of a shape.
    pub fields: usize,
    /// How a shape is prepared, and how many numbers that gives; `None` to leave it as it is.
    pub frame: Option<(usize, Prepare<T>)>,
    /// The bounds of shapes in the plane; `None` where pairs that are apart have results to compute.
    pub bounds: Option<Outline<T>>,
    /// `true` if numbers are those of valid shapes of ordinary size: a quick test, which may also fail for some
    /// of these.
    pub all_ordinary: fn(&[T]) -> bool,
    /// Returns the flaw of a shape that is not valid.
    pub check: fn(&[T]) -> Result<(), Flaw>,
    /// `true` if a valid shape is too rare for kernels.
    pub is_rare: fn(&[T]) -> bool,
}

impl<T> Preparation<T> {
    /// Numbers of a prepared shape.
    pub fn frame_fields(&self) -> usize {
        self.frame.as_ref().map_or(self.fields, |frame| frame.0)
    }
    /// How errors call the shape, which is number `k` of those that the operation takes.
    pub fn argument(&self, k: usize) -> Argument {
        self.name.map_or(Argument::input(k), Argument::named)
    }
    /// A shape that is left as it is.
    pub fn plain(leaf: Leaf<T>) -> Self {
        Preparation {
            name: None,
            fields: leaf.fields,
            frame: None,
            bounds: None,
            all_ordinary: leaf.all_valid,
            check: leaf.check,
            is_rare: |_| false,
        }
    }
}

/// Gives shapes the names that an operation has for its arguments, if it has one for each.
pub(crate) fn name<T>(arguments: &mut [Preparation<T>], names: &[&'static str]) {
    if arguments.len() == names.len() {
        for (argument, &name) in arguments.iter_mut().zip(names) {
            argument.name = Some(name);
        }
    }
}

/// Results of an item that kernels do not serve: the numbers of its shapes, the cotangent of its
/// result, and room for a result, or for a result and derivatives.
pub type Rare<T> = Box<dyn Fn(&[&[T]], &[T], &mut [T]) + Send + Sync>;

/// How batches compute an operation.
pub struct Face<T> {
    /// For every shape that it takes.
    pub(crate) arguments: Vec<Preparation<T>>,
    /// Numbers of every shape that it gives.
    pub(crate) gives: Vec<usize>,
    /// How many numbers come before those.
    pub(crate) skipped: usize,
    /// Computes results of prepared shapes.
    pub(crate) maker: Box<dyn Maker<T>>,
    /// The steepest cotangent that the maker bears.
    pub(crate) steepest: f64,
    /// Results of shapes, or of cotangents, that the maker does not serve.
    pub(crate) rare: Option<Rare<T>>,
}

impl<T> Face<T> {
    /// Numbers that its maker puts down per item.
    pub(crate) fn made(&self) -> usize {
        self.skipped + self.gives.iter().sum::<usize>()
    }
    /// The plan of an operation that takes and gives such shapes. The result comes before its derivatives.
    pub(super) fn new(
        mode: Mode,
        arguments: Vec<Preparation<T>>,
        outputs: Vec<usize>,
        maker: Box<dyn Maker<T>>,
    ) -> Self {
        let derivatives: Vec<usize> = arguments.iter().map(|x| x.fields).collect();
        let skipped = mode.skipped(&outputs);
        let gives = mode.gives(&derivatives, &outputs);
        Face {
            arguments,
            gives,
            skipped,
            maker,
            steepest: f64::INFINITY,
            rare: None,
        }
    }
}

//! Data that stay on the machine between calls: one interface for the CPU and for GPUs.
//!
//! [`upload`](Machine::upload) makes an array on the machine, a column of every call. Results of such columns stay
//! there, too, so that calls chain; only [`download`](Held::download) brings data back. A call may mix arrays with
//! slices and [`One`](crate::kernels::One). On the CPU an array is the data itself, at no cost.
//!
//! ```
//! use geograd::Obb2;
//! use geograd::kernels::{Backend, Iou, Op};
//! let here = Backend::Cpu; // or a GPU
//! let mut guesses = vec![Obb2::new(0.4, 0.0, 2.0, 2.0, 0.0); 3];
//! let truths = vec![Obb2::new(0.0, 0.0, 2.0, 2.0, 0.0); 3];
//!
//! let (mut a, b) = (here.upload(&guesses)?, here.upload(&truths)?);
//! let mut found = here.aligned(Iou.value_grad(), (&a, &b))?;
//! for _ in 0..20 {
//!     let (_, (derivatives, _)) = found.download()?;
//!     for (guess, derivative) in guesses.iter_mut().zip(derivatives) {
//!         guess.center += derivative.center * 0.05;
//!     }
//!     a.update(&guesses)?; // into the same buffers, and so are the results
//!     here.aligned_into(Iou.value_grad(), (&a, &b), &mut found)?;
//! }
//! let (iou, _) = found.split(); // a handle of each part
//! assert!(iou.download()?.iter().all(|&iou| iou > 0.95));
//!
//! let matrix = here.all_pairs(Iou, &a, &b)?;
//! let best = matrix.row_max()?; // of a matrix on the machine
//! let matched = here.pick(&b, &best)?; // the truth of every guess
//! assert!(here.aligned(Iou, (&a, &matched))?.download()?[0] > 0.95);
//! # Ok::<(), geograd::Error>(())
//! ```
#[cfg(doc)]
use crate::kernels::machine::Machine;
pub use crate::kernels::machine::{
    Bests, Founds, Held, HeldNumbers, Matrix, Pending, RingBars, RingValues, Stored,
};

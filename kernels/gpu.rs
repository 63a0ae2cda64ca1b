#[path = "gpu_source.rs"]
mod source;
pub use source::*;

//! Rules of the repository itself: its imports, its names, the documentation of its functions, its unsafe code.
mod names;
mod prose;
mod source;
mod structure;

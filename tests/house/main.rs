//! Rules of the repository itself: its imports, its names, its unsafe code.
mod names;
mod source;
mod structure;

//! `#[derive(Shape)]` of geograd, where it is documented.
//!
//! It has no dependencies: it reads a struct's fields from its tokens, so that building geograd needs no parser of all
//! of Rust.
mod parse;
mod rules;
mod write;
mod writer;

use proc_macro::TokenStream;

/// Makes a struct of numbers a shape; see the documentation of `geograd::Shape`.
#[proc_macro_derive(Shape, attributes(shape))]
pub fn shape(input: TokenStream) -> TokenStream {
    match parse::shape(input) {
        Ok(shape) => write::impls(&shape),
        Err(refusal) => refusal.into_tokens(),
    }
}

//! `#[derive(Shape)]` of geograd, where it is documented.
//!
//! No dependencies: a struct's fields are read from its tokens in a few lines, and whoever builds
//! geograd builds no parser of all of Rust.
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

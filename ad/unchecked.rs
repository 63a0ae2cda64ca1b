//! The macros of the harness in a build without it: each is an error that names the missing feature.

/// Checks a gradient at points; needs the feature `check`.
#[macro_export]
macro_rules! assert_gradient {
    ($($any:tt)*) => {
        ::core::compile_error!(
            "`assert_gradient!` needs the feature `check` of geograd; add to Cargo.toml: [dev-dependencies] geograd = { …, features = [\"check\"] }"
        )
    };
}

/// A check of a function generic over the scalar; needs the feature `check`.
#[macro_export]
macro_rules! generic_check {
    ($($any:tt)*) => {
        ::core::compile_error!(
            "`generic_check!` needs the feature `check` of geograd; add to Cargo.toml: [dev-dependencies] geograd = { …, features = [\"check\"] }"
        )
    };
}

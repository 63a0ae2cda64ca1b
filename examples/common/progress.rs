//! Progress bars, which show themselves only where stderr is a terminal.
use indicatif::{ProgressBar, ProgressStyle};

/// A bar of a program.
#[must_use]
pub fn bar(program: &str, length: u64) -> ProgressBar {
    let bar = ProgressBar::new(length);
    let style = ProgressStyle::with_template("{prefix} {wide_bar} {percent} % {eta}");
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_prefix(program.to_owned());
    bar
}

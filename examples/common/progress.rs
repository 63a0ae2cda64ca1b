//! Progress bars, which show themselves only where stderr is a terminal.
use indicatif::{ProgressBar, ProgressStyle};

/// A bar of a program.
#[must_use]
pub fn bar(program: &str, length: u64) -> ProgressBar {
    let bar = styled("{prefix} {wide_bar} {percent} % {eta}", length);
    bar.with_prefix(program.to_owned())
}

/// A bar that looks as a template says.
#[must_use]
pub fn styled(template: &str, length: u64) -> ProgressBar {
    let style = ProgressStyle::with_template(template);
    ProgressBar::new(length).with_style(style.expect("a valid template"))
}

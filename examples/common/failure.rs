//! How the examples' command lines fail, and how they print.
use std::io::Write;
use std::process::ExitCode;

/// Why a run ends early.
#[derive(Debug)]
pub enum Failure {
    /// The command line makes no sense, or asks for what this build cannot do.
    Usage(String),
    /// The work itself went wrong.
    Work(String),
}

impl From<lexopt::Error> for Failure {
    fn from(error: lexopt::Error) -> Self {
        Failure::Usage(error.to_string())
    }
}

impl Failure {
    /// Says why on stderr and gives the exit status: 2 for usage, 1 for work.
    pub fn report(&self, program: &str) -> ExitCode {
        match self {
            Failure::Usage(why) => {
                eprintln!("{program}: {why}\nTry `--help`.");
                ExitCode::from(2)
            }
            Failure::Work(why) => {
                eprintln!("{program}: {why}");
                ExitCode::from(1)
            }
        }
    }
}

/// A command line that makes no sense.
///
/// # Errors
///
/// Always.
pub fn usage<X>(why: impl Into<String>) -> Result<X, Failure> {
    Err(Failure::Usage(why.into()))
}

/// Prints the text that a program ends with, or says why it failed.
pub fn finish(program: &str, done: Result<String, Failure>) -> ExitCode {
    match done {
        Ok(text) => {
            say(&text);
            ExitCode::SUCCESS
        }
        Err(failure) => failure.report(program),
    }
}

/// Prints a text. Output that the reader has closed is no failure.
pub fn say(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

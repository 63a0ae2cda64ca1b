//! What the examples' command lines share: how they fail, and which machine runs the batches.
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

/// Prints a text. A reader that has seen enough and gone away is no failure.
pub fn say(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// The machine that runs the batches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// `geograd::kernels::cpu`.
    Cpu,
}

impl Backend {
    /// From the value of `--backend`.
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        match name {
            "cpu" | "auto" => Ok(Backend::Cpu),
            "gpu" => Err(Failure::Usage(
                "this program was built without GPU support; use `--backend cpu`".into(),
            )),
            other => Err(Failure::Usage(format!(
                "`--backend {other}`: it is cpu, gpu or auto"
            ))),
        }
    }
}

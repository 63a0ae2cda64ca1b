//! Shared parts of the examples' command lines: how they fail, and which machine runs the batches.
pub use crate::failure::{Failure, say};
use geograd::kernels::Backend;
use geograd::kernels::backend::Auto;
use geograd::kernels::gpu::Gpu;
use geograd::{Error, GpuFault};

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Failure::Work(reason(error))
    }
}

/// The value of `--backend`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    Cpu,
    Gpu,
    /// A GPU if there is one that is faster.
    Auto,
}

impl Wish {
    /// From the text on the command line. A build without GPU support refuses to wish for one.
    pub fn from_name(name: &str) -> Result<Self, Failure> {
        match name {
            "cpu" => Ok(Wish::Cpu),
            "auto" => Ok(Wish::Auto),
            "gpu" if cfg!(feature = "gpu") => Ok(Wish::Gpu),
            "gpu" => Err(Failure::Usage(format!("`--backend gpu`: {UNSUPPORTED}"))),
            other => Err(Failure::Usage(format!(
                "`--backend {other}`: it is cpu, gpu or auto"
            ))),
        }
    }

    /// Gets the machine ready. Says on stderr what it is, unless it was clear from the start.
    pub fn machine(self, program: &str) -> Result<Machine, Failure> {
        let gpu = match self {
            Wish::Cpu => return Ok(Machine::Cpu),
            Wish::Gpu => Gpu::new()?,
            Wish::Auto => match Backend::auto() {
                Auto::Gpu(gpu) => gpu,
                Auto::Cpu(error) => return Ok(on_the_cpu(program, &reason(error))),
            },
        };
        eprintln!("{program}: computing on {gpu}");
        Ok(Machine::Gpu(gpu))
    }
}

/// `true` for the value `f64` of `--precision`, `false` for `f32`.
pub fn is_double(name: &str) -> Result<bool, Failure> {
    match name {
        "f32" => Ok(false),
        "f64" => Ok(true),
        other => Err(Failure::Usage(format!(
            "`--precision {other}`: it is f32 or f64"
        ))),
    }
}

/// Why there is no GPU in a build without the feature.
const UNSUPPORTED: &str =
    "this program was built without GPU support (`cargo run --features gpu` adds it)";

/// The processor where a GPU would have done, with the reason told.
pub fn on_the_cpu(program: &str, why: &str) -> Machine {
    eprintln!("{program}: computing on the CPU: {why}");
    Machine::Cpu
}

/// The message for the user about a failed call.
fn reason(error: Error) -> String {
    let wanted = std::env::var("GEOGRAD_GPU").unwrap_or_default();
    match error {
        Error::Gpu(GpuFault::NotBuilt) => UNSUPPORTED.into(),
        Error::Gpu(GpuFault::NoSuchAdapter) => format!("no GPU found that is GEOGRAD_GPU={wanted}"),
        other => other.to_string(),
    }
}

/// The machine that runs the batches.
#[derive(Debug)]
pub enum Machine {
    Cpu,
    Gpu(Gpu),
}

impl Machine {
    pub fn backend(&self) -> Backend<'_> {
        match self {
            Machine::Cpu => Backend::Cpu,
            Machine::Gpu(gpu) => Backend::Gpu(gpu),
        }
    }
}

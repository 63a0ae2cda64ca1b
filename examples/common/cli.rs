//! Shared parts of the examples' command lines: how they fail, and which machine runs the batches.
pub use crate::failure::{Failure, finish, say, usage};
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
            "gpu" if cfg!(not(feature = "gpu")) => usage(format!("`--backend gpu`: {UNSUPPORTED}")),
            _ => {
                let known = [("cpu", Wish::Cpu), ("gpu", Wish::Gpu), ("auto", Wish::Auto)];
                choice("--backend", name, known)
            }
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
    choice("--precision", name, [("f32", false), ("f64", true)])
}

/// The value of an option that has one of these names.
pub fn choice<T, const N: usize>(
    option: &str,
    name: &str,
    known: [(&str, T); N],
) -> Result<T, Failure> {
    let names = known.each_ref().map(|own| own.0);
    if let Some((_, found)) = known.into_iter().find(|own| own.0 == name) {
        return Ok(found);
    }
    let list = match &names[..] {
        [first @ .., last] if N < 4 => format!("{} or {last}", first.join(", ")),
        all => format!("one of {}", all.join(", ")),
    };
    usage(format!("`{option} {name}`: it is {list}"))
}

/// Why no GPU computes in double precision.
pub const NO_F64: &str = "GPUs have no f64; `--precision f32` allows one";

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

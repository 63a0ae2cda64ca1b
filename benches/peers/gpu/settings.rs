//! Settings of the bench, and the fastest of several runs.
use geograd::Error;
use geograd::kernels::gpu::Gpu;
use std::time::{Duration, Instant};

/// Runs of each; the fastest counts, the others are noise of the machine.
const RUNS: usize = 5;

/// The fastest of several runs, by the clock and by the GPU's own.
pub struct Took {
    pub wall: Duration,
    pub kernel: Option<Duration>,
}

/// Runs that take this long are enough.
const LONG: Duration = Duration::from_secs(2);

pub fn fastest(gpu: &Gpu, mut run: impl FnMut() -> Result<(), Error>) -> Result<Took, Error> {
    let mut took = Took {
        wall: Duration::MAX,
        kernel: None,
    };
    let began = Instant::now();
    for _ in 0..=RUNS {
        let _ = gpu.take_kernel_time();
        let start = Instant::now();
        run()?;
        gpu.wait()?;
        let wall = start.elapsed();
        took.wall = took.wall.min(wall);
        let kernel = gpu.take_kernel_time();
        took.kernel = match (took.kernel, kernel) {
            (Some(least), Some(this)) => Some(least.min(this)),
            (least, this) => least.or(this),
        };
        if began.elapsed() > LONG {
            break;
        }
    }
    Ok(took)
}

/// The settings of the command line.
pub struct Settings {
    /// Operations; all if there are none.
    pub names: Vec<String>,
    /// Parts of the bench; all but `targets` if there are none.
    pub parts: Vec<String>,
    pub scale: f64,
    pub csv: Option<String>,
    /// The time after which no measurement begins.
    pub deadline: Instant,
}

const PARTS: [&str; 4] = ["hand", "list", "targets", "row_max"];

impl Settings {
    pub fn new() -> Result<Self, String> {
        let mut settings = Settings {
            names: Vec::new(),
            parts: Vec::new(),
            scale: 1.0,
            csv: None,
            deadline: Instant::now() + Duration::from_secs(60 * 7),
        };
        let known: Vec<&str> = geograd_tests::listed::list()
            .iter()
            .map(|op| op.name)
            .collect();
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or(format!("`{word}` needs a value"));
            match word.as_str() {
                // Cargo's own.
                "--bench" => {}
                "--csv" => settings.csv = Some(value()?),
                "--minutes" => {
                    let minutes: f64 = value()?.parse().map_err(|_| "`--minutes` is a number")?;
                    let seconds = (60.0 * minutes).clamp(0.0, 1e6);
                    settings.deadline = Instant::now() + Duration::from_secs_f64(seconds);
                }
                part if PARTS.contains(&part) => settings.parts.push(word),
                name if known.contains(&name) => settings.names.push(word),
                other => match other.parse::<f64>() {
                    Ok(scale) if scale > 0.0 && scale.is_finite() => settings.scale = scale,
                    _ => {
                        return Err(format!(
                            "`{other}`: no operation of the list and no part of the bench"
                        ));
                    }
                },
            }
        }
        Ok(settings)
    }
    pub fn wants(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.iter().any(|own| own == name)
    }
    /// `true` if the settings name a part, or no part at all.
    pub fn has(&self, part: &str) -> bool {
        match self.parts.is_empty() {
            // An operation is not every operation's row maxima.
            true => part != "targets" && (part != "row_max" || self.names.is_empty()),
            false => self.parts.iter().any(|own| own == part),
        }
    }
}

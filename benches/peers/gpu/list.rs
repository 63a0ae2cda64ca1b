//! The whole list by generated kernels over data that stay: kernel time, bytes and counted instructions of
//! every form, and what share of the machine that is.
use crate::count::count;
use crate::settings::{Settings, fastest};
use geograd::kernels::Backend;
use geograd::kernels::gpu::Gpu;
use geograd::{Error, Program, Scalar, Sym, Unrecordable};
use geograd_tests::listed::ready::CORNERS;
use geograd_tests::listed::{Form, Listed, list};
use std::fmt::Write;
use std::time::Instant;

/// The bytes that an item moves and its instructions; `None` if they are not counted.
#[derive(Clone, Copy, Debug)]
struct Cost {
    bytes: usize,
    instructions: Option<usize>,
}

/// Numbers that a function takes and gives: `fn body(x: array<f32, 9>) -> array<f32, 1> {`.
fn numbers(text: &str, function: &str) -> Option<(usize, usize)> {
    let head = text
        .split(&format!("fn {function}("))
        .nth(1)?
        .lines()
        .next()?;
    let mut counts = head.split("array<f32, ").skip(1);
    let mut next = || counts.next()?.split('>').next()?.parse::<usize>().ok();
    Some((next()?, next()?))
}

/// Bytes that an item of an aligned kernel reads and writes.
pub fn bytes(texts: &[(String, String)], kernel: &str) -> usize {
    let found = texts.iter().find(|(own, _)| own.ends_with(kernel));
    let counts = found.and_then(|(_, text)| numbers(text, "body"));
    counts.map_or(0, |(taken, given)| 4 * (taken + given))
}

fn cost(op: &Listed, form: Form) -> Result<Cost, Error> {
    let texts = op.shaders()?;
    let of = |kernel: &str| {
        let found = texts.iter().find(|(own, _)| own.ends_with(kernel));
        found.map(|(_, text)| text.as_str())
    };
    let aligned = |kernel: &str| Cost {
        bytes: bytes(&texts, kernel),
        instructions: of(kernel).map(|text| count(text, "body").total()),
    };
    let paths = |kernel: &str, bytes: usize, parts: &[&str]| Cost {
        bytes: bytes * CORNERS,
        instructions: of(kernel).map(|text| {
            CORNERS
                * parts
                    .iter()
                    .map(|part| count(text, part).total())
                    .sum::<usize>()
        }),
    };
    Ok(match form {
        Form::Value => aligned("Value Aligned"),
        Form::Gradient => aligned("ValueGrad Aligned"),
        Form::Adjoint => aligned("Vjp Aligned"),
        // Boxes are read once for many pairs.
        Form::Pairs => Cost {
            bytes: 4,
            instructions: of("Value Pairs").map(|text| count(text, "body").total()),
        },
        // Once for the rows and once for the columns; every derivative is added up.
        Form::PairsAdjoint => Cost {
            bytes: 8,
            instructions: of("Vjp RowDerivatives")
                .zip(of("Vjp ColumnDerivatives"))
                .map(|(rows, columns)| {
                    let sums = |text| numbers(text, "body").map_or(0, |(_, given)| given);
                    let both = [rows, columns];
                    both.iter()
                        .map(|text| count(text, "body").total() + sums(text))
                        .sum()
                }),
        },
        Form::Paths => paths("Fold", 8, &["fold_edge", "fold_join"]),
        Form::PathsAdjoint => paths(
            "FoldDerivatives",
            16,
            &[
                "fold_edge",
                "fold_join",
                "fold_edge",
                "fold_join_vjp",
                "fold_edge_vjp",
            ],
        ),
    })
}

/// Instructions of plain arithmetic a second, of a program of nothing else.
pub fn arithmetic(gpu: &Gpu, settings: &Settings) -> Result<f64, Error> {
    const STEPS: usize = 256;
    const CHAINS: usize = 4;
    type S = Sym<f32>;
    let program = Program::trace(|x: S| {
        let mut chains = [0.0_f32, 0.1, 0.2, 0.3].map(|k| x + S::lit(f64::from(k)));
        for _ in 0..STEPS {
            chains = chains.map(|y| y * y - S::lit(0.7));
        }
        (chains[0] + chains[1]) + (chains[2] + chains[3])
    })?;
    let count = ((1 << 22) as f64 * settings.scale) as usize;
    let here = Backend::Gpu(gpu).resident();
    let held = here.upload(&vec![0.25; count])?;
    let mut found = here.aligned(&program, &held)?;
    let took = fastest(gpu, || here.aligned_into(&program, &held, &mut found))?;
    let instructions = 2 * STEPS * CHAINS;
    Ok((count * instructions) as f64 / took.kernel.unwrap_or(took.wall).as_secs_f64())
}

const HEAD: &str = "\
| operation | batch | items | kernel | M/s | bytes each | instructions each | of copy bandwidth | of arithmetic |
| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |";

/// The machine as it was measured: what copies, and what computes.
#[derive(Clone, Copy, Debug)]
pub struct Roofs {
    /// Bytes a second.
    pub copy: f64,
    /// Instructions a second.
    pub arithmetic: f64,
}

/// Measures all operations, or those that are named; gives the table as lines of a CSV file.
pub fn all(gpu: &Gpu, settings: &Settings, roofs: Roofs) -> Result<String, Error> {
    println!("\nGenerated kernels over data that stay:\n\n{HEAD}");
    let mut csv = String::from(
        "operation,form,items,kernel_seconds,million_per_second,bytes_each,instructions_each,\
         share_of_copy,share_of_arithmetic\n",
    );
    let (mut left_out, mut searches) = (Vec::new(), Vec::new());
    for op in list().iter().filter(|op| settings.wants(op.name)) {
        if Instant::now() > settings.deadline {
            left_out.push(op.name);
            continue;
        }
        for form in op.forms() {
            match line(gpu, settings, roofs, op, form) {
                Ok(line) => csv += &line,
                Err(Error::Program(Unrecordable::Search)) => {
                    searches.push(op.name);
                    break;
                }
                Err(error) => return Err(error),
            }
        }
    }
    for (names, why) in [
        (searches, "search, and are for the CPU"),
        (left_out, "were left out: the time was over (`--minutes`)"),
    ] {
        if !names.is_empty() {
            println!("\n{} operations {why}: {}", names.len(), names.join(", "));
        }
    }
    Ok(csv)
}

fn line(
    gpu: &Gpu,
    settings: &Settings,
    roofs: Roofs,
    op: &Listed,
    form: Form,
) -> Result<String, Error> {
    let Cost {
        bytes,
        instructions,
    } = cost(op, form)?;
    let most = match form {
        Form::Pairs | Form::PairsAdjoint => 1 << 24,
        Form::Paths | Form::PathsAdjoint => (1 << 24) / CORNERS,
        // Half a gigabyte is more than caches hold.
        _ => (1 << 22).min((1 << 29) / bytes.max(1)),
    };
    let wanted = ((most as f64 * settings.scale) as usize).max(256);
    let mut ready = op.make(form, Backend::Gpu(gpu), wanted)?;
    let items = match form {
        Form::Pairs | Form::PairsAdjoint => ((wanted as f64).sqrt() as usize).pow(2),
        _ => wanted,
    };
    let took = fastest(gpu, || ready.run())?;
    let seconds = took.kernel.unwrap_or(took.wall).as_secs_f64();
    let rate = items as f64 / seconds;
    let copy = rate * bytes as f64 / roofs.copy;
    let computing = instructions.map(|each| rate * each as f64 / roofs.arithmetic);
    let percent =
        |share: Option<f64>| share.map_or("—".into(), |x| format!("{:.0} %", 100.0 * x));
    let name = op.name;
    println!(
        "| {name} | {} | {items} | {:.2?} | {:.1} | {bytes} | {} | {} | {} |",
        form.title(),
        took.kernel.unwrap_or(took.wall),
        rate / 1e6,
        instructions.map_or("—".into(), |each| each.to_string()),
        percent(Some(copy)),
        percent(computing),
    );
    let mut line = String::new();
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.4}"));
    let _ = writeln!(
        line,
        "{name},\"{}\",{items},{seconds:.9},{:.3},{bytes},{},{copy:.4},{}",
        form.title(),
        rate / 1e6,
        instructions.map_or(String::new(), |each| each.to_string()),
        number(computing),
    );
    Ok(line)
}

//! Tests on a GPU: the context, and what is asked of every operation.
use geograd::ad::check::Plan;
use geograd::ad::check::sample::Sample;
use geograd::kernels::check::{prove_on, prove_with};
use geograd::kernels::gpu::{Gpu, op_sources};
use geograd::kernels::{Backend, Op, Row};
use std::sync::OnceLock;

/// One context for all tests of a binary; `None`, loudly, where there is no adapter.
///
/// # Panics
///
/// If there is none and `GEOGRAD_REQUIRE_GPU=1`.
pub fn any_gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Option<Gpu>> = OnceLock::new();
    let made = GPU.get_or_init(|| match Gpu::new() {
        Ok(gpu) => {
            eprintln!("testing on {}", gpu.adapter());
            Some(gpu)
        }
        Err(error) => {
            let required = std::env::var("GEOGRAD_REQUIRE_GPU").is_ok_and(|x| x == "1");
            assert!(!required, "a GPU is required: {error}");
            eprintln!("SKIPPED, NOTHING WAS TESTED: {error}");
            None
        }
    });
    made.as_ref()
}

/// A shader parses and passes validation without any GPU.
pub fn validate(name: &str, text: &str) {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let module = match naga::front::wgsl::parse_str(text) {
        Ok(module) => module,
        Err(error) => panic!("{name}: {}", error.emit_to_string(text)),
    };
    // WebGPU's own capabilities, and subgroups where a device has them.
    let capabilities = Capabilities::SUBGROUP;
    if let Err(error) = Validator::new(ValidationFlags::all(), capabilities).validate(&module) {
        panic!("{name}: {}", error.emit_to_string(text));
    }
}

/// Shader text needs no GPU to be judged.
pub fn shaders_are_valid<O: Op>()
where
    O::In<f32>: Row<Scalar = f32>,
    O::Out<f32>: Row,
{
    for (name, text) in op_sources::<O>().unwrap() {
        validate(&name, &text);
    }
}

/// Values and slopes are the processor's, within what the harness measures.
pub fn agrees<O: Op>()
where
    O::In<f64>: Sample + Row,
    O::Out<f64>: Sample + Row,
    O::In<f32>: Row<Scalar = f32>,
    O::Out<f32>: Row<Scalar = f32>,
{
    let Some(gpu) = any_gpu() else { return };
    // Of what has tens of thousands of operations, fewer inputs.
    let is_large = O::default().program::<f32>().unwrap().cost().total() > 5000;
    // What takes time is the harness, which has said the same of the processor's batches.
    let plan = Plan {
        hard: if is_large { 197 } else { 71 },
        ..Plan::new(if is_large { 4 } else { 10 }, 1)
    };
    let report = prove_on::<O>(Backend::Gpu(gpu), &plan).unwrap();
    assert!(report.worst[5].count > 0, "{report}");
    // What is refused without a GPU, too, is for the harness's own tests to say.
    let alone = || prove_with::<O, f32>(&plan);
    let refused = report.failures.len();
    assert!(
        refused == 0 || refused == alone().failures.len(),
        "{report}"
    );
}

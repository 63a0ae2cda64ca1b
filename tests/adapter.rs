//! Tests on a GPU: the context, and whether shader text is valid.
use geograd::kernels::gpu::Gpu;
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

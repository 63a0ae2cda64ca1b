use geograd::kernels::gpu::{pair_sources, ring_sources};
use naga::valid::{Capabilities, ValidationFlags, Validator};
fn validate(name: &str, text: &str) {
    let module = match naga::front::wgsl::parse_str(text) {
        Ok(module) => module,
        Err(error) => panic!("{name}: {}", error.emit_to_string(text)),
    };
    let capabilities = Capabilities::SUBGROUP;
    if let Err(error) = Validator::new(ValidationFlags::all(), capabilities).validate(&module) {
        panic!("{name}: {}", error.emit_to_string(text));
    }
}
macro_rules! shaders {
    (pairs { $($pair:ident: $pair_op:ty,)* } rings { $($ring:ident: $ring_op:ty,)* }) => {
        #[test]
        fn every_shader_is_valid() {
            let mut all = Vec::new();
            $(all.extend(pair_sources::<$pair_op>());)*
            $(all.extend(ring_sources::<$ring_op>());)*
            for (name, text) in &all { validate(name, text); }
            assert!(all.len() > 9);
        }
    };
}
geograd::for_each_op!(shaders);

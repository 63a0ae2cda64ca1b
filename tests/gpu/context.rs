//! Contexts: choosing, sharing, waiting.
use crate::gpu;
use crate::shapes::{Draw, bits};
use geograd::Obb2;
use geograd::kernels::Backend;
use geograd::kernels::gpu::{Gpu, Options};
use geograd::{Error, GpuFault};
use geograd_tests::rows::overlap;

#[test]
fn contexts_are_shared_between_threads() {
    let Some((_turn, gpu)) = gpu() else { return };
    let here = Backend::Gpu(gpu).resident();
    let on = here.upload(&Obb2::<f32>::hard()).unwrap();
    let once = || {
        let matrix = here.all_pairs(overlap::IouObb2, &on, &on).unwrap();
        bits(&matrix.download().unwrap())
    };
    let first = once();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            // Again and again: threads are told of each other's downloads.
            scope.spawn(|| (0..25).for_each(|_| assert_eq!(once(), first)));
        }
    });
}

#[test]
fn adapters_are_chosen_by_name() {
    use geograd::kernels::gpu::Choice;
    assert_eq!(Choice::parse(" CPU "), Choice::Cpu);
    assert_eq!(Choice::parse("1"), Choice::Index(1));
    assert_eq!(Choice::parse("H200"), Choice::Name("H200".to_owned()));
    let Some((_turn, gpu)) = gpu() else { return };
    let mut options = Options::default();
    options.adapter = Choice::Index(gpu.adapter().index);
    assert_eq!(Gpu::with(&options).unwrap().adapter(), gpu.adapter());
    options.adapter = Choice::Name("no such GPU".to_owned());
    assert_eq!(
        Gpu::with(&options).unwrap_err(),
        Error::Gpu(GpuFault::NoSuchAdapter)
    );
}

//! Bad input and faults: typed errors, after which everything else still works.
use crate::gpu;
use crate::shapes::{Draw, fields};
use geograd::error::{Argument, Field};
use geograd::kernels::gpu::{Gpu, GpuPair};
use geograd::kernels::{Backend, GpuError, overlap, reduce, ring};
use geograd::{Aabb2, Error, Flaw, Obb2, Vec2};

pub fn bad_input_is_refused<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let (bad, flaw) = O::Shape::flawed();
    let good = O::Shape::hard()[0];
    let invalid = |argument| {
        GpuError::Input(Error::Invalid {
            argument,
            row: 1,
            flaw,
        })
    };
    assert_eq!(
        gpu.upload(&[good, bad]).unwrap_err(),
        invalid(Argument::Shape)
    );
    let backend = Backend::Gpu(gpu);
    let refused = backend.aligned::<O>(&[good, good], &[good, bad]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::B));
    let refused = backend.all_pairs::<O>(&[good, bad], &[good]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::A));
    let on = gpu.upload(&[good, good]).unwrap();
    let one = gpu.upload(&[good]).unwrap();
    let length = |argument, expected, found| {
        GpuError::Input(Error::Length {
            argument,
            expected,
            found,
        })
    };
    let refused = gpu.aligned::<O>(&on, &one).unwrap_err();
    assert_eq!(refused, length(Argument::B, 2, 1));
    let upstream = gpu.upload_values(&[1.0]).unwrap();
    let refused = gpu.aligned_vjp::<O>(&on, &on, &upstream).unwrap_err();
    assert_eq!(refused, length(Argument::Upstream, 2, 1));
    assert!(gpu.upload_values(&[f32::INFINITY]).is_err());
    assert!(gpu.upload_matrix(2, 2, &[1.0; 3]).is_err());
    assert!(gpu.above::<O>(&on, &on, f32::NAN).is_err());
    // What was refused harmed nothing.
    assert!(gpu.aligned::<O>(&on, &on).unwrap().download().is_ok());
}

pub fn empty_batches_are_valid<O: GpuPair>()
where
    O::Shape: Draw,
{
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    let (none, one) = (&[][..], &[O::Shape::hard()[0]][..]);
    assert_eq!(backend.aligned::<O>(none, none).unwrap(), []);
    assert_eq!(backend.aligned_grad::<O>(none, none).unwrap().0, []);
    assert_eq!(backend.all_pairs::<O>(none, one).unwrap(), []);
    assert_eq!(backend.all_pairs::<O>(one, none).unwrap(), []);
    assert_eq!(backend.all_pairs_grad::<O>(one, none).unwrap().planes, []);
    let (a_bars, b_bars) = backend.all_pairs_vjp::<O>(one, none, &[]).unwrap();
    assert_eq!((a_bars.len(), b_bars.len()), (1, 0));
    assert!(fields(a_bars[0]).iter().all(|&slope| slope == 0.0));
    assert_eq!(backend.row_max::<O>(none, one).unwrap(), []);
    assert_eq!(
        backend.row_max::<O>(one, none).unwrap_err(),
        Backend::Cpu.row_max::<O>(one, none).unwrap_err()
    );
    assert_eq!(backend.above::<O>(one, none, 0.5).unwrap(), []);
    assert_eq!(backend.sum::<O>(one, none).unwrap(), 0.0);
    assert_eq!(backend.mean::<O>(none, none).unwrap(), 0.0);
}

#[test]
fn rings_may_be_missing_or_bad() {
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    assert_eq!(backend.ragged::<ring::SignedArea>(&[], &[0]).unwrap(), []);
    assert_eq!(
        backend.ragged::<ring::SignedArea>(&[], &[0, 0]).unwrap(),
        [0.0]
    );
    for (vertices, offsets) in [
        (vec![Vec2::new(f32::NAN, 0.0)], vec![0, 1]),
        (vec![Vec2::new(0.0, 0.0)], vec![0, 2]),
        (vec![], vec![]),
    ] {
        assert_eq!(
            backend
                .ragged::<ring::Centroid>(&vertices, &offsets)
                .unwrap_err(),
            Backend::Cpu
                .ragged::<ring::Centroid>(&vertices, &offsets)
                .unwrap_err()
        );
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some((_turn, other)) = gpu() else { return };
    let gpu = Gpu::new().unwrap();
    let boxes = Obb2::<f32>::hard();
    let on = gpu.upload(&boxes).unwrap();
    let values = gpu.aligned::<overlap::IouObb2>(&on, &on).unwrap();
    let pending = values.start_download().unwrap();
    // A handle of one context is nothing to another.
    let foreign = other.aligned::<overlap::IouObb2>(&on, &on);
    assert_eq!(foreign.unwrap_err(), GpuError::ForeignBuffer);
    gpu.destroy();
    assert_eq!(pending.wait().unwrap_err(), GpuError::DeviceLost);
    assert_eq!(values.download().unwrap_err(), GpuError::DeviceLost);
    assert_eq!(gpu.upload(&boxes).unwrap_err(), GpuError::DeviceLost);
    assert_eq!(gpu.wait().unwrap_err(), GpuError::DeviceLost);
    let lost = gpu.all_pairs::<overlap::IouObb2>(&on, &on);
    assert_eq!(lost.unwrap_err(), GpuError::DeviceLost);
}

#[test]
fn too_much_is_an_error() {
    let Some((_turn, gpu)) = gpu() else { return };
    // More than any address space: refused before anything is asked of the device.
    let refused = gpu.upload_matrix(usize::MAX, 2, &[]);
    assert_eq!(refused.unwrap_err(), GpuError::Input(Error::TooLarge));
}

#[test]
fn rows_in_errors_count_from_the_start() {
    // More rows than a reduction on the CPU takes at a time.
    let mut boxes = vec![Aabb2::new(0.0, 0.0, 1.0, 1.0); 600];
    boxes[599].max.x = -1.0;
    let refused = reduce::row_max::<overlap::IouAabb2, f32>(&boxes, &boxes[..500]);
    let expected = Error::Invalid {
        argument: Argument::A,
        row: 599,
        flaw: Flaw::Inverted(Field::MinX),
    };
    assert_eq!(refused.unwrap_err(), expected);
}

//! Bad input and faults: typed errors, after which everything else still works.
use crate::gpu;
use crate::shapes::{Draw, Score, fields};
use geograd::GpuFault;
use geograd::error::{Argument, Field};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Backend, Op};
use geograd::{Aabb2, Error, Flaw, Obb2, Vec2};
use geograd_tests::calls;
use geograd_tests::rows::{iou, overlap, ring};

pub fn bad_input_is_refused<O: Score>() {
    let Some((_turn, gpu)) = gpu() else { return };
    let (bad, flaw) = O::Shape::flawed();
    let good = O::Shape::hard()[0];
    let invalid = |argument| Error::Invalid {
        argument,
        item: 1,
        flaw,
    };
    let (run, here) = (O::default(), Backend::Gpu(gpu).resident());
    let refused = here.upload(&[good, bad]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::Shape));
    let refused = gpu.aligned(run, (&[good, good], &[good, bad]));
    assert_eq!(refused.unwrap_err(), invalid(Argument::B));
    let refused = gpu.all_pairs(run, &[good, bad], &[good]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::A));
    let refused = gpu.row_max(run, &[good], &[good, bad]);
    assert_eq!(refused.unwrap_err(), invalid(Argument::B));
    let on = here.upload(&[good, good]).unwrap();
    let one = here.upload(&[good]).unwrap();
    let length = |argument, expected, found| Error::Length {
        argument,
        expected,
        found,
    };
    let refused = here.aligned(run, (&on, &one)).unwrap_err();
    assert_eq!(refused, length(Argument::B, 2, 1));
    let refused = gpu.all_pairs_vjp(run, &[good], &[good], &[1.0; 2]);
    assert_eq!(refused.unwrap_err(), length(Argument::Upstream, 1, 2));
    assert!(here.upload(&[f32::INFINITY]).is_err());
    assert!(here.upload_matrix(2, 2, &[1.0; 3]).is_err());
    assert!(here.above(run, &on, &on, f32::NAN).is_err());
    // The refused calls leave the data as they were.
    assert!(here.aligned(run, (&on, &on)).unwrap().download().is_ok());
}

pub fn empty_batches_are_valid<O: Score>() {
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    let run = O::default();
    let (none, one): (&[O::Shape], &[O::Shape]) = (&[], &[O::Shape::hard()[0]]);
    assert_eq!(backend.aligned(run, (none, none)).unwrap(), []);
    let grads = backend.aligned(run.value_grad(), (none, none)).unwrap();
    assert_eq!(grads.0, []);
    assert_eq!(backend.all_pairs(run, none, one).unwrap().planes(), []);
    assert_eq!(backend.all_pairs(run, one, none).unwrap().planes(), []);
    let grads = backend.all_pairs(run.value_grad(), one, none).unwrap();
    assert_eq!(grads.planes(), []);
    let (a_bars, b_bars) = backend.all_pairs_vjp(run, one, none, &[]).unwrap();
    assert_eq!((a_bars.len(), b_bars.len()), (1, 0));
    assert!(
        fields(a_bars[0])
            .iter()
            .all(|&derivative| derivative == 0.0)
    );
    assert_eq!(backend.row_max(run, none, one).unwrap(), []);
    assert_eq!(
        backend.row_max(run, one, none).unwrap_err(),
        Backend::Cpu.row_max(run, one, none).unwrap_err()
    );
    assert_eq!(backend.above(run, one, none, 0.5).unwrap(), []);
    assert_eq!(backend.sum(run, one, none).unwrap(), 0.0);
    assert_eq!(backend.mean(run, none, none).unwrap(), 0.0);
    let (sum, by_a, _) = backend.sum_grad(run, one, none).unwrap();
    assert!(sum == 0.0 && fields(by_a[0]).iter().all(|&derivative| derivative == 0.0));
}

#[test]
fn rings_may_be_missing_or_bad() {
    let Some((_turn, gpu)) = gpu() else { return };
    let backend = Backend::Gpu(gpu);
    assert_eq!(
        backend
            .ragged(ring::SignedArea, &[] as &[Vec2<f32>], &[0])
            .unwrap(),
        []
    );
    assert_eq!(
        backend
            .ragged(ring::SignedArea, &[] as &[Vec2<f32>], &[0, 0])
            .unwrap(),
        [0.0]
    );
    for (vertices, offsets) in [
        (vec![Vec2::new(f32::NAN, 0.0)], vec![0, 1]),
        (vec![Vec2::new(0.0, 0.0)], vec![0, 2]),
        (vec![], vec![]),
    ] {
        assert_eq!(
            backend
                .ragged(ring::Centroid, &vertices, &offsets)
                .unwrap_err(),
            Backend::Cpu
                .ragged(ring::Centroid, &vertices, &offsets)
                .unwrap_err()
        );
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some((_turn, other)) = gpu() else { return };
    let gpu = Gpu::new().unwrap();
    let boxes = Obb2::<f32>::hard();
    let here = Backend::Gpu(&gpu).resident();
    let on = here.upload(&boxes).unwrap();
    let values = here.aligned(overlap::IouObb2, (&on, &on)).unwrap();
    let pending = values.start_download().unwrap();
    // A handle of one context is nothing to another.
    let other = Backend::Gpu(other).resident();
    let foreign = Error::Gpu(GpuFault::ForeignBuffer);
    let refused = other.aligned(overlap::IouObb2, (&on, &on));
    assert_eq!(refused.unwrap_err(), foreign);
    let refused = other.row_max(overlap::IouObb2, &on, &on);
    assert_eq!(refused.unwrap_err(), foreign);
    gpu.destroy();
    assert_eq!(
        pending.wait().unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    assert_eq!(
        values.download().unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    assert_eq!(
        here.upload(&boxes).unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    assert_eq!(gpu.wait().unwrap_err(), Error::Gpu(GpuFault::DeviceLost));
    let lost = here.all_pairs(overlap::IouObb2, &on, &on);
    assert_eq!(lost.unwrap_err(), Error::Gpu(GpuFault::DeviceLost));
}

/// The outcome of every call of the front.
fn every_call(backend: Backend<'_>) -> Vec<Result<(), Error>> {
    type O = overlap::IouObb2;
    type R = ring::Centroid;
    let boxes = Obb2::<f32>::hard();
    let (a, b) = (&boxes[..], &boxes[..]);
    let ones = vec![1.0; a.len()];
    let matrix = vec![1.0; a.len() * a.len()];
    let corners = [
        Vec2::new(0.0, 0.0),
        Vec2::new(1.0, 0.0),
        Vec2::new(0.0, 1.0),
    ];
    let mut values = ones.clone();
    let (run, here) = (O::default(), backend.resident());
    vec![
        backend.aligned(run, (a, b)).map(drop),
        backend.aligned_into(run, (a, b), &mut values[..]),
        backend.aligned(run.value_grad(), (a, b)).map(drop),
        backend.aligned(run.vjp(), ((a, b), &ones)).map(drop),
        backend.all_pairs(run, a, b).map(drop),
        backend.all_pairs(run.value_grad(), a, b).map(drop),
        backend.all_pairs_vjp(run, a, b, &matrix).map(drop),
        backend.sum_grad(run, a, b).map(drop),
        backend.mean_grad(run, a, b).map(drop),
        backend.row_max(run, a, b).map(drop),
        backend.column_max(run, a, b).map(drop),
        backend.above(run, a, b, 0.5).map(drop),
        backend.count_above(run, a, b, 0.5).map(drop),
        backend.sum(run, a, b).map(drop),
        backend.mean(run, a, b).map(drop),
        backend.row_max(iou::GiouObb2, a, b).map(drop),
        backend.above(iou::GiouObb2, a, b, 0.5).map(drop),
        backend.sum_grad(iou::GiouObb2, a, b).map(drop),
        backend.ragged(R::default(), &corners, &[0, 3]).map(drop),
        backend
            .ragged_vjp(R::default(), &corners, &[0, 3], &corners[..1])
            .map(drop),
        here.upload(a).map(drop),
        here.upload_matrix(1, a.len(), &ones).map(drop),
        here.upload_rings(&corners, &[0, 3]).map(drop),
    ]
}

#[test]
fn a_lost_device_is_an_error_of_every_call_of_the_front() {
    let Some((_turn, _)) = gpu() else { return };
    let gpu = Gpu::new().unwrap();
    let backend = Backend::Gpu(&gpu);
    assert!(every_call(backend).iter().all(Result::is_ok));
    let boxes = Obb2::<f32>::hard();
    let here = backend.resident();
    let on = here.upload(&boxes).unwrap();
    let matrix = here.all_pairs(overlap::IouObb2, &on, &on).unwrap();
    gpu.destroy();
    for (call, found) in every_call(backend).into_iter().enumerate() {
        assert_eq!(found, Err(Error::Gpu(GpuFault::DeviceLost)), "call {call}");
    }
    assert_eq!(
        here.sum(overlap::IouObb2, &on, &on).unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    assert_eq!(
        matrix.row_max().unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    assert_eq!(
        matrix.download().unwrap_err(),
        Error::Gpu(GpuFault::DeviceLost)
    );
    // A new context is as good as the old one was.
    let gpu = Gpu::new().unwrap();
    assert!(every_call(Backend::Gpu(&gpu)).iter().all(Result::is_ok));
}

#[test]
fn a_device_lost_in_the_middle_of_work_is_an_error() {
    let Some((_turn, _)) = gpu() else { return };
    for pause in [0, 3, 10, 30] {
        let gpu = Gpu::new().unwrap();
        std::thread::scope(|scope| {
            let workers: Vec<_> = (0..2)
                .map(|_| {
                    scope.spawn(|| {
                        loop {
                            let found = every_call(Backend::Gpu(&gpu));
                            let failed = found.into_iter().find_map(Result::err);
                            if let Some(error) = failed {
                                return error;
                            }
                        }
                    })
                })
                .collect();
            std::thread::sleep(std::time::Duration::from_millis(pause));
            gpu.destroy();
            for worker in workers {
                assert_eq!(worker.join().unwrap(), Error::Gpu(GpuFault::DeviceLost));
            }
        });
    }
}

#[test]
fn a_ring_beyond_every_buffer_is_an_error() {
    let Some((_turn, _)) = gpu() else { return };
    let gpu = crate::small();
    let backend = Backend::Gpu(&gpu);
    let most = gpu.most_bytes() as usize / 8;
    let corners = vec![Vec2::new(1.0, 2.0); most + 1];
    let refused = backend.ragged(ring::Centroid, &corners, &[0, most + 1]);
    let (bytes, limit) = (8 * (most as u64 + 1), gpu.most_bytes());
    let too_large = GpuFault::TooLarge { bytes, most: limit };
    assert_eq!(refused.unwrap_err(), Error::Gpu(too_large));
    let found = backend.ragged(ring::Centroid, &corners, &[0, most, most + 1]);
    assert_eq!(found.unwrap(), [corners[0]; 2]);
}

/// The address space is cut down, in a process of its own, until the driver has no more memory.
#[cfg(target_os = "linux")]
#[test]
fn no_more_memory_is_an_error_and_everything_goes_on() {
    const STARVED: &str = "GEOGRAD_TEST_STARVED";
    if std::env::var_os(STARVED).is_some() {
        return starve(&Gpu::new().unwrap());
    }
    let Some((_turn, gpu)) = gpu() else { return };
    if !gpu.adapter().is_software {
        eprintln!("SKIPPED: the memory of this GPU is not the process's");
        return;
    }
    if gpu.adapter().backend == "Gl" {
        eprintln!("SKIPPED: wgpu does not ask OpenGL whether memory was there");
        return;
    }
    let name = "faults::no_more_memory_is_an_error_and_everything_goes_on";
    let done = std::process::Command::new("sh")
        .args(["-c", "ulimit -v 2500000; exec \"$0\" \"$@\""])
        .arg(std::env::current_exe().unwrap())
        .args([name, "--exact", "--nocapture"])
        .env(STARVED, "1")
        .env("GEOGRAD_GPU", gpu.adapter().index.to_string())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&done.stderr);
    assert!(
        done.status.success() && told.contains("starved after"),
        "{told}"
    );
}

#[cfg(target_os = "linux")]
fn starve(gpu: &Gpu) {
    let boxes = Obb2::<f32>::hard();
    let here = Backend::Gpu(gpu).resident();
    let on = here.upload(&boxes).unwrap();
    let again = || {
        let aligned = here.aligned(overlap::IouObb2, (&on, &on));
        let sums = here.sum(overlap::IouObb2, &on, &on);
        (aligned.unwrap().download().unwrap(), sums.unwrap())
    };
    let expected = again();
    let first = here
        .upload_matrix(1, 32 << 20, &vec![1.0; 32 << 20])
        .unwrap();
    let mut held = Vec::new();
    let error = loop {
        assert!(held.len() < 100, "memory without end");
        match first.duplicate().and_then(|copy| gpu.wait().map(|()| copy)) {
            Ok(copy) => held.push(copy),
            Err(error) => break error,
        }
    };
    eprintln!("starved after {}", held.len());
    assert_eq!(error, Error::Gpu(GpuFault::OutOfMemory));
    // Earlier data are unchanged, with the memory still full and after it was given back.
    assert_eq!(again(), expected);
    held.clear();
    gpu.wait().unwrap();
    assert_eq!(again(), expected);
    assert_eq!(
        first.duplicate().unwrap().download().unwrap()[..3],
        [1.0; 3]
    );
}

#[test]
fn too_much_is_an_error() {
    let Some((_turn, gpu)) = gpu() else { return };
    // More than any address space: refused before anything is asked of the device.
    let here = Backend::Gpu(gpu).resident();
    let refused = here.upload_matrix(usize::MAX, 2, &[] as &[f32]);
    assert_eq!(refused.unwrap_err(), Error::TooLarge);
}

#[test]
fn rows_in_errors_count_from_the_start() {
    // More rows than a reduction on the CPU takes at a time.
    let mut boxes = vec![Aabb2::new(0.0, 0.0, 1.0, 1.0); 600];
    boxes[599].max.x = -1.0;
    let refused = calls::row_max::<overlap::IouAabb2, f32>(&boxes, &boxes[..500]);
    let expected = Error::Invalid {
        argument: Argument::A,
        item: 599,
        flaw: Flaw::Inverted(Field::new("min.x"), "max"),
    };
    assert_eq!(refused.unwrap_err(), expected);
}

//! Batches as witnesses: those of the CPU, and of a GPU where there is one, agree with everybody
//! else; a batch that is wrong is refused.
use geograd::ad::check::subject::{Conventions, Jumps};
use geograd::ad::check::verdict::{Reason, Witness};
use geograd::ad::check::{Check, Sampling, examine};
use geograd::kernels::check::OpSubject;
use geograd::kernels::check::Straight;
use geograd::kernels::check::witness::{Batch, BatchResult};
use geograd::kernels::gpu::Gpu;
use geograd::kernels::{Backend, Op};
use geograd::{Error, GpuFault};
use geograd::{Obb2, Pack, ad};
use geograd_tests::list;
use geograd_tests::rows::IouObb2;

/// Rows whose kernels, on the processor and on a GPU, are by hand.
pub const HOT: [&str; 9] = [
    "intersection_area_obb2",
    "iou_obb2",
    "iof_obb2",
    "intersection_area_aabb2",
    "iou_aabb2",
    "iof_aabb2",
    "signed_area",
    "perimeter",
    "centroid",
];

/// Every so many hard cases, and random inputs on top.
fn plan() -> Sampling<'static> {
    Sampling {
        hard: 23,
        shared_ties: true,
        ..Sampling::new(40, 1)
    }
}

/// A GPU, unless there is none and none is required.
pub fn gpu() -> Option<Gpu> {
    let required = std::env::var("GEOGRAD_REQUIRE_GPU").is_ok_and(|x| x == "1");
    match Gpu::new() {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            assert!(
                !(required && cfg!(feature = "gpu")),
                "a GPU is required: {error}"
            );
            eprintln!("SKIPPED, NOTHING WAS TESTED: {error}");
            None
        }
    }
}

/// On a GPU `adjoint::single` asks them.
#[test]
fn batches_on_the_cpu() {
    let hot: Vec<_> = HOT.iter().map(|name| list::row(name)).collect();
    list::each(&hot, |row| {
        let report = row.check::<f32>(&plan(), Some(Backend::Cpu)).unwrap();
        assert!(report.passed() && report.worst[5].count > 0, "{report}");
    });
}

#[test]
fn a_wrong_batch_is_refused() {
    let input: (Obb2<f64>, Obb2<f64>) = (
        Obb2::new(0.0, 0.0, 2.0, 1.0, 0.25),
        Obb2::new(0.5, 0.25, 1.5, 1.0, 0.5),
    );
    let report = |value: f32, derivative: f32| {
        let ask = |inputs: &[Vec<f32>]| {
            let answer = |x: &Vec<f32>| {
                let x: Vec<f64> = x.iter().map(|&x| f64::from(x)).collect();
                let (a, b) = input.refill(&x);
                let (iou, bars) =
                    ad::adjoint::overlap::iou_obb2_grad(a.cast::<f32>(), b.cast::<f32>());
                let mut derivatives: Vec<f64> =
                    bars.scalars().iter().map(|&x| f64::from(x)).collect();
                derivatives[7] *= f64::from(derivative);
                BatchResult {
                    value: vec![f64::from(iou * value)],
                    rows: vec![derivatives],
                }
            };
            Ok(inputs.iter().map(answer).collect())
        };
        let batch = Batch::new(vec![&ask], &[input.scalars()]).unwrap();
        let inputs = [input];
        examine("wrong", &Sampling::new(1, 1), &inputs, 1, |x, judge| {
            let subject = OpSubject::<f32>::of::<Straight<IouObb2>>(x, &[], None);
            judge(&subject.with_batch(Some(&batch)));
        })
    };
    assert!(report(1.0, 1.0).passed(), "{}", report(1.0, 1.0));
    let wrong = report(1.001, 1.0);
    assert!(
        wrong.refused_for(Reason::ValuesDisagree(Witness::Batch)),
        "{wrong}"
    );
    let wrong = report(1.0, 0.999);
    let reason = Reason::Disagree(Witness::Adjoint, Witness::Batch);
    assert!(wrong.refused_for(reason), "{wrong}");
    assert_eq!(wrong.failures[0].fault.input, 7);
}

#[test]
fn an_error_of_the_backend_is_handed_on() {
    let unit: Obb2<f64> = Obb2::new(0.0, 0.0, 1.0, 1.0, 0.0);
    let input = (unit, unit);
    let lost = |_: &[Vec<f32>]| Err(Error::Gpu(GpuFault::DeviceLost));
    let error = Batch::new(vec![&lost], &[input.scalars()]).err();
    assert_eq!(error, Some(Error::Gpu(GpuFault::DeviceLost)));
    // Nothing was known beforehand.
    let late = |inputs: &[Vec<f32>]| {
        if inputs.is_empty() {
            Ok(Vec::new())
        } else {
            Err(Error::Gpu(GpuFault::DeviceLost))
        }
    };
    let batch = Batch::new(vec![&late], &[]).unwrap();
    assert!(batch.about(0, &input.scalars()).is_none());
    assert_eq!(batch.error(), Some(Error::Gpu(GpuFault::DeviceLost)));
}

#[test]
fn a_backend_as_a_witness_of_ones_own_check() {
    // The code of a user of the feature `gpu`; `Backend::Gpu(&gpu)` computes on the GPU.
    let gpu = gpu();
    let backend = gpu.as_ref().map_or(Backend::Cpu, Backend::Gpu);
    type Pair = (Obb2<f32>, Obb2<f32>);
    Check::at((
        Obb2::new(0.0, 0.0, 2.0, 1.0, 0.25),
        Obb2::new(0.5, 0.25, 1.5, 1.0, 0.5),
    ))
    .value(|(a, b): Pair| a.iou(b))
    .gradient(|(a, b)| ad::adjoint::overlap::iou_obb2_vjp(a, b, 1.0))
    .conventions(Conventions {
        shared_ties: false,
        searches: false,
        flat: true,
        jumps: Jumps::FromZero,
    })
    .witness(|(a, b): Pair, seed| {
        let bars = backend.aligned(IouObb2.vjp(), ((&[a], &[b]), seed));
        let (a_bars, b_bars) = bars.expect("the backend answers");
        (a_bars[0], b_bars[0])
    })
    .assert();
}

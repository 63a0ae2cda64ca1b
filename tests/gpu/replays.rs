//! Operations with a search: decided on the processor, replayed on the GPU.
use crate::{any_gpu, gpu, small, validate};
use geograd::ad::check::sample::Draw;
use geograd::kernels::dynamic::{Mode, Rows, Sort};
use geograd::kernels::gpu::replay_source;
use geograd::kernels::op::{Declared, Declares, Jumps};
use geograd::kernels::search::search;
use geograd::kernels::{Backend, Cpu, One, Search};
use geograd::kernels::{Diameter, Giou, Iou};
use geograd::{ConvexPolygon, Error, Fixed, GpuFault, Pack, Scalar, Unrecordable, Vec2};
use geograd_tests::list::{self, Tested};

#[test]
fn the_shader_is_valid() {
    validate("replay", &replay_source());
}

/// Numbers that may differ by so much of the largest of their item, and of one.
fn near(name: &str, found: &[Vec<f32>], expected: &[Vec<f32>], by: f32) {
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(expected).enumerate() {
        let size = expected.iter().fold(1.0, |size: f32, x| size.max(x.abs()));
        for (found, expected) in found.iter().zip(expected) {
            let off = (found - expected).abs();
            assert!(off <= by * size, "{name} {i}: {found} for {expected}");
        }
    }
}

/// Results item by item, each as its numbers.
pub trait Flat {
    fn flat(&self) -> Vec<Vec<f32>>;
}
impl<P: Fixed<Scalar = f32>> Flat for Vec<P> {
    fn flat(&self) -> Vec<Vec<f32>> {
        self.iter().map(Pack::scalars).collect()
    }
}
impl<A: Flat, B: Flat> Flat for (A, B) {
    fn flat(&self) -> Vec<Vec<f32>> {
        let both = self.0.flat().into_iter().zip(self.1.flat());
        both.map(|(a, b)| [a, b].concat()).collect()
    }
}

/// Values and derivatives are those of batches on the processor, and those are the operation's own.
pub fn agrees(row: &Tested) {
    let name = row.name();
    if row.operation.sort != Sort::Search {
        return;
    }
    let layouts = row.operation.layouts::<f32>();
    // Every pair of polygons has a record of its own, nearly.
    let count = if layouts.len() > 1 { 40 } else { 300 };
    let items = list::inputs::<f32>(row, count, |draw| row.ordinary(draw));
    let alone: Vec<Vec<f32>> = items.iter().map(|x| row.alone(x)).collect();
    let on = |backend, mode, bar: Option<&[f32]>| -> Vec<Vec<f32>> {
        let function = row.operation.function::<f32>(mode).unwrap();
        let columns = list::columns(row, &items);
        let columns = columns.iter().zip(&layouts);
        let mut rows: Vec<_> = columns.map(|(x, y)| Rows::new(x, y.fields())).collect();
        rows.extend(bar.map(Rows::one));
        let (lists, gives) = (
            function.on(backend).unwrap().aligned(&rows).unwrap(),
            function.gives(),
        );
        let item = |i: usize| {
            let lists = lists.iter().zip(&gives);
            lists
                .flat_map(|(list, n)| list[i * n..][..*n].to_vec())
                .collect()
        };
        (0..items.len()).map(item).collect()
    };
    let expected = on(Backend::Cpu, Mode::Value, None);
    near(name, &expected, &alone, 1e-6);
    let Some(gpu) = any_gpu() else { return };
    let gpu = Backend::Gpu(gpu);
    let found = on(gpu, Mode::Value, None);
    near(name, &found, &expected, 2e-5);
    assert_eq!(found, on(gpu, Mode::Value, None), "{name}");
    let outputs = list::outputs(row);
    for k in 0..outputs {
        let seed: Vec<f32> = (0..outputs).map(|j| f32::from(u8::from(j == k))).collect();
        let found = on(gpu, Mode::Vjp, Some(&seed));
        near(
            name,
            &found,
            &on(Backend::Cpu, Mode::Vjp, Some(&seed)),
            1e-4,
        );
    }
}

/// A polygon of so many corners on a circle.
fn ring<const N: usize>(draw: &mut Draw, count: usize) -> ConvexPolygon<f32, N> {
    let (x, y, turn) = (
        draw.within(-1.0, 1.0),
        draw.within(-1.0, 1.0),
        draw.within(0.0, 1.0),
    );
    let corner = |k: usize| {
        let (sin, cos) = ((k as f64 + turn) * std::f64::consts::TAU / count as f64).sin_cos();
        Vec2::new((x + 2.0 * cos) as f32, (y + 2.0 * sin) as f32)
    };
    ConvexPolygon::from_vertices(&(0..count).map(corner).collect::<Vec<_>>())
}

/// Polygons of several sizes in one batch, more than one chunk of the smallest buffers, one for all.
#[test]
fn polygons_of_many_sizes() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(2);
    let mut list = |from: usize| -> Vec<ConvexPolygon<f32, 6>> {
        (0..2500)
            .map(|i| ring(&mut draw, 3 + (i + from) % 4))
            .collect()
    };
    let (many, b) = (list(0), list(1));
    // Costly calls take a part of the list.
    let (a, b) = (&many[..400], &b[..400]);
    let cpu = Cpu::new();
    let found = gpu.aligned(Iou, (a, b)).unwrap();
    let direct: Vec<f32> = a.iter().zip(b).map(|(a, b)| a.iou(b)).collect();
    near("iou", &[found], &[direct], 1e-5);
    let (value, (by_a, by_b)) = gpu.aligned(Iou.value_grad(), (a, b)).unwrap();
    let (expected, grads) = cpu.aligned(Iou.value_grad(), (a, b)).unwrap();
    near("iou", &[value], &[expected], 1e-5);
    near("iou", &by_a.flat(), &grads.0.flat(), 1e-4);
    near("iou", &by_b.flat(), &grads.1.flat(), 1e-4);
    // A gradient has the codes of its shape.
    assert!(
        by_a.iter()
            .zip(a)
            .all(|(bar, shape)| bar.count == shape.count)
    );
    let run = Diameter;
    let found = gpu.aligned(run, &many).unwrap();
    near(
        "diameter",
        std::slice::from_ref(&found),
        &[cpu.aligned(run, &many).unwrap()],
        1e-6,
    );
    assert_eq!(small().aligned(run, &many).unwrap(), found);
    let one = gpu.aligned(Iou, (a, One(b[0]))).unwrap();
    let all = gpu.aligned(Iou, (a, &vec![b[0]; a.len()])).unwrap();
    assert_eq!(one, all);
    assert_eq!(gpu.aligned(run, &many[..0]).unwrap(), []);
    let mut lengths = vec![0.0; many.len()];
    Backend::Gpu(gpu)
        .aligned_into(run, &many, &mut lengths)
        .unwrap();
    assert_eq!(lengths, found);
}

/// Derivatives of a search along directions are replays, too.
#[test]
fn along_directions() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(7);
    let mut many = |corners| -> Vec<_> { (0..50).map(|_| ring::<6>(&mut draw, corners)).collect() };
    let (a, b, to_a, to_b) = (many(6), many(5), many(6), many(4));
    let columns = ((&a, &b), (&to_a, &to_b));
    let on = |backend: Backend<'_>| {
        let (values, slopes) = backend.aligned(Iou.jvp(), columns).unwrap();
        (
            values,
            slopes,
            backend.aligned(Iou.hvp(), columns).unwrap().flat(),
        )
    };
    let (found, expected) = (on(Backend::Gpu(gpu)), on(Backend::Cpu));
    let near = |x: f32, y: f32| assert!((x - y).abs() <= 1e-3 * (1.0 + y.abs()), "{x} for {y}");
    assert!(expected.1.iter().filter(|&&x| x != 0.0).count() > 20);
    for i in 0..a.len() {
        near(found.0[i], expected.0[i]);
        near(found.1[i], expected.1[i]);
        let rows = found.2[i].iter().zip(&expected.2[i]);
        rows.for_each(|(&x, &y)| near(x, y));
    }
}

#[test]
fn what_cannot_be_replayed_is_refused() {
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(5);
    let (a, b) = ([ring::<6>(&mut draw, 6)], [ring::<6>(&mut draw, 5)]);
    // A program longer than a buffer.
    let refused = small().aligned(Giou, (&a, &b));
    assert!(matches!(
        refused.unwrap_err(),
        Error::Gpu(GpuFault::TooLarge { bytes, most }) if bytes > most
    ));
    // All pairs would decide every pair on the processor.
    let refused = gpu.all_pairs(Iou, &a, &b);
    assert_eq!(refused.unwrap_err(), Error::Program(Unrecordable::Search));
    let mut bad = a;
    bad[0].vertices[1].x = f32::NAN;
    let refused = gpu.aligned(Iou, (&bad, &b));
    assert_eq!(
        refused.unwrap_err(),
        Cpu::new().aligned(Iou, (&bad, &b)).unwrap_err()
    );
    let refused = gpu.aligned(Iou, (&a, &[b[0]; 2]));
    assert!(matches!(
        refused.unwrap_err(),
        Error::Length {
            expected: 1,
            found: 2,
            ..
        }
    ));
    let lost = geograd::kernels::gpu::Gpu::new().unwrap();
    lost.destroy();
    let refused = lost.aligned(Iou, (&a, &b));
    assert_eq!(refused.unwrap_err(), Error::Gpu(GpuFault::DeviceLost));
}

/// All instructions there are.
#[derive(Clone, Copy, Debug, Default)]
struct Everything;

impl Declares for Everything {
    const DECLARED: Declared = Declared::new("everything", &[], Jumps::Anywhere);
}

impl Search for Everything {
    type In<S: Scalar> = [S; 3];
    type Out<S: Scalar> = [S; 4];
    type Record = bool;
    fn decide<S: Scalar<Mask = bool>>([a, b, _]: [S; 3]) -> bool {
        a.below(b)
    }
    fn replay<S: Scalar>([a, b, c]: [S; 3], record: bool) -> [S; 4] {
        let (a, b) = if record { (a, b) } else { (b, a) };
        let [(sin_high, sin_low), (cos_high, cos_low)] = a.sin_cos_parts();
        let parts = sin_high * cos_high + sin_low + cos_low + b.parts().0;
        let smooth =
            a.exp() + b.magnitude().ln() + a.atan2(c) + c.magnitude().root() + b.sin() + b.cos();
        let kinks = a.least(b).most(c).magnitude() + b.most(c).least(a) + c.clamp(a, b);
        let fused =
            (a + b) * c - (a - b) * (b - c) + (a * b - c * a) * (a * c + b) + (a + b + c - (c - b));
        let ratio = (a * b + c).over(S::one() + c * c) * a.magnitude().binade();
        let mask = (a.below(c) & b.at_most(c)) | !a.equals(c);
        let other = (a.at_most(b) | c.below(b)) & a.below(b + c);
        let chosen = S::select(mask & other, parts, -kinks) + S::select(a.below(b), -c, fused);
        let more =
            S::select(a.at_most(c), b, c) + S::select(a.equals(b), b, c) + S::select(other, -a, c);
        let clamped = c.most(b.least(a * c)) + a.most(c.least(-b)) + b.most(c * a + b);
        let paired = (a - b) * (c + a) + ((a - c) + (c - b)) + S::select(a.below(c), -b, a);
        let more = more + clamped - paired;
        [chosen, smooth + more, ratio * fused, kinks - more]
    }
}

#[test]
fn every_instruction() {
    let text = replay_source();
    let constants = text.lines().filter_map(|line| line.strip_prefix("const "));
    for line in constants {
        let name = line.split(' ').next().unwrap();
        assert!(
            text.contains(&format!("case {name}:")) || text.contains(&format!("op == {name}")),
            "{name} is never carried out"
        );
    }
    let Some((_turn, gpu)) = gpu() else { return };
    let mut draw = Draw::new(6);
    let mut number = || (4.0 * draw.within(-1.0, 1.0)) as f32;
    let mut items: Vec<[f32; 3]> = (0..500).map(|_| [number(), number(), number()]).collect();
    items.extend([[1.0, 1.0, 2.0], [2.0, 1.0, 1.0], [1.5; 3], [1.0, 2.0, 1.0]]);
    let cpu = Cpu::new();
    let found = gpu.aligned(search(Everything), &items).unwrap();
    let expected = cpu.aligned(search(Everything), &items).unwrap();
    near("everything", &found.flat(), &expected.flat(), 1e-5);
    let seeds = vec![[1.0, -0.5, 0.25, 2.0]; items.len()];
    let found = gpu
        .aligned(search(Everything).vjp(), (&items, &seeds))
        .unwrap();
    let expected = cpu
        .aligned(search(Everything).vjp(), (&items, &seeds))
        .unwrap();
    near("adjoint", &found.flat(), &expected.flat(), 1e-4);
}

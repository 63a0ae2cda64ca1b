use geograd::{Obb2, kernels::{IouObb2, cpu, reduce}};
use std::time::Instant;
fn main() {
    let mut s = 7u64;
    let mut r = |l: f32, h: f32| { s = s.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407); l + (h - l) * ((s >> 40) as f32 / (1u64 << 24) as f32) };
    let mut list = |n: usize| -> Vec<Obb2<f32>> { (0..n).map(|_| Obb2::new(r(-5.,5.), r(-5.,5.), r(0.,5.), r(0.,5.), r(-5.,5.))).collect() };
    for n in [1000usize, 8000] {
        let (a, b) = (list(n), list(n));
        let med = |f: &mut dyn FnMut()| { f(); let mut t: Vec<f64> = (0..7).map(|_| { let t = Instant::now(); f(); t.elapsed().as_secs_f64() }).collect(); t.sort_by(f64::total_cmp); (n * n) as f64 / t[t.len() / 2] / 1e6 };
        let mut v = vec![0.0; n * n];
        println!("n {n}: value {:.0}", med(&mut || { cpu::all_pairs_into::<IouObb2, f32>(&a, &b, &mut v).unwrap(); }));
        println!("n {n}: row_max {:.0}", med(&mut || { std::hint::black_box(reduce::row_max::<IouObb2, f32>(&a, &b).unwrap()); }));
        println!("n {n}: column_max {:.0}", med(&mut || { std::hint::black_box(reduce::column_max::<IouObb2, f32>(&a, &b).unwrap()); }));
        println!("n {n}: above 0.5 {:.0}", med(&mut || { std::hint::black_box(reduce::above::<IouObb2, f32>(&a, &b, 0.5).unwrap()); }));
        println!("n {n}: count {:.0}", med(&mut || { std::hint::black_box(reduce::count_above::<IouObb2, f32>(&a, &b, 0.5).unwrap()); }));
        println!("n {n}: sum {:.0}", med(&mut || { std::hint::black_box(reduce::sum::<IouObb2, f32>(&a, &b).unwrap()); }));
        println!("n {n}: sum_grad {:.0}", med(&mut || { std::hint::black_box(reduce::sum_grad::<IouObb2, f32>(&a, &b).unwrap()); }));
        let up = vec![1f32; n * n]; let (mut p, mut q) = (a.clone(), b.clone());
        println!("n {n}: vjp {:.0}", med(&mut || { cpu::all_pairs_vjp_into::<IouObb2, f32>(&a, &b, &up, &mut p, &mut q).unwrap(); }));
    }
}

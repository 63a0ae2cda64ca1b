//! Many shapes at once: pair by pair, every row with every column, and a loss with its gradient.
//! `cargo run --release -p geograd-examples --example batch`
use geograd::prelude::*;

fn main() -> Result<(), geograd::Error> {
    let truths: Vec<Obb2<f32>> = (0..4)
        .map(|i| Obb2::new(6.0 * i as f32, 0.0, 4.0, 2.0, 0.3))
        .collect();
    let guesses: Vec<Obb2<f32>> = (0..4)
        .map(|i| Obb2::new(6.0 * i as f32 + 0.5, 0.2 * i as f32, 4.2, 1.8, 0.1))
        .collect();
    let cpu = Cpu::new();

    let (iou, (by_guess, _)) = cpu.aligned(Iou.value_grad(), (&guesses, &truths))?;
    println!("pair by pair        {iou:.3?}");
    println!("derivative by heading    {:.3}", by_guess[3].heading);

    let best = cpu.row_max(Iou, &guesses, &truths)?;
    println!(
        "best match of each  {:?}",
        best.iter().map(|x| x.index).collect::<Vec<_>>()
    );

    let near = cpu.all_pairs(Distance, &[Vec2::new(3.0, 5.0)], &truths)?;
    println!("distances           {:.3?}", near.values());

    // Ten steps uphill, by the derivatives of GIoU with respect to the centres.
    let mut moved = guesses.clone();
    for _ in 0..10 {
        let (_, (derivative, _)) = cpu.aligned(Giou.value_grad(), (&moved, &truths))?;
        moved
            .iter_mut()
            .zip(derivative)
            .for_each(|(shape, s)| shape.center += s.center * 0.2);
    }
    println!(
        "after ten steps     {:.3?}",
        cpu.aligned(Iou, (&moved, &truths))?
    );
    Ok(())
}

//! Bodies by hand of the overlap of boxes in the plane, copies of their Rust source in WGSL.
use super::operation::{BoxKind, Generated, ProgramName, ShaderBody};
use crate::Error;
use crate::kernels::call::recording::Call;
use crate::kernels::cpu::plan::plan;
use crate::kernels::gpu::device::written::{CLIP, OVERLAP, PRELUDE, policy};
use crate::kernels::row::compiled::Compiled;
use crate::kernels::row::derivation::Mode;
use crate::overlap::Denominator;
use std::fmt::Write;
use std::sync::Arc;

/// Returns the kind of boxes and the divisor of the intersection area of compiled kernels, if they have a body by hand.
fn kind_of(compiled: Compiled) -> Option<(BoxKind, Denominator)> {
    match compiled {
        Compiled::Obb2(over) => Some((BoxKind::Rotated, over)),
        Compiled::Aabb2(over) => Some((BoxKind::AxisAligned, over)),
        _ => None,
    }
}

/// Returns the WGSL of a kind of boxes.
fn text_of(kind: BoxKind) -> &'static str {
    match kind {
        BoxKind::Rotated => include_str!("../../wgsl/obb2.wgsl"),
        BoxKind::AxisAligned => include_str!("../../wgsl/aabb2.wgsl"),
    }
}

/// The number of operations of a body by hand, for the size of a dispatch.
const OPERATIONS: usize = 1 << 12;

impl Generated<f32> {
    /// Returns the body by hand of a call for all pairs, if it has one. Boxes are prepared as for batches on the CPU,
    /// so that both machines use equal sines, also for huge headings and long thin boxes.
    pub(in crate::kernels::gpu::device) fn by_hand(
        call: &Call<f32>,
    ) -> Result<Option<Self>, Error> {
        let Some((kind, over)) = call.recording.compiled.and_then(kind_of) else {
            return Ok(None);
        };
        let (entry, has_seed) = match call.mode {
            Mode::Value => ("value_of", false),
            Mode::Vjp => ("grad_of", true),
            Mode::ValueGrad | Mode::Jacobian => return Ok(None),
        };
        let made = |is_extreme: bool| {
            let arguments = plan(call, true)?.arguments.clone();
            let mut widths: Vec<usize> = arguments.iter().map(|x| x.frame_fields()).collect();
            widths.extend(has_seed.then_some(1));
            let fields: Vec<usize> = arguments.iter().map(|x| x.fields).collect();
            // The result comes before its derivatives.
            let (gives, numbers) = match has_seed {
                false => (vec![1], 1),
                true => (fields.clone(), 1 + fields.iter().sum::<usize>()),
            };
            let takes = widths.iter().sum();
            let body = ShaderBody {
                entry,
                text: String::new(),
                operations: OPERATIONS,
                gives: numbers,
            };
            Ok(Generated {
                name: ProgramName::default(),
                kind: Some(kind),
                head: head(kind, over, is_extreme, takes),
                arguments,
                widths,
                gives,
                bodies: vec![body],
                extreme: None,
            })
        };
        let mut ordinary = made(false)?;
        if kind == BoxKind::Rotated {
            ordinary.extreme = Some(Arc::new(made(true)?));
        }
        Ok(Some(ordinary))
    }
}

/// Returns the WGSL functions that the body calls. With `is_extreme` they serve boxes whose plain products overflow or
/// underflow.
fn head(kind: BoxKind, over: Denominator, is_extreme: bool, takes: usize) -> String {
    let mut text = policy();
    let _ = writeln!(
        text,
        "const TAKES: u32 = {takes}u;\nconst DENOMINATOR: u32 = {}u;\nconst IS_RATIO: bool = {};\n\
         const EXTREME: bool = {is_extreme};",
        over as u32,
        over != Denominator::None,
    );
    for file in [PRELUDE, CLIP, OVERLAP, text_of(kind)] {
        text.push_str(file);
    }
    text
}

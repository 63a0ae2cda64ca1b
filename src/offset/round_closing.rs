//! Pieces of a border that go over into each other: the certificate, and their order.
use super::capsules::Name;
use super::round_corners::{Corners, Joint};
use crate::Vec2;

/// The length, in local units, below which roundings decide what a curve is cut by.
const TINY: f64 = 1e-9;

/// The most ends of pieces that roundings leave open.
const REPAIRS: usize = 64;

/// A piece of a curve by names, and where the search saw its ends.
pub(super) struct Left {
    pub curve: Name,
    pub from: Option<Name>,
    pub to: Option<Name>,
    pub ends: [Vec2<f64>; 2],
}

/// Returns the curves before and after a piece; `None` at an end of a side that another one cuts off.
fn neighbours(corners: &Corners, piece: &Left) -> [Option<Name>; 2] {
    let own = |k: usize| match piece.curve {
        Name::Side(side) => match corners.joints[side as usize][k] {
            Joint::Inner => None,
            Joint::Arc => Some(Name::Circle(corners.side_places(side)[k])),
            Joint::Straight(other) => Some(Name::Side(other)),
        },
        Name::Circle(place) => {
            let arc = corners.arc(place);
            arc.map(|arc| Name::Side(corners.arcs[arc as usize].sides[k]))
        }
    };
    [piece.from.or_else(|| own(0)), piece.to.or_else(|| own(1))]
}

/// Returns the ends and the starts of pieces that do not go over into exactly one other one.
fn open_ends(corners: &Corners, left: &[Left]) -> [Vec<usize>; 2] {
    let mut open = [Vec::new(), Vec::new()];
    // From which curve to which, at an end or a start, of which piece.
    let mut steps = Vec::with_capacity(2 * left.len());
    for (k, piece) in left.iter().enumerate() {
        let [before, after] = neighbours(corners, piece);
        match after {
            Some(after) => steps.push((piece.curve, after, false, k)),
            None => open[0].push(k),
        }
        match before {
            Some(before) => steps.push((before, piece.curve, true, k)),
            None => open[1].push(k),
        }
    }
    steps.sort_unstable();
    for group in steps.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [(.., false, _), (.., true, _)] = group {
            continue;
        }
        for &(.., is_start, k) in group {
            open[usize::from(is_start)].push(k);
        }
    }
    open
}

/// Closes what roundings leave open; `false` if pieces remain that do not go over into exactly one other one.
///
/// A crossing next to the smooth joint of two curves is at either of them, within the square of its distance from the
/// joint. So pieces that end and start at one place by different names get each other's, and pieces shorter than such
/// distances are left out.
pub(super) fn close(corners: &Corners, left: &mut Vec<Left>) -> bool {
    let mut open = open_ends(corners, left);
    if open.iter().all(Vec::is_empty) {
        return true;
    }
    if open.iter().any(|all| all.len() > REPAIRS) {
        return false;
    }
    let mut k = 0;
    left.retain(|piece| {
        let is_open = open.iter().any(|all| all.contains(&k));
        k += 1;
        !is_open || (piece.ends[1] - piece.ends[0]).length() > TINY
    });
    open = open_ends(corners, left);
    let [ends, starts] = open;
    for end in ends {
        let at = left[end].ends[1];
        let far = |&k: &usize| (left[k].ends[0] - at).length();
        let near = starts.iter().filter(|k| far(k) <= TINY);
        let Some(&start) = near.min_by(|a, b| far(a).total_cmp(&far(b))) else {
            return false;
        };
        left[end].to = Some(left[start].curve);
        left[start].from = Some(left[end].curve);
    }
    open_ends(corners, left).iter().all(Vec::is_empty)
}

/// Puts pieces into the order of the border, one contour after the other; returns the number of pieces up to the end of
/// each. They are closed.
pub(super) fn in_order(corners: &Corners, left: &mut Vec<Left>) -> Vec<u32> {
    let mut starts: Vec<_> = left
        .iter()
        .enumerate()
        .map(|(k, piece)| (neighbours(corners, piece)[0], piece.curve, k))
        .collect();
    starts.sort_unstable();
    let next = |piece: &Left| {
        let wanted = neighbours(corners, piece)[1];
        let at = starts.partition_point(|&(before, curve, _)| {
            (before, Some(curve)) < (Some(piece.curve), wanted)
        });
        starts[at.min(starts.len() - 1)].2
    };
    let (mut order, mut contours) = (Vec::with_capacity(left.len()), Vec::new());
    let mut is_placed = vec![false; left.len()];
    for first in 0..left.len() {
        let mut k = first;
        while !std::mem::replace(&mut is_placed[k], true) {
            order.push(k);
            k = next(&left[k]);
        }
        if contours.last() != Some(&(order.len() as u32)) && !order.is_empty() {
            contours.push(order.len() as u32);
        }
    }
    let mut all: Vec<Option<Left>> = left.drain(..).map(Some).collect();
    left.extend(order.into_iter().filter_map(|k| all[k].take()));
    contours
}

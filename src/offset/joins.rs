//! The decisions of raw rings: the kind of each corner.
use super::raw::{Bend, Plan, directions};
use super::{End, Join, OffsetStyle};
use crate::polygon::Rings;
use crate::{Scalar, Vec2};
use std::f64::consts::{FRAC_PI_2, PI};

/// The part of an edge that cuts at inner corners may take; the rest is for roundings.
const ROOM: f64 = 1.0 - 1e-6;

/// Returns the vertices of each ring by number, without those at the place of the one before.
fn walks(points: &[Vec2<f64>], rings: Rings<'_, f64>) -> Vec<Vec<usize>> {
    let mut first = 0;
    let mut all = Vec::new();
    for ring in rings.iter() {
        let mut kept: Vec<usize> = (first..first + ring.len()).collect();
        kept.dedup_by(|k, before| points[*k] == points[*before]);
        all.push(kept);
        first += ring.len();
    }
    all
}

/// Returns the plan of a polygon whose rings do not cross, outer ones counter-clockwise.
pub(super) fn polygon_plan(rings: Rings<'_, f64>, d: f64, style: &OffsetStyle) -> Plan {
    let points: Vec<_> = rings.iter().flatten().copied().collect();
    let mut walks = walks(&points, rings);
    for walk in &mut walks {
        while walk.len() > 1 && points[walk[0]] == points[walk[walk.len() - 1]] {
            walk.pop();
        }
        if d < 0.0 {
            walk.reverse();
        }
    }
    plan(&points, walks, false, d, style)
}

/// Returns the plan of open paths: there and back.
pub(super) fn path_plan(paths: Rings<'_, f64>, d: f64, style: &OffsetStyle) -> Plan {
    let points: Vec<_> = paths.iter().flatten().copied().collect();
    let mut walks = walks(&points, paths);
    for walk in &mut walks {
        let back: Vec<_> = walk.iter().rev().skip(1).copied().collect();
        // Without the first vertex, at which the walk closes.
        walk.extend(&back[..back.len().saturating_sub(1)]);
    }
    plan(&points, walks, true, d, style)
}

fn plan(
    points: &[Vec2<f64>],
    walks: Vec<Vec<usize>>,
    is_path: bool,
    d: f64,
    style: &OffsetStyle,
) -> Plan {
    let r = d.abs();
    let quarter = style.quarter(r);
    let mut plan = Plan {
        walks: Vec::new(),
        turns: Vec::new(),
        limit: match style.join {
            Join::Mitre(limit) => limit,
            _ => 1.0,
        },
        is_inward: d < 0.0,
    };
    let step = FRAC_PI_2 / f64::from(quarter);
    let mut most = 0;
    for walk in walks {
        let n = walk.len();
        if n < 2 {
            continue;
        }
        let mut corners: Vec<_> = walk.iter().map(|&k| (k, Bend::Straight)).collect();
        let ways = directions(points, &corners);
        let mut costs = vec![0.0; n];
        for (k, (_, bend)) in corners.iter_mut().enumerate() {
            let before = (k + n - 1) % n;
            let [(u, _), (w, _)] = [ways[before], ways[k]];
            let is_end = is_path && walk[before] == walk[(k + 1) % n];
            let turn = u.perp_dot(w);
            let sweep = if is_end {
                PI
            } else {
                Scalar::atan2(turn.abs(), u.dot(w))
            };
            *bend = if is_end || turn > 0.0 || (turn == 0.0 && sweep > 0.0) {
                opening(is_end, sweep, step, style)
            } else if turn < 0.0 {
                costs[k] = r * Scalar::tan(sweep / 2.0);
                Bend::Inner
            } else {
                Bend::Straight
            };
            // Without a distance the sides move as their crossings do.
            if r == 0.0 && sweep < FRAC_PI_2 * 1.99 {
                *bend = Bend::Tip;
            }
            if let Bend::Round(count) = *bend {
                most = most.max(count);
            }
        }
        // An inner corner whose edges reach beyond the crossing on both sides needs no way back through the vertex: the
        // piece that falls away turns once around places that both rectangles cover.
        let fits =
            |k: usize, other: usize, edge: usize| costs[k] + costs[other] < ways[edge].1 * ROOM;
        for (k, (_, bend)) in corners.iter_mut().enumerate() {
            let (before, after) = ((k + n - 1) % n, (k + 1) % n);
            if *bend == Bend::Inner && fits(k, before, before) && fits(k, after, k) {
                *bend = Bend::Tip;
            }
        }
        plan.walks.push(corners);
    }
    plan.turns = (1..=most)
        .map(|k| {
            let (sin, cos) = Scalar::sin_cos(step * k as f64);
            [cos, sin]
        })
        .collect();
    plan
}

/// Returns the kind of a corner that opens by an angle.
fn opening(is_end: bool, sweep: f64, step: f64, style: &OffsetStyle) -> Bend {
    // A last chord that rounding alone makes is none.
    let round = || Bend::Round(((sweep / step - 1e-9).ceil() as usize).saturating_sub(1));
    match (is_end, style.end, style.join) {
        (true, End::Round, _) | (false, _, Join::Round) => round(),
        (true, End::Flat, _) | (false, _, Join::Bevel) => Bend::Bevel,
        (true, End::Square, _) => Bend::Square,
        (false, _, Join::Mitre(limit)) => {
            // The tip is 1 / cos(half) distances away, the middle of a bevel cos(half).
            let half = Scalar::cos(sweep / 2.0);
            if half * limit >= 1.0 {
                Bend::Tip
            } else if half >= limit {
                Bend::Bevel
            } else {
                Bend::Cut
            }
        }
    }
}

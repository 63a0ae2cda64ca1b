//! Reductions within groups on the GPU: a thread per own row (or column) walks a range of the other list; one dispatch
//! computes as many groups as possible.
use super::context::SharedContext;
use super::reducer::{ListPart, ReduceDispatch};
use super::written::STRIP;
use std::ops::Range;

/// The binding of the ranges of own rows.
const RANGES: u32 = 9;

/// A dispatch: own shapes of one part and walked shapes of one part.
#[derive(Clone, Debug, PartialEq, Eq)]
struct GroupDispatch {
    own_part: usize,
    own: Range<usize>,
    walked_part: usize,
    /// The largest number of strips of an own shape.
    strips: usize,
    /// `true` if earlier parts have partial results of these own shapes.
    more: bool,
}

/// The limits of a dispatch.
#[derive(Clone, Copy, Debug)]
struct DispatchLimits {
    /// The number of partial results, one for each own shape and strip.
    room: usize,
    pairs: usize,
}

/// The number of idle pairs of own shape and strip that a dispatch may have in excess of the busy ones.
const SPARE: usize = 1 << 16;

/// Returns the dispatches of groups, given by their ranges of both lists: in the order of own shapes, each with as many
/// groups as fit. A group with walked shapes in several parts has dispatches of its own.
fn runs(
    own: &[Range<usize>],
    walked: &[Range<usize>],
    groups: impl Iterator<Item = [Range<usize>; 2]>,
    limits: DispatchLimits,
) -> Vec<GroupDispatch> {
    let mut runs: Vec<GroupDispatch> = Vec::new();
    // The largest number of strips, and the pairs, of the last run, if groups may be added to it.
    let mut open: Option<(usize, usize)> = None;
    let (mut own_part, mut first_part) = (0, 0);
    for [rows, others] in groups {
        while walked
            .get(first_part)
            .is_some_and(|part| part.end <= others.start)
        {
            first_part += 1;
        }
        let parts = walked.iter().enumerate().skip(first_part);
        let parts: Vec<(usize, usize)> = parts
            .map(|(k, part)| {
                (
                    k,
                    others
                        .end
                        .min(part.end)
                        .saturating_sub(others.start.max(part.start)),
                )
            })
            .take_while(|(_, count)| *count > 0)
            .collect();
        let strips = |count: usize| count.div_ceil(STRIP).max(1);
        let most = parts.iter().map(|(_, count)| *count).max().unwrap_or(0);
        let at_once = (limits.room / strips(most)).min(limits.pairs / most.max(1));
        let mut start = rows.start;
        while start < rows.end {
            while own[own_part].end <= start {
                own_part += 1;
            }
            let end = rows.end.min(own[own_part].end);
            let stretch = start..end.min(start + at_once.max(1));
            start = stretch.end;
            if let [] | [_] = parts[..] {
                let (k, count) = parts.first().copied().unwrap_or((first_part, 0));
                let last = runs.last_mut().zip(open.as_mut());
                if let Some((run, (needed, pairs))) = last
                    && (run.walked_part == k || count == 0)
                    && run.own_part == own_part
                {
                    let more = stretch.len() * strips(count);
                    let all = (run.own.len() + stretch.len()) * run.strips.max(strips(count));
                    let work = *pairs + stretch.len() * count;
                    let is_dense = all <= 2 * (*needed + more) + SPARE;
                    if all <= limits.room && work <= limits.pairs && is_dense {
                        run.own.end = stretch.end;
                        run.strips = run.strips.max(strips(count));
                        (*needed, *pairs) = (*needed + more, work);
                        continue;
                    }
                }
                if count == 0 {
                    // An empty group ends the run.
                    open = None;
                    continue;
                }
                open = Some((stretch.len() * strips(count), stretch.len() * count));
            } else {
                open = None;
            }
            for (i, &(walked_part, count)) in parts.iter().enumerate() {
                runs.push(GroupDispatch {
                    own_part,
                    own: stretch.clone(),
                    walked_part,
                    strips: strips(count),
                    more: i > 0,
                });
            }
        }
    }
    runs
}

impl SharedContext {
    /// Returns the dispatches of groups, given by the offsets of own and walked shapes, with at most `pairs` pairs
    /// each.
    pub fn group_sweeps(
        &self,
        own: &[ListPart],
        walked: &[ListPart],
        offsets: [&[usize]; 2],
        pairs: usize,
    ) -> Vec<ReduceDispatch> {
        let spans = offsets.map(|all| all.windows(2).map(|span| span[0]..span[1]));
        let [own_spans, walked_spans] = spans;
        let groups = own_spans
            .zip(walked_spans)
            .map(|(own, walked)| [own, walked]);
        let shapes = |parts: &[ListPart]| -> Vec<_> {
            parts.iter().map(|part| part.shapes.clone()).collect()
        };
        let limits = DispatchLimits {
            // Reductions write four numbers per entry.
            room: self.most_bytes as usize / 16,
            pairs,
        };
        let runs = runs(&shapes(own), &shapes(walked), groups.clone(), limits);
        // The range of every own shape, piece after piece of results.
        let mut ranges = Vec::new();
        for [own, walked] in groups {
            let range = [walked.start as u32, walked.end as u32];
            ranges.resize(ranges.len() + own.len(), range);
        }
        let ranges: Vec<_> = ranges
            .chunks(self.chunk)
            .map(|piece| self.stored(piece))
            .collect();
        let sweep = |run: GroupDispatch| {
            let (from, to) = (&own[run.own_part], &walked[run.walked_part]);
            let out_piece = run.own.start / self.chunk;
            ReduceDispatch {
                own_start: from.at + run.own.start - from.shapes.start,
                out_piece,
                out_start: run.own.start - out_piece * self.chunk,
                own_base: run.own.start,
                own: run.own.len(),
                walked_start: to.at,
                walked_base: to.shapes.start,
                walked: to.shapes.len(),
                strips: run.strips,
                more: run.more,
                bound: vec![
                    (from.binding, from.buffer.clone()),
                    (to.binding, to.buffer.clone()),
                    (RANGES, ranges[out_piece].clone()),
                ],
            }
        };
        runs.into_iter().map(sweep).collect()
    }
}

//! Assignment and metrics of many groups, such as the frames of a data set, on all threads: the results of one group
//! after another.
use crate::assignment;
use crate::error::{Argument, Error, Field, Flaw};
use crate::kernels::Groups;
use crate::kernels::cpu::Cpu;
use crate::kernels::cpu::work::{Interruption, in_parallel};
use crate::metric::{self, Frame, Outcome, kitti, nuscenes};
use crate::suppression::{Pair, invalid};
use crate::{Real, Scalar};
use std::borrow::Cow;
use std::ops::Range;

/// The work of a piece, in pairs and items: a millisecond or less. A larger group is a piece of its own.
const PIECE: usize = 1 << 13;

/// Cuts groups into ranges of about equal work. The cuts depend on `work`, the work of a group, alone.
fn pieces(groups: usize, work: impl Fn(usize) -> usize) -> Vec<Range<usize>> {
    let (mut pieces, mut first, mut sum) = (Vec::new(), 0, 0);
    for group in 0..groups {
        sum += work(group);
        if sum >= PIECE {
            pieces.push(first..group + 1);
            (first, sum) = (group + 1, 0);
        }
    }
    pieces.extend((first < groups).then_some(first..groups));
    pieces
}

/// Runs every piece on all threads. Returns the results of all pieces in order.
fn each<W: Send, R: Send>(work: Vec<W>, run: impl Fn(W) -> R + Send + Sync) -> Vec<R> {
    let mut results: Vec<Option<R>> = work.iter().map(|_| None).collect();
    let all = work.into_iter().zip(&mut results).collect();
    in_parallel(all, |(work, result): (W, &mut Option<R>)| {
        *result = Some(run(work))
    });
    results.into_iter().flatten().collect()
}

/// Pairs sorted by their groups.
struct GroupedPairs<'a, T: Clone> {
    pairs: Cow<'a, [Pair<T>]>,
    /// Group g has the pairs `ends[g]..ends[g + 1]`.
    ends: Vec<usize>,
    offsets: [&'a [usize]; 2],
}

impl<'a, T: Real> GroupedPairs<'a, T> {
    /// Sorts pairs by their groups; within a group they keep their order.
    fn new(pairs: &'a [Pair<T>], groups: Groups<'a>, counts: [usize; 2]) -> Result<Self, Error> {
        groups.spans(counts)?;
        let offsets = groups.offsets();
        let count = offsets[0].len() - 1;
        let mut group = vec![0; counts[0]];
        for (g, own) in offsets[0].windows(2).enumerate() {
            group[own[0]..own[1]].fill(g);
        }
        let (mut ends, mut before, mut is_ordered) = (vec![0; count + 1], 0, true);
        for (item, pair) in pairs.iter().enumerate() {
            let broken =
                |field, why| Err(invalid("pairs", item, Flaw::Broken(Field::new(field), why)));
            for (name, place, end) in [
                ("first", pair.first, counts[0]),
                ("second", pair.second, counts[1]),
            ] {
                if place >= end {
                    return broken(name, "is beyond its list");
                }
            }
            let own = group[pair.first];
            if !(offsets[1][own]..offsets[1][own + 1]).contains(&pair.second) {
                return broken("second", "is in another group");
            }
            ends[own + 1] += 1;
            is_ordered &= own >= before;
            before = own;
        }
        for g in 0..count {
            ends[g + 1] += ends[g];
        }
        let mut pairs = Cow::Borrowed(pairs);
        if !is_ordered {
            pairs.to_mut().sort_by_key(|pair| group[pair.first]);
        }
        Ok(GroupedPairs {
            pairs,
            ends,
            offsets,
        })
    }
    fn count(&self) -> usize {
        self.ends.len() - 1
    }
    /// Returns the ranges of some groups in both lists.
    fn places(&self, groups: &Range<usize>) -> [Range<usize>; 2] {
        self.offsets
            .map(|offsets| offsets[groups.start]..offsets[groups.end])
    }
    /// Returns the pairs of some groups, with indices counted from the first items of these groups.
    fn own(&self, groups: &Range<usize>) -> Vec<Pair<T>> {
        let [first, second] = self.places(groups).map(|places| places.start);
        let pairs = &self.pairs[self.ends[groups.start]..self.ends[groups.end]];
        let own = pairs.iter().map(|pair| Pair {
            first: pair.first - first,
            second: pair.second - second,
            overlap: pair.overlap,
        });
        own.collect()
    }
    fn pieces(&self) -> Vec<Range<usize>> {
        let places = |g: usize| self.offsets[0][g + 1] - self.offsets[0][g];
        pieces(self.count(), |g| {
            self.ends[g + 1] - self.ends[g] + places(g)
        })
    }
}

/// Returns pairs with `first` and `second` added to their indices.
fn shifted<T>(pairs: Vec<Pair<T>>, [first, second]: [usize; 2]) -> impl Iterator<Item = Pair<T>> {
    pairs.into_iter().map(move |pair| Pair {
        first: pair.first + first,
        second: pair.second + second,
        ..pair
    })
}

/// Returns the lengths of both lists, from the offsets of their groups.
fn counts(groups: Groups<'_>) -> [usize; 2] {
    let last = |offsets: &[usize]| offsets.last().copied().unwrap_or(0);
    groups.offsets().map(last)
}

impl Cpu {
    /// Applies [`greedy`](assignment::greedy) to every group. Returns one-to-one pairs group by group, in a group the
    /// largest overlap first.
    ///
    /// # Errors
    ///
    /// [`Error::GroupsOf`] for offsets that decrease or do not begin at zero, [`Error::Length`] for lists of different
    /// numbers of groups, [`Error::Invalid`] for a pair beyond the lists or of two groups.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Groups};
    /// use geograd::suppression::Pair;
    /// let pair = |first, second, overlap| Pair { first, second, overlap };
    /// let all = [pair(0, 0, 0.8), pair(1, 0, 0.9), pair(2, 1, 0.7)];
    /// let frames = Groups::new(&[0, 2, 3], &[0, 1, 2]);
    /// assert_eq!(Cpu::new().greedy_grouped(&all, frames)?, [all[1], all[2]]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn greedy_grouped<T: Real + Scalar<Mask = bool>>(
        &self,
        pairs: &[Pair<T>],
        groups: Groups<'_>,
    ) -> Result<Vec<Pair<T>>, Error> {
        let split = GroupedPairs::new(pairs, groups, counts(groups))?;
        let of_piece = |piece: Range<usize>| {
            let one = |g: usize| {
                let from = split.places(&(g..g + 1)).map(|places| places.start);
                shifted(assignment::greedy(&split.own(&(g..g + 1))), from)
            };
            piece.flat_map(one).collect::<Vec<_>>()
        };
        Ok(each(split.pieces(), of_piece).concat())
    }

    /// Applies [`largest`](assignment::largest) to every group. Returns the one-to-one pairs of the largest sum,
    /// ordered by their first index.
    ///
    /// # Errors
    ///
    /// As [`greedy_grouped`](Cpu::greedy_grouped), and [`Error::Invalid`] for an overlap that is not finite.
    pub fn largest_grouped(
        &self,
        pairs: &[Pair<f64>],
        groups: Groups<'_>,
    ) -> Result<Vec<Pair<f64>>, Error> {
        let split = GroupedPairs::new(pairs, groups, counts(groups))?;
        let of_piece = |piece: Range<usize>| {
            let from = split.places(&piece).map(|places| places.start);
            let interruption = Interruption::current();
            let own = split.own(&piece);
            let chosen = assignment::largest_until(&own, &|| interruption.is_due())?;
            Ok(shifted(chosen, from).collect::<Vec<_>>())
        };
        let done: Result<Vec<_>, Error> = each(split.pieces(), of_piece).into_iter().collect();
        match done {
            Ok(done) => Ok(done.concat()),
            // The error counts items in the whole list.
            Err(_) => assignment::largest(pairs),
        }
    }

    /// Applies [`outcomes`](metric::outcomes) to every group of detections and truths. Returns which detections are
    /// right.
    ///
    /// # Errors
    ///
    /// As [`outcomes`](metric::outcomes), and as [`greedy_grouped`](Cpu::greedy_grouped) for groups.
    ///
    /// ```
    /// use geograd::kernels::{Cpu, Groups};
    /// use geograd::metric::{Frame, Outcome};
    /// use geograd::suppression::Pair;
    /// let pairs = [Pair { first: 1, second: 0, overlap: 0.8 }];
    /// let frames = Groups::new(&[0, 1, 2], &[0, 0, 1]);
    /// let found = Cpu::new().outcomes_grouped(&Frame::new(&[0.9, 0.5], 1, &pairs), frames, 0.5)?;
    /// assert_eq!(found, [Outcome::Wrong, Outcome::Right(0)]);
    /// # Ok::<(), geograd::Error>(())
    /// ```
    pub fn outcomes_grouped(
        &self,
        frame: &Frame<'_>,
        groups: Groups<'_>,
        threshold: f64,
    ) -> Result<Vec<Outcome>, Error> {
        for (name, flags, count) in [
            ("ignored_truths", frame.ignored_truths, frame.truths),
            (
                "ignored_detections",
                frame.ignored_detections,
                frame.scores.len(),
            ),
        ] {
            if !flags.is_empty() && flags.len() != count {
                return Err(Error::Length {
                    argument: Argument::Named(name),
                    expected: count,
                    found: flags.len(),
                });
            }
        }
        let split = GroupedPairs::new(frame.pairs, groups, [frame.scores.len(), frame.truths])?;
        let of_piece = |piece: Range<usize>| {
            let [own, truths] = split.places(&piece);
            let part = Frame {
                scores: &frame.scores[own.clone()],
                truths: truths.len(),
                pairs: &split.own(&piece),
                ignored_truths: frame.ignored_truths.get(truths.clone()).unwrap_or_default(),
                ignored_detections: frame.ignored_detections.get(own).unwrap_or_default(),
            };
            let mut found = metric::outcomes(&part, threshold)?;
            for outcome in &mut found {
                if let Outcome::Right(truth) = outcome {
                    *truth += truths.start;
                }
            }
            Ok(found)
        };
        let done: Result<Vec<_>, Error> = each(split.pieces(), of_piece).into_iter().collect();
        match done {
            Ok(done) => Ok(done.concat()),
            // The error counts items in the whole list.
            Err(_) => metric::outcomes(frame, threshold),
        }
    }

    /// Runs [`kitti::judge`], or with angles [`kitti::judge_oriented`], on all threads. Each of the forty scores at
    /// which precision is read is a piece of work.
    ///
    /// # Errors
    ///
    /// As [`kitti::judge_oriented`].
    pub fn judge_kitti(
        &self,
        frames: &[kitti::Frame<'_>],
        angles: Option<&[kitti::Angles<'_>]>,
        threshold: f64,
    ) -> Result<kitti::Judged, Error> {
        let judging = kitti::Judging::new(frames, angles, threshold)?;
        let read = each(judging.scores.clone(), |score| judging.at(score));
        Ok(judging.collect(read.into_iter()))
    }

    /// Runs [`nuscenes::judge`] at several thresholds.
    ///
    /// # Errors
    ///
    /// As [`nuscenes::judge`].
    pub fn judge_nuscenes(
        &self,
        frames: &nuscenes::Frames<'_>,
        thresholds: &[f64],
    ) -> Result<Vec<nuscenes::Judged>, Error> {
        nuscenes::check(frames)?;
        let sizes = [frames.detection_offsets, frames.truth_offsets];
        let work = |f: usize| {
            let [own, truths] = sizes.map(|offsets| offsets[f + 1] - offsets[f]);
            own.saturating_mul(truths + 16)
        };
        let pieces = pieces(frames.count(), work);
        let all: Vec<_> = thresholds
            .iter()
            .flat_map(|&threshold| pieces.iter().map(move |piece| (threshold, piece.clone())))
            .collect();
        let found = each(all, |(threshold, piece): (f64, Range<usize>)| {
            let offsets = frames.detection_offsets;
            let mut found = vec![None; offsets[piece.end] - offsets[piece.start]];
            nuscenes::found_truths(frames, piece, threshold, &mut found);
            found
        });
        let order = nuscenes::ranked(frames, 0..frames.detections.len());
        let of_threshold: Vec<_> = match pieces.len() {
            0 => thresholds.iter().map(|_| Vec::new()).collect(),
            count => found.chunks(count).map(<[_]>::concat).collect(),
        };
        Ok(each(of_threshold, |found: Vec<Option<usize>>| {
            nuscenes::judged(frames, &order, &found)
        }))
    }
}

//! Spectra of the last blocks of one input, and cross-fades between filters.

use super::filters::LANES;
use crate::PreparedFilters;
use crate::shelf::{Garbage, Shelf};
use std::sync::Arc;
use unripple_dsp::Complex;

/// Floats of a group of lanes of an input's spectrum: the real parts; the imaginary parts, with 0 in lane 0; the real
/// parts again, with the highest frequency in lane 0. Three times the lanes, so that the product needs no special case
/// for lane 0.
pub(crate) const SPECTRUM: usize = 3 * LANES;

/// Spectra of the last blocks of one input, and the filters through which each block goes.
pub(crate) struct History {
    /// Block of the ring x share (old, new) x group of lanes x [`SPECTRUM`].
    spectra: Vec<f32>,
    /// The filters of each block's two shares.
    through: Vec<[Option<usize>; 2]>,
    groups: usize,
    head: usize,
    shelf: Shelf<PreparedFilters>,
    present: Option<usize>,
    turning: Option<Turning>,
    waits: Option<(Arc<PreparedFilters>, u32)>,
}

/// A change of filters under way.
struct Turning {
    to: usize,
    done: u32,
    blocks: u32,
}

/// How the samples of a block are divided between the present filters and those that replace them in a
/// cross-fade.
pub(crate) struct Shares {
    /// Weight of the replacing filters, from 0 to 1, at the block's start and end; linear between.
    pub(crate) new: [f32; 2],
    /// Whether a cross-fade is under way.
    pub(crate) turning: bool,
}

impl History {
    /// A silent input without filters, for a number of partitions and groups of lanes.
    pub(crate) fn new(partitions: usize, groups: usize) -> Self {
        Self {
            spectra: vec![0.0; partitions * 2 * groups * SPECTRUM],
            through: vec![[None; 2]; partitions],
            groups,
            head: 0,
            shelf: Shelf::new(Self::places(partitions)),
            present: None,
            turning: None,
            waits: None,
        }
    }

    /// Largest number of filters that may be held at once.
    pub(crate) fn places(partitions: usize) -> usize {
        partitions + 4
    }

    /// Cross-fades to other filters over a number of blocks, once a cross-fade that is under way has ended.
    /// Returns filters that were waiting for the same and are replaced.
    pub(crate) fn turn(
        &mut self,
        filters: Arc<PreparedFilters>,
        blocks: u32,
    ) -> Option<Arc<PreparedFilters>> {
        self.waits.replace((filters, blocks.max(1))).map(|(filters, _)| filters)
    }

    /// Whether a cross-fade is under way or waiting.
    pub(crate) fn is_turning(&self) -> bool {
        self.turning.is_some() || self.waits.is_some()
    }

    /// Removes the filters for samples that enter from now on.
    pub(crate) fn clear(&mut self, mut leave: impl FnMut(Garbage)) {
        let turning = self.turning.take().map(|turning| turning.to);
        for place in self.present.take().into_iter().chain(turning) {
            self.shelf.release(place).into_iter().for_each(|filters| leave(Garbage::Filters(filters)));
        }
        self.waits.take().into_iter().for_each(|(filters, _)| leave(Garbage::Filters(filters)));
    }

    /// Begins the next block, and drops the oldest. Returns how the new block's samples are divided among
    /// filters.
    pub(crate) fn advance(&mut self, mut leave: impl FnMut(Garbage)) -> Shares {
        self.head = (self.head + 1) % self.through.len();
        for place in std::mem::take(&mut self.through[self.head]).into_iter().flatten() {
            self.shelf.release(place).into_iter().for_each(|filters| leave(Garbage::Filters(filters)));
        }
        if self.turning.is_none()
            && let Some((filters, blocks)) = self.waits.take()
        {
            match self.shelf.put(filters) {
                Ok(to) => self.turning = Some(Turning { to, done: 0, blocks }),
                Err(filters) => leave(Garbage::Filters(filters)),
            }
        }
        let present = self.present;
        let Some(turning) = &mut self.turning else {
            self.through[self.head] = [present, None];
            present.into_iter().for_each(|place| self.shelf.hold(place));
            return Shares { new: [0.0; 2], turning: false };
        };
        let weight = |done: u32| done as f32 / turning.blocks as f32;
        let new = [weight(turning.done), weight(turning.done + 1)];
        turning.done += 1;
        let (to, over) = (turning.to, turning.done >= turning.blocks);
        self.through[self.head] = [present, Some(to)];
        present.into_iter().chain([to]).for_each(|place| self.shelf.hold(place));
        if over {
            self.turning = None;
            if let Some(filters) = present.and_then(|place| self.shelf.release(place)) {
                leave(Garbage::Filters(filters));
            }
            self.present = Some(to);
        }
        Shares { new, turning: true }
    }

    /// Stores the spectrum of one share (old or new filters) of the present block.
    pub(crate) fn put(&mut self, share: usize, spectrum: &[Complex<f32>]) {
        let length = self.groups * SPECTRUM;
        let at = (self.head * 2 + share) * length;
        let low = spectrum.len() - 1;
        for (group, to) in self.spectra[at..at + length].chunks_exact_mut(SPECTRUM).enumerate() {
            let bins = &spectrum[group * LANES..low.min((group + 1) * LANES)];
            for (lane, bin) in bins.iter().enumerate() {
                to[lane] = bin.re;
                to[LANES + lane] = bin.im;
                to[2 * LANES + lane] = bin.re;
            }
        }
        if let Some(first) = self.spectra.get_mut(at..at + SPECTRUM) {
            first[LANES] = 0.0;
            first[2 * LANES] = spectrum[low].re;
        }
    }

    /// Every share of every stored block that passes through filters: how many blocks ago it entered, its
    /// spectrum in a group of lanes, and the filters.
    #[inline(always)]
    pub(crate) fn shares(&self, group: usize) -> impl Iterator<Item = (usize, &[f32], &PreparedFilters)> {
        let blocks = self.through.len();
        (0..blocks).flat_map(move |age| {
            let slot = (self.head + blocks - age) % blocks;
            (0..2).filter_map(move |share| {
                let filters = self.shelf.get(self.through[slot][share]?)?;
                let at = ((slot * 2 + share) * self.groups + group) * SPECTRUM;
                Some((age, &self.spectra[at..at + SPECTRUM], filters))
            })
        })
    }
}

//! State of each point: missing, measured or bad.

use super::array::BLOCK;
use super::{Damage, Library};
use crate::StoreError;

/// State of a point of a library.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PointState {
    /// No responses are stored yet.
    #[default]
    Missing,
    /// Responses are stored.
    Measured,
    /// Responses are stored, but too bad to be used.
    Bad,
}

impl PointState {
    /// Name of the state in files and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Missing => "missing",
            Self::Measured => "measured",
            Self::Bad => "bad",
        }
    }

    pub(crate) fn code(self) -> u8 {
        self as u8
    }

    fn of(code: u8) -> Option<Self> {
        [Self::Missing, Self::Measured, Self::Bad].into_iter().find(|state| state.code() == code)
    }
}

impl Library {
    /// The states of all points, and the blocks of them that cannot be read.
    pub(crate) fn read_states(&self) -> (Vec<PointState>, Vec<Damage>) {
        let (mut states, mut damaged) = (Vec::with_capacity(self.plan.points.len()), Vec::new());
        for block in 0..self.arrays.state.chunks() {
            let points = self.points_of(block);
            match self.read_block(block) {
                Ok(codes) => states.extend(codes),
                Err(error) => {
                    let readable = |point| match self.arrays.responses.read(&self.root, point) {
                        Ok(_) => PointState::Measured,
                        Err(_) => PointState::Missing,
                    };
                    states.extend(points.map(readable));
                    damaged.push(Damage::of(&error, &self.arrays.state.chunk(&self.root, block), None));
                }
            }
        }
        (states, damaged)
    }

    /// The states of one block's points.
    fn read_block(&self, block: usize) -> Result<Vec<PointState>, StoreError> {
        let codes = self.arrays.state.read(&self.root, block)?;
        let known = |code: &u8| {
            PointState::of(*code).ok_or_else(|| {
                let file = self.arrays.state.chunk(&self.root, block).display().to_string();
                StoreError::content(&file, "states 0 to 2", code.to_string())
            })
        };
        codes.iter().take(self.points_of(block).len()).map(known).collect()
    }

    /// The points whose states and qualities are in one chunk.
    pub(crate) fn points_of(&self, block: usize) -> std::ops::Range<usize> {
        block * BLOCK..((block + 1) * BLOCK).min(self.plan.points.len())
    }

    /// Writes the states of blocks as they are known here.
    pub(crate) fn write_states(&self, blocks: &[usize]) -> Result<(), StoreError> {
        for block in blocks {
            let mut codes: Vec<u8> = self.states[self.points_of(*block)].iter().map(|s| s.code()).collect();
            codes.resize(BLOCK, 0);
            self.arrays.state.write(&self.root, *block, &codes)?;
        }
        self.arrays.state.sync(&self.root)
    }
}

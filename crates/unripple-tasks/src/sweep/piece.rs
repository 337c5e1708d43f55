//! Pieces of a sweep, as processes take them.

use std::fmt;
use std::str::FromStr;

/// The part of a sweep that one process computes, which can be written as an argument of a command line.
///
/// ```
/// use unripple_tasks::sweep::Piece;
///
/// assert_eq!("every:1:4".parse(), Ok(Piece::Every { first: 1, step: 4 }));
/// assert_eq!(Piece::Shard(7).to_string(), "shard:7");
/// assert!("every:1:0".parse::<Piece>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    /// The shards `first`, `first + step` and so on, those that are missing: `every:FIRST:STEP`.
    Every {
        /// The first of the shards, counted from 0.
        first: usize,
        /// Distance to the next one, at least 1.
        step: usize,
    },
    /// One shard, counted from 0: `shard:K`.
    Shard(usize),
    /// One design, counted from 0, kept for the shard that it belongs to: `design:I`.
    Design(usize),
}

impl fmt::Display for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Every { first, step } => write!(f, "every:{first}:{step}"),
            Self::Shard(shard) => write!(f, "shard:{shard}"),
            Self::Design(index) => write!(f, "design:{index}"),
        }
    }
}

impl FromStr for Piece {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let words: Vec<&str> = text.split(':').collect();
        let number = |word: &str| word.parse::<usize>().ok();
        let found = match words[..] {
            ["every", first, step] => number(first)
                .zip(number(step).filter(|step| *step > 0))
                .map(|(first, step)| Self::Every { first, step }),
            ["shard", shard] => number(shard).map(Self::Shard),
            ["design", index] => number(index).map(Self::Design),
            _ => None,
        };
        found.ok_or_else(|| format!("expected every:FIRST:STEP, shard:K or design:I, found {text}"))
    }
}

//! Pieces of a sweep, as processes take them.

use std::ffi::OsString;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// The part of a sweep that one process computes, which can be written as an argument of a command line.
///
/// ```
/// use unripple_tasks::sweep::Piece;
///
/// assert_eq!("shards:1,4,9".parse(), Ok(Piece::Shards(vec![1, 4, 9])));
/// assert_eq!(Piece::Shard(7).to_string(), "shard:7");
/// assert!("shards:".parse::<Piece>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Shards, counted from 0, in this order, beside those of other processes: `shards:K,K,…`. A shard with a design that memory is
    /// lacking for is kept, row by row.
    Shards(Vec<usize>),
    /// One shard, counted from 0, while nothing else is computed: `shard:K`.
    Shard(usize),
    /// One design, counted from 0, kept for the shard that it belongs to, while nothing else is computed: `design:I`.
    Design(usize),
}

impl Piece {
    /// The arguments of the program with which a process computes this piece of a plan into a folder.
    pub fn arguments(&self, plan: &Path, place: &Path) -> [OsString; 8] {
        let piece = self.to_string().into();
        let plan = plan.into();
        [
            "sweep".into(),
            "--quiet".into(),
            "--piece".into(),
            piece,
            "-o".into(),
            place.into(),
            "--".into(),
            plan,
        ]
    }
}

impl fmt::Display for Piece {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shards(shards) => {
                let numbers: Vec<String> = shards.iter().map(usize::to_string).collect();
                write!(f, "shards:{}", numbers.join(","))
            }
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
            ["shards", list] => list.split(',').map(number).collect::<Option<_>>().map(Self::Shards),
            ["shard", shard] => number(shard).map(Self::Shard),
            ["design", index] => number(index).map(Self::Design),
            _ => None,
        };
        found.ok_or_else(|| format!("expected shards:K,K,…, shard:K or design:I, found {text}"))
    }
}

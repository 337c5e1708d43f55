//! A sweep computed by processes, with what one of them died of, or had no memory for, computed by itself.

use super::folder::Folder;
use super::{Piece, Row, Workers};
use crate::{Progress, TaskError};
use std::thread::available_parallelism;

/// Most shards that a process is told at once, so that its command line is no longer than any system allows. With fewer, processes that
/// have done theirs would wait more often for the others.
const MOST_SHARDS: usize = 2000;

/// Computes all shards that are missing: together, and by itself what a process died of or had no memory for. Designs that are equal to
/// those of earlier shards are left out, and get their rows in between.
///
/// # Errors
/// [`TaskError::Cancelled`]; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
pub(super) fn run(workers: &Workers, folder: &Folder, progress: &mut dyn Progress) -> Result<(), TaskError> {
    loop {
        folder.share()?;
        let (waiting, missing): (Vec<usize>, Vec<usize>) =
            folder.missing()?.into_iter().partition(|shard| folder.waits(*shard));
        if missing.is_empty() {
            // The rows that any wait for are there and cannot be taken, as those of another version.
            return waiting.iter().try_for_each(|shard| settle(workers, folder, *shard, progress));
        }
        let shares = shares(&missing, workers.jobs.min(most()));
        let endings = together(workers, folder, &shares, progress)?;
        for (share, how) in shares.iter().zip(endings) {
            complete(workers, folder, share, how, progress)?;
        }
    }
}

/// Most processes at a time: more of them only take memory from each other.
fn most() -> usize {
    4 * available_parallelism().map_or(1, usize::from)
}

/// Shards that are missing, dealt out in turn to at most `jobs` processes: whatever was done before, none has nothing to do, and what takes
/// long at one end of an axis is shared.
fn shares(missing: &[usize], jobs: usize) -> Vec<Vec<usize>> {
    let jobs = jobs.min(missing.len()).max(1);
    let share = |first| missing.iter().copied().skip(first).step_by(jobs).take(MOST_SHARDS).collect();
    (0..jobs).map(share).collect()
}

/// Runs a process for each share until all have ended; returns how each died, if it did.
fn together(
    workers: &Workers,
    folder: &Folder,
    shares: &[Vec<usize>],
    progress: &mut dyn Progress,
) -> Result<Vec<Option<String>>, TaskError> {
    let pieces: Vec<Piece> = shares.iter().cloned().map(Piece::Shards).collect();
    let shards = folder.plan.shards() as f64;
    let mut count = |progress: &mut dyn Progress| -> Result<(), TaskError> {
        progress.done(1.0 - folder.missing()?.len() as f64 / shards);
        Ok(())
    };
    workers.wait(&pieces, progress, &mut count)
}

/// Computes what is missing of the share of a process that has ended: shards that it had no memory for, and the one that it died of, if it
/// did. What it did not come to is left to the next round.
fn complete(
    workers: &Workers,
    folder: &Folder,
    share: &[usize],
    how: Option<String>,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    for shard in share.iter().copied().filter(|shard| !folder.has(*shard) && !folder.waits(*shard)) {
        if folder.is_kept(shard) {
            let told =
                format!("shard {shard}: designs that memory was lacking for are tried again by themselves");
            progress.tell(&told);
            one_by_one(workers, folder, shard, progress)?;
            continue;
        }
        // A process takes its shards in order: it died of the first that it neither did nor kept.
        let Some(how) = how else {
            return Err(TaskError::Work("a process of the sweep ended before its shards were done".into()));
        };
        progress.tell(&format!("shard {shard}: its process was ended by {how}; it is tried again by itself"));
        return settle(workers, folder, shard, progress);
    }
    Ok(())
}

/// Has a shard computed by one process alone, with all memory to itself. If that dies too, each design gets a process of its own, and one that
/// ends its process becomes a row with that error.
fn settle(
    workers: &Workers,
    folder: &Folder,
    shard: usize,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    let how = alone(workers, Piece::Shard(shard), progress)?;
    if folder.has(shard) {
        return Ok(());
    }
    if let Some(how) = how {
        let told = format!(
            "shard {shard}: its process was ended by {how} again; its designs are computed one by one"
        );
        progress.tell(&told);
    }
    one_by_one(workers, folder, shard, progress)
}

/// Completes a shard, each design of which that has no row yet gets a process of its own.
fn one_by_one(
    workers: &Workers,
    folder: &Folder,
    shard: usize,
    progress: &mut dyn Progress,
) -> Result<(), TaskError> {
    let designs = folder.plan.shard(shard);
    let rows =
        designs.map(|index| design(workers, folder, index, progress)).collect::<Result<Vec<_>, _>>()?;
    folder.put(shard, &rows)
}

/// The row of a design that has a process of its own.
fn design(
    workers: &Workers,
    folder: &Folder,
    index: usize,
    progress: &mut dyn Progress,
) -> Result<Row, TaskError> {
    if let Some(row) = folder.settled(index).or_else(|| folder.equal_elsewhere(index)) {
        return Ok(row);
    }
    let how = alone(workers, Piece::Design(index), progress)?;
    if let Some(row) = folder.settled(index) {
        return Ok(row);
    }
    let Some(how) = how else {
        return Err(TaskError::Work(format!("the process of design {index} ended without a row")));
    };
    progress.tell(&format!("design {index}: its process was ended by {how}"));
    let row = Row::failed(folder.plan.design(index), format!("its process was ended by {how}"));
    folder.put_row(&row)?;
    Ok(row)
}

/// Runs one process alone; returns how it died, if it did.
fn alone(workers: &Workers, piece: Piece, progress: &mut dyn Progress) -> Result<Option<String>, TaskError> {
    Ok(workers.wait(&[piece], progress, &mut |_| Ok(()))?.into_iter().flatten().next())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_is_shared_whatever_was_done_before() {
        // All shards with odd numbers are done, as after a process of two was killed.
        let even: Vec<usize> = (0..10).map(|k| 2 * k).collect();
        assert_eq!(shares(&even, 2), [[0, 4, 8, 12, 16], [2, 6, 10, 14, 18]]);
        assert_eq!(shares(&[3, 7], 4), [[3], [7]]);
        assert_eq!(shares(&[5], 0), [[5]]);
        let many: Vec<usize> = (0..9000).collect();
        let lengths: Vec<usize> = shares(&many, 2).iter().map(Vec::len).collect();
        assert_eq!(lengths, [MOST_SHARDS, MOST_SHARDS]);
        // With numbers of seven digits, below the 32 767 characters of Windows.
        let longest = Piece::Shards((9_000_000..9_000_000 + MOST_SHARDS).collect()).to_string();
        assert!(longest.len() < 20_000, "{}", longest.len());
    }
}

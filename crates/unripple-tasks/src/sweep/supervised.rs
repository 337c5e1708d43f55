//! A sweep computed by processes, with what one of them died of computed by itself.

use super::folder::Folder;
use super::{Piece, Row, Workers};
use crate::{Progress, TaskError};
use std::thread::available_parallelism;

/// Computes all shards that are missing: together, and by itself what a process died of.
///
/// # Errors
/// [`TaskError::Cancelled`]; [`TaskError::Work`] of a process that cannot be started, or that ends with an error of its own.
pub(super) fn run(workers: &Workers, folder: &Folder, progress: &mut dyn Progress) -> Result<(), TaskError> {
    progress.stage("designs");
    loop {
        let before = folder.missing()?;
        if before.is_empty() {
            return Ok(());
        }
        let jobs = workers.jobs.clamp(1, before.len().min(most()));
        let died = together(workers, folder, jobs, progress)?;
        for (first, how) in &died {
            // A process takes its shards in order: it died of the first that is missing.
            let shard = folder.missing()?.into_iter().find(|shard| shard % jobs == *first);
            if let Some(shard) = shard {
                let told = format!("shard {shard}: its process was ended by {how}; it is tried again alone");
                progress.tell(&told);
                settle(workers, folder, shard, progress)?;
            }
        }
        if died.is_empty() && !folder.missing()?.is_empty() {
            return Err(TaskError::Work("processes of the sweep ended before their shards were done".into()));
        }
    }
}

/// Most processes at a time: more of them only take memory from each other.
fn most() -> usize {
    4 * available_parallelism().map_or(1, usize::from)
}

/// Runs that many processes until all have ended; returns those that died, with how they did.
fn together(
    workers: &Workers,
    folder: &Folder,
    jobs: usize,
    progress: &mut dyn Progress,
) -> Result<Vec<(usize, String)>, TaskError> {
    let pieces: Vec<Piece> = (0..jobs).map(|first| Piece::Every { first, step: jobs }).collect();
    let shards = folder.plan.shards() as f64;
    let mut count = |progress: &mut dyn Progress| -> Result<(), TaskError> {
        progress.done(1.0 - folder.missing()?.len() as f64 / shards);
        Ok(())
    };
    let endings = workers.wait(&pieces, progress, &mut count)?;
    Ok(endings.into_iter().enumerate().filter_map(|(first, how)| Some((first, how?))).collect())
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
    if let Some(row) = folder.row(index)? {
        return Ok(row);
    }
    let how = alone(workers, Piece::Design(index), progress)?;
    if let Some(row) = folder.row(index)? {
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

//! Runs all test programs side by side: `cargo xtask test`.
//!
//! Cargo runs test programs one after the other, and most of them end with one long test on one core. Here as many run at once as there are
//! cores, the longest first, and beside them, one at a time, those of [`lanes::ALONE`].

mod build;
mod lanes;
mod program;
mod tally;

use build::Program;
use program::{End, Pace};
use std::collections::VecDeque;
use std::path::Path;
use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};
use tally::Tally;

/// Time without any program ending after which those still running are printed, so that a program that hangs can be named.
const SILENCE: Duration = Duration::from_secs(120);

/// What a program says of itself to whoever waits.
enum News {
    Began(String),
    Ended(String, Result<End, String>),
}

/// Runs the test programs that the arguments choose ([`build::programs`]); returns the failures.
pub fn run(root: &Path, arguments: &[String]) -> Vec<String> {
    let built = match build::programs(root, arguments) {
        Ok(built) => built,
        Err(reason) => return vec![reason],
    };
    let began = Instant::now();
    let count = built.programs.len();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let (alone, others) = lanes::sorted(built.programs);
    let (alone, others) = (Mutex::new(alone), Mutex::new(others));
    let mut total = Tally::default();
    let mut faults = Vec::new();
    std::thread::scope(|scope| {
        let (tell, news) = channel();
        let lanes = (0..cores).map(|_| (&others, Pace::Yielding)).chain([(&alone, Pace::Prompt)]);
        for (queue, pace) in lanes {
            let (tell, folder) = (tell.clone(), &built.folder);
            scope.spawn(move || drain(queue, pace, folder, &tell));
        }
        drop(tell);
        listen(&news, &mut total, &mut faults);
    });
    println!("{count} programs in {:.0} s", began.elapsed().as_secs_f64());
    // A line of its own, in the words of most test runners, for whoever reads them by program.
    println!("tests: {} passed, {} failed", total.passed, total.failed);
    if total == Tally::default() {
        faults.push("no test ran".into());
    }
    faults
}

/// Runs the programs of a queue, one after the other.
fn drain(queue: &Mutex<VecDeque<Program>>, pace: Pace, folder: &Path, tell: &Sender<News>) {
    let next = || queue.lock().ok()?.pop_front();
    while let Some(program) = next() {
        let name = program.to_string();
        // Whoever listens does so until all who tell have gone.
        let _ = tell.send(News::Began(name.clone()));
        let _ = tell.send(News::Ended(name, program::run(&program, pace, folder)));
    }
}

/// Prints what becomes of the programs, and adds it up.
fn listen(news: &std::sync::mpsc::Receiver<News>, total: &mut Tally, faults: &mut Vec<String>) {
    let mut running = Vec::new();
    loop {
        match news.recv_timeout(SILENCE) {
            Ok(News::Began(name)) => running.push(name),
            Ok(News::Ended(name, end)) => {
                running.retain(|other| *other != name);
                match end {
                    Ok(end) => {
                        told(&name, &end);
                        total.add(&end.tally);
                        faults.extend((!end.passed).then(|| format!("{name}: FAILED, see above")));
                    }
                    Err(reason) => faults.push(format!("{name}: {reason}")),
                }
            }
            Err(RecvTimeoutError::Timeout) => println!("still running: {}", running.join(", ")),
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
}

/// A line for each program; all that it wrote if it failed, else what it skipped.
fn told(name: &str, end: &End) {
    if !end.passed {
        println!("\n{name}:\n{}", end.output);
    }
    end.output.lines().filter(|line| line.starts_with("SKIPPED: ")).for_each(|line| println!("{line}"));
    println!(
        "{:6.1} s  {name}: {} passed, {} failed",
        end.took.as_secs_f64(),
        end.tally.passed,
        end.tally.failed
    );
}

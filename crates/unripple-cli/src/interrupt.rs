//! Handling of Ctrl+C and other signals that end the program, so that nothing unfinished is left behind; and of the end of its input.

use crate::error::CliError;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Arc, OnceLock};

/// Flag that the first signal sets, for a command that watches it and then stops by itself.
static WISHED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The first signal, if it only set the flag; 0, which is no signal, before.
static FIRST: AtomicI32 = AtomicI32::new(0);

/// Handles the signals that end the program from now on. Files under construction are removed, calls of JACK are completed, and the program
/// then ends as the signal would have ended it, so that shells see status 128 and the signal's number. If a command uses [`wished`], the
/// first signal only sets that flag.
pub fn watch() -> Result<(), CliError> {
    each(|signal| {
        // The first one is a wish to stop; whoever sends another does not want to wait.
        match WISHED.get().filter(|wished| !wished.load(Ordering::Relaxed)) {
            Some(wished) => {
                FIRST.store(signal, Ordering::Relaxed);
                wished.store(true, Ordering::Release);
            }
            None => end(signal),
        }
    })
}

/// Calls `act` with each signal that is to end the program.
#[cfg(unix)]
fn each(act: impl FnMut(i32) + Send + 'static) -> Result<(), CliError> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let wishes =
        [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| *signal != SIGHUP || !is_ignored(SIGHUP));
    let mut signals = signal_hook::iterator::Signals::new(wishes).map_err(CliError::work)?;
    beside("signals", move || signals.forever().for_each(act))
}

/// How often a system that can only count signals is asked for them: too short a wait to be noticed.
#[cfg(not(unix))]
const LOOK: std::time::Duration = std::time::Duration::from_millis(50);

/// Calls `act` with each signal that is to end the program.
#[cfg(not(unix))]
fn each(mut act: impl FnMut(i32) + Send + 'static) -> Result<(), CliError> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let came = Arc::new(std::sync::atomic::AtomicUsize::new(0));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register_usize(signal, came.clone(), signal as usize).map_err(CliError::work)?;
    }
    beside("signals", move || {
        loop {
            match came.swap(0, Ordering::Relaxed) {
                0 => std::thread::sleep(LOOK),
                signal => act(signal as i32),
            }
        }
    })
}

/// Does `work` on a thread of its own, which nothing waits for.
fn beside(name: &str, work: impl FnOnce() + Send + 'static) -> Result<(), CliError> {
    std::thread::Builder::new().name(name.into()).spawn(work).map_err(CliError::work)?;
    Ok(())
}

/// Sets the flag of [`wished`] when standard input ends, for a command that then stops by itself. A pipe ends when the last program that
/// holds its other end has ended or was killed.
pub fn wish_when_input_ends() -> Result<(), CliError> {
    let wished = wished();
    beside("input", move || {
        // Nobody reads what comes; what cannot be read has ended.
        let _ = std::io::copy(&mut std::io::stdin().lock(), &mut std::io::sink());
        wished.store(true, Ordering::Release);
    })
}

/// Ends the program when standard input ends, for a process that must not outlive the program that started it. A pipe ends when the last
/// program that holds its other end has ended or was killed.
pub fn end_when_input_ends() -> Result<(), CliError> {
    beside("input", || {
        // Nobody reads what comes; what cannot be read has ended.
        let _ = std::io::copy(&mut std::io::stdin().lock(), &mut std::io::sink());
        end(signal_hook::consts::SIGTERM);
    })
}

/// Ends the program as a signal would.
fn end(signal: i32) -> ! {
    let _abandoned = unripple_store::abandon_all();
    unripple_devices::jack::shut();
    #[cfg(unix)]
    let _ = signal_hook::low_level::emulate_default_handler(signal);
    std::process::exit(128 + signal);
}

/// Ends the program if a signal has arrived that a command should have answered by stopping its task, but that came before the task had
/// begun.
pub fn end_as_wished() {
    match FIRST.load(Ordering::Relaxed) {
        0 => {}
        signal => end(signal),
    }
}

/// Flag that the first signal sets, for a command that watches it and then stops by itself.
pub fn wished() -> Arc<AtomicBool> {
    WISHED.get_or_init(Arc::default).clone()
}

/// Whether whoever started this program wants it to go on without a terminal, as `nohup` does. Only Linux shows that.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let bits = ignored.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok());
    bits.is_some_and(|bits| bits & (1 << (signal - 1)) != 0)
}

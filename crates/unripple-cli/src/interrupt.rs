//! Handling of Ctrl+C and other signals that end the program, so that nothing unfinished is left behind.

use crate::error::CliError;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::{Arc, OnceLock};

/// Flag that the first signal sets, for a command that then stops by itself.
static WISHED: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// The first signal, if it only set the flag; 0, which is no signal, before.
static FIRST: AtomicI32 = AtomicI32::new(0);

/// Handles the signals that end the program from now on. Files under construction are removed, calls of JACK are completed, and the program
/// then ends as the signal would have ended it, so that shells see status 128 and the signal's number. If a command uses [`wished`], the
/// first signal only sets that flag.
pub fn watch() -> Result<(), CliError> {
    let wishes =
        [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| *signal != SIGHUP || !is_ignored(SIGHUP));
    let mut signals = Signals::new(wishes).map_err(CliError::work)?;
    let watch = move || {
        for signal in signals.forever() {
            // The first one is a wish to stop; whoever sends another does not want to wait.
            if let Some(wished) = WISHED.get().filter(|wished| !wished.load(Ordering::Relaxed)) {
                FIRST.store(signal, Ordering::Relaxed);
                wished.store(true, Ordering::Release);
                continue;
            }
            end(signal);
        }
    };
    std::thread::Builder::new().name("signals".into()).spawn(watch).map_err(CliError::work)?;
    Ok(())
}

/// Ends the program as a signal would.
fn end(signal: i32) -> ! {
    let _abandoned = unripple_store::abandon_all();
    unripple_devices::jack::shut();
    let _ = emulate_default_handler(signal);
    std::process::exit(128 + signal);
}

/// Ends the program as the first signal would have, if there was one: for a command that was to stop by itself and had nothing yet to stop.
pub fn end_as_wished() {
    match FIRST.load(Ordering::Relaxed) {
        0 => {}
        signal => end(signal),
    }
}

/// Flag that the first signal sets, for a command that then stops by itself.
pub fn wished() -> Arc<AtomicBool> {
    WISHED.get_or_init(Arc::default).clone()
}

/// Whether whoever started this program wants it to go on without a terminal, as `nohup` does. Only Linux shows that.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let bits = ignored.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok());
    bits.is_some_and(|bits| bits & (1 << (signal - 1)) != 0)
}

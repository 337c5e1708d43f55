//! A lock that survives a panic elsewhere.

use std::sync::{Mutex, MutexGuard};

/// Holds what a lock guards; what another thread left behind when it panicked can still be read.
pub fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

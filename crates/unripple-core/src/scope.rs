//! Values that are set for a thread while some work runs on it.

use std::cell::RefCell;
use std::thread::LocalKey;

/// A value of the current thread.
pub(crate) type Slot<T> = LocalKey<RefCell<T>>;

/// Runs `work` with `value` in `slot`, and restores what was there, also after a panic.
pub(crate) fn during<T: Default, R>(slot: &'static Slot<T>, value: T, work: impl FnOnce() -> R) -> R {
    let _back = Back { slot, value: slot.replace(value) };
    work()
}

/// Restores the previous value of a slot when it is dropped.
struct Back<T: Default + 'static> {
    slot: &'static Slot<T>,
    value: T,
}

impl<T: Default> Drop for Back<T> {
    fn drop(&mut self) {
        self.slot.replace(std::mem::take(&mut self.value));
    }
}

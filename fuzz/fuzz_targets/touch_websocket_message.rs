//! Any text is a message, or a short mistake.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_touch::Message;

fuzz_target!(|text: &str| {
    if let Err(what) = Message::read(text) {
        assert!(!what.is_empty() && what.chars().count() <= 200);
    }
});

//! Any text is a command of a page, or is refused in words; an edit makes a surface or says what is wrong with it.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_store::load_surface;
use unripple_session::{Command, Draft};

fuzz_target!(|text: &str| match Command::read(text) {
    Ok(Command::Edit(edit)) => {
        let mut draft = Draft::new(load_surface("hudin-2012").expect("a built-in surface"));
        let before = draft.surface().clone();
        if draft.edit(&edit).is_err() {
            assert_eq!(draft.surface(), &before);
        }
    }
    Ok(_) => {}
    Err(refused) => assert!(!refused.to_string().is_empty()),
});

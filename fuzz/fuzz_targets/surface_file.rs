//! Any text is a surface that comes back from its own file, or faults that say where they are.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_store::{parse_surface, parse_surface_with, to_toml};

const RIM: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="150mm" height="150mm" viewBox="0 0 150 150">
<path d="M10 10H100A40 30 20 0 1 110 90Q60 150 10 100C0 80 20 40 10 10ZM30 30V40L45 42Z"/></svg>"#;
const HOLE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm"><circle cx="99" cy="99" r="80"/></svg>"#;

fuzz_target!(|text: &str| {
    let fetch = |name: &str| Ok(if name.len() % 2 == 0 { RIM.into() } else { HOLE.into() });
    match parse_surface_with(text, "fuzz.toml", &fetch) {
        Ok(surface) => match parse_surface(&to_toml(&surface), "copy.toml") {
            Ok(copy) => assert_eq!(copy, surface),
            Err(faults) => panic!("{faults:#}"),
        },
        Err(faults) => {
            assert!(!faults.faults().is_empty());
            for fault in faults.faults() {
                assert!(fault.line >= 1 && fault.column >= 1 && fault.span.end <= text.len());
            }
        }
    }
});

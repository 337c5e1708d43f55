//! Any bytes are a score that can be written and read back, or a message; the first byte says which format.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_effects::{Effect, EffectSet, Kind, Level, Region};
use unripple_store::{effects_to_toml, import_haptic, parse_effects};

const FILES: [&str; 3] = ["fuzz.haptic", "fuzz.ahap", "fuzz.hjif"];

fuzz_target!(|input: (u8, &str)| {
    let (which, text) = input;
    if let Ok(score) = import_haptic(text, FILES[usize::from(which) % FILES.len()]) {
        let effect =
            Effect { name: "it".into(), region: Region::Everywhere, level: Level::Felt(20.0), kind: Kind::Score(score) };
        let set = EffectSet { name: "it".into(), about: String::new(), effects: vec![effect] };
        assert_eq!(set.check(), Ok(()));
        match parse_effects(&effects_to_toml(&set), "copy.toml") {
            Ok(copy) => assert_eq!(copy, set),
            Err(faults) => panic!("{faults:#}"),
        }
    }
});

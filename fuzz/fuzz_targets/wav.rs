//! Any bytes are finite channels of equal length, or a message.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unripple_store::decode_wav;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(wav) = decode_wav(bytes, "fuzz.wav") {
        assert!(wav.rate > 0.0 && !wav.channels.is_empty());
        let length = wav.channels[0].len();
        assert!(wav.channels.iter().all(|c| c.len() == length && c.iter().all(|x| x.is_finite())));
    }
});

//! Drives as WAV: what is written comes back, what is not a WAV is refused.

use proptest::prelude::*;
use std::io::Cursor;
use std::path::PathBuf;
use unripple_core::Drive;
use unripple_store::{StoreError, Wav, decode_wav, read_wav, write_wav};

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("unripple-wavs-{}-{name}", std::process::id()))
}

fn drive(rate: f64, channels: Vec<Vec<f64>>) -> Drive {
    let names = (0..channels.len()).map(|i| format!("a{i}")).collect();
    Drive::new(rate, names, channels).unwrap()
}

fn refusal(bytes: &[u8]) -> String {
    decode_wav(bytes, "d.wav").unwrap_err().to_string()
}

/// A WAV of two channels of integers, written by hand from the format's definition.
fn integers(bits: u16, samples: &[i32]) -> Vec<u8> {
    let width = usize::from(bits / 8);
    let data: Vec<u8> = samples.iter().flat_map(|s| s.to_le_bytes()[..width].to_vec()).collect();
    let mut bytes = b"RIFF".to_vec();
    bytes.extend((36 + data.len() as u32).to_le_bytes());
    bytes.extend(b"WAVEfmt ");
    bytes.extend(16_u32.to_le_bytes());
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(2_u16.to_le_bytes());
    bytes.extend(44_100_u32.to_le_bytes());
    bytes.extend((44_100 * 2 * width as u32).to_le_bytes());
    bytes.extend((2 * width as u16).to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    bytes.extend(b"data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

/// A WAV of two channels of float64, its format plain or one that says its own further on, with a chunk before the samples.
fn doubles(extensible: bool, samples: &[f64]) -> Vec<u8> {
    let mut format = if extensible { 0xfffe_u16 } else { 3 }.to_le_bytes().to_vec();
    format.extend(2_u16.to_le_bytes());
    format.extend(96_000_u32.to_le_bytes());
    format.extend((96_000_u32 * 16).to_le_bytes());
    format.extend(16_u16.to_le_bytes());
    format.extend(64_u16.to_le_bytes());
    if extensible {
        format.extend(22_u16.to_le_bytes());
        format.extend(64_u16.to_le_bytes());
        format.extend([0; 4]);
        format.extend(3_u16.to_le_bytes());
        format.extend([0; 14]);
    }
    let data: Vec<u8> = samples.iter().flat_map(|s| s.to_le_bytes()).collect();
    let mut bytes = b"RIFF\0\0\0\0WAVE".to_vec();
    for (name, chunk) in
        [(b"LIST", b"odd".to_vec()), (b"fmt ", format), (b"fact", vec![0; 4]), (b"data", data)]
    {
        bytes.extend(name);
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(&chunk);
        bytes.extend(vec![0; chunk.len() % 2]);
    }
    bytes
}

#[test]
fn float64_comes_as_it_is() {
    for extensible in [false, true] {
        let wav = decode_wav(Cursor::new(doubles(extensible, &[0.1, -2.5, 1e-300, 4.0])), "d.wav").unwrap();
        assert_eq!(wav, Wav { rate: 96e3, channels: vec![vec![0.1, 1e-300], vec![-2.5, 4.0]] });
        let whole = doubles(extensible, &[0.0, 0.0, 0.0, f64::NAN]);
        assert_eq!(refusal(&whole), "d.wav: expected finite samples, found NaN at sample 1 of channel 2");
        let cut = &doubles(extensible, &[0.0; 4])[..whole.len() - 3];
        assert!(refusal(cut).ends_with("found a file that ends after 3 samples"), "{}", refusal(cut));
        let odd = refusal(&doubles(extensible, &[0.0; 3]));
        assert!(odd.contains("channels of one length"), "{odd}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn comes_back_as_emitted(
        count in 1_usize..40, samples in 0_usize..50, rate in 1_u32..1_000_000, seed in any::<u64>(),
    ) {
        let value = |c: usize, s: usize| ((c * 31 + s * 17) as f64 + seed as f64 * 1e-12).sin() * 3.0;
        let sent = drive(f64::from(rate), (0..count).map(|c| (0..samples).map(|s| value(c, s)).collect()).collect());
        let path = scratch("trip.wav");
        write_wav(&path, &sent).unwrap();
        let back = read_wav(&path).unwrap().into_drive(sent.names(), "d.wav").unwrap();
        std::fs::remove_file(&path).unwrap();
        prop_assert_eq!(back, sent.as_emitted());
    }

    #[test]
    fn bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..400), cut in 0_usize..200) {
        let _ = decode_wav(&bytes[..], "d.wav");
        let mut wav = integers(16, &[1, 2, 3, 4]);
        for (i, byte) in bytes.iter().take(8).enumerate() {
            let at = (usize::from(*byte) + i * cut) % wav.len();
            wav[at] = wav[at].wrapping_add(*byte);
        }
        let _ = decode_wav(&wav[..], "d.wav");
        let mut wav = doubles(cut % 2 == 0, &[1.0, 2.0]);
        for (i, byte) in bytes.iter().take(8).enumerate() {
            let at = (usize::from(*byte) + i * cut) % wav.len();
            wav[at] = wav[at].wrapping_add(*byte);
        }
        let _ = decode_wav(&wav[..], "d.wav");
    }
}

#[test]
fn integers_are_shares_of_full_scale() {
    for bits in [16, 24, 32] {
        let full = 1_i64 << (bits - 1);
        let samples = [(full / 2) as i32, (-full) as i32, 0, (full / 4) as i32];
        let wav = decode_wav(Cursor::new(integers(bits, &samples)), "d.wav").unwrap();
        assert_eq!(
            wav,
            Wav { rate: 44_100.0, channels: vec![vec![0.5, 0.0], vec![-1.0, 0.25]] },
            "{bits} bits"
        );
    }
}

#[test]
fn what_is_no_wav() {
    assert_eq!(refusal(b""), "d.wav: expected a WAV file, found an empty file");
    assert_eq!(
        refusal(b"format = 1\n"),
        "d.wav: expected a WAV file of integers, float32 or float64, found no RIFF tag found"
    );
    let whole = integers(16, &[1, 2, 3, 4]);
    assert_eq!(
        refusal(&whole[..whole.len() - 3]),
        "d.wav: expected a WAV file of integers, float32 or float64, found a file that ends after 2 samples"
    );
    assert!(matches!(read_wav(scratch("absent.wav")), Err(StoreError::Read { .. })));
}

#[test]
fn samples_that_are_no_numbers() {
    let path = scratch("nan.wav");
    write_wav(&path, &drive(8e3, vec![vec![0.0, 1.5], vec![0.0, 0.0]])).unwrap();
    let mut bytes = std::fs::read(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    let at = bytes.len() - 8;
    bytes[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(refusal(&bytes), "d.wav: expected finite samples, found NaN at sample 1 of channel 1");
}

#[test]
fn channels_must_match_actuators() {
    let wav = Wav { rate: 48e3, channels: vec![vec![0.0]; 2] };
    let names: Vec<String> = ["a", "b", "c"].map(String::from).into();
    let error = wav.into_drive(&names, "d.wav").unwrap_err();
    assert_eq!(error.to_string(), "d.wav: expected a channel for each of the 3 actuators, found 2 channels");
}

#[test]
fn what_the_format_cannot_hold() {
    let path = scratch("odd.wav");
    for (bad, message) in [
        (
            drive(44_100.5, vec![vec![0.0]]),
            "expected a whole sample rate from 1 to 1073741823 Hz, found 44100.5 Hz",
        ),
        (drive(48e3, vec![]), "expected 1 to 65535 channels, found 0"),
        (drive(48e3, vec![vec![1e300]]), "expected samples that float32 holds, found 1"),
    ] {
        let error = write_wav(&path, &bad).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
        assert!(!path.exists());
    }
    let nowhere = scratch("no-such-folder").join("d.wav");
    assert!(matches!(write_wav(nowhere, &drive(1.0, vec![vec![0.0]])), Err(StoreError::Write { .. })));
}

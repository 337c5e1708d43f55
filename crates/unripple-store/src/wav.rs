//! WAV files.

use crate::StoreError;
use crate::file::write_beside;
use crate::wide::{self, Format};
use hound::{SampleFormat, WavReader, WavSpec, WavWriter};
use std::fs::File;
use std::io::{BufReader, BufWriter, Cursor, ErrorKind, Read, Seek, Write};
use std::path::Path;
use unripple_core::Drive;

/// Largest number of bytes of samples: the format counts them, and its header, in 32 bits.
const MOST_BYTES: u64 = u32::MAX as u64 - 1024;

/// The content of a WAV file: channels of equal length, at a rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Wav {
    /// Samples per second.
    pub rate: f64,
    /// Samples of each channel: in the drive's unit if the file holds floats, as fractions of full scale if
    /// it holds integers.
    pub channels: Vec<Vec<f64>>,
}

impl Wav {
    /// Converts the channels to a drive of actuators with these names, in channel order.
    ///
    /// # Errors
    /// [`StoreError::Content`] if there are not as many channels as names; `file` names the file in the message.
    pub fn into_drive(self, names: &[String], file: &str) -> Result<Drive, StoreError> {
        if self.channels.len() != names.len() {
            let expected = format!("a channel for each of the {} actuators", names.len());
            return Err(StoreError::content(file, expected, format!("{} channels", self.channels.len())));
        }
        Drive::new(self.rate, names.to_vec(), self.channels)
            .map_err(|error| StoreError::content(file, "a drive", error.to_string()))
    }
}

/// Writes a drive as float32 WAV in the drive's own unit, one channel per actuator; whole or not at all.
///
/// # Errors
/// [`StoreError::Content`] if the format cannot hold the drive: a fractional rate, no channel, more than 65 535 channels
/// or 4 GiB, or a sample past float32. [`StoreError::Write`] if the file cannot be written.
///
/// ```
/// use unripple_core::Drive;
/// let drive = Drive::new(48e3, vec!["a1".into(), "a2".into()], vec![vec![0.5, -1.0], vec![0.0, 0.25]]).unwrap();
/// let path = std::env::temp_dir().join(format!("unripple-doc-{}.wav", std::process::id()));
/// unripple_store::write_wav(&path, &drive)?;
/// let back = unripple_store::read_wav(&path)?.into_drive(drive.names(), "drive.wav")?;
/// assert_eq!(back, drive);
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), unripple_store::StoreError>(())
/// ```
pub fn write_wav(path: impl AsRef<Path>, drive: &Drive) -> Result<(), StoreError> {
    let path = path.as_ref();
    let spec = spec(path, drive)?;
    write_beside(path, |file| {
        encode(BufWriter::new(file), spec, drive).map_err(|e| StoreError::write(path)(into_io(e)))
    })
}

/// The bytes of the file that [`write_wav`] writes.
///
/// # Errors
/// [`StoreError::Content`], as [`write_wav`].
pub fn encode_wav(drive: &Drive) -> Result<Vec<u8>, StoreError> {
    let name = Path::new("drive.wav");
    let spec = spec(name, drive)?;
    let mut bytes = Cursor::new(Vec::new());
    encode(&mut bytes, spec, drive).map_err(|error| StoreError::write(name)(into_io(error)))?;
    Ok(bytes.into_inner())
}

pub(crate) fn encode(to: impl Write + Seek, spec: WavSpec, drive: &Drive) -> Result<(), hound::Error> {
    let mut writer = WavWriter::new(to, spec)?;
    for sample in 0..drive.samples() {
        for channel in drive.channels() {
            writer.write_sample(channel[sample] as f32)?;
        }
    }
    writer.finalize()
}

pub(crate) fn spec(path: &Path, drive: &Drive) -> Result<WavSpec, StoreError> {
    let name = path.display().to_string();
    let refuse = |expected: &str, found: String| StoreError::content(&name, expected, found);
    let count = drive.channels().len();
    let channels = u16::try_from(count).ok().filter(|c| *c > 0);
    let channels = channels.ok_or_else(|| refuse("1 to 65535 channels", count.to_string()))?;
    let rate = drive.rate();
    let most = most_rate(count);
    if rate.fract() != 0.0 || !(1.0..=most).contains(&rate) {
        return Err(refuse(&format!("a whole sample rate from 1 to {most} Hz"), format!("{rate} Hz")));
    }
    let bytes = drive.samples() as u64 * u64::from(channels) * 4;
    if bytes > MOST_BYTES {
        return Err(refuse("at most 4 GiB of samples", format!("{bytes} bytes")));
    }
    if let Some(sample) = drive.channels().iter().flatten().find(|x| !(**x as f32).is_finite()) {
        return Err(refuse("samples that float32 holds", sample.to_string()));
    }
    Ok(WavSpec {
        channels,
        sample_rate: rate as u32,
        bits_per_sample: 32,
        sample_format: SampleFormat::Float,
    })
}

/// Highest sample rate of `channels` channels, in Hz: the header counts the bytes of a second, four for a sample, in 32 bits.
pub(crate) fn most_rate(channels: usize) -> f64 {
    (u32::MAX as usize / 4 / channels.max(1)) as f64
}

pub(crate) fn into_io(error: hound::Error) -> std::io::Error {
    match error {
        hound::Error::IoError(error) => error,
        other => std::io::Error::other(other),
    }
}

/// Reads a WAV file of integers of 8 to 32 bits, float32 or float64.
///
/// # Errors
/// [`StoreError::Content`] if it is empty, not a WAV, cut short, or holds a sample that is not finite;
/// [`StoreError::Read`] if it cannot be read.
pub fn read_wav(path: impl AsRef<Path>) -> Result<Wav, StoreError> {
    let path = path.as_ref();
    let file = File::open(path).map_err(StoreError::read(path))?;
    decode_wav(BufReader::new(file), &path.display().to_string())
}

/// Reads a WAV file from any reader; `name` is its name in messages.
///
/// # Errors
/// As [`read_wav`].
///
/// ```
/// let error = unripple_store::decode_wav(&b""[..], "drive.wav").unwrap_err();
/// assert_eq!(error.to_string(), "drive.wav: expected a WAV file, found an empty file");
/// ```
pub fn decode_wav(mut reader: impl Read, name: &str) -> Result<Wav, StoreError> {
    let mut first = [0; 1];
    match reader.read_exact(&mut first) {
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => {
            return Err(StoreError::content(name, "a WAV file", "an empty file"));
        }
        read => read.map_err(StoreError::read(Path::new(name)))?,
    }
    let reader = match wide::format((&first[..]).chain(reader)).map_err(StoreError::read(Path::new(name)))? {
        Format::Other(whole) => whole,
        Format::Float64 { rate, channels, rest } => {
            let mut wav = Filling::new(rate, channels, name)?;
            wide::samples(BufReader::new(rest), name, |i, sample| wav.keep(i, sample))?;
            return wav.whole(name);
        }
    };
    let reader = WavReader::new(reader).map_err(|error| refuse(name, error, 0))?;
    let spec = reader.spec();
    let mut wav = Filling::new(spec.sample_rate, spec.channels, name)?;
    let mut keep = |i: usize, sample: f64| wav.keep(i, sample);
    match spec.sample_format {
        SampleFormat::Float => {
            for (i, sample) in reader.into_samples::<f32>().enumerate() {
                keep(i, f64::from(sample.map_err(|error| refuse(name, error, i))?))?;
            }
        }
        SampleFormat::Int => {
            let full = 2_f64.powi(i32::from(spec.bits_per_sample) - 1);
            for (i, sample) in reader.into_samples::<i32>().enumerate() {
                keep(i, f64::from(sample.map_err(|error| refuse(name, error, i))?) / full)?;
            }
        }
    }
    wav.whole(name)
}

/// Channels that are being read, sample after sample of each in turn.
struct Filling<'a> {
    wav: Wav,
    name: &'a str,
}

impl<'a> Filling<'a> {
    fn new(rate: u32, channels: u16, name: &'a str) -> Result<Self, StoreError> {
        if rate == 0 {
            return Err(StoreError::content(name, "a positive sample rate", "0 Hz"));
        }
        if channels == 0 {
            return Err(StoreError::content(name, "1 channel or more", "none"));
        }
        let channels = vec![Vec::new(); usize::from(channels)];
        Ok(Self { wav: Wav { rate: f64::from(rate), channels }, name })
    }

    /// The sample number `i` of all channels together. In messages channels count from 1, as sockets do.
    fn keep(&mut self, i: usize, sample: f64) -> Result<(), StoreError> {
        let count = self.wav.channels.len();
        self.wav.channels[i % count].push(sample);
        if sample.is_finite() {
            return Ok(());
        }
        let found = format!("{sample} at sample {} of channel {}", i / count, i % count + 1);
        Err(StoreError::content(self.name, "finite samples", found))
    }

    /// The complete content; channels of different lengths mean that the file was cut short.
    fn whole(self, name: &str) -> Result<Wav, StoreError> {
        let length = self.wav.channels.first().map_or(0, Vec::len);
        if self.wav.channels.iter().any(|channel| channel.len() != length) {
            let found = format!("one that ends within sample {length}");
            return Err(StoreError::content(name, "channels of one length", found));
        }
        Ok(self.wav)
    }
}

/// Converts an error of the WAV reader: wrong content is the file's fault, the rest the system's.
fn refuse(name: &str, error: hound::Error, samples: usize) -> StoreError {
    let found = match error {
        hound::Error::IoError(error)
            if matches!(error.kind(), ErrorKind::UnexpectedEof | ErrorKind::Other) =>
        {
            format!("a file that ends after {samples} samples")
        }
        hound::Error::IoError(error) => return StoreError::read(Path::new(name))(error),
        hound::Error::FormatError(message) => message.into(),
        other => other.to_string(),
    };
    StoreError::content(name, "a WAV file of integers, float32 or float64", found)
}

//! A card's two streams, one that plays and one that records, opened through `cpal`.

use super::crossing::{Events, Player, Recorder};
use super::found::name;
use super::side::Side;
use crate::DevicesError;
use cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use cpal::{BufferSize, Error, ErrorKind, FromSample, Sample, SampleFormat, SizedSample, StreamConfig};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;
use unripple_core::clock::Instant;

/// Source of the calls to a card's two sides: streams of the sound system, or a simulation of them.
pub(super) trait Streams: Send {
    /// Waits until a side may have processed a chunk, for the time `at_most` at most; returns the time
    /// waited.
    fn wait(&mut self, at_most: Duration) -> Duration;
}

/// Streams of the sound system, whose threads call the sides.
pub(super) struct Running {
    /// The open streams; they play and record until they are dropped.
    pub(super) streams: Vec<cpal::Stream>,
    pub(super) events: Arc<Events>,
}

impl Running {
    /// Largest number of frames that a side is called with, if the system reports it; otherwise 0.
    pub(super) fn period(&self) -> usize {
        let told = self.streams.iter().filter_map(|stream| stream.buffer_size().ok());
        told.max().map_or(0, |frames| frames as usize)
    }
}

impl Streams for Running {
    fn wait(&mut self, at_most: Duration) -> Duration {
        let since = Instant::now();
        if !self.events.bell.wakes(std::thread::current().id()) {
            self.events.bell.listen();
            return Duration::ZERO;
        }
        std::thread::park_timeout(at_most);
        since.elapsed()
    }
}

/// Sample formats that are supported, the best first.
const FORMATS: [SampleFormat; 3] = [SampleFormat::F32, SampleFormat::I32, SampleFormat::I16];

/// Finds a device by name, with or without the name of its sound system before it; the system's default for
/// `None`.
pub(super) fn find(named: Option<&str>, side: Side) -> Result<cpal::Device, DevicesError> {
    let host = cpal::default_host();
    let found = match (named, side) {
        (Some(text), _) => {
            let id = text.parse().unwrap_or_else(|_| cpal::DeviceId::new(host.id(), text));
            host.device_by_id(&id)
        }
        (None, Side::Playback) => host.default_output_device(),
        (None, Side::Capture) => host.default_input_device(),
    };
    found.ok_or_else(|| {
        let known = super::found().into_iter().map(|card| card.id).collect::<Vec<_>>().join(", ");
        DevicesError::Card {
            what: named.map_or_else(|| "there is none".into(), |text| format!("there is no `{text}`")),
            fix: if known.is_empty() { "plug one in".into() } else { format!("there are: {known}") },
        }
    })
}

/// The format in which a device is to be opened: of those with enough channels at that rate, the one with fewest.
pub(super) fn config(
    device: &cpal::Device,
    side: Side,
    channels: usize,
    rate: u32,
    block: usize,
) -> Result<(StreamConfig, SampleFormat), DevicesError> {
    let (offers, name) = (side.offers(device), name(device));
    let most = offers.iter().map(|offer| usize::from(offer.channels())).max().unwrap_or(0);
    if most < channels {
        let fix =
            "choose a card with more (`unripple devices` lists them), or a surface with fewer actuators";
        let (what, expected) = (side.channels(), channels);
        return Err(DevicesError::Channels { device: name, what, expected, found: most, fix: fix.into() });
    }
    let refuse = |what: String, fix: &str| Err(DevicesError::Card { what, fix: fix.into() });
    let wide = offers.iter().filter(|offer| usize::from(offer.channels()) >= channels);
    let at_rate: Vec<_> = wide.filter(|offer| offer.contains_rate(rate)).collect();
    if at_rate.is_empty() {
        let what = format!("`{name}` has no {rate} Hz with {channels} {}", side.channels());
        return refuse(what, "use a surface file with a `sample_rate_hz` that the card has");
    }
    let rank = |format: SampleFormat| FORMATS.iter().position(|known| *known == format);
    let known =
        at_rate.iter().filter_map(|offer| Some((rank(offer.sample_format())?, offer.channels(), *offer)));
    let Some((_, _, offer)) = known.min_by_key(|(rank, channels, _)| (*channels, *rank)) else {
        return refuse(
            format!("`{name}` has none of the formats float32, int32, int16"),
            "name its `plughw:` device, which converts",
        );
    };
    let fits = match *offer.buffer_size() {
        cpal::SupportedBufferSize::Range { min, max } => (min..=max).contains(&(block as u32)),
        cpal::SupportedBufferSize::Unknown => false,
    };
    let buffer_size = if fits { BufferSize::Fixed(block as u32) } else { BufferSize::Default };
    let config = StreamConfig { channels: offer.channels(), sample_rate: rate, buffer_size };
    Ok((config, offer.sample_format()))
}

/// Turns an error of a card into one that says how to fix it.
pub(super) fn refused(name: &str, error: &Error) -> DevicesError {
    let fix = match error.kind() {
        ErrorKind::DeviceBusy => "another program has it: close that one, or go through JACK or PipeWire",
        ErrorKind::PermissionDenied => "add yourself to the group `audio`",
        _ => "try its `plughw:` device, or JACK or PipeWire",
    };
    DevicesError::Card { what: format!("`{name}`: {error}"), fix: fix.into() }
}

/// Handles an error of a running card: the card is gone, or it had an underrun or overrun.
fn told(events: &Events, error: &Error) {
    match error.kind() {
        ErrorKind::Xrun => {
            events.xruns.fetch_add(1, Ordering::Relaxed);
            events.bell.ring();
        }
        ErrorKind::RealtimeDenied | ErrorKind::DeviceChanged => {}
        _ => events.lose(error.to_string()),
    }
}

/// Opens the stream that plays.
pub(super) fn playback(
    device: &cpal::Device,
    (config, format): (StreamConfig, SampleFormat),
    player: Player,
    events: &Arc<Events>,
) -> Result<cpal::Stream, DevicesError> {
    match format {
        SampleFormat::I32 => playback_as::<i32>(device, config, player, events),
        SampleFormat::I16 => playback_as::<i16>(device, config, player, events),
        _ => playback_as::<f32>(device, config, player, events),
    }
    .map_err(|error| refused(&name(device), &error))
}

fn playback_as<T: SizedSample + FromSample<f32>>(
    device: &cpal::Device,
    config: StreamConfig,
    mut player: Player,
    events: &Arc<Events>,
) -> Result<cpal::Stream, Error> {
    let (width, events) = (usize::from(config.channels).max(1), events.clone());
    let play = move |data: &mut [T], _: &cpal::OutputCallbackInfo| {
        data.fill(T::EQUILIBRIUM);
        player.play(data.len() / width, |frame, output, x| data[frame * width + output] = T::from_sample(x));
    };
    device.build_output_stream(config, play, move |error| told(&events, &error), None)
}

/// Opens the stream that records.
pub(super) fn capture(
    device: &cpal::Device,
    (config, format): (StreamConfig, SampleFormat),
    recorder: Recorder,
    events: &Arc<Events>,
) -> Result<cpal::Stream, DevicesError> {
    match format {
        SampleFormat::I32 => capture_as::<i32>(device, config, recorder, events),
        SampleFormat::I16 => capture_as::<i16>(device, config, recorder, events),
        _ => capture_as::<f32>(device, config, recorder, events),
    }
    .map_err(|error| refused(&name(device), &error))
}

fn capture_as<T: SizedSample>(
    device: &cpal::Device,
    config: StreamConfig,
    mut recorder: Recorder,
    events: &Arc<Events>,
) -> Result<cpal::Stream, Error>
where
    f32: FromSample<T>,
{
    let (width, events) = (usize::from(config.channels).max(1), events.clone());
    let hear = move |data: &[T], _: &cpal::InputCallbackInfo| {
        recorder.hear(data.len() / width, |frame, input| f32::from_sample(data[frame * width + input]));
    };
    device.build_input_stream(config, hear, move |error| told(&events, &error), None)
}

//! List of the sound cards that are present, and of the formats they offer.

use super::side::Side;
use cpal::traits::{DeviceTrait, HostTrait};

/// A device of the sound system, which can play, record or both.
#[derive(Clone, Debug, PartialEq)]
pub struct CardFound {
    /// Identifier of the device, for [`CardOptions`](super::CardOptions).
    pub id: String,
    /// Name of the device, for display.
    pub name: String,
    /// Formats in which the device can play; `None` if it cannot play.
    pub playback: Option<Offer>,
    /// Formats in which the device can record; `None` if it cannot record.
    pub capture: Option<Offer>,
}

/// The channels, rates and block sizes that a device offers in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    /// Smallest and largest number of channels.
    pub channels: [usize; 2],
    /// Lowest and highest sample rate, in Hz.
    pub rates: [f64; 2],
    /// Smallest and largest block size, in samples; `None` if the system does not report them.
    pub blocks: Option<[usize; 2]>,
}

/// Lists the devices of the sound system that can play or record; several of them may belong to one card.
///
/// ```
/// for card in unripple_devices::cards::found() {
///     assert!(card.playback.is_some() || card.capture.is_some());
/// }
/// ```
pub fn found() -> Vec<CardFound> {
    let devices = cpal::default_host().devices().into_iter().flatten();
    let card = |device: cpal::Device| {
        let id = name(&device);
        let told = device.description().map(|said| said.name().to_owned());
        let [playback, capture] = [Side::Playback, Side::Capture].map(|side| offer(side, &device));
        CardFound { name: told.unwrap_or_else(|_| id.clone()), id, playback, capture }
    };
    devices.map(card).filter(|card| card.playback.is_some() || card.capture.is_some()).collect()
}

/// The name of a sound card.
pub(super) fn name(device: &cpal::Device) -> String {
    device.id().map_or_else(|_| "card".into(), |id| id.id().to_owned())
}

fn offer(side: Side, device: &cpal::Device) -> Option<Offer> {
    let offers = side.offers(device);
    let span = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, 0.0], |[low, high], x| [x.min(low), x.max(high)])
    };
    let channels = span(&mut offers.iter().map(|offer| f64::from(offer.channels())));
    let rates = offers.iter().flat_map(|offer| [offer.min_sample_rate(), offer.max_sample_rate()]);
    let rates = span(&mut rates.map(f64::from));
    let blocks: Vec<[u32; 2]> = offers
        .iter()
        .filter_map(|offer| match *offer.buffer_size() {
            cpal::SupportedBufferSize::Range { min, max } => Some([min, max]),
            cpal::SupportedBufferSize::Unknown => None,
        })
        .collect();
    let blocks = match blocks.is_empty() {
        true => None,
        false => Some(span(&mut blocks.iter().flatten().map(|x| f64::from(*x))).map(|x| x as usize)),
    };
    (!offers.is_empty()).then(|| Offer { channels: channels.map(|x| x as usize), rates, blocks })
}

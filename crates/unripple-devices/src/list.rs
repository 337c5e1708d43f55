//! List of the devices that are available.

use crate::jack;
use std::path::Path;

/// Entry of the list of devices: a device that is available, or the reason why one is not.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// A virtual surface, with a channel for each actuator of a surface, at any sample rate and block size.
    Virtual,
    /// A tape: drive and recordings are files, with any number of channels, at any sample rate.
    Tape,
    /// A JACK server that answers.
    Jack(Server),
    /// No JACK server answers, for the reason in the string.
    NoJack(String),
    /// A sound card, as the kernel describes it.
    Card {
        /// Number of the card, as the kernel counts cards.
        index: usize,
        /// Name of the card, as the kernel reports it.
        name: String,
        /// Streams of the card, each one direction of one device.
        streams: Vec<Stream>,
    },
}

/// Properties of a JACK server: rate, cycle length and ports.
#[derive(Clone, Debug, PartialEq)]
pub struct Server {
    /// Samples per second.
    pub rate: f64,
    /// Samples per cycle.
    pub block: usize,
    /// Full names of the ports to which sound can be sent.
    pub playback: Vec<String>,
    /// Full names of the ports from which sound comes.
    pub capture: Vec<String>,
}

/// One direction of a sound card's device.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    /// The ALSA device, such as `hw:1,0`.
    pub device: String,
    /// Whether the stream plays; otherwise it records.
    pub playback: bool,
    /// Channel counts that the stream offers, ascending; empty if the kernel does not report them (it does
    /// for USB cards only).
    pub channels: Vec<usize>,
    /// Sample rates that the stream offers, in Hz, ascending; empty if the kernel does not report them (it
    /// does for USB cards only).
    pub rates: Vec<f64>,
}

/// Lists all devices that are available, the virtual surface first. The JACK server of the specified name,
/// or the default one, is contacted.
///
/// ```
/// assert_eq!(unripple_devices::list(None)[0], unripple_devices::Found::Virtual);
/// ```
pub fn list(server: Option<&str>) -> Vec<Found> {
    let mut found = vec![Found::Virtual, Found::Tape];
    found.push(match jack::look(server) {
        Ok(jack::Seen { rate, block, playback, capture }) => {
            Found::Jack(Server { rate, block, playback, capture })
        }
        Err(error) => Found::NoJack(error.to_string()),
    });
    found.extend(cards(Path::new("/proc/asound")));
    found
}

/// The cards that a folder such as `/proc/asound` lists.
fn cards(root: &Path) -> Vec<Found> {
    let names = |path: &Path, prefix: &str| -> Vec<(usize, String)> {
        let entries = std::fs::read_dir(path).into_iter().flatten().flatten();
        let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
        let mut found: Vec<(usize, String)> =
            names.filter_map(|name| Some((index(&name, prefix)?, name))).collect();
        found.sort();
        found
    };
    let card = |(number, folder): (usize, String)| {
        let path = root.join(&folder);
        let name = std::fs::read_to_string(path.join("id")).unwrap_or_default().trim().to_owned();
        let streams = names(&path, "pcm").into_iter().map(|(device, pcm)| {
            let usb = std::fs::read_to_string(path.join(format!("stream{device}"))).unwrap_or_default();
            let playback = pcm.ends_with('p');
            let (channels, rates) = offers(&usb, playback);
            Stream { device: format!("hw:{number},{device}"), playback, channels, rates }
        });
        Found::Card { index: number, name, streams: streams.collect() }
    };
    names(root, "card").into_iter().map(card).collect()
}

/// The number in `card3`, `pcm0p`, `pcm0c`.
fn index(name: &str, prefix: &str) -> Option<usize> {
    let rest = name.strip_prefix(prefix)?;
    rest.trim_end_matches(['p', 'c']).parse().ok()
}

/// Channel counts and rates in the text of a USB card's `stream` file, for one direction.
fn offers(text: &str, playback: bool) -> (Vec<usize>, Vec<f64>) {
    let (mut channels, mut rates, mut within) = (Vec::new(), Vec::new(), false);
    for line in text.lines().map(str::trim) {
        match line.split_once(':') {
            Some(("Playback", "")) => within = playback,
            Some(("Capture", "")) => within = !playback,
            Some(("Channels", count)) if within => channels.extend(count.trim().parse::<usize>()),
            Some(("Rates", list)) if within => {
                let known = |rate: &str| rate.trim().parse::<f64>().ok();
                rates.extend(list.split(['-', ',']).filter_map(known));
            }
            _ => {}
        }
    }
    channels.sort_unstable();
    channels.dedup();
    rates.sort_by(f64::total_cmp);
    rates.dedup();
    (channels, rates)
}

#[cfg(test)]
mod tests {
    use super::*;

    const USB: &str = "\
Focusrite Scarlett 18i20 USB at usb-0000:00:14.0-2, high speed : USB Audio

Playback:
  Status: Stop
  Interface 1
    Altset 1
    Format: S32_LE
    Channels: 20
    Endpoint: 0x01 (1 OUT) (ASYNC)
    Rates: 44100, 48000
  Interface 1
    Altset 2
    Channels: 16
    Rates: 88200, 96000

Capture:
  Interface 2
    Altset 1
    Channels: 18
    Rates: 44100, 48000, 88200, 96000
";

    #[test]
    fn a_usb_card_says_what_it_offers() {
        assert_eq!(offers(USB, true), (vec![16, 20], vec![44100.0, 48000.0, 88200.0, 96000.0]));
        assert_eq!(offers(USB, false).0, [18]);
        assert_eq!(offers("", true), (vec![], vec![]));
    }

    #[test]
    fn cards_are_read_from_their_folder() {
        let root = std::env::temp_dir().join(format!("unripple-asound-{}", std::process::id()));
        let card = root.join("card1");
        ["pcm0p", "pcm0c", "pcm3p"].iter().for_each(|pcm| std::fs::create_dir_all(card.join(pcm)).unwrap());
        std::fs::write(card.join("id"), "USB\n").unwrap();
        std::fs::write(card.join("stream0"), USB).unwrap();
        let found = cards(&root);
        std::fs::remove_dir_all(&root).unwrap();
        let [Found::Card { index: 1, name, streams }] = &found[..] else { panic!("{found:?}") };
        assert_eq!((name.as_str(), streams.len()), ("USB", 3));
        assert_eq!(
            (streams[0].device.as_str(), streams[0].playback, &streams[0].channels[..]),
            ("hw:1,0", false, &[18][..])
        );
        assert!(streams[2].channels.is_empty());
        assert!(cards(Path::new("/nowhere")).is_empty());
    }
}

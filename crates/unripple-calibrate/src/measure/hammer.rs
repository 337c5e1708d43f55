//! Responses from blows of a hammer whose force is recorded: the H1 estimate over all blows, and its coherence.

use super::blow::{Blow, BlowAccount, BlowFault, overload, usable_to_hz};
use super::channel::thirds;
use super::{BandQuality, Channel, blows};
use crate::CalibrateError;
use crate::signals::{Band, CrossSpectra, Inversion, Quality, band_powers, snr_db};

/// Regularisation of the deconvolution, relative to the strongest line of the forces' power: 20 dB down, where the usable band ends, it
/// makes responses 1 % too weak.
const FLOOR: f64 = 1e-4;

/// Share at the end of a blow's recording that counts as noise, where there is one blow only.
const END: f64 = 0.05;

/// Least power of noise relative to that of the signal: the rounding of float32.
const LEAST_NOISE: f64 = 1e-15;

/// A blow and what the sensors recorded of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Struck {
    /// The blow; its beginning is the first sample of the sensors' signals.
    pub blow: Blow,
    /// Signal of each sensor from the beginning of the blow on, `[sensor][sample]`, each without its mean before the blow.
    pub heard: Vec<Vec<f64>>,
}

/// Time in s before a blow over which a sensor's offset is averaged.
const BEFORE: f64 = 10e-3;

/// Cuts the blows out of a recording of a force (N) and of sensors, `[sensor][sample]`, all at one rate and of one length. Blows less than
/// `window` samples apart count as double hits. Sensors in `deaf` (indices) may be clipped.
///
/// # Errors
/// [`CalibrateError::Recording`] if there is no blow in the force; [`CalibrateError::Count`] without sensors.
pub fn struck(
    force: &[f64],
    sensors: &[Vec<f64>],
    deaf: &[usize],
    (rate, window): (f64, usize),
) -> Result<Vec<Result<Struck, BlowFault>>, CalibrateError> {
    if sensors.is_empty() {
        let what = "sensors that recorded a blow";
        return Err(CalibrateError::Count { what, expected: "at least 1".into(), found: 0 });
    }
    let shortest = sensors.iter().map(Vec::len).chain([force.len()]).min().unwrap_or(0);
    let mut found = Vec::new();
    for blow in blows(&force[..shortest], rate, window)? {
        found.push(blow.and_then(|blow| {
            let [from, to] = [blow.begin, (blow.begin + window).min(shortest)];
            let cut = |sensor: &Vec<f64>| {
                let before = &sensor[from.saturating_sub((BEFORE * rate) as usize)..from];
                let offset = before.iter().sum::<f64>() / before.len().max(1) as f64;
                sensor[from..to].iter().map(|x| x - offset).collect()
            };
            let heard: Vec<&[f64]> = sensors
                .iter()
                .enumerate()
                .map(|(index, sensor)| if deaf.contains(&index) { &[][..] } else { &sensor[from..to] })
                .collect();
            match overload(&heard) {
                Some(fault) => Err(fault),
                None => Ok(Struck { blow, heard: sensors.iter().map(cut).collect() }),
            }
        }));
    }
    Ok(found)
}

/// The responses of a place to blows there, `samples` of each from the blow on, in the sensors' unit per newton and second, by the H1
/// estimate: the cross spectra of force and signal over the power spectra of the force, both summed over the blows. `refused` are the blows
/// that were not used.
///
/// Responses are limited to the band, and to where the force is [usable](BlowAccount::usable_to_hz), as signal-to-noise ratio and coherence
/// are; with several blows
/// they follow from each other, `γ² / (1 − γ²)` for one blow, after the bias of `n` blows is removed.
///
/// Source: D. J. Ewins, "Modal Testing" (2000), section 3.8; J. S. Bendat, A. G. Piersol, "Random Data" (2010), section 9.2.
///
/// # Errors
/// [`CalibrateError::Recording`] without blows; [`CalibrateError::Dsp`] from deconvolution.
pub fn hammered(
    blows: &[Struck],
    refused: Vec<BlowFault>,
    samples: usize,
    (rate, band): (f64, Band),
) -> Result<Channel, CalibrateError> {
    let Some(first) = blows.first() else {
        let why: Vec<String> = refused.iter().map(ToString::to_string).collect();
        return Err(CalibrateError::Recording {
            what: "blows".into(),
            expected: "at least one that can be used".into(),
            found: format!("none ({})", why.join("; ")),
        });
    };
    let usable = usable_to_hz(blows.iter().map(|one| &one.blow), rate, band.high[1]);
    let trusted = usable.map_or(band, |hz| up_to(band, hz));
    let length = blows.iter().map(|one| one.heard.iter().map(Vec::len).max().unwrap_or(0)).max().unwrap_or(0);
    let mut channel = Channel::default();
    for sensor in 0..first.heard.len() {
        let mut spectra = CrossSpectra::new(length.max(samples).max(1), rate)?;
        blows.iter().try_for_each(|one| spectra.add(&one.blow.force, &one.heard[sensor]))?;
        let mut response = vec![0.0; samples];
        let inversion = Inversion { band: Some(trusted), regularisation: FLOOR, ..Inversion::default() };
        spectra.response(&inversion, &mut response)?;
        let alone = match blows {
            [one] => Some(&one.heard[sensor][..]),
            _ => None,
        };
        let own = Quality::of(&response, &[], rate)?;
        let (snr_db, coherence) = match alone {
            Some(heard) => (of_one(heard, trusted, rate)?, None),
            None => {
                let shared = spectra.coherence_in(trusted);
                (of_shared(shared, blows.len()), Some(shared))
            }
        };
        channel.quality.push(Quality { snr_db, coherence, ..own });
        channel.bands.push(by_thirds(&spectra, alone, (rate, band)));
        channel.responses.push(response);
    }
    let peaks_n = blows.iter().map(|one| one.blow.peak()).collect();
    channel.account.blows = Some(BlowAccount { used: blows.len(), peaks_n, usable_to_hz: usable, refused });
    Ok(channel)
}

/// Beginning of the upper edge of a band that the force limits, relative to its end: softer would take more of what was measured, sharper
/// would ring for longer than a response of 10 ms.
const EDGE: f64 = 0.95;

/// A band that ends at a frequency (Hz), or at its own end.
fn up_to(band: Band, hz: f64) -> Band {
    let top = hz.max(1.1 * band.low[1]).min(band.high[1]);
    Band { high: [band.high[0].min(EDGE * top).max(band.low[1]), top], ..band }
}

/// Signal-to-noise ratio in dB of the mean of `count` blows whose coherence is `shared`: noise alone has a coherence of 1 / `count`.
fn of_shared(shared: f64, count: usize) -> f64 {
    let count = count as f64;
    let noise = ((1.0 - shared) * count / (count - 1.0)).clamp(LEAST_NOISE, 1.0);
    let signal = 1.0 - noise;
    if signal > 0.0 { 10.0 * (count * signal / noise).log10() } else { f64::NEG_INFINITY }
}

/// Signal-to-noise ratio in dB of one blow in a band: the end of its recording counts as noise.
fn of_one(heard: &[f64], band: Band, rate: f64) -> Result<f64, CalibrateError> {
    let mut heard = heard.to_vec();
    band.limit(&mut heard, rate)?;
    Ok(snr_db(&heard, end(&heard)))
}

/// The end of a recording.
fn end(heard: &[f64]) -> &[f64] {
    &heard[heard.len() - (END * heard.len() as f64) as usize..]
}

/// Quality of a response by thirds of an octave.
fn by_thirds(spectra: &CrossSpectra, alone: Option<&[f64]>, (rate, band): (f64, Band)) -> Vec<BandQuality> {
    let thirds = thirds(band);
    let powers =
        alone.map(|heard| [band_powers(heard, rate, &thirds), band_powers(end(heard), rate, &thirds)]);
    let one = |(index, [from, to]): (usize, &[f64; 2])| {
        let hz = (from * to).sqrt();
        match &powers {
            Some([all, noise]) => {
                let noise = noise[index].max(LEAST_NOISE * all[index]);
                let ratio = (all[index] - noise) / noise;
                let snr_db = if ratio > 0.0 { 10.0 * ratio.log10() } else { f64::NEG_INFINITY };
                BandQuality { hz, snr_db, coherence: None }
            }
            None => {
                let shared = spectra.coherence_in(Band { low: [*from; 2], high: [*to; 2] });
                let snr_db = of_shared(shared, spectra.count());
                BandQuality { hz, snr_db, coherence: Some(shared) }
            }
        }
    };
    thirds.iter().enumerate().map(one).collect()
}

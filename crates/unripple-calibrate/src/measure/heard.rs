//! From recordings to responses and their quality: deconvolution, cutting, averaging.

use super::channel::{Noise, by_bands, thirds};
use super::knock::Sweeps;
use super::session::{LEAD, Session, Take};
use super::telling::around;
use super::{Account, Channel, Knocked};
use crate::CalibrateError;
use crate::signals::{Average, Band, Harmonics, Outliers, Quality, Remap, Split, band_powers};
use unripple_dsp::mean_square;

impl Session {
    /// Deconvolves a recording: the responses to all sweeps, one after the other.
    pub(super) fn whole(&self, heard: &[f64]) -> Result<Vec<f64>, CalibrateError> {
        let mut whole = vec![0.0; self.plan.size()];
        self.plan.deconvolve(
            &heard[..self.heard.min(heard.len())],
            &mut whole,
            &mut self.plan.workspace(),
        )?;
        Ok(whole)
    }

    /// Responses and their quality from the signal of one input in all takes; the first `from` samples,
    /// which precede time 0, are left out.
    pub(super) fn channel(
        &self,
        takes: &[Take],
        input: usize,
        from: usize,
    ) -> Result<Channel, CalibrateError> {
        let wholes =
            takes.iter().map(|take| self.whole(&take.lines[input])).collect::<Result<Vec<_>, _>>()?;
        let noise =
            wholes.first().map(|whole| Noise::of(whole, &self.sweep, LEAD, self.band)).unwrap_or_default();
        let mut accounts = takes.iter().map(|take| take.verdict.account.clone());
        let account = accounts.next().unwrap_or_default();
        let account = Account { repeats: accounts.collect(), ..account };
        let mut channel = Channel { account, ..Channel::default() };
        let loud =
            takes.iter().flat_map(|take| &take.lines[input]).fold(0.0, |most: f64, x| most.max(x.abs()));
        channel.account.peak = loud;
        let hits: Vec<Vec<bool>> =
            takes.iter().map(|take| self.knocked(&mut channel, &take.lines[input])).collect();
        channel.account.unlike = self.unlike(takes, &hits);
        let samples = self.options.samples(self.sweep.rate);
        for actuator in 0..self.wires.drives.len() {
            let used = unhit(&hits, actuator);
            let cuts = used.iter().map(|take| self.cut(&takes[*take], &wholes[*take], actuator));
            let cuts = cuts.collect::<Result<Vec<_>, _>>()?;
            let whole = &wholes[used.first().copied().unwrap_or(0)];
            let response = self.response(&mut channel, &cuts, whole, actuator, &noise)?;
            channel.responses.push(response[from..].iter().take(samples + LEAD - from).copied().collect());
        }
        let replaced = |actuator: &usize| hits.iter().any(|hits| !hits[*actuator - 1]);
        for knock in &mut channel.account.knocks {
            knock.left_out = knock.actuators.iter().all(replaced);
        }
        Ok(channel)
    }

    /// Largest number, over the takes, of sweeps whose sensor signals differ from the first take's, without
    /// those disturbed by a knock, and number of all sweeps; `None` unless the former is large.
    fn unlike(&self, takes: &[Take], hits: &[Vec<bool>]) -> Option<[usize; 2]> {
        let all = self.wires.drives.len();
        let missed = |(take, hits): (&Take, &Vec<bool>)| {
            take.verdict.unlike.iter().filter(|sweep| !hits.get(**sweep).copied().unwrap_or(false)).count()
        };
        let most = takes.iter().zip(hits).map(missed).max()?;
        (MANY * most > all).then_some([most, all])
    }

    /// Whether a knock disturbed each actuator's response in the signal of one input; the knocks are added
    /// to the account.
    fn knocked(&self, channel: &mut Channel, line: &[f64]) -> Vec<bool> {
        let starts = self.schedule.starts();
        let sweeps = Sweeps {
            sweep: &self.sweep,
            starts,
            latency: self.options.latency,
            decay: self.decay(),
            band: self.band,
        };
        let rate = self.sweep.rate;
        let mut hits = vec![false; starts.len()];
        for knock in sweeps.knocks(line) {
            // In the deconvolved signal a knock lies from a sweep's length before its time to where it has died away.
            let until = knock.at as f64 + 2.0 * self.decay() * rate;
            let since = knock.at as f64 - (self.sweep.sounding() + self.options.response_length) * rate;
            let hit = |start: &usize| (since..until).contains(&(*start as f64 + self.options.latency));
            let actuators: Vec<usize> =
                (0..starts.len()).filter(|a| hit(&starts[*a])).map(|a| a + 1).collect();
            actuators.iter().for_each(|actuator| hits[*actuator - 1] = true);
            let (at_s, share_db) = (knock.at as f64 / rate, 10.0 * knock.share.log10());
            channel.account.knocks.push(Knocked { at_s, actuators, share_db, left_out: false });
        }
        hits
    }

    /// The response to one actuator, corrected to the tension of the first take.
    fn cut(&self, take: &Take, whole: &[f64], actuator: usize) -> Result<Vec<f64>, CalibrateError> {
        let mut cut = vec![0.0; self.schedule.window()];
        self.schedule.cut(whole, actuator, &mut cut)?;
        let change = take.verdict.changes.as_ref().and_then(|changes| changes.get(actuator));
        let Some([change, rate]) = change.copied() else { return Ok(cut) };
        // Each frequency was swept at its own time.
        let growth = self.sweep.growth();
        let at = |hz: f64| growth * (hz.max(self.sweep.from) / self.sweep.from).ln();
        let middle = at(felt_at(&cut, self.band, self.sweep.rate));
        let from = |hz: f64| self.law.changed(hz, change + rate * (at(hz) - middle));
        Ok(Remap::new(&cut, self.sweep.rate, LEAD as f64).moved([0.0, 0.5 * self.sweep.rate], from))
    }

    /// The mean of the takes' cuts, with its quality added to the channel.
    fn response(
        &self,
        channel: &mut Channel,
        cuts: &[Vec<f64>],
        whole: &[f64],
        actuator: usize,
        noise: &Noise,
    ) -> Result<Vec<f64>, CalibrateError> {
        let kept = LEAD + self.options.samples(self.sweep.rate);
        let rows: Vec<&[f64]> = cuts.iter().map(|cut| &cut[..kept.min(cut.len())]).collect();
        let average = Average::of(&rows, Outliers::default())?;
        // The decay in the quality is that over the whole window.
        let mut quality = Quality::of(&cuts[0][LEAD..], &[], self.sweep.rate)?;
        quality.snr_db = noise.snr_db(&average.mean[LEAD..]);
        if average.kept.iter().filter(|kept| **kept).count() > 1 {
            quality.snr_db = average.snr_db();
            quality.coherence = Some(average.coherence());
        }
        if !self.stands_out(&cuts[0], whole, actuator, noise) {
            quality.snr_db = f64::NEG_INFINITY;
        }
        let harmonics = self.harmonics(whole, actuator, noise);
        let power: f64 = harmonics.iter().flatten().map(|ratio| ratio * ratio).sum();
        quality.distortion_db = (power > 0.0).then(|| 10.0 * power.log10());
        let ratio = |i: usize| harmonics.get(i).copied().flatten().unwrap_or(f64::NAN);
        channel.account.harmonics.push([ratio(0), ratio(1)]);
        let kept: Vec<&[f64]> =
            rows.iter().zip(&average.kept).filter(|(_, kept)| **kept).map(|(row, _)| &row[LEAD..]).collect();
        channel.bands.push(by_bands(&kept, noise, self.band, self.sweep.rate));
        channel.quality.push(quality);
        Ok(average.mean)
    }

    /// Whether a response has more energy than the remaining ringing of earlier sweeps.
    fn stands_out(&self, response: &[f64], whole: &[f64], actuator: usize, noise: &Noise) -> bool {
        let rate = self.sweep.rate;
        let start = (self.schedule.starts()[actuator] + LEAD) as i64;
        let [from, to] = BEFORE.map(|share| (share * self.decay() * rate) as i64);
        let before = around(whole, start - from, usize::try_from(from - to).unwrap_or(0));
        let ringing = mean_square(&before) - noise.power;
        // Energy of that ringing in the window, from time 0 to the end, as an exponential decay.
        let left = ringing.max(0.0) * (-(BEFORE[0] + BEFORE[1])).exp() * self.decay() / 2.0 * rate;
        let all: f64 = response[LEAD..].iter().map(|x| x * x - noise.power).sum();
        all > MORE * left
    }

    /// Amplitude decay time, in s, that the schedule is made for: e⁻⁵ of a response is left when the next begins.
    fn decay(&self) -> f64 {
        self.options.settle_time / 5.0
    }

    /// Harmonics as shares of the drive's amplitude, from the second on; `None` where one does not stand out of the noise.
    fn harmonics(&self, whole: &[f64], actuator: usize, noise: &Noise) -> Vec<Option<f64>> {
        if self.options.highest_order < 2 {
            return Vec::new();
        }
        let split = Split {
            start: self.schedule.starts()[actuator],
            lead: LEAD,
            window: self.schedule.window(),
            highest_order: self.options.highest_order,
            band: Some(self.band),
        };
        match Harmonics::of(whole, &self.sweep, &split) {
            Ok(harmonics) => harmonics.of_drive(whole, &self.sweep, &split, &noise.early, self.decay()),
            // A silent channel has no harmonics; its signal-to-noise ratio is reported anyway.
            Err(_) => Vec::new(),
        }
    }
}

/// Takes in which no knock disturbed the actuator's response; all takes if there is no such take.
fn unhit(hits: &[Vec<bool>], actuator: usize) -> Vec<usize> {
    let hit = |take: &usize| hits[*take].get(actuator).copied().unwrap_or(false);
    let clean: Vec<usize> = (0..hits.len()).filter(|take| !hit(take)).collect();
    if clean.is_empty() { (0..hits.len()).collect() } else { clean }
}

/// Unrecognised sweeps are many if they are more than one in three of all: fewer may be those of dead actuators.
const MANY: usize = 3;

/// Start and end of the interval before a response in which the ringing of earlier sweeps is measured, in decay times: not so close that
/// the ringing of the band's edges reaches it.
const BEFORE: [f64; 2] = [0.6, 0.4];

/// Smallest energy of a response, relative to the remaining ringing of earlier sweeps. With less, that
/// ringing would be taken for a response; with much more, weak actuators would count as silent.
const MORE: f64 = 3.0;

/// The frequency (Hz) whose time in the sweep is used as the time of a measured change of tension: the mean
/// of its logarithm over thirds of an octave, weighted by the power of the response and the square of the
/// frequency, since phases change in proportion to frequency.
fn felt_at(response: &[f64], band: Band, rate: f64) -> f64 {
    let thirds = thirds(band);
    let powers = band_powers(response, rate, &thirds);
    let (sum, weight) = thirds.iter().zip(powers).fold((0.0, 0.0), |(sum, weight), ([from, to], power)| {
        let own = power * from * to;
        (sum + own * 0.5 * (from * to).ln(), weight + own)
    });
    if weight > 0.0 { (sum / weight).exp() } else { (band.low[1] * band.high[0]).sqrt() }
}

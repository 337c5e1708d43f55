//! Findings of a recording besides the responses: clock error, lost samples, change of tension, knocks, harmonics, blows.

use super::blow::BlowAccount;

/// A gap in a recording: samples that were lost or recorded twice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lost {
    /// Number of samples lost; negative if that many were recorded twice.
    pub samples: i64,
    /// Bounds between which the gap lies somewhere, in s of the played signal.
    pub between_s: [f64; 2],
    /// Number of the last sweep that ended before the gap, and of the first that began after it; from 1.
    pub sweeps: [usize; 2],
}

impl Lost {
    /// How many samples are missing or surplus, and where, in words.
    pub(super) fn said(&self) -> String {
        let (count, what) = (self.samples.abs(), if self.samples > 0 { "lost" } else { "recorded twice" });
        let ([from, to], [before, after]) = (self.between_s, self.sweeps);
        format!(
            "{count} samples were {what} between {from:.3} and {to:.3} s, between sweeps {before} and {after}"
        )
    }
}

/// A knock: a sound in a recording that was not played.
#[derive(Clone, Debug, PartialEq)]
pub struct Knocked {
    /// Time of the knock, in s of the played signal.
    pub at_s: f64,
    /// Numbers, from 1, of the actuators whose sweeps the knock disturbed.
    pub actuators: Vec<usize>,
    /// Energy of the knock, relative to that of one recorded sweep, in dB.
    pub share_db: f64,
    /// Whether the sweeps that the knock disturbed were replaced by those of other takes of the same point.
    pub left_out: bool,
}

/// Findings from the sweeps of a take (one recording) about its clock, its gaps, the sheet's tension and
/// other sounds. `None` means unknown: the recording has nothing from which the quantity follows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    /// Error of the recording's clock relative to that of playing, in parts per million, positive if it is faster; corrected in the
    /// responses.
    pub clock_ppm: Option<f64>,
    /// Standard error of `clock_ppm`, in parts per million.
    pub clock_error_ppm: f64,
    /// Rms deviation of the sweeps' times of arrival, in samples, that neither a clock error nor lost
    /// samples explain; not corrected in the responses.
    pub scatter: Option<f64>,
    /// Delay of this take relative to the first take, in samples; corrected in the responses.
    pub late: Option<f64>,
    /// Gaps in the recording; samples after each gap have been moved back to their correct time.
    pub lost: Vec<Lost>,
    /// Relative change of tension (of stiffness, for a plate without tension) since the first take, at the
    /// first and at the last sweep; corrected in the responses.
    pub drift: Option<[f64; 2]>,
    /// Whether `drift` is a change of stiffness, since the plate has no tension.
    pub of_stiffness: bool,
    /// Knocks (sounds that were not played) in the recording, in order of time.
    pub knocks: Vec<Knocked>,
    /// Largest magnitude that was recorded, in the device's unit: 1 is full scale.
    pub peak: f64,
    /// Amplitudes of the second and third harmonic of each actuator, relative to that of the drive; NaN for
    /// a harmonic that does not stand out of the noise.
    pub harmonics: Vec<[f64; 2]>,
    /// Number of sweeps whose sensor signals differ from those of the first take for other reasons than
    /// noise or a knock, and number of all sweeps; `None` unless the former are many.
    pub unlike: Option<[usize; 2]>,
    /// Blows of a hammer with a force sensor at the place; `None` for other ways of measuring.
    pub blows: Option<BlowAccount>,
    /// Accounts of further takes of the same place, in their order; the fields above are those of the first take.
    pub repeats: Vec<Account>,
}

/// Smallest clock error that is reported, in parts per million.
const SAME_PPM: f64 = 0.5;

/// Smallest relative change of tension that is reported.
const SAME_TENSION: f64 = 1e-4;

/// Smallest delay that is reported, in samples: a third of a degree of the phase at 1 kHz for a rate of 48
/// kHz.
const SAME_TIME: f64 = 0.05;

/// Smallest harmonic that is reported, as a share of the drive's amplitude.
const LEAST_HARMONIC: f64 = 1e-3;

impl Account {
    /// The findings in words, one sentence each; only deviations and faults are mentioned.
    pub fn said(&self) -> Vec<String> {
        let mut said = self.brought();
        if !self.repeats.is_empty() {
            let takes = std::iter::once(said).chain(self.repeats.iter().map(Self::brought)).enumerate();
            let named = |(take, said): (usize, Vec<String>)| {
                said.into_iter().map(move |what| format!("take {}: {what}", take + 1))
            };
            said = takes.flat_map(named).collect();
        }
        said.extend(self.distorted());
        said.extend(self.blows.iter().flat_map(BlowAccount::said));
        said.extend(self.knocks.iter().map(|knock| {
            let (at, left) =
                (knock.at_s, if knock.left_out { ": the sweeps that it hit were left out" } else { "" });
            format!("a knock at {at:.2} s{left}")
        }));
        said
    }

    /// The corrections of one take to the clock, the time and the tension of the first, in words.
    fn brought(&self) -> Vec<String> {
        let mut said = Vec::new();
        if let Some(ppm) = self.clock_ppm.filter(|ppm| ppm.abs() >= SAME_PPM) {
            let side = if ppm > 0.0 { "fast" } else { "slow" };
            let ppm = ppm.abs();
            said.push(format!("the recording's clock runs {ppm:.1} millionths {side}: resampled"));
        }
        said.extend(self.lost.iter().map(|lost| format!("{}: what comes after was moved back", lost.said())));
        if let Some(late) = self.late.filter(|late| late.abs() >= SAME_TIME) {
            let side = if late > 0.0 { "later" } else { "earlier" };
            let late = late.abs();
            said.push(format!("the recording is {late:.2} samples {side} than the first: shifted back"));
        }
        if let Some([first, last]) = self.drift.filter(|drift| drift.iter().any(|x| x.abs() >= SAME_TENSION))
        {
            let what = if self.of_stiffness { "stiffness" } else { "tension" };
            let (first, last) = (100.0 * first, 100.0 * last);
            said.push(format!(
                "{what} differed by {first:+.2} % from the first recording, by {last:+.2} % at its end: corrected"
            ));
        }
        if let Some(scatter) = self.scatter {
            said.push(format!(
                "the arrival times of the sweeps deviate by {scatter:.2} samples rms, which no clock error explains (latency that \
                 jitters, or a few samples lost): not corrected"
            ));
        }
        said
    }

    /// The harmonics in words, rms over all actuators for which any was found; `None` if they are small.
    fn distorted(&self) -> Option<String> {
        let rms = |order: usize| {
            let told: Vec<f64> = self.harmonics.iter().map(|h| h[order]).filter(|h| h.is_finite()).collect();
            let known = told.iter().map(|h| h * h).sum::<f64>() / told.len().max(1) as f64;
            // Found for only a few actuators, it may be chance.
            if 2 * told.len() >= self.harmonics.len() { known.sqrt() } else { 0.0 }
        };
        let [second, third] = [rms(0), rms(1)];
        (second.max(third) >= LEAST_HARMONIC).then(|| {
            let [second, third] = [second, third].map(|share| 100.0 * share);
            format!("harmonics of the drive: second {second:.2} %, third {third:.2} %")
        })
    }
}

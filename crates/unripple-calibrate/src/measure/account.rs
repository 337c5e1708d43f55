//! Findings of a recording besides the responses: clock error, lost samples, change of tension, knocks, harmonics.

/// Samples that were lost, or repeated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lost {
    /// Number of samples lost; negative if as many were heard twice.
    pub samples: i64,
    /// Where, in s of what is played: not before and not after.
    pub between_s: [f64; 2],
    /// The last sweep that ended before, and the first that began after; from 1.
    pub sweeps: [usize; 2],
}

/// Something that was heard and not played.
#[derive(Clone, Debug, PartialEq)]
pub struct Knocked {
    /// Where, in s of what is played.
    pub at_s: f64,
    /// The actuators whose sweeps it hit, from 1.
    pub actuators: Vec<usize>,
    /// Energy of the knock over that of one sweep as heard, in dB.
    pub share_db: f64,
    /// Whether other takes of the same point stand in for the sweeps that it hit.
    pub left_out: bool,
}

/// Findings from the sweeps of a take on its clock, its gaps, the sheet's tension and other sounds. `None` is not known:
/// nothing that shows it was recorded.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    /// Error of the recording's clock against that of what is played, in millionths, positive if it is quicker; taken
    /// out.
    pub clock_ppm: Option<f64>,
    /// Standard error of that.
    pub clock_error_ppm: f64,
    /// Samples, root mean square, by which sweeps came early or late that neither one clock nor lost samples explain; left as it is.
    pub scatter: Option<f64>,
    /// Samples by which it came late beside the first take; taken out.
    pub late: Option<f64>,
    /// Samples lost, put back as far as that goes.
    pub lost: Vec<Lost>,
    /// Tension (stiffness, of a plate without tension) beside the first take, as a share more, at the first and the last
    /// sweep; taken out.
    pub drift: Option<[f64; 2]>,
    /// Whether it is stiffness that `drift` speaks of.
    pub of_stiffness: bool,
    /// The knocks that were found, in order of time.
    pub knocks: Vec<Knocked>,
    /// Largest magnitude that was heard, in the device's unit: 1 is full scale.
    pub peak: f64,
    /// Second and third harmonic of each actuator, as a share of the amplitude; NaN where none stands out of the noise.
    pub harmonics: Vec<[f64; 2]>,
    /// Sweeps that sensors heard otherwise than in the first take, where neither noise nor a knock is why, and all sweeps; if they are many.
    pub unlike: Option<[usize; 2]>,
    /// The same of further takes of the same place, in their order; the fields above are the first's.
    pub repeats: Vec<Account>,
}

/// Clocks closer than this, in millionths, are not worth a word.
const SAME_PPM: f64 = 0.5;

/// Neither is a change of tension below this share.
const SAME_TENSION: f64 = 1e-4;

/// Nor is a delay below this many samples, a third of a degree of the phase at 1 kHz for a rate of 48 kHz.
const SAME_TIME: f64 = 0.05;

/// Share of the amplitude from which a harmonic is worth a word.
const LEAST_HARMONIC: f64 = 1e-3;

impl Account {
    /// The findings in words, a sentence each; nothing of what is as it should be.
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
        said.extend(self.knocks.iter().map(|knock| {
            let (at, left) =
                (knock.at_s, if knock.left_out { ": the sweeps that it hit were left out" } else { "" });
            format!("a knock at {at:.2} s{left}")
        }));
        said
    }

    /// How a take was brought to the clock, the time and the tension of the first.
    fn brought(&self) -> Vec<String> {
        let mut said = Vec::new();
        if let Some(ppm) = self.clock_ppm.filter(|ppm| ppm.abs() >= SAME_PPM) {
            let side = if ppm > 0.0 { "fast" } else { "slow" };
            let ppm = ppm.abs();
            said.push(format!("the recording's clock runs {ppm:.1} millionths {side}: resampled"));
        }
        for lost in &self.lost {
            let (count, what) = (lost.samples.abs(), if lost.samples > 0 { "lost" } else { "heard twice" });
            let ([from, to], [before, after]) = (lost.between_s, lost.sweeps);
            said.push(format!(
                "{count} samples were {what} between {from:.3} and {to:.3} s, between sweeps {before} and {after}: what comes \
                 after was moved back"
            ));
        }
        if let Some(late) = self.late.filter(|late| late.abs() >= SAME_TIME) {
            let side = if late > 0.0 { "later" } else { "earlier" };
            let late = late.abs();
            said.push(format!("it came {late:.2} samples {side} than the first: shifted back"));
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
                "sweeps came {scatter:.2} samples early or late that no clock explains (latency that jitters, or a few samples \
                 lost): not corrected"
            ));
        }
        said
    }

    /// The harmonics that are worth a word, over all actuators for which any was found.
    fn distorted(&self) -> Option<String> {
        let rms = |order: usize| {
            let told: Vec<f64> = self.harmonics.iter().map(|h| h[order]).filter(|h| h.is_finite()).collect();
            let known = told.iter().map(|h| h * h).sum::<f64>() / told.len().max(1) as f64;
            // Told of few, it is as likely the scatter of noise.
            if 2 * told.len() >= self.harmonics.len() { known.sqrt() } else { 0.0 }
        };
        let [second, third] = [rms(0), rms(1)];
        (second.max(third) >= LEAST_HARMONIC).then(|| {
            let [second, third] = [second, third].map(|share| 100.0 * share);
            format!("harmonics of the drive: second {second:.2} %, third {third:.2} %")
        })
    }
}

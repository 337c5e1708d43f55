//! A set of actuators, and how adding or removing one changes its contrasts.

use crate::{Forms, Objective};

/// A set of chosen actuators, with the sums of the quadratic forms over it.
#[derive(Clone, Debug)]
pub struct Chosen<'a> {
    forms: &'a Forms,
    actuators: Vec<usize>,
    /// Sum of p_a over the set, per case.
    peaks: Vec<f32>,
    /// zᵀQz, per case.
    squares: Vec<f32>,
    /// Sum of Q_ab over the set's a, cases x all actuators b.
    cross: Vec<f32>,
}

impl<'a> Chosen<'a> {
    /// The sums over a set of actuators, given by their indices.
    pub fn new(forms: &'a Forms, actuators: Vec<usize>) -> Self {
        let (cases, count) = (forms.cases(), forms.actuators());
        let mut cross = vec![0.0f32; cases * count];
        for a in &actuators {
            cross.iter_mut().zip(forms.row(*a)).for_each(|(sum, row)| *sum += row);
        }
        let over = |of: &[f32]| actuators.iter().map(|a| of[*a]).sum::<f32>();
        let peaks = (0..cases).map(|case| over(forms.peaks(case))).collect();
        let squares = (0..cases).map(|case| over(&cross[case * count..]).max(0.0)).collect();
        Self { forms, actuators, peaks, squares, cross }
    }

    /// Indices of the actuators.
    pub fn actuators(&self) -> &[usize] {
        &self.actuators
    }

    /// Contrast of every case (a target on one model of the surface), a ratio.
    pub fn contrasts(&self) -> Vec<f64> {
        let ratio = |(peak, square): (&f32, &f32)| f64::from(contrast(*peak, *square));
        self.peaks.iter().zip(&self.squares).map(ratio).collect()
    }

    /// The value of the objective for this set, a contrast (ratio).
    pub fn score(&self, objective: Objective) -> f64 {
        objective.of(&self.contrasts(), self.forms.weights())
    }

    /// The set without its actuator number `index`, counted as in [`Chosen::actuators`].
    #[must_use]
    pub fn without(&self, index: usize) -> Self {
        let mut rest = self.actuators.clone();
        let a = rest.remove(index);
        let (count, row) = (self.forms.actuators(), self.forms.row(a));
        let own = |case: usize| row[case * count + a];
        Self {
            forms: self.forms,
            actuators: rest,
            peaks: self
                .peaks
                .iter()
                .enumerate()
                .map(|(case, peak)| peak - self.forms.peaks(case)[a])
                .collect(),
            squares: (self.squares.iter().enumerate())
                .map(|(case, square)| (square - 2.0 * self.cross[case * count + a] + own(case)).max(0.0))
                .collect(),
            cross: self.cross.iter().zip(row).map(|(sum, row)| sum - row).collect(),
        }
    }

    /// The set with the actuator `a` inserted as number `index`, counted as in [`Chosen::actuators`].
    #[must_use]
    pub fn with(mut self, index: usize, a: usize) -> Self {
        let (count, row) = (self.forms.actuators(), self.forms.row(a));
        for case in 0..self.forms.cases() {
            self.squares[case] += 2.0 * self.cross[case * count + a] + row[case * count + a];
            self.peaks[case] += self.forms.peaks(case)[a];
        }
        self.cross.iter_mut().zip(row).for_each(|(sum, row)| *sum += row);
        self.actuators.insert(index, a);
        self
    }

    /// The value of the objective for the set with one more actuator, a contrast (ratio) for each actuator of
    /// the forms.
    pub fn with_each(&self, objective: Objective) -> Vec<f64> {
        match objective {
            Objective::Mean => self.fold(0.0, |sum, weight, contrast| sum + weight * contrast),
            Objective::Worst => self.fold(f32::INFINITY, |least, _, contrast| least.min(contrast)),
            Objective::Quantile(_) => self.sorted(objective),
        }
    }

    fn fold(&self, first: f32, with: impl Fn(f32, f32, f32) -> f32) -> Vec<f64> {
        let mut scores = vec![first; self.forms.actuators()];
        for case in 0..self.forms.cases() {
            let weight = self.forms.weights()[case] as f32;
            let (peaks, own, cross) = (self.forms.peaks(case), self.forms.own(case), self.cross_of(case));
            let (peak, square) = (self.peaks[case], self.squares[case]);
            for (((score, p), own), cross) in scores.iter_mut().zip(peaks).zip(own).zip(cross) {
                *score = with(*score, weight, contrast(peak + p, square + 2.0 * cross + own));
            }
        }
        scores.into_iter().map(f64::from).collect()
    }

    fn sorted(&self, objective: Objective) -> Vec<f64> {
        let with = |b: usize| -> Vec<f64> {
            let of = |case: usize| {
                let square = self.squares[case] + 2.0 * self.cross_of(case)[b] + self.forms.own(case)[b];
                f64::from(contrast(self.peaks[case] + self.forms.peaks(case)[b], square))
            };
            (0..self.forms.cases()).map(of).collect()
        };
        (0..self.forms.actuators()).map(|b| objective.of(&with(b), self.forms.weights())).collect()
    }

    fn cross_of(&self, case: usize) -> &[f32] {
        let count = self.forms.actuators();
        &self.cross[case * count..(case + 1) * count]
    }
}

/// Peak over the rms outside; 0 where nothing moves.
fn contrast(peak: f32, square: f32) -> f32 {
    peak.abs() / square.max(f32::MIN_POSITIVE).sqrt()
}

//! The paper's figures and remarks (Hudin et al. 2012) for a design of its own film.

use super::ground::Ground;
use super::paper::WAVELENGTH;
use super::tradeoffs::by_rate;
use super::{Design, Nature, PaperFigures, Remark, table1};
use std::f64::consts::TAU;

/// Phase velocities that the paper prints for the longest waves and for waves of 15 mm, in m/s.
const PRINTED_CELERITIES: [f64; 2] = [34.0, 43.0];

/// The paper's figures for its own film, with the remarks on its text.
pub(super) fn paper_figures(ground: &Ground<'_>, design: &Design) -> PaperFigures {
    let (n, window) = (ground.actuators, ground.window.seconds);
    let decay_time_s = window / n;
    let damped = ground.cavity.clone().with_decay_time(decay_time_s);
    let figures = PaperFigures {
        celerity_at_15mm_m_s: ground.medium.phase_celerity(TAU / WAVELENGTH),
        window_s: ground.window_paper(),
        decay_time_s,
        contrast_at_decay_time: ground.correction() * damped.contrast(n, window),
        contrast_by_rate: by_rate(&damped, ground.correction(), n, window),
        table1: table1(),
        remarks: Vec::new(),
    };
    let mut remarks = misprints(ground.surface.sheet.tension, design, &figures).to_vec();
    remarks.extend(counts(design));
    remarks.extend(laws(design, &figures));
    remarks.extend(finger(design));
    PaperFigures { remarks, ..figures }
}

fn remark(topic: &str, nature: Nature, printed: &str, remark: impl Into<String>) -> Remark {
    Remark { topic: topic.into(), nature, printed: printed.into(), remark: remark.into() }
}

/// The remarks that can be shown from the paper alone. `tension` is that of the film here, in N/m.
fn misprints(tension: f64, design: &Design, figures: &PaperFigures) -> [Remark; 3] {
    let [slow, fast] = PRINTED_CELERITIES;
    let window_ms = |celerity: f64| 1e3 * figures.window_s * design.celerity_min_m_s / celerity;
    [
        remark(
            "tension",
            Nature::Misprint,
            "R_s = 30 N/m",
            format!(
                "with the density of table 1 it gives long waves of 13 m/s, where {slow} m/s is printed beside it; that takes 200 N/m, \
                 as do the 2 N of table 1 on a strip of 10 mm. 30 N is the force of 200 N/m on a side of 150 mm. Here it is \
                 {tension} N/m"
            ),
        ),
        remark(
            "window",
            Nature::Misprint,
            "(2Sk_max + P)/(2Nc_min) ≃ 30 ms",
            format!(
                "the printed sides, wavelength, actuators and {slow} m/s give {:.1} ms, and {fast} m/s in place of the least velocity \
                 {:.1} ms; the velocity of this model, {:.2} m/s, gives {:.1} ms",
                window_ms(slow),
                window_ms(fast),
                design.celerity_min_m_s,
                1e3 * figures.window_s
            ),
        ),
        remark(
            "reflected wave",
            Nature::Misprint,
            "A_R e^{j(ωt - kx)}",
            "such a wave travels along with the incident one, and equation 3 does not follow from it; with A_R e^{j(ωt + kx)} it does",
        ),
    ]
}

/// The remarks on counts of modes: edges and dispersion.
fn counts(design: &Design) -> [Remark; 2] {
    [
        remark(
            "mode count",
            Nature::Model,
            "M = πS(f/c)² + Pf/2c",
            format!(
                "the sign + is that of free edges, and the sheet is glued to a frame; fixed edges take -, and somewhat more where a \
                 clamped sheet has stiffness, with {:.0} modes in the band",
                design.mode_count_weyl
            ),
        ),
        remark(
            "mode spacing",
            Nature::Model,
            "2c/(2Sk + P)",
            format!(
                "derived for a velocity that is the same at all frequencies; with dispersion and fixed edges it is 2c_g/(2Sk - P), and \
                 with the stiffness at the clamped rim {:.1} Hz at the top of the band",
                1.0 / design.heisenberg_time_top_s
            ),
        ),
    ]
}

/// The remarks on laws of contrast and their range.
fn laws(design: &Design, figures: &PaperFigures) -> [Remark; 2] {
    [
        remark(
            "contrast",
            Nature::Model,
            "∝ √(NT) as long as T < τ",
            format!(
                "here T must be far below the Heisenberg time as well, {:.0} ms on this film; around the window contrast varies \
                 as T^{:.2}",
                design.heisenberg_time_s * 1e3,
                design.window_exponent
            ),
        ),
        remark(
            "reverberation",
            Nature::Model,
            "τ of the order of T/N",
            format!(
                "advice for fast repetition; a single focus would have a contrast of {:.1} with T/N = {:.1} ms, and has {:.1} with the \
                 film's own decay time",
                figures.contrast_at_decay_time,
                figures.decay_time_s * 1e3,
                design.contrast_predicted
            ),
        ),
    ]
}

/// The remarks on the strip under a finger: impedances, and which power is meant.
fn finger(design: &Design) -> [Remark; 2] {
    let shortest = design.touch.first();
    let (strip, finger) =
        shortest.map_or((0.0, 0.0), |t| (t.impedance_n_s_per_m, t.finger_impedance_n_s_per_m));
    [
        remark(
            "impedances",
            Nature::Model,
            "Z_S larger than Z_F against muffling; best transmission at Z_F = Z_S",
            format!(
                "Z_F = Z_S is the match of a load at the end of a strip; by equation 3, a load with strip on both sides takes most \
                 power at Z_F = 2Z_S. The film is far from either: abs(Z_S) is {strip:.3} and abs(Z_F) {finger:.2} N·s/m at the \
                 shortest wavelength"
            ),
        ),
        remark(
            "power",
            Nature::Model,
            "P_I = c²k²Z_S A_I²",
            "the power at the crest of the wave, twice its mean over a period; powers here are crests too, to compare with table 1",
        ),
    ]
}

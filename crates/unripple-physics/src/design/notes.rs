//! Errors in the paper (Hudin et al. 2012) and the right values, for readers who compare.

use super::{Design, Note};
use unripple_core::Surface;

fn note(topic: &str, paper: &str, here: String) -> Note {
    Note { topic: topic.into(), paper: paper.into(), here }
}

/// Errors in the paper, with the right values for this surface.
pub(super) fn notes(surface: &Surface, design: &Design) -> Vec<Note> {
    let mut notes = Vec::new();
    if is_papers_film(surface) {
        notes.push(note(
            "tension",
            "30 N/m",
            format!(
                "{} N/m: 30 N/m would give 13 m/s and a first mode at 62 Hz, against the 34-43 m/s, 150 Hz and 2 N on a \
                 10 mm strip printed beside it",
                surface.sheet.tension
            ),
        ));
    }
    notes.extend(modal_notes(design));
    notes.extend(wave_notes(design));
    notes
}

/// Errors about counts of modes, windows and contrast.
fn modal_notes(design: &Design) -> [Note; 5] {
    [
        note(
            "mode count",
            "M = πS(f/c)² + Pf/2c for a sheet glued to a frame",
            format!(
                "+ is for free edges, fixed ones take -: {:.0} modes in the band",
                design.mode_count_weyl
            ),
        ),
        note(
            "mode spacing",
            "2c/(2Sk + P) with the phase velocity, then its least value",
            format!(
                "2c_g/(2Sk - P) with the group velocity: {:.3} modes per Hz at the top of the band",
                design.heisenberg_time_top_s
            ),
        ),
        note(
            "window",
            "(2Sk_max + P)/(2Nc_min) = 30 ms",
            format!("that formula gives {:.1} ms here", design.window_paper_s * 1e3),
        ),
        note(
            "contrast",
            "follows √(NT) as long as T < τ",
            format!(
                "only while T is far below the Heisenberg time ({:.0} ms); the exponent of T here is {:.2} around the window",
                design.heisenberg_time_s * 1e3,
                design.window_exponent
            ),
        ),
        note(
            "reverberation",
            "τ should be about T/N",
            format!(
                "T/N = {:.1} ms would leave a contrast of {:.1} where the surface's own decay gives {:.1}",
                design.decay_time_paper_s * 1e3,
                design.contrast_at_papers_decay,
                design.contrast_predicted
            ),
        ),
    ]
}

/// Errors about reflection, impedances and power.
fn wave_notes(design: &Design) -> [Note; 3] {
    let film = design.touch.last();
    let (strip, finger) = film.map_or((0.0, 0.0), |t| (t.impedance_n_s_per_m, t.finger_impedance_n_s_per_m));
    [
        note(
            "reflected wave",
            "A_R e^{j(ωt - kx)}",
            "it travels back, A_R e^{j(ωt + kx)}, or the strip has no reflection at all".into(),
        ),
        note(
            "impedances",
            "Z_S should be larger than Z_F; transmission is best at Z_F = Z_S",
            format!(
                "here abs(Z_S) is {strip:.3} and abs(Z_F) {finger:.2} N·s/m; a strip loaded at mid-span gives most power at Z_F = 2Z_S"
            ),
        ),
        note(
            "power",
            "P_I = c²k²Z_S A_I²",
            "that is its crest; the mean over a period is half, here as in table 1".into(),
        ),
    ]
}

/// Whether the sheet is the paper's film, under any tension.
fn is_papers_film(surface: &Surface) -> bool {
    let sheet = &surface.sheet;
    sheet.tension > 0.0
        && (sheet.young / 4e9 - 1.0).abs() < 1e-6
        && (sheet.thickness / 0.125e-3 - 1.0).abs() < 1e-6
}

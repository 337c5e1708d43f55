//! The design figures as text for people.

use super::digits::rounded;
use super::{Design, PaperFigures, Predicted, Touch, milliseconds};
use std::fmt::{Display, Formatter, Result};

impl Display for Design {
    /// Formats the design figures as text, one section per topic, in millimetres, milliseconds and hertz.
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        writeln!(
            f,
            "{} · {} actuators · {} to {} Hz",
            self.surface, self.actuators, self.band_hz[0], self.band_hz[1]
        )?;
        waves(self, f)?;
        super::lattice::text(&self.lattices, f)?;
        modes(self, f)?;
        contrast(self, f)?;
        repetition(self, f)?;
        deformation(self, f)?;
        touch(self, f)?;
        notes(self, f)?;
        self.paper.as_ref().map_or(Ok(()), |paper| remarks(paper, f))
    }
}

fn section(f: &mut Formatter<'_>, title: &str) -> Result {
    writeln!(f, "\n{title}")
}

/// A line of name, value and unit, the values in one column.
fn line(f: &mut Formatter<'_>, name: &str, value: &str) -> Result {
    writeln!(f, "  {name:<37}{value}")
}

fn waves(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Waves")?;
    let (low, top) = (d.celerity_min_m_s, d.celerity_max_m_s);
    line(f, "phase velocity over the band", &format!("{low:.2} to {top:.2} m/s"))?;
    if let Some(paper) = &d.paper {
        line(f, "at a wavelength of 15 mm", &format!("{:.2} m/s", paper.celerity_at_15mm_m_s))?;
    }
    line(f, "shortest wavelength", &format!("{:.2} mm", d.lambda_min_m * 1e3))?;
    if let Some(hz) = d.coincidence_hz {
        line(f, "coincidence with sound in air", &format!("{hz:.0} Hz"))?;
    }
    line(f, "spot, full width at half maximum", &format!("{:.1} mm", d.spot_diameter_m * 1e3))?;
    line(f, "pulse, full width at half maximum", &format!("{:.3} ms", d.pulse_duration_s * 1e3))?;
    writeln!(
        f,
        "  {:>8} {:>9} {:>9} {:>9} {:>11} {:>9}",
        "Hz", "λ mm", "c m/s", "c_g m/s", "spacing Hz", "τ ms"
    )?;
    for w in d.dispersion.iter().skip((d.dispersion.len() + 1) % 2).step_by(2) {
        let spacing = w.mode_spacing_hz.map_or("-".into(), |hz| format!("{hz:.1}"));
        writeln!(
            f,
            "  {:>8.0} {:>9.2} {:>9.2} {:>9.2} {:>11} {:>9.1}",
            w.frequency_hz,
            w.wavelength_m * 1e3,
            w.phase_celerity_m_s,
            w.group_celerity_m_s,
            spacing,
            w.decay_time_s * 1e3
        )?;
    }
    Ok(())
}

fn modes(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Modes")?;
    let exact = match (d.mode_count_exact, &d.mode_count_exact_reason) {
        (Some(count), _) => count.to_string(),
        (None, Some(reason)) => format!("unknown ({reason})"),
        (None, None) => "unknown".into(),
    };
    let loaded = d.with_actuators.as_ref();
    // With the actuators first: that is the surface which will be played.
    let both = |with: Option<String>, alone: String| match with {
        Some(with) => format!("{with} with the actuators on it, {alone} of the sheet alone"),
        None => alone,
    };
    line(f, "in the band, counted", &both(loaded.map(|l| l.mode_count.to_string()), exact))?;
    line(f, "in the band, by Weyl's law", &format!("{:.0}", d.mode_count_weyl))?;
    let hz = |hz: f64| format!("{hz:.1} Hz");
    line(f, "first", &both(loaded.map(|l| hz(l.first_mode_hz)), hz(d.first_mode_hz)))?;
    let top = d.heisenberg_time_top_s * 1e3;
    let mean = d.heisenberg_time_s * 1e3;
    line(f, "Heisenberg time", &format!("{mean:.0} ms over the band, {top:.0} ms at its top"))?;
    let ms = |s: f64| format!("{:.1} ms", s * 1e3);
    line(f, "decay time", &both(loaded.map(|l| ms(l.decay_time_s)), ms(d.decay_time_s)))
}

fn contrast(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Window and contrast")?;
    line(f, "window recommended", &d.window_text())?;
    if let Some(paper) = &d.paper {
        line(f, "window by the paper's formula", &format!("{:.1} ms", paper.window_s * 1e3))?;
    }
    let how = match d.contrast_from {
        Predicted::Modes => "from the modes with these actuators",
        Predicted::Statistics => "by statistics of the band",
    };
    let interval =
        d.contrast_interval.map(|[low, high]| format!("; nine targets in ten have {low:.1} to {high:.1}"));
    line(f, "contrast", &format!("{:.1}, {how}{}", d.contrast_predicted, interval.unwrap_or_default()))?;
    let (endless, plain) = (d.contrast_endless, d.contrast_plain);
    line(
        f,
        "at the best window",
        &format!("{endless:.1}; {plain:.1} by the plain form, at the recommended window"),
    )?;
    write!(f, "  {:>8}", "T ms \\ N")?;
    d.actuator_counts.iter().try_for_each(|n| write!(f, " {n:>7}"))?;
    writeln!(f)?;
    for row in &d.contrast_by_window {
        write!(f, "  {:>8}", rounded(row.window_s * 1e3, 3))?;
        row.contrast.iter().try_for_each(|c| write!(f, " {c:>7.1}"))?;
        writeln!(f)?;
    }
    writeln!(
        f,
        "  {:>8} {:>9} {:>7} {:>9} {:>9} {:>9}",
        "band Hz", "λ_min mm", "modes", "spot mm", "pulse ms", "contrast"
    )?;
    for row in &d.contrast_by_band {
        writeln!(
            f,
            "  {:>8.0} {:>9.2} {:>7.0} {:>9.1} {:>9.3} {:>9.1}",
            row.top_hz,
            row.lambda_min_m * 1e3,
            row.modes,
            row.spot_diameter_m * 1e3,
            row.pulse_duration_s * 1e3,
            row.contrast
        )?;
    }
    let noisy = |r: &super::ByNoise| format!("{:.1} at {}", r.contrast, r.noise_ratio);
    let noise: Vec<_> = d.contrast_by_noise.iter().map(noisy).collect();
    line(f, "with noise, relative to the signal", &noise.join(", "))
}

fn repetition(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Repetition")?;
    let mut columns = vec![(d.decay_time_s, &d.contrast_by_rate)];
    if let Some(paper) = &d.paper {
        let aim = paper.decay_time_s * 1e3;
        line(f, "reverberation the paper aims for", &format!("T/N = {aim:.1} ms"))?;
        columns.push((paper.decay_time_s, &paper.contrast_by_rate));
    }
    write!(f, "  {:>8}", "Hz")?;
    for (decay_time, _) in &columns {
        write!(f, " {:>18}", format!("contrast, {} ms", milliseconds(*decay_time)))?;
    }
    writeln!(f)?;
    for (i, row) in d.contrast_by_rate.iter().enumerate() {
        write!(f, "  {:>8.0}", row.rate_hz)?;
        let here = columns.iter().filter_map(|(_, rows)| rows.get(i));
        for row in here {
            write!(f, " {:>18.1}", row.contrast)?;
        }
        writeln!(f)?;
    }
    Ok(())
}

fn deformation(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Deformation at the shortest wavelength")?;
    writeln!(
        f,
        "  {:>8} {:>10} {:>10} {:>12} {:>10} {:>9}",
        "µm", "radius mm", "bending", "stretching", "strain", "of yield"
    )?;
    for row in &d.deformation.rows {
        let share = row.share_of_yield.map_or("-".into(), |s| format!("{:.1} %", s * 100.0));
        writeln!(
            f,
            "  {:>8.0} {:>10.1} {:>10.2e} {:>12.2e} {:>10.2e} {:>9}{}",
            row.amplitude_m * 1e6,
            row.bending_radius_m * 1e3,
            row.bending_strain,
            row.stretching_strain,
            row.strain,
            share,
            if row.linear { "" } else { "  past linear theory" }
        )?;
    }
    let thickness = d.deformation.linear_limit_thickness_m * 1e6;
    line(f, "linear theory up to (thickness)", &format!("{thickness:.0} µm"))?;
    if let Some(limit) = d.deformation.linear_limit_tension_m {
        line(f, "tension rises by a tenth at", &format!("{:.0} µm", limit * 1e6))?;
    }
    Ok(())
}

fn touch(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Power to move a finger by 10 µm")?;
    write!(
        f,
        "  {:<24} {:>7} {:>8} {:>8} {:>9} {:>8} {:>8}",
        "strip", "λ mm", "c m/s", "Hz", "Z_S", "Z_F", "P W"
    )?;
    let papers: &[Touch] = match &d.paper {
        Some(paper) => &paper.table1,
        None => &[],
    };
    writeln!(f, "{}", if papers.is_empty() { "" } else { "   printed" })?;
    for row in papers.iter().chain(&d.touch) {
        let printed = row.printed_power_w.map(|p| format!(" {p:>9}")).unwrap_or_default();
        writeln!(
            f,
            "  {:<24} {:>7.2} {:>8.1} {:>8.0} {:>9.4} {:>8.2} {:>8.3}{printed}",
            row.strip,
            row.wavelength_m * 1e3,
            row.celerity_m_s,
            row.frequency_hz,
            row.impedance_n_s_per_m,
            row.finger_impedance_n_s_per_m,
            row.power_w,
        )?;
    }
    Ok(())
}

fn notes(d: &Design, f: &mut Formatter<'_>) -> Result {
    section(f, "Notes")?;
    d.notes.iter().try_for_each(|note| writeln!(f, "  {}: {}", note.topic, note.text))
}

fn remarks(paper: &PaperFigures, f: &mut Formatter<'_>) -> Result {
    section(f, "Remarks on the paper, Hudin et al. (2012)")?;
    paper.remarks.iter().try_for_each(|remark| {
        let (topic, nature) = (&remark.topic, remark.nature.name());
        writeln!(f, "  {topic} ({nature}): printed {}; {}", remark.printed, remark.remark)
    })
}

//! Names of the options that set the fields of asks, for messages.

/// Fields whose option has another name.
const OTHERWISE: &[(&str, &str)] = &[
    ("top_hz", "--max-hz"),
    ("pitch_m", "--grid-mm"),
    ("points_m", "--at"),
    ("listen_m", "--listen-m"),
    ("peak_m", "--peak-um"),
    ("output", "-o"),
    ("name", "NAME"),
    ("points, shapes", "targets"),
    ("points", "--at"),
    ("shapes", "--shape"),
    ("waveforms", "--waveform"),
    ("instants_s", "--at-ms"),
    ("fingers_m", "--finger"),
    ("fingers_m without on", "--finger without --on"),
    ("judge_hz without on", "--judge-hz without --on"),
    ("bear_tension", "--bear-tension-percent"),
    ("bear_fingers_m", "--bear-finger"),
    ("input_scales", "--input-scale"),
    ("wires", "--wire"),
    ("drift", "--drift-percent"),
    ("range", "--within-percent"),
    ("changed", "--changed-percent"),
    ("changing_per_min", "--changing-percent-per-min"),
    ("speed_m_s", "--speed-mm-s"),
    ("level_m_s", "--level-mm-s"),
    ("within_m", "--within"),
    ("keep_out_m", "--keep-out"),
    ("keep_m", "--keep"),
    ("places_m", "--place"),
    ("actuator_names", "--actuator"),
    ("weights", "--at"),
    ("targets_within_m", "--screen"),
    ("share", "--share-percent"),
    ("tension", "--tension-percent"),
    ("stop_share", "--stop-percent"),
    ("plan", "PLAN"),
    ("error", "--error-percent"),
    ("recording", "RECORDING"),
    ("target_m", "--at"),
    ("instant_s", "--at-ms"),
    ("probes_m", "--probe-mm"),
    ("probe_count", "--probes"),
    ("swapped", "--swapped"),
    ("waveforms and path", "--waveform and --path"),
];

/// Fields, separated by spaces, that texts name in backticks, and whose option has their name: these names alone are replaced, since texts also
/// quote other words.
const ALIKE: &str = "window_s length_s duration_s period_s movie_s probe_delay_s sweep_s response_s rim_m apart_m mounting_m format losses \
    output_scale without any_wiring check_levels resample repeats level figure device tape tape_inputs by no_model even_if_doubtful unknowns \
    method tuio websocket listen screen real_time record keep_drive follow_tension no_ask table \
    probe_scale";

/// The option of a field that has another name than its field.
fn otherwise(field: &str) -> Option<&'static str> {
    OTHERWISE.iter().find(|(name, _)| *name == field).map(|(_, option)| *option)
}

/// The option that sets a field of a request; for fields separated by commas, the options of all.
pub fn option(field: &str) -> String {
    let one = |name: &str| otherwise(name).map_or_else(|| alike(name), str::to_owned);
    otherwise(field).map_or_else(|| field.split(", ").map(one).collect::<Vec<_>>().join(", "), str::to_owned)
}

/// The option with the name of its field: with hyphens, and in mm or ms where the field is in m or s.
fn alike(field: &str) -> String {
    let name = match field.strip_suffix("_m").or_else(|| field.strip_suffix("_s")) {
        Some(rest) => format!("{rest}_m{}", &field[rest.len() + 1..]),
        None => field.to_owned(),
    };
    format!("--{}", name.replace('_', "-"))
}

/// Replaces the names of fields in backticks by their options; other text in backticks stays.
pub fn spoken(text: &str) -> String {
    let mut spoken = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find('`') {
        let (before, quoted) = rest.split_at(start);
        spoken.push_str(before);
        let name = quoted[1..].split('`').next().unwrap_or_default();
        let known = (otherwise(name).is_some() || ALIKE.split(' ').any(|field| field == name))
            && quoted[1 + name.len()..].starts_with('`');
        rest = if known {
            spoken.push_str(&option(name));
            &quoted[name.len() + 2..]
        } else {
            spoken.push('`');
            &quoted[1..]
        };
    }
    spoken + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_said_as_options() {
        assert_eq!(option("peak_m"), "--peak-um");
        assert_eq!(option("full_limit"), "--full-limit");
        assert_eq!(option("window_s"), "--window-ms");
        assert_eq!(option("method robust"), "--method robust");
        assert_eq!(option("places_m, pitch_m, rim_m"), "--place, --grid-mm, --rim-mm");
        assert_eq!(option("points, shapes"), "targets");
        assert_eq!(option("author, organization"), "--author, --organization");
        assert_eq!(spoken("`rim_m` and `felt`"), "--rim-mm and `felt`");
        assert_eq!(spoken("`points_m` beside it, not `a1`"), "--at beside it, not `a1`");
        assert_eq!(spoken("a ` alone, then `without` a2"), "a ` alone, then --without a2");
        assert_eq!(spoken("`limit`, `"), "`limit`, `");
    }
}

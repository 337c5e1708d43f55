//! Names of the options that set the fields of asks, for messages.

/// Fields whose option is not merely `--` and the field's name with hyphens: other units, or other names.
const OTHERWISE: &[(&str, &str)] = &[
    ("top_hz", "--max-hz"),
    ("pitch_m", "--grid-mm"),
    ("points_m", "--at"),
    ("peak_m", "--peak-um"),
    ("window_s", "--window-ms"),
    ("length_s", "--length-ms"),
    ("output", "-o"),
    ("name", "NAME"),
    ("format", "--format"),
    ("points, shapes", "targets"),
    ("points", "--at"),
    ("shapes", "--shape"),
    ("waveforms", "--waveform"),
    ("instants_s", "--at-ms"),
    ("fingers_m", "--finger"),
    ("fingers_m without on", "--finger without --on"),
    ("judge_hz without on", "--judge-hz without --on"),
    ("method robust", "--method robust"),
    ("method felt", "--method felt"),
    ("losses uniform", "--losses uniform"),
    ("losses", "--losses"),
    ("bear_tension", "--bear-tension-percent"),
    ("bear_fingers_m", "--bear-finger"),
    ("duration_s", "--duration-ms"),
    ("period_s", "--period-ms"),
    ("movie_s", "--movie-ms"),
    ("probe_delay_s", "--probe-delay-ms"),
    ("sweep_s", "--sweep-ms"),
    ("response_s", "--response-ms"),
    ("input_scales", "--input-scale"),
    ("output_scale", "--output-scale"),
    ("input_scales, output_scale", "--input-scale, --output-scale"),
    ("wires", "--wire"),
    ("without", "--without"),
    ("any_wiring", "--any-wiring"),
    ("check_levels", "--check-levels"),
    ("resample", "--resample"),
    ("repeats", "--repeats"),
    ("level", "--level"),
    ("figure", "--figure"),
    ("device", "--device"),
    ("tape", "--tape"),
    ("tape_inputs", "--tape-inputs"),
    ("by", "--by"),
    ("no_model", "--no-model"),
    ("even_if_doubtful", "--even-if-doubtful"),
    ("unknowns", "--unknowns"),
    ("method", "--method"),
    ("tuio", "--tuio"),
    ("websocket", "--websocket"),
    ("listen", "--listen"),
    ("screen", "--screen"),
    ("real_time", "--real-time"),
    ("record", "--record"),
    ("keep_drive", "--keep-drive"),
    ("follow_tension", "--follow-tension"),
    ("drift", "--drift-percent"),
    ("range", "--within-percent"),
    ("changed", "--changed-percent"),
    ("changing_per_min", "--changing-percent-per-min"),
    ("speed_m_s", "--speed-mm-s"),
    ("level_m_s", "--level-mm-s"),
    ("rim_m", "--rim-mm"),
    ("within_m", "--within"),
    ("keep_out_m", "--keep-out"),
    ("places_m", "--place"),
    ("places_m, pitch_m, rim_m", "--place, --grid-mm, --rim-mm"),
    ("points_m, targets_within_m", "--at, --screen"),
    ("apart_m", "--apart-mm"),
    ("count, apart_m", "--count, --apart-mm"),
    ("weights", "--at"),
    ("targets_within_m", "--screen"),
    ("share", "--share-percent"),
    ("mounting_m", "--mounting-mm"),
    ("tension", "--tension-percent"),
    ("plan", "PLAN"),
    ("waveforms and path", "--waveform and --path"),
];

/// The option that sets a field of a request; for fields separated by commas, the options of all.
pub fn option(field: &str) -> String {
    let one = |name: &str| match OTHERWISE.iter().find(|(field, _)| *field == name) {
        Some((_, option)) => (*option).to_owned(),
        None => format!("--{}", name.replace('_', "-")),
    };
    if let Some((_, option)) = OTHERWISE.iter().find(|(known, _)| *known == field) {
        return (*option).to_owned();
    }
    field.split(", ").map(one).collect::<Vec<_>>().join(", ")
}

/// Replaces the names of fields in backticks by their options; other text in backticks stays.
pub fn spoken(text: &str) -> String {
    let mut spoken = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find('`') {
        let (before, quoted) = rest.split_at(start);
        spoken.push_str(before);
        let name = quoted[1..].split('`').next().unwrap_or_default();
        let known =
            OTHERWISE.iter().any(|(field, _)| *field == name) && quoted[1 + name.len()..].starts_with('`');
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
        assert_eq!(option("author, organization"), "--author, --organization");
        assert_eq!(spoken("`points_m` beside it, not `a1`"), "--at beside it, not `a1`");
        assert_eq!(spoken("a ` alone, then `without` a2"), "a ` alone, then --without a2");
        assert_eq!(spoken("`limit`, `"), "`limit`, `");
    }
}

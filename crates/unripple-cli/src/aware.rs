//! Drives made for a surface under fingers, and for others that it may turn into, as typed.

use crate::args::FocusOptions;
use crate::error::CliError;
use crate::fingers;
use unripple::act::Aware;
use unripple::core::Surface;

/// What a drive is made for, as the options say.
pub fn aware(options: &FocusOptions, surface: &Surface) -> Result<Aware, CliError> {
    if options.finger_aware && options.finger.is_empty() {
        return Err(CliError::Input("--finger-aware: expected --finger X,Y with it, found none".into()));
    }
    let resting = fingers::contacts(&options.finger, surface)?;
    let known = if options.finger_aware { resting.as_slice() } else { &[] };
    let tension = options.bear_tension_percent.map(|percent| percent / 100.0);
    if let (Some(share), Some(percent)) = (tension, options.bear_tension_percent)
        && !(share > 0.0 && share < 0.5)
    {
        return Err(CliError::Input(format!(
            "--bear-tension-percent: expected a number above 0 and below 50, found {percent}"
        )));
    }
    let more = fingers::contacts(&options.bear_finger, surface)?;
    Ok(Aware::of(surface, known, tension, &more)?)
}

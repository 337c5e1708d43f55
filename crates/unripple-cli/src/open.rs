//! What the options of a device say of it, for whoever opens one.

use crate::args::DeviceOptions;
use unripple::core::Surface;
use unripple_devices::{DevicesError, JackOptions, Links, Unknowns, Virtual, VirtualOptions};

/// A virtual surface, and what it was not told of if anything.
pub fn virtual_surface(
    options: &DeviceOptions,
    surface: &Surface,
    plain: &VirtualOptions,
) -> Result<(Virtual, Option<Unknowns>), DevicesError> {
    let Some(seed) = options.unknowns else {
        return Ok((Virtual::new(surface, plain)?, None));
    };
    let usual = Unknowns { seed, ..Unknowns::default() };
    let unknowns = Unknowns { snr_db: options.snr_db.unwrap_or(usual.snr_db), ..usual };
    let device = Virtual::of_truth(&unknowns.truth(surface)?, plain)?;
    Ok((device, Some(unknowns)))
}

/// Names of the actuators, which are those of their channels.
pub fn names(surface: &Surface) -> Vec<String> {
    surface.actuators.iter().map(|actuator| actuator.name.clone()).collect()
}

/// A sound server that plays all actuators and hears some channels.
pub fn jack(options: &DeviceOptions, surface: &Surface, inputs: Vec<String>) -> JackOptions {
    JackOptions {
        server: options.jack_server.clone(),
        inputs,
        outputs: names(surface),
        links: options.jack_client.clone().map_or(Links::System, Links::Client),
        full_scale: options.output_scale.unwrap_or(surface.emission.limit),
        freewheel: options.freewheel,
        ..JackOptions::default()
    }
}

/// A sound card, whose first channels are the actuators, and those that it hears.
#[cfg(feature = "cards")]
pub fn card(
    options: &DeviceOptions,
    surface: &Surface,
    inputs: Vec<String>,
) -> unripple_devices::cards::CardOptions {
    unripple_devices::cards::CardOptions {
        playback: options.card.clone(),
        capture: options.capture_card.clone(),
        inputs,
        outputs: names(surface),
        rate: surface.emission.rate,
        block: options.card_block,
        full_scale: options.output_scale.unwrap_or(surface.emission.limit),
        ..Default::default()
    }
}

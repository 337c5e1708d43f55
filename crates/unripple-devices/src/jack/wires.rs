//! Pairs of ports (source and destination) to connect after a client has joined a server.

use super::events::Side;
use super::library::Client;
use super::links::Links;
use super::options::JackOptions;
use crate::DevicesError;

/// Placeholder for the name of this client, which the server decides.
pub(super) const OWN: &str = "\u{1}";

/// Pairs of ports to connect: source and destination.
pub(super) fn wires(client: &Client, options: &JackOptions) -> Result<Vec<(String, String)>, DevicesError> {
    let (outputs, inputs) = (&options.outputs, &options.inputs);
    let (playback, capture) = match &options.links {
        Links::None => return Ok(Vec::new()),
        Links::System => {
            let fix = |what: &str| {
                format!(
                    "start the server on a card with more {what} channels, or name the ports of several (Links::Ports, \
                     Links::Client)"
                )
            };
            let playback = client.ports(Side::Playback, true);
            let capture = client.ports(Side::Capture, true);
            enough("playback ports", outputs.len(), playback.len(), fix("playback"))?;
            enough("capture ports", inputs.len(), capture.len(), fix("capture"))?;
            (playback, capture)
        }
        Links::Ports { playback, capture } => {
            let fix = || "name one port for each channel".to_owned();
            enough("named playback ports", outputs.len(), playback.len(), fix())?;
            enough("named capture ports", inputs.len(), capture.len(), fix())?;
            (playback.clone(), capture.clone())
        }
        Links::Client(other) => (
            outputs.iter().map(|name| format!("{other}:in_{name}")).collect(),
            inputs.iter().map(|name| format!("{other}:out_{name}")).collect(),
        ),
    };
    let known = [client.ports(Side::Playback, false), client.ports(Side::Capture, false)];
    let (wanted, theirs) = ([&playback[..outputs.len()], &capture[..inputs.len()]], ["playback", "capture"]);
    for ((wanted, known), side) in wanted.into_iter().zip(&known).zip(theirs) {
        if let Some(missing) = wanted.iter().find(|port| !known.contains(port)) {
            let what = format!("there is no {side} port `{missing}`");
            return Err(DevicesError::Jack { what, fix: format!("there are: {}", known.join(", ")) });
        }
    }
    let out = outputs.iter().zip(playback).map(|(name, to)| (format!("{OWN}:out_{name}"), to));
    let back = inputs.iter().zip(capture).map(|(name, from)| (from, format!("{OWN}:in_{name}")));
    Ok(out.chain(back).collect())
}

fn enough(what: &'static str, expected: usize, found: usize, fix: String) -> Result<(), DevicesError> {
    if found >= expected {
        return Ok(());
    }
    Err(DevicesError::Channels { device: "jack".into(), what, expected, found, fix })
}

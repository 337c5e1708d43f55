//! Live play of a surface: sources of touches, effects, player and device joined.

use crate::pinging::Pinging;
use crate::touch_input::TouchInput;
use crate::{
    Conductor, DriveCache, FocusWorker, Follower, Heartbeat, Listener, LiveError, LiveOptions, Percentiles,
    Stage, Timing,
};
use std::sync::Arc;
use unripple_calibrate::Ping;
use unripple_core::{Device, Surface};
use unripple_devices::Feeler;
use unripple_effects::{EffectSet, Effects};
use unripple_player::{PreparedDrive, player};
use unripple_touch::{Counts, Heard, Sources};

/// Longest block of the player when it plays through a sound server, in samples. A command waits for one block at
/// most, whatever the server's period becomes.
const LONGEST_BLOCK: usize = 64;

/// Shortest block, in samples: below it the player's fixed work of each block outweighs the rest.
const SHORTEST_BLOCK: usize = 16;

/// Live play of a surface: touches in, drives out.
///
/// [`Engine::step`] plays one block on the calling thread, so that the same touches give the same drive whatever the
/// device's clock. [`Engine::run`](crate::Engine::run) puts the player and the device on a thread of their own.
pub struct Engine {
    pub(crate) stage: Stage,
    pub(crate) heart: Heartbeat,
    pub(crate) touch_input: TouchInput,
    /// Samples that the player may compute in one step: the device's block, rounded up to whole blocks of the player.
    ahead: u64,
}

impl Engine {
    /// Combines a surface, the worker that computes its drives, a set of effects, the sources of touches and a device.
    ///
    /// # Errors
    /// [`LiveError::Unlike`] for a device of another rate or with other outputs than the surface has actuators;
    /// [`LiveError::Range`] or [`LiveError::Player`] for options out of range; [`LiveError::Effects`] for effects
    /// that do not suit the surface.
    pub fn new(
        surface: &Surface,
        maker: FocusWorker,
        set: &EffectSet,
        sources: Sources,
        device: Box<dyn Device>,
        options: &LiveOptions,
    ) -> Result<Self, LiveError> {
        let layout = device.layout().clone();
        fits(surface, &layout)?;
        let rate = surface.emission.rate;
        let effects = Effects::new(set, surface.outline.clone(), rate)?;
        let drives = DriveCache::new(maker, options.focus.limit, options.full);
        let block = match device.status().server {
            Some(_) => layout.block.clamp(SHORTEST_BLOCK, LONGEST_BLOCK),
            None => layout.block,
        };
        let (player, desk) = player(&options.player(surface, block)?)?;
        let window = options.focus.window;
        let time = Timing { rate, window, block };
        let conductor = Conductor::new(effects, drives, desk, time, options.waves);
        let stage = Stage {
            conductor,
            feeler: None,
            follower: None,
            drift: None,
            pinging: None,
            listener: None,
            rate,
            block: layout.block,
            heard: Heard::default(),
            fingers: Vec::new(),
            counts: Counts::default(),
            computing: Percentiles::default(),
            clock: 0,
        };
        let touch_input = TouchInput::new(sources, options.predict, window);
        let ahead = layout.block.next_multiple_of(block) as u64;
        Ok(Self { stage, heart: Heartbeat::new(player, block, device), touch_input, ahead })
    }

    /// This engine, with fingers pressed on a virtual surface, so that what they feel is computed.
    pub fn with_feeler(mut self, feeler: Feeler) -> Self {
        self.stage.feeler = Some(feeler);
        self
    }

    /// This engine with a follower of the sheet's tension. The ping, its test signal, is sent once per period of
    /// observation, while no finger is on the surface.
    ///
    /// # Errors
    /// [`LiveError::Player`] for a ping that cannot be played.
    pub fn with_follower(mut self, follower: Follower, ping: &Ping) -> Result<Self, LiveError> {
        let samples = ping.drive.iter().flatten().map(|x| *x as f32).collect();
        let prepared = PreparedDrive::new(ping.drive.len(), samples)?;
        self.stage.pinging = Some(Pinging::new(Arc::new(prepared), follower.period() as u64));
        self.stage.follower = Some(follower);
        Ok(self)
    }

    /// This engine with a function that is called with all touches and requests as they arrive.
    pub fn with_listener(mut self, listener: Listener) -> Self {
        self.stage.listener = Some(listener);
        self
    }

    /// Plays one block on this thread: touches, cues, drives, the player, the device, in this order.
    ///
    /// # Errors
    /// Those of the device; [`LiveError::Gone`] if the thread that computes drives is gone.
    pub fn step(&mut self) -> Result<(), LiveError> {
        let stage = &mut self.stage;
        let batch = self.touch_input.poll(stage.time());
        stage.take(batch)?;
        stage.conduct(stage.clock, stage.clock + self.ahead)?;
        self.heart.beat()?;
        stage.clock = stage.conductor.desk().clock();
        stage.follow(self.heart.drive(), self.heart.heard())
    }

    /// The part of the engine outside the audio thread.
    pub fn stage(&mut self) -> &mut Stage {
        &mut self.stage
    }

    /// The part of the engine on the audio thread: player and device.
    pub fn heart(&self) -> &Heartbeat {
        &self.heart
    }
}

fn fits(surface: &Surface, layout: &unripple_core::Layout) -> Result<(), LiveError> {
    let device = layout.device.clone();
    let rate = surface.emission.rate;
    if layout.rate != rate {
        let (expected, found) = (format!("{rate} samples per second"), layout.rate.to_string());
        return Err(LiveError::Unlike { device, expected, found });
    }
    let names: Vec<&str> = surface.actuators.iter().map(|actuator| actuator.name.as_str()).collect();
    if layout.outputs != names {
        let (expected, found) = (format!("outputs {}", names.join(", ")), layout.outputs.join(", "));
        return Err(LiveError::Unlike { device, expected, found });
    }
    Ok(())
}

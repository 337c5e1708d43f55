//! Messages of the simulation to pages.

use super::{PACED, Simulation};
use crate::outbox::Outbox;
use crate::wire::Resting;
use serde::Serialize;
use serde_json::{Value, json};
use unripple_calibrate::Drift;
use unripple_devices::Feeling;

/// Time over which the drive's peak and rms are taken, in s.
const LOOKED: f64 = 0.2;

/// A finger, and what it feels.
#[derive(Serialize)]
struct Feels {
    #[serde(flatten)]
    resting: Resting,
    level_db: Option<f64>,
    contrast: Option<f64>,
}

impl Simulation {
    /// Sends a message on the state of the surface.
    pub(super) fn tell(&mut self, out: &mut Outbox) {
        let fingers = std::mem::take(&mut self.known.fingers);
        self.known = self.instrument.playback.look();
        self.known.fingers = fingers;
        self.take_pace();
        let (tail, _) = self.remembered();
        let head = self.replay.as_ref().map_or(self.transport.now, |replay| replay.to());
        let (peak, rms) = self.instrument.tape.newest((LOOKED * self.instrument.rate()) as usize);
        let tally = &self.known.tally;
        let wrong = self.wrong.as_ref().or(self.known.wrong.as_ref());
        let feels: Vec<Feels> = self.fingers().into_iter().map(|resting| self.feels(resting)).collect();
        let status = json!({
            "is": "status",
            "clock_s": self.head(),
            "head_s": head,
            "shown_s": self.transport.shown(),
            "tail_s": tail,
            "speed_real": self.pace.2,
            "live": self.transport.back.is_none(),
            "viewers": self.viewers,
            "frames": self.frame,
            "fingers": feels,
            "drive_peak": peak,
            "rms": rms,
            "tally": { "started": tally.started, "limited": tally.limited, "lost": self.known.lost, "failed": tally.failed,
                "failure": tally.failure },
            "state": wrong.map_or("running", String::as_str),
            "drift": self.known.drift.as_ref().map(drift),
        });
        out.tell("status", &status);
        self.untold = 0.0;
    }

    fn feels(&self, resting: Resting) -> Feels {
        let here = |feeling: &&Feeling| feeling.finger == resting.id;
        let feeling = self.known.feelings.iter().find(here);
        let (level_db, contrast) = feeling.map_or((None, None), |f| (f.level_db, f.contrast));
        Feels { resting, level_db, contrast }
    }

    /// How fast the surface runs beside the clock on the wall.
    fn take_pace(&mut self) {
        let (seconds, clock, _) = self.pace;
        if seconds >= PACED {
            let now = self.transport.now;
            self.pace = (0.0, now, (now - clock) / seconds);
        }
    }

    /// Sends all messages that depend on the clock, at once, after another clock has begun: pages must not take what they know of the
    /// earlier clock for the new one, nor see one of its pictures.
    pub(super) fn tell_anew(&mut self, out: &mut Outbox) {
        for pane in ["frame 0", "frame 1"] {
            out.withdraw(pane);
        }
        self.first = self.frame + 1;
        self.known.fingers.clear();
        self.tell(out);
        self.tell_transport(out);
    }

    /// Sends a message on how time passes and which places are followed.
    pub(super) fn tell_transport(&mut self, out: &mut Outbox) {
        let probe =
            |probe: &super::Probe| json!({ "id": probe.id, "at_mm": [probe.at.x * 1e3, probe.at.y * 1e3] });
        let transport = json!({
            "is": "transport",
            "speed": self.transport.speed,
            "paused": self.transport.paused,
            "quantity": if self.velocity { "velocity" } else { "displacement" },
            "gain_db": self.gain_db,
            "probes": self.probes.iter().map(probe).collect::<Vec<_>>(),
        });
        out.tell("transport", &transport);
        self.changed = true;
    }
}

fn drift(drift: &Drift) -> Value {
    json!({ "tension": drift.tension(), "explained": !drift.needs_calibration() })
}

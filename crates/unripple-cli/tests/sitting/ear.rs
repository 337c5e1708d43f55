//! A client of the JACK server that hears what the program sends.

use std::time::{Duration, Instant};
use unripple_core::Device;
use unripple_devices::{Jack, JackOptions, Links};

/// How long it must be silent, in s of heard samples: four times the longest pause between two pulses, which is that of the viewer.
const QUIET: f64 = 0.4;

/// How long a finger may be there and nothing be heard before the ports are looked for again: they may be those of a client that has gone.
/// Many times what the first pulse takes.
const DEAF: Duration = Duration::from_secs(3);

/// How long to wait before the ports are looked for again. Each time a client joins the server, and leaves it.
const AGAIN: Duration = Duration::from_millis(200);

/// What is waited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    Sound,
    Silence,
}

/// Ears at the program's ports, while they are needed.
pub struct Ear {
    server: String,
    device: Option<Jack>,
}

impl Ear {
    pub fn new(server: &str) -> Self {
        Self { server: server.to_owned(), device: None }
    }

    fn join(&self, links: Links) -> Result<Jack, String> {
        let options = JackOptions {
            client: "ear".into(),
            server: Some(self.server.clone()),
            inputs: vec!["a1".into(), "a2".into()],
            links,
            ..JackOptions::default()
        };
        Jack::open(&options).map_err(|error| error.to_string())
    }

    /// Waits until the server answers.
    pub fn wait_for_server(&self, deadline: Instant) {
        while let Err(why) = self.join(Links::None) {
            assert!(Instant::now() < deadline, "the server does not answer: {why}");
            std::thread::sleep(AGAIN);
        }
    }

    /// Leaves the server, until something is to be heard again.
    pub fn leave(&mut self) {
        self.device = None;
    }

    /// Hears one block: how long it is, in s, and whether it sounds.
    fn block(&mut self) -> Result<(f64, bool), String> {
        let mut device = match self.device.take() {
            Some(device) => device,
            None => self.join(Links::Client("unripple".into()))?,
        };
        let layout = device.layout();
        let seconds = layout.block as f64 / layout.rate;
        let mut heard = vec![0.0; layout.block * layout.inputs.len()];
        device.exchange(&[], &mut heard).map_err(|error| error.to_string())?;
        self.device = Some(device);
        Ok((seconds, heard.iter().any(|x| *x != 0.0)))
    }

    /// Listens until there is what is wanted, and calls `act` before each block; the error is what was there instead at last.
    pub fn until(&mut self, wanted: Wanted, deadline: Instant, act: &mut dyn FnMut()) -> Result<(), String> {
        let (mut quiet, mut why, mut since) = (0.0, String::new(), Instant::now());
        while Instant::now() < deadline {
            act();
            match self.block() {
                Ok((_, true)) if wanted == Wanted::Sound => return Ok(()),
                Ok((_, true)) => (quiet, why) = (0.0, "it sounds".to_owned()),
                Ok((seconds, false)) => {
                    quiet += seconds;
                    if wanted == Wanted::Silence && quiet >= QUIET {
                        return Ok(());
                    }
                    if since.elapsed() > DEAF {
                        (self.device, since, why) = (None, Instant::now(), "it is silent".to_owned());
                    }
                }
                Err(error) => {
                    (quiet, why) = (0.0, error);
                    std::thread::sleep(AGAIN);
                    since = Instant::now();
                }
            }
        }
        Err(why)
    }
}

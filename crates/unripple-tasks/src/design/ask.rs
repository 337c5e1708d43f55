//! Options of the task `design`.

use crate::SurfaceAsk;
use crate::record::Request;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The surface whose design tradeoffs are to be computed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
}

impl Request for Ask {
    const COMMAND: &'static str = "design";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        vec![&mut self.surface]
    }

    fn send_to(&mut self, _output: Option<PathBuf>) {}
}

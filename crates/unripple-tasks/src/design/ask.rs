//! Options of the task `design`.

use crate::SurfaceAsk;
use serde::{Deserialize, Serialize};

/// The surface whose tradeoffs are wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
}

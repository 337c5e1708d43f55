//! Options of the task `check`.

use crate::SurfaceAsk;
use serde::{Deserialize, Serialize};

/// Which surface file is to be checked.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, or the name of a built-in surface.
    pub surface: SurfaceAsk,
}

//! The tasks of the worker, and the requests of pages that they answer.

use crate::edition::Edition;
use crate::wire::Measure;
use std::sync::Arc;

/// A computation that a page requests. A focus is computed for the surface that the page showed, even if it
/// has been edited since.
pub enum Task {
    /// The design figures of a surface.
    Design(Arc<Edition>),
    /// A focus, computed and evaluated with all figures.
    Measure {
        /// Targets, method and level.
        measure: Measure,
        /// The surface that the page showed.
        of: Arc<Edition>,
        /// Number of the page that requests it.
        page: u64,
    },
    /// A comparison of two focusing methods on the same targets.
    Compare {
        /// The page's own number for the request.
        id: u64,
        /// Places of the targets, in mm.
        at: Vec<[f64; 2]>,
        /// Names of the two methods.
        methods: Vec<String>,
        /// The window, in ms; 0 or `None` for the recommended one.
        window_ms: Option<f64>,
        /// The surface that the page showed.
        of: Arc<Edition>,
        /// Number of the page that requests it.
        page: u64,
    },
}

/// Kinds of computations that a page requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A focus with all figures.
    Measure,
    /// A comparison of two methods, side by side.
    Compare,
}

/// A request of a page for a computation; the page gets the result of the task as its answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Asked {
    /// Number of the page that requests it.
    pub page: u64,
    /// The page's own number for the request.
    pub id: u64,
    /// Kind of the computation.
    pub kind: Kind,
}

impl Task {
    /// The request of a page for which the task is computed; `None` for design figures, which are computed
    /// after every edit without a request.
    pub fn asked(&self) -> Option<Asked> {
        match self {
            Self::Design(_) => None,
            Self::Measure { measure, page, .. } => {
                Some(Asked { page: *page, id: measure.id, kind: Kind::Measure })
            }
            Self::Compare { id, page, .. } => Some(Asked { page: *page, id: *id, kind: Kind::Compare }),
        }
    }
}

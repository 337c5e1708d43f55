//! Options of the task `compare`.

use crate::record::{Request, Visit};
use crate::target::{LevelAsk, PointAsk, ShapeAsk};
use crate::{SurfaceAsk, TaskError, names};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use unripple::focus::Method;

/// Request to compare focusing methods: targets, level, methods and surfaces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Ask {
    /// A surface file, the name of a built-in surface, or a library of responses.
    pub surface: SurfaceAsk,
    /// Further surfaces or libraries, on which the methods are compared too.
    pub others: Vec<SurfaceAsk>,
    /// Names of all surfaces in the report, one for each; by default the names in their files.
    pub labels: Vec<String>,
    /// Methods to be compared with time reversal; by default every method if there is one surface, only `concentrate` if there are several.
    #[serde(with = "names::methods")]
    pub methods: Vec<Method>,
    /// Points to be in focus.
    pub points: Vec<PointAsk>,
    /// Shapes to be in focus.
    pub shapes: Vec<ShapeAsk>,
    /// Level to which each drive is scaled.
    pub level: LevelAsk,
    /// Window T in s; by default the one that `design` recommends for each surface.
    pub window_s: Option<f64>,
    /// Evaluate drives on modes up to this frequency, in Hz; by default up to twice the top of the band.
    pub judge_hz: Option<f64>,
    /// Height above the middle of the surface, in m, at which the sound pressure level is computed; by default
    /// 0.3.
    pub listen_m: Option<f64>,
    /// Leave out the tradeoff curves of the methods' parameters, which take half of the time, and the
    /// figure that shows them. On several surfaces the curves are always left out, and the figure shows the
    /// methods alone.
    pub no_tradeoffs: bool,
    /// Write no figure.
    pub no_figures: bool,
    /// Width of the figure in columns of a printed page: 1 (86 mm) or 2 (178 mm); by default 2.
    pub columns: Option<usize>,
    /// Folder for the report and figure; by default no file is written.
    pub output: Option<PathBuf>,
}

/// Methods that are compared on several surfaces by default: time reversal as the reference, and the method
/// with the most contrast. A table of all methods on all surfaces would be too long to read.
const ON_SEVERAL: [Method; 2] = [Method::TimeReversal, Method::Concentrate];

impl Ask {
    /// All surfaces, in the order of the report.
    pub(super) fn all(&self) -> impl Iterator<Item = &SurfaceAsk> {
        std::iter::once(&self.surface).chain(&self.others)
    }

    /// The methods in the order of the report: time reversal, to which the others are related, and the
    /// requested ones.
    pub(super) fn chosen(&self) -> impl Iterator<Item = Method> {
        let asked: &[Method] = match (self.methods.as_slice(), self.others.as_slice()) {
            ([], []) => &Method::ALL,
            ([], _) => &ON_SEVERAL,
            (asked, _) => asked,
        };
        let among = move |method: &Method| *method == Method::TimeReversal || asked.contains(method);
        Method::ALL.into_iter().filter(among)
    }
}

impl Request for Ask {
    const COMMAND: &'static str = "compare";

    fn surfaces(&mut self) -> Vec<&mut SurfaceAsk> {
        std::iter::once(&mut self.surface).chain(&mut self.others).collect()
    }

    fn inputs(&mut self, visit: &mut Visit<'_>) -> Result<(), TaskError> {
        self.shapes.iter_mut().filter_map(ShapeAsk::file).try_for_each(visit)
    }

    fn send_to(&mut self, output: Option<PathBuf>) {
        self.output = output;
    }
}

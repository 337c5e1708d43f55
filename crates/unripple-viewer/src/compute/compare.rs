//! Comparison of two focusing methods on the same targets, side by side.

use super::{ComputeWorker, Found, Hear, method, options, places, tell, text};
use crate::edition::Edition;
use crate::simulation::Replay;
use serde_json::json;
use std::sync::Arc;
use unripple::act::{Act, Level, Readouts};
use unripple::core::{Drive, Point};
use unripple::focus::{Method, Target};
use unripple::physics::Modes;

impl ComputeWorker {
    /// Evaluates two methods on the same targets, each brought to the same peak, and sends both to be shown side by
    /// side.
    pub(super) fn compare(
        &mut self,
        at: &[[f64; 2]],
        methods: &[String],
        window: Option<f64>,
        of: &Edition,
        hear: &mut Hear,
    ) -> Result<(), String> {
        let methods = methods.iter().map(|name| method(name)).collect::<Result<Vec<Method>, String>>()?;
        let places = places(at);
        let (surface, responses) = (&of.surface, self.known(of, &places)?);
        let (window, _) = self.window(of, &responses, window);
        let targets: Vec<Target> = places.into_iter().map(Target::at).collect();
        let (mut drives, mut panes): (Vec<Drive>, Vec<_>) = (Vec::new(), Vec::new());
        let (mut focus, mut used) = (0.0, Vec::<Point>::new());
        let on = Readouts::of(&responses);
        for method in methods {
            let options = options(surface, method, window);
            let level = if self.unscaled(of).is_some() { Level::Limit } else { Level::default() };
            let act = Act { surface, responses: &responses, targets: &targets, options: &options, level };
            let acted = act.run_on(&on).map_err(text)?;
            focus = acted.focused.instant();
            used = acted.focused.points.iter().flatten().copied().collect();
            panes.push(
                json!({ "method": method.name(), "report": self.known_of(acted.report(surface, &options), of), "focus_s": focus }),
            );
            drives.push(acted.drive);
        }
        let top = surface.emission.band[1];
        let modes =
            Modes::solve(surface, top, unripple::act::accuracy(surface)).map_err(|e| e.to_string())?;
        let replay = Replay::record(surface, Arc::new(modes), &drives, focus, &used);
        let replay = replay.map_err(|error| error.to_string())?;
        let message = json!({
            "is": "compare",
            "edit": of.edit,
            "panes": panes,
            "from_s": replay.from(),
            "to_s": replay.to(),
            "focus_s": replay.focus(),
        });
        tell(hear, "compare", &message);
        hear(Found::Replay(Box::new(replay)));
        Ok(())
    }
}

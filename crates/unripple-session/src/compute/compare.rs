//! Comparison of two focusing methods on the same targets, side by side.

use super::{ComputeWorker, Found, Hear, Unfinished, method, options, places, tell};
use crate::edition::Edition;
use crate::simulation::Replay;
use serde_json::{Value, json};
use std::sync::Arc;
use unripple::act::{Act, Judging, Level, Readouts, accuracy};
use unripple::core::{Drive, Point, Responses};
use unripple::focus::{Method, Target};
use unripple::physics::Modes;
use unripple_tasks::{Progress, TaskError, go_on};

impl ComputeWorker {
    /// Evaluates two methods on the same targets, each brought to the same peak, and sends both to be shown side by
    /// side, as the answer to the request of number `id`.
    pub(super) fn compare(
        &mut self,
        at: &[[f64; 2]],
        methods: &[String],
        window: Option<f64>,
        (of, id): (&Arc<Edition>, u64),
        progress: &mut dyn Progress,
        hear: &mut Hear,
    ) -> Result<(), Unfinished> {
        let methods = methods.iter().map(|name| method(name)).collect::<Result<Vec<Method>, String>>()?;
        let places = places(at);
        let responses = self.known(of, &places, progress)?;
        let (window, _) = self.window(of, &responses, window, progress)?;
        let pair = Pair {
            of: of.clone(),
            responses,
            judged: self.judged(of, progress)?,
            targets: places.into_iter().map(Target::at).collect(),
            methods,
            window,
            unscaled: self.unscaled(of).is_some(),
        };
        let (panes, replay) = self.aside(progress, move |progress| pair.run(progress))?;
        let message = json!({
            "is": "compare",
            "id": id,
            "edit": of.edit,
            "panes": panes,
            "from_s": replay.from(),
            "to_s": replay.to(),
            "focus_s": replay.focus(),
            "dropped_s": replay.dropped(),
        });
        tell(hear, "compare", &message);
        hear(Found::Replay(Box::new(replay)));
        Ok(())
    }
}

/// Two methods to be compared, and what they are compared on.
struct Pair {
    of: Arc<Edition>,
    responses: Arc<Responses>,
    /// What drives are evaluated on, where that is something else than these responses.
    judged: Option<(Arc<Responses>, Judging)>,
    targets: Vec<Target>,
    methods: Vec<Method>,
    window: f64,
    unscaled: bool,
}

impl Pair {
    /// Computes the drive of each method; what pages are told of each, and the motion of the surface under both.
    fn run(&self, progress: &dyn Progress) -> Result<(Vec<Value>, Replay), TaskError> {
        let surface = &self.of.surface;
        let (mut drives, mut panes): (Vec<Drive>, Vec<_>) = (Vec::new(), Vec::new());
        let (mut focus, mut used) = (0.0, Vec::<Point>::new());
        let responses = self.judged.as_ref().map_or(&self.responses, |(judged, _)| judged);
        let on = Readouts::of(responses);
        for method in &self.methods {
            go_on(progress)?;
            let options = options(surface, *method, self.window);
            let level = if self.unscaled { Level::Limit } else { Level::default() };
            let act = Act { surface, responses, targets: &self.targets, options: &options, level };
            let acted = act.run_from(&self.responses, &on).map_err(TaskError::work)?;
            let report = acted.report(surface, &options);
            let mut report = if self.unscaled { report.without_scale() } else { report };
            self.judged.iter().for_each(|(_, judging)| judging.tell(surface, &mut report));
            focus = acted.focused.instant();
            used = acted.focused.points.iter().flatten().copied().collect();
            panes.push(json!({ "method": method.name(), "report": report, "focus_s": focus }));
            drives.push(acted.drive);
        }
        go_on(progress)?;
        let modes = Modes::solve(surface, surface.emission.band[1], accuracy(surface));
        let modes = Arc::new(modes.map_err(TaskError::work)?);
        let replay = Replay::record(surface, modes, &drives, focus, &used, progress)?;
        Ok((panes, replay))
    }
}

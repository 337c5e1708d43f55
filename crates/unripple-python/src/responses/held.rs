//! Responses that are kept for many tasks, and the tasks that are done on them.

use super::array::{self, Given};
use crate::commands::Done;
use crate::field::Seen;
use crate::focused::{Draw, Outcome};
use std::path::Path;
use std::sync::Arc;
use unripple::calibrate::Interpolation;
use unripple::core::{Drive, ModalResponses, Point, Responses, SampledResponses, Surface, window_samples};
use unripple::physics::sample;
use unripple_store::Library;
use unripple_tasks::field::DriveAsk;
use unripple_tasks::figures::Columns;
use unripple_tasks::record::Request;
use unripple_tasks::respond::MOST_VALUES;
use unripple_tasks::{
    Place, Progress, Record, Report, Solved, Source, SurfaceAsk, TaskError, between, field, fingers, focus,
    go_on, point, source, stroke, waveform,
};

/// Responses, and what they are of.
pub(super) struct Held {
    source: Source,
    responses: Responses,
    origin: Origin,
}

/// Where responses come from.
enum Origin {
    /// From the modes of a surface, as asks name it.
    Surface {
        named: SurfaceAsk,
        /// Highest frequency of the modes, in Hz, where that was given.
        max_hz: Option<f64>,
        /// Fingers that rest on the surface, in m.
        fingers: Vec<Place>,
    },
    /// From a library.
    Library {
        /// The path of its folder as it was given, which reports name.
        name: String,
        /// The same from the root, by which the library is found after the current folder has changed.
        path: String,
    },
    /// From an array; whether its surface is made up.
    Array { made_up: bool },
}

impl Held {
    /// The responses of a surface with fingers at some places (m), from modes up to `max_hz` (Hz) or those of its band; requests name the
    /// surface as `named`.
    pub fn of_surface(
        surface: &Surface,
        named: SurfaceAsk,
        (max_hz, fingers): (Option<f64>, Vec<Place>),
        progress: &mut dyn Progress,
    ) -> Result<Self, TaskError> {
        let contacts = fingers::contacts(&fingers, "fingers_m", surface)?;
        go_on(progress)?;
        progress.stage("responses");
        let solved = Solved::default();
        let responses = solved.model(surface, max_hz, &contacts)?;
        go_on(progress)?;
        let source = Source::computed(surface.clone(), responses.clone()).with(&solved);
        Ok(Self { source, responses, origin: Origin::Surface { named, max_hz, fingers } })
    }

    /// The responses of a library, by its folder.
    pub fn open(path: &Path, progress: &mut dyn Progress) -> Result<Self, TaskError> {
        let name = path.display().to_string();
        if !Library::is_at(path) {
            return Err(TaskError::Input(format!("{name}: expected a library of responses, found none")));
        }
        let whole =
            std::path::absolute(path).map_err(|error| TaskError::Input(format!("{name}: {error}")))?;
        let source = source::open(&SurfaceAsk::Name(name.clone()), progress)?;
        go_on(progress)?;
        Self::sampled(source, Origin::Library { name, path: whole.display().to_string() })
    }

    /// The responses of an array.
    pub fn of_array(given: Given) -> Result<Self, TaskError> {
        let made_up = given.surface.is_none();
        Self::sampled(given.source()?, Origin::Array { made_up })
    }

    fn sampled(source: Source, origin: Origin) -> Result<Self, TaskError> {
        let stored = source.stored.as_ref().map(|stored| Responses::Sampled(stored.responses.clone()));
        let none = || TaskError::Work("expected stored responses, found none".into());
        Ok(Self { responses: stored.ok_or_else(none)?, source, origin })
    }

    /// The surface that the responses are of.
    pub fn surface(&self) -> &Surface {
        &self.source.surface
    }

    /// The responses themselves.
    pub fn responses(&self) -> &Responses {
        &self.responses
    }

    /// The responses, if they are modal.
    pub fn modal(&self) -> Option<&ModalResponses> {
        match &self.responses {
            Responses::Modal(modal) => Some(modal),
            Responses::Sampled(_) => None,
        }
    }

    /// The responses, if they are sampled.
    pub fn stored(&self) -> Option<&SampledResponses> {
        match &self.responses {
            Responses::Modal(_) => None,
            Responses::Sampled(stored) => Some(stored),
        }
    }

    /// Where the responses come from, for people.
    pub fn told(&self) -> &str {
        match &self.origin {
            Origin::Surface { .. } => &self.source.surface.name,
            Origin::Library { name, .. } => name,
            Origin::Array { .. } => "array",
        }
    }

    /// Responses of some length (s) at some places (m), by interpolation where they are sampled.
    pub fn impulse(&self, places: &[Point], length: f64) -> Result<SampledResponses, TaskError> {
        let outline = &self.responses.conditions().outline;
        if let Some(beyond) = places.iter().find(|place| !outline.contains(**place)) {
            let found = format!("{beyond}, beyond its rim (nearest: {})", outline.nearest(*beyond));
            return Err(TaskError::ask("points_m", "places on the surface", found));
        }
        let samples = self.samples(places.len(), length)?;
        match &self.responses {
            Responses::Modal(modal) => Ok(sample(modal, places, samples)),
            Responses::Sampled(stored) => self.interpolated(stored, places, samples),
        }
    }

    /// Number of samples in responses of some length (s), at so many places; refuses more than memory is to hold.
    fn samples(&self, places: usize, length: f64) -> Result<usize, TaskError> {
        let (rate, found) = (self.responses.conditions().rate, format!("{length} s"));
        if !(length.is_finite() && length > 0.0) {
            return Err(TaskError::ask("length_s", "a number above 0 s", found));
        }
        let rows = places.saturating_mul(self.responses.ports().len()).max(1);
        let most = match &self.responses {
            Responses::Modal(modal) => MOST_VALUES / rows.max(modal.poles.len()),
            Responses::Sampled(stored) => stored.samples().min(MOST_VALUES / rows),
        };
        // As real numbers, since no integer holds every length.
        if (length * rate).round() >= most as f64 {
            let longest = most.saturating_sub(1) as f64 / rate;
            return Err(TaskError::ask(
                "length_s",
                format!("at most {longest} s, for {places} places"),
                found,
            ));
        }
        Ok(window_samples(length, rate) + 1)
    }

    /// Sampled responses at some places (m), cut to so many samples. Interpolation copies the stored ones.
    fn interpolated(
        &self,
        stored: &SampledResponses,
        places: &[Point],
        samples: usize,
    ) -> Result<SampledResponses, TaskError> {
        if self.is_made_up()
            && let Some(place) = array::elsewhere(stored, places)
        {
            let expected = "points of the array, since nobody knows its waves between them without a surface";
            return Err(TaskError::ask("points_m", expected, place));
        }
        let way = Interpolation::default();
        let (all, _) = between::completed(stored.clone(), self.surface(), places, way)?;
        let mut data = Vec::with_capacity(places.len() * all.ports.len() * samples);
        // Every place is one of the points now.
        for point in places.iter().filter_map(|place| all.nearest(*place)) {
            for actuator in 0..all.ports.len() {
                data.extend_from_slice(&all.response(actuator, point)[..samples]);
            }
        }
        let SampledResponses { ports, conditions, .. } = all;
        SampledResponses::new(ports, places.to_vec(), conditions, samples, data).map_err(TaskError::work)
    }

    /// Computes a drive that focuses, from these responses, and evaluates it.
    pub fn focus(&self, mut ask: focus::Ask, progress: &mut dyn Progress) -> Result<Outcome, TaskError> {
        let columns = columns(ask.no_figures, ask.columns, ask.output.as_deref())?;
        self.name(&mut ask.surface);
        self.touch(&mut ask.fingers_m);
        let record = self.record(&ask)?;
        let mut source = self.source.clone();
        let made_up = self.is_made_up();
        if made_up {
            array::choose(&mut ask, &mut source)?;
        }
        let mut made = focus::make_on(&ask, source, progress)?;
        if made_up && ask.on.is_none() {
            array::forget(&mut made.report);
        }
        let (done, drive) = (Done::of(&made.report, record.as_ref())?, made.drive.clone());
        Ok(Outcome { done, drive, draw: draw(Arc::new(made), columns, focus::figures) })
    }

    /// Computes a drive by which targets follow waveforms on the surface, and evaluates it.
    pub fn waveform(
        &self,
        mut ask: waveform::Ask,
        progress: &mut dyn Progress,
    ) -> Result<Outcome, TaskError> {
        let columns = columns(ask.no_figures, ask.columns, ask.output.as_deref())?;
        self.untouched()?;
        self.name(&mut ask.surface);
        let record = self.record(&ask)?;
        played(waveform::make_on(&ask, self.source.clone(), progress)?, columns, record.as_ref())
    }

    /// Computes a drive whose focus moves along a path on the surface, and evaluates it.
    pub fn stroke(&self, mut ask: stroke::Ask, progress: &mut dyn Progress) -> Result<Outcome, TaskError> {
        let columns = columns(ask.no_figures, ask.columns, ask.output.as_deref())?;
        self.untouched()?;
        self.name(&mut ask.surface);
        let record = self.record(&ask)?;
        played(stroke::make_on(&ask, self.source.clone(), progress)?, columns, record.as_ref())
    }

    /// Evaluates what a drive does to the surface. The record holds the samples of the drive, which are many times as long as the report,
    /// and take longer to write than a small field to evaluate: it is written when it is first asked for.
    pub fn field(
        &self,
        mut ask: field::Ask,
        drive: Arc<Drive>,
        progress: &mut dyn Progress,
    ) -> Result<Seen, TaskError> {
        let columns = columns(ask.no_figures, ask.columns, ask.output.as_deref())?;
        self.name(&mut ask.surface);
        self.touch(&mut ask.fingers_m);
        if let Origin::Surface { max_hz, .. } = &self.origin {
            ask.judge_hz = ask.judge_hz.or(*max_hz);
        }
        if let (true, Some(stored)) = (self.is_made_up(), self.stored()) {
            let places: Vec<Point> = ask.points_m.iter().map(point).collect();
            array::between(stored, &places, ask.between)?;
        }
        let record = match &self.origin {
            Origin::Array { .. } => None,
            Origin::Surface { .. } | Origin::Library { .. } => {
                // Of all but the samples: files may change meanwhile.
                let drive = DriveAsk::Samples { channels: Vec::new(), rate_hz: drive.rate() };
                Some(Record::of(&field::Ask { drive, ..ask.clone() })?)
            }
        };
        let mut made = field::make_on(&ask, self.source.clone(), Drive::clone(&drive), progress)?;
        if self.is_made_up() {
            array::forget(&mut made.report);
        }
        let done = match record {
            None => Done::of(&made.report, None)?,
            Some(record) => {
                let report = made.report.clone();
                Done::late(&made.report, move || with_samples(&record, &drive)?.json(&report))?
            }
        };
        let made = Arc::new(made);
        Ok(Seen { done, draw: draw(made.clone(), columns, field::figures), made })
    }

    /// Runs a task that writes a folder on these responses. Its ask names a surface at `surface`.
    pub fn fill<A: Request, R: Report>(
        &self,
        mut ask: A,
        surface: fn(&mut A) -> &mut SurfaceAsk,
        run: fn(&A, Source, &mut dyn Progress) -> Result<R, TaskError>,
        progress: &mut dyn Progress,
    ) -> Result<Done, TaskError> {
        self.name(surface(&mut ask));
        // Before the work, as tasks by name make it: files may change meanwhile.
        let record = Record::of(&ask)?;
        Done::of(&run(&ask, self.source.clone(), progress)?, Some(&record))
    }

    /// Whether the surface is made up, so that nobody knows its sheet.
    fn is_made_up(&self) -> bool {
        matches!(self.origin, Origin::Array { made_up: true })
    }

    /// Puts the surface or library into a request.
    fn name(&self, surface: &mut SurfaceAsk) {
        match &self.origin {
            Origin::Surface { named, .. } => surface.clone_from(named),
            Origin::Library { path, .. } => *surface = SurfaceAsk::Name(path.clone()),
            Origin::Array { .. } => {}
        }
    }

    /// Puts the fingers of the responses into a request that names none.
    fn touch(&self, asked: &mut Vec<Place>) {
        if let Origin::Surface { fingers, .. } = &self.origin
            && asked.is_empty()
        {
            asked.clone_from(fingers);
        }
    }

    /// Refuses responses under fingers, for tasks that know none.
    fn untouched(&self) -> Result<(), TaskError> {
        match &self.origin {
            Origin::Surface { fingers, .. } if !fingers.is_empty() => Err(TaskError::ask(
                "fingers_m",
                "responses without fingers, which only `focus` and `field` take into account",
                format!("{} of them", fingers.len()),
            )),
            _ => Ok(()),
        }
    }

    /// The record of a request that is about to be done; nothing where doing that request would not use the same responses.
    fn record<A: Request>(&self, ask: &A) -> Result<Option<Record>, TaskError> {
        let same = match &self.origin {
            Origin::Surface { max_hz, fingers, .. } => {
                fingers.is_empty() && max_hz.is_none_or(|hz| hz == self.surface().emission.band[1])
            }
            Origin::Library { .. } => true,
            Origin::Array { .. } => false,
        };
        same.then(|| Record::of(ask)).transpose()
    }
}

/// The record of a field with the samples of its drive.
fn with_samples(record: &Record, drive: &Drive) -> Result<Record, TaskError> {
    let samples = DriveAsk::Samples { channels: drive.channels().to_vec(), rate_hz: drive.rate() };
    let mut record = record.clone();
    record.ask["drive"] = serde_json::to_value(samples).map_err(TaskError::work)?;
    Ok(record)
}

/// How wide figures are, where a request wants them; refuses a folder for them.
fn columns(
    no_figures: bool,
    columns: Option<usize>,
    output: Option<&Path>,
) -> Result<Option<Columns>, TaskError> {
    if let Some(output) = output {
        let expected = "none: the task itself writes folders";
        return Err(TaskError::ask("output", expected, output.display()));
    }
    let columns = Columns::of(columns)?;
    Ok((!no_figures).then_some(columns))
}

/// What came of a task that plays.
fn played(
    made: waveform::Made,
    columns: Option<Columns>,
    record: Option<&Record>,
) -> Result<Outcome, TaskError> {
    let (done, drive) = (Done::of(&made.report, record)?, made.drive.clone());
    Ok(Outcome { done, drive, draw: draw(Arc::new(made), columns, waveform::figures) })
}

/// A task's function that draws what was made: names and SVG texts.
type Figures<M> = fn(&M, Columns) -> Result<Vec<(String, String)>, TaskError>;

/// Draws the figures of what was made as wide as is wanted, or none.
fn draw<M: Send + Sync + 'static>(made: Arc<M>, columns: Option<Columns>, figures: Figures<M>) -> Draw {
    Arc::new(move || columns.map_or_else(|| Ok(Vec::new()), |columns| figures(&made, columns)))
}

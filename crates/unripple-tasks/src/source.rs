//! The input of tasks that work on either a surface or a library of responses.

use crate::numbers::{ACCURACY, accuracy};
use crate::{Progress, Solved, SurfaceAsk, TaskError, between, own, wavelength};
use std::cell::RefCell;
use std::path::PathBuf;
use unripple::act::Note;
use unripple::core::{Point, Responses, SampledResponses, Surface};
use unripple::physics::Medium;
use unripple_calibrate::Interpolation;
use unripple_store::{Library, surface_files};

/// Input of a task: a surface, whose responses are computed, or a library of stored responses. Clones share the responses.
#[derive(Clone, Debug)]
pub struct Source {
    /// The surface; for a library, the surface that it was measured or computed for.
    pub surface: Surface,
    /// The stored responses, if the input is a library.
    pub stored: Option<Stored>,
    /// Responses computed earlier, to be used for the surface; `None` to compute those of the modes in its
    /// band.
    pub computed: Option<Responses>,
    /// Cache of responses and windows computed from modes, for this surface and others.
    pub solved: Solved,
}

/// Responses of a library, with remarks on them.
#[derive(Clone, Debug)]
pub struct Stored {
    /// Responses at the finished points of the library whose files can be read.
    pub responses: SampledResponses,
    /// Phrase for reports that names the responses used, such as "the 25 points of film-library".
    pub told: String,
    /// Notes on faults of the library: doubts, missing actuators, damaged files.
    pub notes: Vec<Note>,
    /// Reason why absolute levels are unknown; `None` if they are known.
    pub without_scale: Option<String>,
}

/// Notes on a library as a whole: doubts, actuators left out, checks not made, another wavelength than its file's, unknown scale.
fn about(library: &Library) -> Vec<Note> {
    let mut notes: Vec<Note> =
        library.doubts().iter().map(|doubt| Note { topic: "doubtful", text: doubt.to_string() }).collect();
    let dead: Vec<&str> = library.dead().iter().map(|i| library.plan().ports[*i].name.as_str()).collect();
    if !dead.is_empty() {
        let text = format!("without {}: dead, or left out when the library was measured", dead.join(", "));
        notes.push(Note { topic: "actuators", text });
    }
    let unchecked = library.logged("model").filter(|log| log["checked"] == false);
    let said = unchecked.and_then(|log| log["said"].as_str());
    notes.extend(said.map(|said| Note { topic: "model", text: said.into() }));
    let tapped = library.logged("taps").and_then(|log| log["said"].as_str());
    notes.extend(tapped.map(|said| Note { topic: "model", text: said.into() }));
    let waves = library.logged(wavelength::KEY).and_then(|log| log["said"].as_str());
    notes.extend(waves.map(|said| Note { topic: "wavelength", text: said.into() }));
    notes.extend(library.without_scale().map(|why| Note { topic: "level", text: why.into() }));
    notes
}

/// Reports warnings about a library to `progress`, and returns them as notes: doubts, actuators left out,
/// checks not made, unknown scale.
pub fn warn(library: &Library, progress: &mut dyn Progress) -> Vec<Note> {
    let notes = about(library);
    for note in &notes {
        let what = if note.topic == "doubtful" { "doubtful: " } else { "" };
        progress.tell(&format!("warning: {}: {what}{}", library.path().display(), note.text));
    }
    notes
}

/// Opens a surface by name, file or text, or a library by its folder, with warnings about the library.
///
/// # Errors
/// Those of [`SurfaceAsk::load`]; [`TaskError::Input`] of a library that does not describe its surface or has no finished point.
pub fn open(ask: &SurfaceAsk, progress: &mut dyn Progress) -> Result<Source, TaskError> {
    if let SurfaceAsk::Name(name) | SurfaceAsk::Set { name, .. } = ask
        && Library::is_at(name)
    {
        warn(&Library::open(name)?, progress);
    }
    open_again(ask)
}

/// Opens a surface or library as [`open`] does, without warnings: for callers that open the same one repeatedly.
///
/// # Errors
/// Those of [`open`].
pub fn open_again(ask: &SurfaceAsk) -> Result<Source, TaskError> {
    match ask {
        SurfaceAsk::Name(name) if Library::is_at(name) => library(name),
        // Of the surface that a library describes, the accuracy of its modes alone may be another.
        SurfaceAsk::Set { name, set } if Library::is_at(name) && set.keys().all(|key| key == ACCURACY) => {
            let mut source = library(name)?;
            for text in set.values() {
                // What is no number is refused as one out of range is.
                let asked = text.parse().unwrap_or(f64::NAN);
                source.surface.accuracy = Some(accuracy(asked)?);
            }
            Ok(source)
        }
        _ => Ok(Source::of(ask.load()?)),
    }
}

/// The surface that a library describes: the one that it was measured or computed for.
///
/// # Errors
/// [`TaskError::Input`] of a library that does not describe it.
pub(crate) fn described(library: &Library) -> Result<Surface, TaskError> {
    library.plan().surface.clone().ok_or_else(|| {
        TaskError::Input(format!(
            "{}: expected a library that describes its surface, found one without",
            library.path().display()
        ))
    })
}

thread_local! {
    /// The library that was read last by work on this thread, by its path, while [`keeping`] runs that work; `None` while it does not.
    static KEPT: RefCell<Option<Vec<(String, Source)>>> = const { RefCell::new(None) };
}

/// Runs `work` and keeps the library that it read last, so that work that opens one library again and again reads it once.
pub(crate) fn keeping<T>(work: impl FnOnce() -> T) -> T {
    /// Forgets the library, also after a panic.
    struct Forget;

    impl Drop for Forget {
        fn drop(&mut self) {
            KEPT.set(None);
        }
    }

    if KEPT.with_borrow(Option::is_some) {
        // Whoever keeps it already forgets it.
        return work();
    }
    KEPT.set(Some(Vec::new()));
    let _forget = Forget;
    work()
}

/// A library by its folder, as it was when it was read, if it is kept.
fn library(name: &str) -> Result<Source, TaskError> {
    let is_asked = |(path, _): &&(String, Source)| path == name;
    let known =
        KEPT.with_borrow(|kept| kept.iter().flatten().find(is_asked).map(|(_, source)| source.clone()));
    if let Some(source) = known {
        return Ok(source.with(&Solved::default()));
    }
    let source = read(name)?;
    KEPT.with_borrow_mut(|kept| {
        if let Some(kept) = kept {
            *kept = vec![(name.to_owned(), source.clone())];
        }
    });
    Ok(source)
}

/// A library from its files.
fn read(name: &str) -> Result<Source, TaskError> {
    let library = Library::open(name)?;
    let surface = described(&library)?;
    let names = |list: Vec<&String>| list.into_iter().cloned().collect::<Vec<_>>().join(", ");
    let (ports, actuators) = (&library.plan().ports, &surface.actuators);
    let expected = names(actuators.iter().map(|a| &a.name).collect());
    let found = names(ports.iter().map(|p| &p.name).collect());
    if expected != found {
        return Err(TaskError::Input(format!(
            "{name}: expected responses of {expected}, found those of {found}"
        )));
    }
    let (responses, damage) = library.intact()?;
    let responses = own::as_velocities(&library, &surface, responses)?;
    let (points, all) = (responses.points.len(), library.points().len());
    if points == 0 {
        return Err(TaskError::Input(format!(
            "{name}: expected a library with finished points, found 0 of {all}"
        )));
    }
    let note = |text| Note { topic: "library", text };
    let mut notes = about(&library);
    notes.extend(damage.iter().take(LISTED).map(|damage| note(format!("damaged, and left out: {damage}"))));
    if damage.len() > LISTED {
        notes.push(note(format!("{} more files are damaged", damage.len() - LISTED)));
    }
    if points < all {
        notes.push(note(format!("{points} of {all} points are finished and intact")));
    }
    let told = format!("the {points} points of {name}");
    let without_scale = library.without_scale().map(str::to_owned);
    Ok(Source::sampled(surface, Stored { responses, told, notes, without_scale }))
}

/// Paths that are read for a surface or a library.
pub fn reads(ask: &SurfaceAsk) -> Vec<PathBuf> {
    match ask {
        SurfaceAsk::Name(name) if Library::is_at(name) => vec![name.into()],
        SurfaceAsk::Name(name) | SurfaceAsk::Set { name, .. } => surface_files(name, &ask.keys()),
        SurfaceAsk::Text { .. } => Vec::new(),
    }
}

/// Pair for reports: a phrase that names the responses used, and notes on these responses.
pub type Told = (String, Vec<Note>);

/// Largest number of damaged files that are named one by one; beyond it, only their number is reported.
const LISTED: usize = 5;

impl Source {
    /// A surface, whose responses are computed when they are needed.
    pub fn of(surface: Surface) -> Self {
        Self { surface, stored: None, computed: None, solved: Solved::default() }
    }

    /// A surface with responses in modal form that were computed for it.
    pub fn computed(surface: Surface, responses: Responses) -> Self {
        Self { computed: Some(responses), ..Self::of(surface) }
    }

    /// Sampled responses, with the surface that they belong to.
    pub fn sampled(surface: Surface, stored: Stored) -> Self {
        Self { stored: Some(stored), ..Self::of(surface) }
    }

    /// This source with the cache `solved` of responses and windows, whose contents are not computed again.
    #[must_use]
    pub fn with(self, solved: &Solved) -> Self {
        Self { solved: solved.clone(), ..self }
    }

    /// The shortest wavelength in a library's band, in m; `None` for a surface.
    pub fn lambda_min(&self) -> Option<f64> {
        self.stored.as_ref().map(|stored| stored.responses.conditions.lambda_min)
    }

    /// The shortest wavelength in the band, in m: that of a library, or of the sheet.
    pub fn shortest_wavelength(&self) -> f64 {
        self.lambda_min()
            .unwrap_or_else(|| Medium::of(&self.surface.sheet).lambda_min(self.surface.emission.band[1]))
    }

    /// Reason why absolute displacements and velocities are unknown; `None` if they are known.
    pub fn without_scale(&self) -> Option<String> {
        self.stored.as_ref().and_then(|stored| stored.without_scale.clone())
    }

    /// Returns the surface and its responses: those computed earlier or stored, or else those of the modes
    /// in its band; for a library also a phrase and notes about its responses. A library's responses are
    /// completed by interpolation (`way`) at `places`, in m.
    pub fn respond(
        self,
        places: &[Point],
        way: Interpolation,
    ) -> Result<(Surface, Responses, Option<Told>), TaskError> {
        match (self.stored, self.computed) {
            (Some(Stored { responses, told, mut notes, .. }), _) => {
                let (responses, more) = between::completed(responses, &self.surface, places, way)?;
                notes.extend(more);
                Ok((self.surface, Responses::Sampled(responses), Some((told, notes))))
            }
            (None, Some(computed)) => Ok((self.surface, computed, None)),
            (None, None) => {
                let responses = self.solved.model(&self.surface, None, &[])?;
                Ok((self.surface, responses, None))
            }
        }
    }

    /// Returns an error if the source is a library and a field of the request is set that needs a model.
    /// `fields` are pairs of a field's name and whether it is set.
    ///
    /// # Errors
    /// [`TaskError::Ask`] that names the first of them.
    pub fn allows(&self, fields: &[(&'static str, bool)]) -> Result<(), TaskError> {
        let given = fields.iter().find(|(_, given)| *given && self.stored.is_some());
        given.map_or(Ok(()), |(name, _)| {
            Err(TaskError::ask(name, "a surface, whose modes it needs", "a library"))
        })
    }
}

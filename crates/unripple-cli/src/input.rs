//! Surfaces and libraries as named on the command line.

use crate::between;
use crate::error::CliError;
use crate::judge::{self, Note};
use crate::own;
use unripple::core::{Point, Responses, SampledResponses, Surface};
use unripple_calibrate::Interpolation;
use unripple_store::{Library, StoreError, load_surface};

impl From<StoreError> for CliError {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::Surface(faults) => Self::Faults(Box::new(faults)),
            error if error.is_bad_input() => Self::input(error),
            error => Self::work(error),
        }
    }
}

/// A built-in surface or a surface file.
pub fn surface(name: &str) -> Result<Surface, CliError> {
    Ok(load_surface(name)?)
}

/// What a command works on.
pub struct Source {
    /// The surface; of a library, the one it was made for.
    pub surface: Surface,
    /// Its responses, where they are stored.
    pub stored: Option<Stored>,
}

/// Responses from a library.
pub struct Stored {
    /// Those of the finished points that can be read.
    pub responses: SampledResponses,
    /// What figures taken on them are of.
    pub told: String,
    /// What is wrong with it.
    pub notes: Vec<Note>,
    /// Why its levels mean nothing, if they do not.
    pub without_scale: Option<String>,
}

/// What is wrong with a library as a whole, as notes: why it is not to be trusted, what was left out, what is not known of it.
fn about(library: &Library) -> Vec<Note> {
    let mut notes: Vec<Note> =
        library.doubts().iter().map(|doubt| Note { topic: "doubtful", text: doubt.to_string() }).collect();
    let dead: Vec<&str> = library.dead().iter().map(|i| library.plan().ports[*i].name.as_str()).collect();
    if !dead.is_empty() {
        let text = format!("without {}, dead or left out when it was measured", dead.join(", "));
        notes.push(Note { topic: "actuators", text });
    }
    let unchecked = library.logged("model").filter(|log| log["checked"] == false);
    let said = unchecked.and_then(|log| log["said"].as_str());
    notes.extend(said.map(|said| Note { topic: "model", text: said.into() }));
    notes.extend(library.without_scale().map(|why| Note { topic: "level", text: why.into() }));
    notes
}

/// Warns of a library on standard error: why it is not to be trusted, what was left out, what is not known of it. Returns the same as notes.
pub fn warn(library: &Library) -> Vec<Note> {
    let notes = about(library);
    for note in &notes {
        let what = if note.topic == "doubtful" { "doubtful: " } else { "" };
        eprintln!("warning: {}: {what}{}", library.path().display(), note.text);
    }
    notes
}

/// A surface by name or file, or a library by its folder; what is wrong with that is said on standard error.
pub fn source(name: &str) -> Result<Source, CliError> {
    if Library::is_at(name) {
        warn(&Library::open(name)?);
    }
    quiet_source(name)
}

/// The same without a word on standard error, for whoever asks again and again.
pub fn quiet_source(name: &str) -> Result<Source, CliError> {
    if !Library::is_at(name) {
        return Ok(Source { surface: surface(name)?, stored: None });
    }
    let library = Library::open(name)?;
    let Some(surface) = library.plan().surface.clone() else {
        return Err(CliError::Input(format!(
            "{name}: expected a library that describes its surface, found one without"
        )));
    };
    let names = |list: Vec<&String>| list.into_iter().cloned().collect::<Vec<_>>().join(", ");
    let (ports, actuators) = (&library.plan().ports, &surface.actuators);
    let expected = names(actuators.iter().map(|a| &a.name).collect());
    let found = names(ports.iter().map(|p| &p.name).collect());
    if expected != found {
        return Err(CliError::Input(format!(
            "{name}: expected responses of {expected}, found those of {found}"
        )));
    }
    let (responses, damage) = library.intact()?;
    let responses = own::as_velocities(&library, &surface, responses)?;
    let (points, all) = (responses.points.len(), library.points().len());
    if points == 0 {
        return Err(CliError::Input(format!(
            "{name}: expected a library with finished points, found 0 of {all}"
        )));
    }
    let note = |text| Note { topic: "library", text };
    let mut notes = about(&library);
    notes.extend(damage.iter().take(LISTED).map(|damage| note(format!("damaged, and left out: {damage}"))));
    if damage.len() > LISTED {
        notes.push(note(format!("{} files more are damaged", damage.len() - LISTED)));
    }
    if points < all {
        notes.push(note(format!("{points} of {all} points are finished and sound")));
    }
    let told = format!("the {points} points of {name}");
    let without_scale = library.without_scale().map(str::to_owned);
    Ok(Source { surface, stored: Some(Stored { responses, told, notes, without_scale }) })
}

/// What figures taken on a library are of, and notes on it.
pub type Told = (String, Vec<Note>);

/// Damaged files named one by one.
const LISTED: usize = 5;

impl Source {
    /// Its shortest wavelength, where responses are stored.
    pub fn lambda_min(&self) -> Option<f64> {
        self.stored.as_ref().map(|stored| stored.responses.conditions.lambda_min)
    }

    /// Why lengths and velocities taken on it mean nothing, if they do not.
    pub fn without_scale(&self) -> Option<String> {
        self.stored.as_ref().and_then(|stored| stored.without_scale.clone())
    }

    /// The surface, its responses within the band, and, of a library, what to say of them. A library's are made complete at
    /// `places`.
    pub fn respond(
        self,
        places: &[Point],
        way: Interpolation,
    ) -> Result<(Surface, Responses, Option<Told>), CliError> {
        match self.stored {
            Some(Stored { responses, told, mut notes, .. }) => {
                let (responses, more) = between::completed(responses, &self.surface, places, way)?;
                notes.extend(more);
                Ok((self.surface, Responses::Sampled(responses), Some((told, notes))))
            }
            None => {
                let responses = judge::model(&self.surface, None, &[])?;
                Ok((self.surface, responses, None))
            }
        }
    }

    /// Refuses, for a library, options that need a model. Each is a name and whether it was given.
    pub fn allows(&self, options: &[(&str, bool)]) -> Result<(), CliError> {
        let given = options.iter().find(|(_, given)| *given && self.stored.is_some());
        given.map_or(Ok(()), |(name, _)| {
            Err(CliError::Input(format!("{name}: expected a surface, whose modes it needs, found a library")))
        })
    }
}

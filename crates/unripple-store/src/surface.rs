mod actuator;
mod emission;
mod outline;
mod place;
mod polygon;
mod range;
mod reader;
mod sheet;
mod write;

pub use write::to_toml;

use crate::StoreError;
use crate::fault::{Fault, SurfaceFaults};
use crate::file::LARGEST_TEXT;
use outline::{Fetch, Rim};
use reader::{Faults, Section};
use toml::de::DeTable;
use unripple_core::{Finger, Outline, Surface};

/// The format this version reads and writes.
const FORMAT: i64 = 1;
const KEYS: [&str; 7] = ["format", "name", "outline", "sheet", "drive", "finger", "actuator"];

/// The surface that a text in format 1 describes. `file` names it in messages; an SVG outline is refused, because a
/// text alone reaches no other file.
///
/// # Errors
/// All faults of the text at once; after an error of TOML itself, that one.
///
/// ```
/// let text = r#"
///     format = 1
///     [outline]
///     rectangle_mm = [150, 150]
///     [sheet]
///     material = "BoPET"
///     thickness_mm = 0.125
///     tension_n_per_m = 200
///     decay_time_ms = 70
///     [drive]
///     band_hz = [0, 3000]
///     [[actuator]]
///     at_mm = [12, 31]
/// "#;
/// let surface = unripple_store::parse_surface(text, "film.toml")?;
/// assert_eq!(surface.name, "film");
/// assert_eq!(surface.sheet.thickness, 0.125e-3);
/// # Ok::<(), unripple_store::SurfaceFaults>(())
/// ```
pub fn parse_surface(text: &str, file: &str) -> Result<Surface, SurfaceFaults> {
    parse_surface_with(text, file, &|name| {
        Err(StoreError::content(name, "a surface file on disk, which `svg` is relative to", "text alone"))
    })
}

/// As [`parse_surface`], with `fetch` to hand over the text of the SVG file that an outline names.
///
/// # Errors
/// All faults of the text at once; after an error of TOML itself, that one.
pub fn parse_surface_with(
    text: &str,
    file: &str,
    fetch: &dyn Fn(&str) -> Result<String, StoreError>,
) -> Result<Surface, SurfaceFaults> {
    if text.len() > LARGEST_TEXT {
        return Err(too_large(file));
    }
    let mut faults = Faults::new(text);
    let surface = match DeTable::parse(text) {
        Ok(document) => read(&Section::root(document.get_ref()), file, fetch, &mut faults),
        Err(error) => {
            let span = error.span().unwrap_or(0..0);
            faults.add("", span, format!("an error of TOML: {}", error.message()), "a TOML file", None);
            None
        }
    };
    let list = faults.into_list();
    match surface {
        Some(surface) if list.is_empty() => Ok(surface),
        _ => Err(SurfaceFaults::new(file, text, list)),
    }
}

/// The fault of a file past the size limit.
pub(crate) fn too_large(file: &str) -> SurfaceFaults {
    whole(file, "", 0, "more than that", &format!("a file of at most {LARGEST_TEXT} bytes"))
}

/// One fault of a whole file, at a byte of its text.
pub(crate) fn whole(file: &str, text: &str, at: usize, found: &str, expected: &str) -> SurfaceFaults {
    let fault = Fault {
        key: String::new(),
        line: 0,
        column: 0,
        found: found.into(),
        expected: expected.into(),
        nearest: None,
        span: at..at,
    };
    SurfaceFaults::new(file, text, vec![fault])
}

fn read(root: &Section, file: &str, fetch: &Fetch, faults: &mut Faults) -> Option<Surface> {
    let format = root.get("format");
    if let Some(entry) = format.as_ref().filter(|entry| !entry.is(FORMAT)) {
        // Another format has other keys, which would only be noise here.
        entry.refuse(format!("{FORMAT}, the format this version reads"), Some(FORMAT.to_string()), faults);
        return None;
    }
    if format.is_none() {
        faults.add("format", 0..0, "no such key", "format = 1 at the top", Some(FORMAT.to_string()));
    }
    root.check_keys(&KEYS, |_| None, faults);
    let name = match root.get("name") {
        Some(entry) => entry.line("a name", faults),
        None => Some(stem(file)),
    };
    let table = |key: &str, faults: &mut Faults| {
        root.require(key, &format!("a table [{key}]"), faults).and_then(|entry| entry.section(faults))
    };
    let rim = table("outline", faults).map_or_else(Rim::default, |t| outline::read(&t, fetch, faults));
    let sheet = table("sheet", faults).and_then(|t| sheet::read(&t, faults));
    let emission = table("drive", faults).and_then(|t| emission::read(&t, faults));
    let finger = match root.get("finger") {
        Some(entry) => entry.section(faults).and_then(|t| emission::finger(&t, faults)),
        None => Some(Finger::default()),
    };
    let inside = rim.shape.clone().map(Outline::new);
    let actuators = actuator::read(root, inside.as_ref(), faults);
    Some(Surface {
        name: name?,
        outline: Outline { shape: rim.shape?, edges: rim.edges? },
        sheet: sheet?,
        emission: emission?,
        finger: finger?,
        actuators: actuators?,
    })
}

/// What to call a surface whose file does not say.
fn stem(file: &str) -> String {
    let stem = std::path::Path::new(file).file_stem().map(|s| s.to_string_lossy().into_owned());
    stem.map(|s| s.chars().filter(|c| !c.is_control()).take(50).collect::<String>().trim().to_owned())
        .filter(|s| !s.is_empty())
        .unwrap_or_else(|| "surface".into())
}

//! Libraries written as SOFA files (AES69-2022). SOFA is netCDF-4, which is HDF5; the part of HDF5 that is needed is
//! written here.

mod about;
mod bytes;
mod heap;
mod message;
mod netcdf;
mod seal;

pub use about::{SofaAbout, date};

use crate::building::sweep;
use crate::file::write_beside;
use crate::{Committed, Library, StoreError};
use about::API;
use message::{Kind, MOST_TEXT};
use netcdf::{Counted, NetCdf, Variable};
use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Read, Write};
use std::path::Path;
use unripple_core::Point;

/// First bytes of an HDF5 file, by which readers know one.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";

/// Axes of the file, by their index: measurements, receivers, emitters, samples, one, coordinates, letters of a name.
const M: usize = 0;
const R: usize = 1;
const E: usize = 2;
const N: usize = 3;
const I: usize = 4;
const C: usize = 5;
const S: usize = 6;

impl Library {
    /// Writes every finished point into one SOFA file of the convention `GeneralFIR-E` 2.0. A measurement (M) is a point,
    /// where the listener is; its one receiver (R) is the probe; actuators are the emitters (E), with their names in
    /// `EmitterDescriptions`. Places are in metres, cartesian, on the plane z = 0; `Data.IR` is `[M][R][N][E]` in float64,
    /// in m/s per unit of drive and second, and `Data.Delay` says where time 0 is. Provenance is in `History`.
    ///
    /// An earlier export is replaced if it is unchanged. The file appears completely or not at all.
    ///
    /// # Errors
    /// [`StoreError::Content`] if no point is finished, a finished one is damaged, or a text has more than 60 000
    /// bytes; [`StoreError::Occupied`] if something else is at `path`; [`StoreError::Read`] and
    /// [`StoreError::Write`].
    ///
    /// ```
    /// use unripple_core::{Conditions, Outline, Point, Port, Shape};
    /// use unripple_store::{Library, LibraryPlan, Quality, SofaAbout};
    /// let outline = Outline::new(Shape::Rectangle { width: 0.15, height: 0.15 });
    /// let conditions = Conditions { rate: 48e3, band: [0.0, 3e3], lambda_min: 14.6e-3, outline };
    /// let port = Port { name: "a1".into(), at: Point::from_mm(12.0, 31.0) };
    /// let plan = LibraryPlan::new(vec![port], vec![Point::from_mm(62.0, 90.0)], conditions, 3);
    /// let folder = std::env::temp_dir().join(format!("unripple-doc-sofa-{}", std::process::id()));
    /// let mut library = Library::create(&folder, &plan)?;
    /// library.put(0, &[0.0, 1.0, -0.5], &[Quality::UNKNOWN])?;
    ///
    /// library.export_sofa(folder.join("film.sofa"), &SofaAbout::default())?;
    /// assert!(std::fs::read(folder.join("film.sofa")).unwrap().starts_with(b"\x89HDF"));
    /// # std::fs::remove_dir_all(&folder).unwrap();
    /// # Ok::<(), unripple_store::StoreError>(())
    /// ```
    pub fn export_sofa(&self, path: impl AsRef<Path>, about: &SofaAbout) -> Result<Committed, StoreError> {
        let path = path.as_ref();
        let replaced = occupied(path)?;
        let done = self.done();
        if done.is_empty() {
            let found = format!("0 of {}", self.points().len());
            let file = self.path().display().to_string();
            return Err(StoreError::content(&file, "a library with finished points", found));
        }
        let texts = about.attributes(self.plan());
        if let Some((name, text)) = texts.iter().find(|(_, text)| text.len() > MOST_TEXT) {
            let expected = format!("a text of at most {MOST_TEXT} bytes for `{name}`");
            return Err(StoreError::content(
                &path.display().to_string(),
                expected,
                format!("{} bytes", text.len()),
            ));
        }
        let (plan, samples) = (self.plan(), self.plan().samples);
        let letters = plan.ports.iter().map(|port| port.name.len()).max().unwrap_or(1);
        let sizes = [done.len(), 1, plan.ports.len(), samples, 1, 3, letters];
        let file = NetCdf {
            attributes: texts,
            axes: ["M", "R", "E", "N", "I", "C", "S"].into_iter().zip(sizes.map(|n| n as u64)).collect(),
            variables: variables(),
        };
        sweep(path);
        write_beside(path, |out| {
            self.fill(&file, &done, path, out)?;
            seal::seal(out).map_err(StoreError::write(path))
        })?;
        Ok(Committed { path: path.into(), replaced })
    }

    /// Writes the file, a point at a time.
    fn fill(&self, file: &NetCdf, done: &[usize], path: &Path, out: &mut File) -> Result<(), StoreError> {
        let plan = self.plan();
        // A damaged chunk is an error of the library, not of the medium.
        let mut damage = None;
        let mut out = BufWriter::new(out);
        let written = file.write(&mut out, |variable, to| match file.variables[variable].name {
            "ListenerPosition" => done.iter().try_for_each(|point| place(to, plan.points[*point])),
            "EmitterPosition" => plan.ports.iter().try_for_each(|port| place(to, port.at)),
            "ReceiverPosition" | "SourcePosition" => place(to, Point::default()),
            "Data.SamplingRate" => number(to, plan.conditions.rate),
            "Data.Delay" => {
                plan.ports.iter().try_for_each(|_| number(to, delay(plan.onset, plan.conditions.rate)))
            }
            "EmitterDescriptions" => plan.ports.iter().try_for_each(|port| {
                let mut name = port.name.clone().into_bytes();
                name.resize(file.axes[S].1 as usize, 0);
                to.write_all(&name)
            }),
            _ => done.iter().try_for_each(|point| match self.get(*point) {
                Ok(values) => responses(to, &values, plan.samples),
                Err(error) => {
                    damage = Some(error);
                    Err(ErrorKind::InvalidData.into())
                }
            }),
        });
        match damage {
            Some(error) => Err(error),
            None => written.and_then(|()| out.flush()).map_err(StoreError::write(path)),
        }
    }
}

/// The arrays of the convention, and the actuators' names.
fn variables() -> Vec<Variable> {
    let metres = || vec![("Type", "cartesian".to_owned()), ("Units", "metre".to_owned())];
    let array = |name, axes: &[usize], attributes| Variable {
        name,
        kind: Kind::F64,
        axes: axes.to_vec(),
        attributes,
    };
    let per_drive = "metre per second per (unit of drive times second)".to_owned();
    let names = Variable { kind: Kind::Text(1), ..array("EmitterDescriptions", &[E, S], vec![]) };
    vec![
        array("ListenerPosition", &[M, C], metres()),
        array("ReceiverPosition", &[R, C], metres()),
        array("SourcePosition", &[I, C], metres()),
        array("EmitterPosition", &[E, C], metres()),
        names,
        array("Data.SamplingRate", &[I], vec![("Units", "hertz".to_owned())]),
        array("Data.Delay", &[I, R, E], vec![]),
        array("Data.IR", &[M, R, N, E], vec![("Units", per_drive)]),
    ]
}

/// Delay in samples that moves the impulse from the onset to time 0.
fn delay(onset: f64, rate: f64) -> f64 {
    0.0 - onset * rate
}

fn number<W: Write>(to: &mut Counted<'_, W>, value: f64) -> io::Result<()> {
    to.write_all(&value.to_le_bytes())
}

fn place<W: Write>(to: &mut Counted<'_, W>, at: Point) -> io::Result<()> {
    [at.x, at.y, 0.0].into_iter().try_for_each(|value| number(to, value))
}

/// One point's responses, actuators x samples, as samples x actuators.
fn responses<W: Write>(to: &mut Counted<'_, W>, values: &[f32], samples: usize) -> io::Result<()> {
    (0..samples).try_for_each(|sample| {
        let mut actuators = values.iter().skip(sample).step_by(samples);
        actuators.try_for_each(|value| number(to, f64::from(*value)))
    })
}

/// Whether an earlier export is there, to be replaced; anything else is left alone.
fn occupied(path: &Path) -> Result<bool, StoreError> {
    let occupied = |found: &str| StoreError::Occupied {
        path: path.into(),
        expected: "no such file yet, or one that an earlier export wrote, unchanged",
        found: found.into(),
    };
    let metadata = match std::fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(false),
        Err(error) => return Err(StoreError::write(path)(error)),
        Ok(metadata) => metadata,
    };
    if !metadata.is_file() {
        return Err(occupied("something that is not a file"));
    }
    let looked = || -> io::Result<_> {
        let (mut file, mut start) = (File::open(path)?, Vec::new());
        Read::by_ref(&mut file).take(512).read_to_end(&mut start)?;
        let known = start.windows(API.len()).any(|bytes| bytes == API.as_bytes());
        Ok((start.starts_with(SIGNATURE) && known, seal::is_whole(&mut file)?))
    };
    match looked().map_err(StoreError::write(path))? {
        (true, Some(true)) => Ok(true),
        (true, _) => Err(occupied("one changed since it was written, or written by an earlier version")),
        (false, _) => Err(occupied("another file")),
    }
}

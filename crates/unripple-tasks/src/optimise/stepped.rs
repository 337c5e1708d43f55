//! A search that its caller takes from one generation to the next.

use super::course::Course;
use super::folder::Folder;
use super::question::Question;
use super::stop::Stop;
use super::{Ask, Crew, End, EndedBy, Report, Search, figure, table};
use crate::figures::Columns;
use crate::sweep::{Piece, Row, TABLE, Workers};
use crate::{Progress, Record, TaskError, figures, go_on, source};
use std::path::PathBuf;
use std::sync::Arc;
use unripple::act::Note;
use unripple_store::write_file;

/// Name of the report in the folder.
const REPORT: &str = "optimise.json";

/// Name of the surface file of the best design.
const BEST: &str = "best.toml";

/// A search that goes on to the next generation that has to be asked for, and waits there until somebody has asked.
pub struct Stepped {
    ask: Ask,
    columns: Columns,
    search: Arc<Search>,
    record: Record,
    folder: Folder,
    course: Course,
    stop: Option<Stop>,
}

/// What has to be computed of a generation, as a sweep.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// File of the plan of the sweep.
    pub plan: PathBuf,
    /// Folder of the sweep.
    pub place: PathBuf,
    /// Shards that have to be computed, counted from 0. Rows of other shards are known.
    pub shards: Vec<usize>,
}

impl Stepped {
    /// Opens a search and its folder.
    ///
    /// # Errors
    /// [`TaskError::Ask`] of options that make no sense; those of [`Search::open`]; [`TaskError::Input`] of a folder with designs of another
    /// plan; [`TaskError::Work`] of one with other things in it.
    pub fn open(ask: &Ask) -> Result<Self, TaskError> {
        let (columns, stop) = (Columns::of(ask.columns)?, Stop::of(ask)?);
        let output = ask.output.as_deref();
        let output = output.ok_or_else(|| TaskError::ask("output", "a folder for the designs", "none"))?;
        let search = Arc::new(Search::open(&ask.plan)?);
        // Before the work, as of every task: files may change meanwhile.
        let record = Record::of(ask)?;
        let folder = Folder::open(&search, output)?;
        Ok(Self { ask: ask.clone(), columns, search, record, folder, course: Course::default(), stop })
    }

    /// Computes generations that have been asked for, by processes or in this one, up to the first that has not: returns that, counted from
    /// 0, or `None` if the search is over.
    ///
    /// # Errors
    /// [`TaskError::Faults`] and [`TaskError::Input`] of a plan that is not of this search; [`TaskError::Work`] if it is called again and
    /// nobody has asked; those of a sweep; [`TaskError::Cancelled`].
    pub fn go(
        &mut self,
        crew: Option<&Crew<'_>>,
        progress: &mut dyn Progress,
    ) -> Result<Option<usize>, TaskError> {
        source::keeping(|| {
            while self.course.ended.is_none() {
                go_on(progress)?;
                let generation = self.course.steps.len();
                if generation < self.search.file().generations && self.folder.is_asked(generation) {
                    self.computed(generation, crew, progress)?;
                } else if self.course.to_ask.is_some() {
                    let text = format!("generation {generation} was asked for, but nothing came");
                    return Err(TaskError::Work(text));
                } else if let Some(end) = self.end(generation) {
                    self.course.ended = Some(end);
                } else {
                    self.course.to_ask = Some(generation);
                    return Ok(Some(generation));
                }
            }
            Ok(None)
        })
    }

    /// Why no further generation is asked for after so many; `None` if one is.
    fn end(&self, generations: usize) -> Option<End> {
        if generations >= self.search.file().generations {
            let why = format!("all {generations} generations of the plan are computed");
            return Some(End { by: EndedBy::Generations, why });
        }
        self.stop.as_ref().and_then(|stop| stop.end(&self.course.told))
    }

    /// Takes the rows of a generation into account, those that are missing computed first.
    fn computed(
        &mut self,
        generation: usize,
        crew: Option<&Crew<'_>>,
        progress: &mut dyn Progress,
    ) -> Result<(), TaskError> {
        self.course.to_ask = None;
        self.folder.remove_question(generation);
        let rows = self.rows(generation, crew, progress)?;
        if let Some(name) = self.folder.asker(generation)
            && !self.course.optimisers.contains(&name)
        {
            self.course.optimisers.push(name);
        }
        self.course.take(&self.search, generation, rows);
        if let Some(stop) = &mut self.stop {
            stop.take(&self.course.front);
        }
        Ok(())
    }

    /// The rows of a generation that has been asked for, by processes or in this one.
    fn rows(
        &self,
        generation: usize,
        crew: Option<&Crew<'_>>,
        progress: &mut dyn Progress,
    ) -> Result<Vec<Row>, TaskError> {
        let known = &self.course.known;
        let Some(crew) = crew else { return self.folder.rows(generation, known, None, progress) };
        let (plan, place) = self.folder.sweep(generation);
        let command = |piece: Piece| (crew.command)(&plan, &place, piece);
        let workers = Workers { jobs: crew.jobs, command: &command };
        self.folder.rows(generation, known, Some(&workers), progress)
    }

    /// What has to be computed of the next generation; `None` if it has not been asked for, or nothing has. For whoever computes it in a way
    /// of its own before [`go`](Self::go).
    ///
    /// # Errors
    /// Those of [`go`](Self::go), but for those of computing.
    pub fn missing(&self) -> Result<Option<Missing>, TaskError> {
        let generation = self.course.steps.len();
        if generation >= self.search.file().generations || !self.folder.is_asked(generation) {
            return Ok(None);
        }
        let shards = self.folder.shards(generation, &self.course.known)?;
        let (plan, place) = self.folder.sweep(generation);
        Ok((!shards.is_empty()).then_some(Missing { plan, place, shards }))
    }

    /// The question for the designs of the next generation.
    pub fn question(&self) -> Question<'_> {
        Question::of(&self.folder, self.course.steps.len(), &self.course.told)
    }

    /// Ends the search, since its optimiser has nothing more to ask for.
    pub fn over(&mut self, why: String) {
        self.course.to_ask = None;
        self.course.ended = Some(End { by: EndedBy::Optimiser, why });
    }

    /// Writes the table of a search that could not go on, unless more is there already, as before one of its first generations came to be
    /// refused.
    ///
    /// # Errors
    /// [`TaskError::Work`] if it cannot be written.
    pub fn keep(&self) -> Result<(), TaskError> {
        match table::rows(&self.folder.file(TABLE)) <= self.course.told.len() {
            true => self.put_table(),
            false => Ok(()),
        }
    }

    fn put_table(&self) -> Result<(), TaskError> {
        let (file, names) = (self.search.file(), self.search.names());
        table::write(&self.folder.file(TABLE), file, &names, &self.course.told)
    }

    /// How the report is made.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// Writes table, report and figures of what is known by now, and returns the report.
    ///
    /// # Errors
    /// [`TaskError::Work`] of what cannot be written.
    pub fn finish(&self, progress: &mut dyn Progress) -> Result<Report, TaskError> {
        self.put_table()?;
        let mut report = Report::of(&self.search, &self.course)?;
        report.files.push(TABLE.into());
        report.notes.extend(self.left_out());
        if let Some(text) = &report.best_surface {
            write_file(self.folder.file(BEST), text.as_bytes())?;
            report.files.push(BEST.into());
        }
        if !self.ask.no_figures && !self.course.told.is_empty() {
            progress.stage("figures");
            match self.drawn() {
                Ok(files) => report.files.extend(files),
                // The table is what was asked for.
                Err(error) => report.notes.push(Note { topic: "figures", text: error.to_string() }),
            }
        }
        write_file(self.folder.file(REPORT), self.record.json(&report)?.as_bytes())?;
        progress.tell(&format!("wrote {}", self.folder.file(TABLE).display()));
        Ok(report)
    }

    /// A note on generations in the folder that are not among those of the plan, as of one that had more.
    fn left_out(&self) -> Option<Note> {
        let text = match self.folder.asked_from(self.search.file().generations) {
            0 => return None,
            1 => "1 later generation in the folder is left out".to_owned(),
            later => format!("{later} later generations in the folder are left out"),
        };
        Some(Note { topic: "generations", text })
    }

    /// Draws the figures, and returns the names of their files.
    fn drawn(&self) -> Result<Vec<String>, TaskError> {
        let objectives = &self.search.file().objectives;
        let drawn = figure::all(objectives, &self.course.told, &self.course.front);
        let Some(figure) = drawn else { return Ok(Vec::new()) };
        let mut names = Vec::new();
        for (name, bytes) in figures::files(&self.columns.fit(vec![figure]))? {
            write_file(self.folder.file(&name), &bytes)?;
            names.push(name);
        }
        Ok(names)
    }
}

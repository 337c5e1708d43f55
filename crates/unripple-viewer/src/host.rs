//! Threads that run the session and the computations beside it, and the notices that links send to pages.

use crate::jobs::Jobs;
use crate::notices::{Notice, Notices};
use crate::{View, ViewError};
use std::collections::{BTreeMap, VecDeque};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use unripple_session::{
    Command, Done, Errand, Instrument, Measured, Out, Session, Settled, Spec, Stop, Task, lock, refusal,
    stopped,
};
use unripple_tasks::{Lane, Silent};

/// Pictures per second: as many as most screens show smoothly. Each costs a product of matrices.
const FRAMES: f64 = 30.0;

/// Most of a picture's time that the surface may take to catch up. The rest of the time goes to the picture and to
/// what pages say.
const BUSY: f64 = 0.8;

/// Least time between two pictures, so that what pages say is heard between them.
const BREATH: Duration = Duration::from_millis(2);

/// How many builds that were given up may still run while the next begins, each with its memory and cores: it must not wait for the modes of
/// a surface that nobody wants any more.
const BESIDE: usize = 1;

/// Messages to the session's thread.
enum Word {
    Come,
    Leave(u64),
    Hear(u64, Command),
    Load(String, tokio::sync::oneshot::Sender<Result<(), String>>),
    Done(Done),
    Stop,
}

/// Files of measurements that are kept: the newest of each of so many pages. A long drive takes some megabytes.
const KEPT: usize = 16;

/// The links of pages, by number, for answers to one page alone.
type Links = Arc<Mutex<BTreeMap<u64, tokio::sync::mpsc::Sender<String>>>>;

/// The running session: its threads, and the notices and links by which pages reach it.
pub struct SessionHost {
    /// Newest messages and pictures for all pages.
    pub notices: Arc<Notices>,
    words: Sender<Word>,
    links: Links,
    jobs: Arc<Jobs>,
    measured: Arc<Mutex<VecDeque<Measured>>>,
    /// The thread that runs the session and plays the surface.
    playing: Mutex<Option<JoinHandle<()>>>,
    quiet: bool,
}

impl SessionHost {
    /// Builds the instrument of a surface and starts all threads. `elsewhere` is the URL for other machines, if they
    /// can connect.
    ///
    /// # Errors
    /// Those of [`Instrument::build`]; [`ViewError::Gone`] if a thread cannot be started.
    pub fn open(view: &View, elsewhere: Option<String>) -> Result<Arc<Self>, ViewError> {
        let instrument = Instrument::build(view.spec(), &mut Silent)?;
        let told =
            Settled { source: view.source.clone(), device: view.device_name.clone(), address: elsewhere };
        let session = Session::new(instrument, told);
        let known = (view.source.clone(), view.respond.clone(), view.without_scale.clone());
        let mut compute = session.compute(known);
        let (words, heard) = channel();
        let (building, specs) = channel::<(Box<Spec>, Stop)>();
        let (computing, tasks) = channel::<(Task, Stop)>();
        // Whoever has gone is at the program's end.
        let say = words.clone();
        thread("builder", move || {
            let lane = Lane::new(BESIDE);
            for (spec, stop) in specs {
                let _ = say.send(Word::Done(Errand::build(spec, &stop, &lane)));
            }
        })?;
        let say = words.clone();
        thread("compute", move || {
            for (task, stop) in tasks {
                let hear = &mut |found| drop(say.send(Word::Done(Done::Found(found))));
                compute.work(task, &mut stop.watch(), hear);
                let _ = say.send(Word::Done(Done::Computed));
            }
        })?;
        let (notices, links) = (Arc::new(Notices::new()), Links::default());
        let measured = Arc::new(Mutex::new(VecDeque::new()));
        let jobs = Arc::new(Jobs::new(notices.clone(), view.folder.clone()));
        let mut stage = Stage {
            session,
            building,
            computing,
            notices: notices.clone(),
            links: links.clone(),
            measured: measured.clone(),
            jobs: jobs.clone(),
        };
        // The first page that asks gets the surface as well.
        stage.pass_on();
        let playing = Mutex::new(Some(thread("surface", move || stage.run(&heard))?));
        Ok(Arc::new(Self { notices, words, links, jobs, measured, playing, quiet: view.quiet }))
    }

    /// Adds a page. `told` receives the messages for this page alone, such as the reasons why its requests
    /// are refused.
    pub fn come(&self, page: u64, told: tokio::sync::mpsc::Sender<String>) {
        lock(&self.links).insert(page, told);
        self.say(Word::Come);
    }

    /// Removes a page; its fingers are lifted, and the computations that it requested are cancelled.
    pub fn leave(&self, page: u64) {
        lock(&self.links).remove(&page);
        self.say(Word::Leave(page));
    }

    /// Passes on a command of a page, given by its number. Commands are carried out in the order in which they come.
    pub fn obey(&self, page: u64, command: Command) {
        self.say(Word::Hear(page, command));
    }

    /// Tells a page, given by its number, why a request is refused.
    pub fn refuse(&self, page: u64, why: &str) {
        refuse(&self.links, page, why);
    }

    /// Replaces the surface by one read from the text of a surface file.
    ///
    /// # Errors
    /// All faults of the file, as text.
    pub async fn load(&self, text: String) -> Result<(), String> {
        let (answer, loaded) = tokio::sync::oneshot::channel();
        self.say(Word::Load(text, answer));
        loaded.await.unwrap_or_else(|_| Err("the program is ending".into()))
    }

    /// The present surface, as the text of its file.
    pub fn toml(&self) -> String {
        toml(&self.notices)
    }

    /// Files of the newest measurement that any page has requested, or of the newest of each page that with a page's own number
    /// for it: a focus, computed and evaluated.
    pub fn measured(&self, id: Option<&str>) -> Option<Measured> {
        let named = |measured: &&Measured| id.is_none_or(|id| id == measured.id.to_string());
        lock(&self.measured).iter().rev().find(named).cloned()
    }

    /// Prints a line on standard error, unless the viewer is quiet.
    pub fn log(&self, line: &str) {
        if !self.quiet {
            eprintln!("{line}");
        }
    }

    /// Stops jobs and playing; returns once the device is closed.
    ///
    /// # Errors
    /// [`ViewError::Gone`] if the thread that plays failed before.
    pub fn close(&self) -> Result<(), ViewError> {
        self.say(Word::Stop);
        self.jobs.close();
        let ended = lock(&self.playing).take().map_or(Ok(()), JoinHandle::join);
        ended.map_err(|_| ViewError::Gone { why: "the surface's own failed".into() })
    }

    fn say(&self, word: Word) {
        // A thread that has gone has said why, and the program is at its end.
        let _ = self.words.send(word);
    }
}

/// The surface that pages are shown, as the text of its file.
fn toml(notices: &Notices) -> String {
    let Some(Notice::Text(text)) = notices.newest("surface") else { return String::new() };
    unripple_session::toml(&text)
}

/// Tells a page why something is refused.
fn refuse(links: &Links, page: u64, why: &str) {
    say(links, page, refusal(why));
}

/// Answers one page, unless so much waits to be told that it would be no use.
fn say(links: &Links, page: u64, text: String) {
    if let Some(told) = lock(links).get(&page) {
        let _ = told.try_send(text);
    }
}

/// Keeps a measurement in place of the last one of its page.
fn keep(kept: &mut VecDeque<Measured>, files: Measured) {
    kept.retain(|measured| measured.page != files.page);
    kept.push_back(files);
    if kept.len() > KEPT {
        kept.pop_front();
    }
}

/// The thread on which the session runs.
struct Stage {
    session: Session,
    building: Sender<(Box<Spec>, Stop)>,
    computing: Sender<(Task, Stop)>,
    notices: Arc<Notices>,
    links: Links,
    measured: Arc<Mutex<VecDeque<Measured>>>,
    jobs: Arc<Jobs>,
}

impl Stage {
    /// Runs the session until it is stopped, or until nothing can send to it any more.
    fn run(mut self, words: &Receiver<Word>) {
        let mut due = Instant::now();
        let mut passed = Instant::now();
        loop {
            match words.recv_timeout(due.saturating_duration_since(Instant::now())) {
                Ok(Word::Stop) | Err(RecvTimeoutError::Disconnected) => return,
                Ok(word) => {
                    self.take(word);
                    // Words that come faster than pictures must not keep them waiting.
                    if Instant::now() < due {
                        continue;
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
            let seconds = passed.elapsed().as_secs_f64();
            passed = Instant::now();
            due = passed.max(due) + Duration::from_secs_f64(1.0 / FRAMES);
            due = due.max(passed + BREATH);
            let began = Instant::now();
            let mut more = || began.elapsed().as_secs_f64() <= BUSY / FRAMES;
            self.session.advance(seconds, self.notices.viewers(), &mut more);
            self.pass_on();
        }
    }

    fn take(&mut self, word: Word) {
        match word {
            Word::Come => self.session.come(),
            Word::Leave(page) => self.session.leave(page),
            Word::Hear(page, Command::Job(job)) => {
                // It is done on the surface as it was edited just before.
                self.session.renew();
                self.pass_on();
                if let Err(why) = self.jobs.obey(&job, toml(&self.notices)) {
                    refuse(&self.links, page, &why);
                }
            }
            Word::Hear(page, command) => self.session.hear(page, command),
            Word::Load(text, answer) => {
                let loaded = self.session.load(&text);
                self.pass_on();
                // The page may have gone meanwhile.
                let _ = answer.send(loaded);
            }
            Word::Done(done) => self.session.done(done),
            Word::Stop => {}
        }
        self.pass_on();
    }

    /// Passes on the session's messages and the work that it wants done.
    fn pass_on(&mut self) {
        while let Some(errand) = self.session.errand() {
            // Whoever has gone is at the program's end.
            let _ = match errand {
                Errand::Build(spec, stop) => self.building.send((spec, stop)).is_ok(),
                Errand::Compute(task, stop) => self.computing.send((task, stop)).is_ok(),
            };
        }
        for out in self.session.take() {
            match out {
                Out::Text(kind, text) => self.notices.post(&kind, Notice::Text(text.into())),
                Out::Frame(kind, bytes, picture) => {
                    self.notices.post(&kind, Notice::Frame(bytes.into(), picture))
                }
                Out::Withdraw(kind) => self.notices.withdraw(&kind),
                Out::Refuse(page, why) => refuse(&self.links, page, &why),
                Out::Stopped(page, id) => say(&self.links, page, stopped(id)),
                Out::Answer(page, text) => say(&self.links, page, text),
                Out::Measured(files) => keep(&mut lock(&self.measured), *files),
            }
        }
    }
}

fn thread(name: &str, work: impl FnOnce() + Send + 'static) -> Result<JoinHandle<()>, ViewError> {
    let spawned = std::thread::Builder::new().name(name.into()).spawn(work);
    spawned.map_err(|error| ViewError::Gone { why: error.to_string() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use unripple::focus::Method;
    use unripple::physics::design::papers_surface;

    #[test]
    fn whoever_asks_first_is_told_of_the_surface() {
        let mut surface = papers_surface();
        surface.emission.band[1] = 300.0;
        let view = View {
            surface,
            stored: None,
            without_scale: None,
            respond: None,
            source: "small".into(),
            method: Method::TimeReversal,
            device: None,
            follow: None,
            device_name: "virtual".into(),
            address: ([127, 0, 0, 1], 0).into(),
            token: None,
            framed_by: Vec::new(),
            folder: std::env::temp_dir(),
            quiet: true,
        };
        for _ in 0..20 {
            let host = SessionHost::open(&view, None).unwrap();
            assert!(host.toml().contains("band_hz = [0, 300]"), "{}", host.toml());
            host.close().unwrap();
        }
    }
}

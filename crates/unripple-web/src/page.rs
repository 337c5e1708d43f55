//! One page's session, with what a server does around it.

use std::collections::VecDeque;
use std::time::Duration;
use unripple::core::Surface;
use unripple::core::clock::Instant;
use unripple_session::{
    Command, ComputeWorker, Done, Errand, Held, Instrument, Measured, Out, Picture, Session, Settled, Spec,
    ViewError, refusal, stopped, toml,
};
use unripple_tasks::{Lane, Silent};

/// Number of the only page.
const PAGE: u64 = 1;

/// Longest time that the surface is stepped at a tick, in s: most of the thirtieth of a second between two pictures. The rest of it goes to
/// the picture and to what the page says.
const BUSY: f64 = 0.8 / 30.0;

/// Number of pictures that may be sent before the page says that it has drawn them, and the time after which a page that says nothing is
/// sent one all the same, as a hidden page is.
const UNSEEN: u64 = 4;
const UNSURE: Duration = Duration::from_secs(1);

/// A message to the page.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A message as JSON.
    Text(String),
    /// A picture as encoded bytes.
    Frame(Vec<u8>),
}

/// A session and its only page.
pub struct Page {
    session: Session,
    compute: ComputeWorker,
    lane: Lane,
    out: VecDeque<Message>,
    /// When time last passed.
    passed: Instant,
    /// Numbers of the newest pictures that were sent, and that the page says it has drawn; when the former was sent.
    shown: u64,
    seen: u64,
    sent: Instant,
    held: Held<Vec<u8>>,
    /// The message that describes the present surface, and the files of the newest measurement.
    surface: String,
    measured: Option<Measured>,
}

impl Page {
    /// A session that simulates a surface; `source` is its name on the command line.
    ///
    /// # Errors
    /// Those of [`Instrument::build`].
    pub fn open(surface: Surface, source: String) -> Result<Self, ViewError> {
        let instrument = Instrument::build(Spec::simulated(surface), &mut Silent)?;
        let told = Settled { source: source.clone(), device: "virtual".into(), address: None };
        let mut session = Session::new(instrument, told);
        let compute = session.compute((source, None, None));
        session.come();
        let now = Instant::now();
        let mut page = Self {
            session,
            compute,
            lane: Lane::new(0),
            out: VecDeque::new(),
            passed: now,
            shown: 0,
            seen: 0,
            sent: now,
            held: Held::default(),
            surface: String::new(),
            measured: None,
        };
        page.collect();
        Ok(page)
    }

    /// Carries out a message of the page; what is refused is answered with the reason.
    pub fn hear(&mut self, text: &str) {
        match Command::read(text) {
            Ok(Command::Seen { frame }) => self.seen = self.seen.max(frame.min(self.shown)),
            Ok(Command::Job(_)) => {
                self.refuse("jobs: expected the program on your machine, found a page without one");
            }
            Ok(command) => self.session.hear(PAGE, command),
            Err(error) => self.refuse(&error.to_string()),
        }
        self.collect();
    }

    /// Replaces the surface by one read from the text of a surface file.
    ///
    /// # Errors
    /// All faults of the file, as text.
    pub fn load(&mut self, text: &str) -> Result<(), String> {
        let loaded = self.session.load(text);
        self.collect();
        loaded
    }

    /// Lets the time pass that has passed by the clock since the last tick.
    pub fn tick(&mut self) {
        let now = Instant::now();
        let seconds = now.duration_since(self.passed).as_secs_f64();
        self.passed = now;
        self.session.advance(seconds, 1, &mut || now.elapsed().as_secs_f64() <= BUSY);
        self.collect();
    }

    /// Does one piece of the long work that the session wants done, and returns whether there was one. Messages that wait should be sent
    /// before.
    pub fn work(&mut self) -> bool {
        let Some(errand) = self.session.errand() else { return false };
        match errand {
            Errand::Build(spec, stop) => self.session.done(Errand::build(spec, &stop, &self.lane)),
            Errand::Compute(task, stop) => {
                let session = &mut self.session;
                let hear = &mut |found| session.done(Done::Found(found));
                self.compute.work(task, &mut stop.watch(), hear);
                self.session.done(Done::Computed);
            }
        }
        self.collect();
        true
    }

    /// Removes and returns the oldest message that waits to be sent to the page.
    pub fn take(&mut self) -> Option<Message> {
        self.out.pop_front()
    }

    /// The bytes of a file that the page may save: `surface.toml`, or of the newest measurement `drive.wav`, `report.json` and `report.md`.
    /// With a number, only those of the measurement with that number.
    pub fn file(&self, name: &str, id: Option<u64>) -> Option<Vec<u8>> {
        if name == "surface.toml" {
            return Some(toml(&self.surface).into_bytes());
        }
        let measured = self.measured.as_ref().filter(|measured| id.is_none_or(|id| id == measured.id))?;
        match name {
            "drive.wav" => Some(measured.drive.clone()),
            "report.json" => Some(measured.json.clone().into_bytes()),
            "report.md" => Some(measured.markdown.clone().into_bytes()),
            _ => None,
        }
    }

    /// Sends a picture, or the one that was held where more moves in that; holds it while the page draws others.
    fn show(&mut self, bytes: Vec<u8>, picture: Picture) {
        let full = self.shown.saturating_sub(self.seen) >= UNSEEN && self.sent.elapsed() < UNSURE;
        if let Some((bytes, picture)) = self.held.pass(bytes, picture, full) {
            (self.shown, self.sent) = (picture.number, Instant::now());
            self.out.push_back(Message::Frame(bytes));
        }
    }

    fn refuse(&mut self, why: &str) {
        self.out.push_back(Message::Text(refusal(why)));
    }

    /// Takes over what the session has for pages.
    fn collect(&mut self) {
        for out in self.session.take() {
            match out {
                Out::Text(kind, text) => {
                    if kind == "surface" {
                        self.surface.clone_from(&text);
                    }
                    self.out.push_back(Message::Text(text));
                }
                Out::Frame(_, bytes, picture) => self.show(bytes, picture),
                // Only a page that comes later would still be sent it.
                Out::Withdraw(_) => {}
                Out::Refuse(_, why) => self.refuse(&why),
                Out::Stopped(_, id) => self.out.push_back(Message::Text(stopped(id))),
                Out::Answer(_, text) => self.out.push_back(Message::Text(text)),
                Out::Measured(files) => self.measured = Some(*files),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;
    use unripple::physics::design::papers_surface;
    use unripple_store::parse_surface;

    fn page() -> Page {
        let mut surface = papers_surface();
        surface.emission.band[1] = 300.0;
        Page::open(surface, "small".into()).unwrap()
    }

    /// The messages of a kind among those that wait.
    fn told(page: &mut Page, kind: &str) -> Vec<Value> {
        let said = std::iter::from_fn(|| page.take());
        let text = |message| match message {
            Message::Text(text) => serde_json::from_str(&text).ok(),
            Message::Frame(_) => None,
        };
        said.filter_map(text).filter(|value: &Value| value["is"] == kind).collect()
    }

    #[test]
    fn what_is_measured_is_told_and_can_be_saved() {
        let mut page = page();
        assert_eq!(page.file("report.json", None), None);
        page.hear(r#"{"do":"measure","id":7,"at":[[62,90]]}"#);
        while page.work() {}
        let measured = told(&mut page, "measured");
        assert_eq!(measured.len(), 1);
        let report: Value = serde_json::from_slice(&page.file("report.json", Some(7)).unwrap()).unwrap();
        assert_eq!(report["contrast"], measured[0]["report"]["contrast"]);
        assert!(page.file("drive.wav", None).unwrap().starts_with(b"RIFF"));
        assert_eq!(page.file("report.md", Some(8)), None);
    }

    #[test]
    fn an_edit_is_built_and_its_surface_saved() {
        let mut page = page();
        page.hear(r#"{"do":"edit","thickness_mm":0.2}"#);
        while page.work() {}
        let built: Vec<bool> = told(&mut page, "building").iter().map(|told| told["on"] == true).collect();
        assert_eq!(built, [true, false]);
        let text = String::from_utf8(page.file("surface.toml", None).unwrap()).unwrap();
        let surface = parse_surface(&text, "saved").unwrap();
        assert!(text.contains("thickness_mm = 0.2"), "{text}");
        assert_eq!(page.load(&text), Ok(()));
        assert!(page.load("nothing").is_err());
        assert_eq!(surface.emission.band[1], 300.0);
    }

    #[test]
    fn what_is_no_command_is_refused_in_words() {
        let mut page = page();
        for refused in [
            r#"{"do":"measure","id":1,"at":[]}"#,
            r#"{"do":"job","start":"doctor"}"#,
            r#"{"do":"open","name":"nothing"}"#,
        ] {
            page.hear(refused);
            let faults = told(&mut page, "fault");
            assert!(
                faults.len() == 1 && faults[0]["text"].as_str().unwrap().contains("expected"),
                "{faults:?}"
            );
        }
    }

    #[test]
    fn a_page_that_draws_nothing_is_sent_no_more() {
        let mut page = page();
        let frames = |page: &mut Page| {
            for _ in 0..10 {
                page.session.advance(1.0 / 30.0, 1, &mut || true);
                page.collect();
            }
            std::iter::from_fn(|| page.take()).filter(|message| matches!(message, Message::Frame(_))).count()
        };
        page.hear(r#"{"do":"touch","finger":0,"phase":"down","at_mm":[62,90]}"#);
        let most = frames(&mut page);
        assert!(most > 0 && most < 10, "{most}");
        let seen = page.shown;
        page.hear(&format!(r#"{{"do":"seen","frame":{seen}}}"#));
        assert!(frames(&mut page) > 0);
    }
}

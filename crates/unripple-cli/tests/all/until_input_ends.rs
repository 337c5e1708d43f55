//! A viewer ends with its standard input where it is asked to, so that it does not outlive a program that started it and was killed.

use crate::common;

use common::{SMALL_FILM, Scratch};
use std::io::{BufRead, BufReader};
use std::process::{Child, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// How long a viewer goes on that nothing ends: several times what one takes that ends.
const GOES_ON: Duration = Duration::from_secs(1);

/// How long a viewer may take to end, on a busy machine.
const ENDS: Duration = Duration::from_secs(20);

/// A viewer whose page can be opened, killed with this.
struct Viewer(Child);

impl Viewer {
    fn new(film: &str, more: &[&str], input: Stdio) -> Self {
        let mut command = common::program();
        command.args(["view", film, "--port", "0", "--no-browser"]).args(more);
        command.stdin(input).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let mut url = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut url).unwrap();
        let viewer = Self(child);
        assert!(url.starts_with("http://127.0.0.1:"), "{url}");
        viewer
    }

    /// How it ended, if it does within some time.
    fn ended_within(&mut self, time: Duration) -> Option<ExitStatus> {
        let began = Instant::now();
        loop {
            match self.0.try_wait().unwrap() {
                None if began.elapsed() < time => std::thread::sleep(Duration::from_millis(20)),
                status => return status,
            }
        }
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        // One that has ended cannot be ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn a_viewer_ends_with_its_input_only_where_it_is_asked_to() {
    let scratch = Scratch::new("input");
    let film = scratch.file("film.toml", SMALL_FILM);
    // As a service has it, and `nohup`.
    let mut plain = Viewer::new(&film, &[], Stdio::null());
    let mut asked = Viewer::new(&film, &["--until-input-ends"], Stdio::piped());
    assert_eq!(plain.ended_within(GOES_ON), None);
    assert_eq!(asked.ended_within(Duration::ZERO), None);
    drop(asked.0.stdin.take());
    let status = asked.ended_within(ENDS);
    assert!(status.is_some_and(|status| status.success()), "{status:?}");
    assert_eq!(plain.ended_within(Duration::ZERO), None);
}

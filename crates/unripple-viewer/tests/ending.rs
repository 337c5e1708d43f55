//! A viewer that is told to stop leaves nothing behind.
#![cfg(unix)]

mod common;

use common::{Served, until};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tungstenite::Message;

/// A program in the viewer's place that begins something and puts it away when it is asked to end, or does not listen.
fn program(folder: &Path, heeds: bool) -> PathBuf {
    let path = folder.join(if heeds { "heeds" } else { "deaf" });
    let trap = if heeds { "trap 'rm begun; exit 1' TERM" } else { "trap '' TERM" };
    let text = format!(
        "#!/bin/sh\ncd {}\n{trap}\ntouch begun\necho $$ > pid\nwhile :; do sleep 0.05; done\n",
        folder.display()
    );
    std::fs::write(&path, text).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
    path
}

/// Files of jobs of this process that are left.
fn sheets() -> Vec<PathBuf> {
    let own = format!("unripple-view-{}-", std::process::id());
    let all = std::fs::read_dir(std::env::temp_dir()).unwrap();
    let all = all.filter_map(|entry| entry.ok().map(|entry| entry.path()));
    all.filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(&own))).collect()
}

/// Starts a job with a program, waits until it is under way, and stops the viewer.
fn stopped(heeds: bool) -> (tempfolder::Folder, i32) {
    let folder = tempfolder::Folder::new(if heeds { "heeds" } else { "deaf" });
    let mut served = Served::with(None, |view| view.program = program(folder.path(), heeds));
    let mut page = served.page();
    page.send(Message::text(r#"{"do":"job","start":"calibrate","name":"x"}"#)).unwrap();
    let pid = loop {
        until(&mut page, "job");
        let pid = std::fs::read_to_string(folder.path().join("pid")).ok();
        if let Some(pid) = pid.and_then(|text| text.trim().parse().ok()) {
            break pid;
        }
    };
    assert!(!sheets().is_empty());
    served.stop();
    // What is open when it ends is cut.
    assert!((0..100_000).any(|_| page.read().is_err()));
    (folder, pid)
}

mod tempfolder {
    use std::path::{Path, PathBuf};

    /// A folder that is gone when it is dropped.
    pub struct Folder(PathBuf);

    impl Folder {
        pub fn new(name: &str) -> Self {
            let path = std::env::temp_dir().join(format!("viewer-ending-{name}-{}", std::process::id()));
            std::fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        pub fn path(&self) -> &Path {
            &self.0
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = std::fs::remove_dir_all(&self.0);
        }
    }
}

#[test]
fn jobs_put_away_what_they_have_begun_and_end_with_the_viewer() {
    let (folder, _) = stopped(true);
    assert!(
        !folder.path().join("begun").exists(),
        "the job was ended before it could put away what it had begun"
    );
    let (deaf, pid) = stopped(false);
    assert!(deaf.path().join("begun").exists());
    assert!(!Path::new(&format!("/proc/{pid}")).exists(), "a job that does not listen is still there");
    assert_eq!(sheets(), Vec::<PathBuf>::new());
}

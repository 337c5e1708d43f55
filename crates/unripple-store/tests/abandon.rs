//! Ending a program in the middle of its work: what is under construction goes, whoever is writing at that moment.

use std::fs;
use std::sync::Arc;
use std::time::Duration;
use unripple_store::{MARKER, OutputDir, abandon_all, new_file};

#[test]
fn nothing_comes_back_while_threads_write() {
    let scratch = std::env::temp_dir().join(format!("unripple-abandon-{}", std::process::id()));
    fs::create_dir(&scratch).unwrap();
    let place = scratch.join("a/out");
    OutputDir::create(&place).unwrap().commit().unwrap();
    let out = Arc::new(OutputDir::create(&place).unwrap());
    let deep = OutputDir::create(scratch.join("b/c/out")).unwrap();
    let (recording, unused) = new_file(scratch.join("taps.jsonl")).unwrap();
    for thread in 0..4 {
        let out = out.clone();
        std::thread::spawn(move || {
            for count in 0.. {
                if out.write(&format!("{thread}-{count}"), &[7; 1 << 14]).is_err() {
                    return;
                }
            }
        });
    }
    // Until all of them are in the middle of it.
    while fs::read_dir(out.path()).unwrap().count() < 100 {
        std::thread::sleep(Duration::from_millis(1));
    }
    let abandoned = abandon_all();
    for _ in 0..20 {
        let names = |path: &str| {
            let mut names: Vec<_> =
                fs::read_dir(scratch.join(path)).unwrap().map(|entry| entry.unwrap().file_name()).collect();
            names.sort();
            names
        };
        assert_eq!(
            (names(""), names("a"), names("a/out")),
            (vec!["a".into()], vec!["out".into()], vec![MARKER.into()])
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    // As at the end of a program: nobody gets the lock again.
    std::mem::forget((abandoned, deep, unused, recording, out));
    fs::remove_dir_all(&scratch).unwrap();
}

//! Truth: a cache on disk gives back what was stored or nothing, whoever else uses it and whoever is killed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use unripple_core::{Cache, Random};
use unripple_store::DiskCache;

/// The variable that names the folder for a child, which then uses the cache until it is killed.
const FOLDER: &str = "UNRIPPLE_TEST_CACHE";

/// Number of keys that all programs use.
const KEYS: u64 = 4;

/// Largest number of bytes of an entry: large enough that a kill falls into the writing.
const LARGEST: f64 = 4e6;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("unripple-cache-{name}-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    folder
}

fn cache(folder: &Path) -> DiskCache {
    DiskCache::new(folder, 1 << 30, "test")
}

/// What is stored under a key: any of three lengths, of bytes that follow from the key.
fn content(key: u64, length: usize) -> Vec<u8> {
    let mut random = Random::seeded(1 + key);
    let some: Vec<u8> = (0..1024).map(|_| random.between(0.0, 256.0) as u8).collect();
    some.iter().copied().cycle().take(length).collect()
}

/// Whether an entry is absent or whole.
fn is_right(cache: &DiskCache, key: u64) -> bool {
    cache.read(&key.to_string()).is_none_or(|found| found == content(key, found.len()) && found.len() > 1000)
}

/// Stores and reads without end.
fn use_without_end(folder: &Path) {
    let cache = cache(folder);
    let mut random = Random::seeded(u64::from(std::process::id()));
    loop {
        let key = random.between(0.0, KEYS as f64) as u64;
        cache.write(&key.to_string(), &content(key, random.between(2000.0, LARGEST) as usize));
        assert!(is_right(&cache, key), "an entry is neither whole nor absent");
    }
}

/// Another program that uses the cache in a folder.
fn user(folder: &Path) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--nocapture", "programs_that_are_killed_while_they_write_leave_whole_entries"])
        .env(FOLDER, folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn programs_that_are_killed_while_they_write_leave_whole_entries() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        use_without_end(Path::new(&folder));
    }
    let folder = folder("killed");
    let mut random = Random::seeded(11);
    let cache = cache(&folder);
    let (mut found, mut parts) = (0, 0);
    for _ in 0..50 {
        let mut users = [user(&folder), user(&folder)];
        std::thread::sleep(Duration::from_secs_f64(random.between(0.03, 0.2)));
        for user in &mut users {
            user.kill().unwrap();
            let output = std::io::read_to_string(user.stderr.take().unwrap()).unwrap();
            user.wait().unwrap();
            assert!(!output.contains("panicked"), "{output}");
        }
        for key in 0..KEYS {
            assert!(is_right(&cache, key), "an entry is neither whole nor absent");
            found += usize::from(cache.read(&key.to_string()).is_some());
        }
        parts += fs::read_dir(&folder)
            .unwrap()
            .filter(|file| {
                file.as_ref().is_ok_and(|file| file.path().extension().is_some_and(|end| end == "part"))
            })
            .count();
    }
    println!("{found} whole entries, {parts} parts left in 50 rounds");
    assert!(found > 50 && parts > 10, "{found} {parts}");
    cache.empty().unwrap();
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
    fs::remove_dir(folder).unwrap();
}

#[test]
fn damaged_entries_are_none_and_removed() {
    let folder = folder("damaged");
    let cache = cache(&folder);
    let right = content(0, 5000);
    let mut random = Random::seeded(3);
    for round in 0..200 {
        cache.write("0", &right);
        assert_eq!(cache.read("0").as_ref(), Some(&right));
        let path = fs::read_dir(&folder).unwrap().next().unwrap().unwrap().path();
        let mut bytes = fs::read(&path).unwrap();
        let at = random.between(0.0, bytes.len() as f64) as usize;
        match round % 4 {
            0 => bytes.truncate(at),
            1 => bytes[at] ^= 1 << (round % 8),
            2 => bytes.extend(content(1, 1 + at)),
            _ => bytes[at..].fill(0),
        }
        fs::write(&path, &bytes).unwrap();
        assert_eq!(cache.read("0"), None, "round {round}");
        assert!(!path.exists());
    }
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_was_not_used_for_longest_goes_first() {
    let folder = folder("limit");
    let cache = DiskCache::new(&folder, 35_000, "test");
    let pause = || std::thread::sleep(Duration::from_millis(15));
    for key in 0..3 {
        cache.write(&key.to_string(), &content(key, 10_000));
        pause();
    }
    assert!(cache.read("0").is_some());
    pause();
    cache.write("3", &content(3, 10_000));
    let there: Vec<u64> = (0..4).filter(|key| cache.read(&key.to_string()).is_some()).collect();
    assert_eq!(there, [0, 2, 3]);
    // What is larger than the whole is not stored, and drives nothing out.
    cache.write("4", &content(4, 40_000));
    assert!(cache.read("4").is_none() && cache.read("0").is_some());
    assert_eq!(cache.usage().unwrap().entries, 3);
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn files_of_others_are_left_alone() {
    let folder = folder("others");
    fs::create_dir_all(&folder).unwrap();
    let others = ["film.iso.part", "notes.entry", "0123456789abcdef.entry"].map(|name| folder.join(name));
    others.iter().for_each(|path| fs::write(path, "somebody's").unwrap());
    let cache = DiskCache::new(&folder, 15_000, "test");
    (0..3).for_each(|key| cache.write(&key.to_string(), &content(key, 10_000)));
    assert_eq!(cache.usage().unwrap().entries, 1);
    cache.empty().unwrap();
    assert!(others.iter().all(|path| path.exists()));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), others.len());
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_file_that_cannot_be_removed_stays_and_others_go() {
    let folder = folder("stuck");
    let cache = DiskCache::new(&folder, 25_000, "test");
    cache.write("0", &content(0, 10_000));
    let path = fs::read_dir(&folder).unwrap().next().unwrap().unwrap().path();
    // A folder in the place of an entry is no file, and not the cache's.
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    (1..6).for_each(|key| cache.write(&key.to_string(), &content(key, 10_000)));
    assert_eq!(cache.usage().unwrap().entries, 2);
    assert!(cache.read("0").is_none() && cache.read("5").is_some());
    fs::remove_dir_all(folder).unwrap();
}

#[cfg(unix)]
#[test]
fn where_nothing_can_be_written_nothing_is_stored() {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let cache = cache(Path::new(&folder));
        for key in 0..KEYS {
            cache.write(&key.to_string(), &content(key, 100_000));
            assert_eq!(cache.read(&key.to_string()), None);
        }
        cache.write("small", &content(0, 2000));
        assert!(cache.read("small").is_some());
        return;
    }
    // As a full disk does, files of more than 16 KiB fail while they are written.
    let folder = folder("full");
    let command =
        "trap '' XFSZ; ulimit -f 16; exec \"$0\" --exact where_nothing_can_be_written_nothing_is_stored";
    let mut shell = Command::new("bash");
    let output = shell
        .args(["-c", command])
        .arg(std::env::current_exe().unwrap())
        .env(FOLDER, &folder)
        .output()
        .unwrap();
    let told =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && told.contains("1 passed"), "{told}");
    assert_eq!(cache(&folder).usage().unwrap().entries, 1);
    // Nothing is left of what failed.
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
    fs::remove_dir_all(&folder).unwrap();
    // A file where the folder should be.
    fs::write(&folder, "").unwrap();
    cache(&folder).write("0", &content(0, 2000));
    assert_eq!(cache(&folder).read("0"), None);
    fs::remove_file(folder).unwrap();
}

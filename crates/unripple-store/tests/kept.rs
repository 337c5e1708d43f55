//! Drives that were kept: replaced while they are as they were written, and nothing else is.

use std::fs;
use std::path::PathBuf;
use unripple_core::Drive;
use unripple_store::{StoreError, check_kept_wav, read_wav, write_kept_wav, write_wav};

#[test]
fn a_kept_drive_is_replaced_until_somebody_changes_it() {
    let scratch = std::env::temp_dir().join(format!("unripple-kept-{}", std::process::id()));
    fs::create_dir(&scratch).unwrap();
    let path = scratch.join("drive.wav");
    let drive =
        Drive::new(48e3, vec!["a".into(), "b".into()], vec![vec![0.5, -0.25], vec![0.0, 1.0]]).unwrap();
    assert!(!check_kept_wav(&path, &[]).unwrap());
    assert!(!write_kept_wav(&path, &[], &drive).unwrap().replaced);
    assert_eq!(read_wav(&path).unwrap().into_drive(drive.names(), "drive.wav").unwrap(), drive);
    let bytes = fs::read(&path).unwrap();
    assert_eq!(bytes.len() as u32 - 8, u32::from_le_bytes(bytes[4..8].try_into().unwrap()));
    assert!(write_kept_wav(&path, &[], &drive).unwrap().replaced);

    let read: Vec<PathBuf> = vec![path.clone()];
    assert!(matches!(write_kept_wav(&path, &read, &drive), Err(StoreError::Reads { .. })));
    let refused =
        |path: &PathBuf| matches!(write_kept_wav(path, &[], &drive), Err(StoreError::Occupied { .. }));
    for at in 8..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 1;
        fs::write(&path, &changed).unwrap();
        assert!(refused(&path), "a change at {at}");
    }
    fs::write(&path, &bytes[..bytes.len() - 1]).unwrap();
    assert!(refused(&path));
    write_wav(&path, &drive).unwrap();
    assert!(refused(&path) && refused(&scratch));
    assert_eq!(fs::read_dir(&scratch).unwrap().count(), 1);
    fs::remove_dir_all(&scratch).unwrap();
}

//! Named arrays of numpy and of MATLAB: every type of number, both orders of axes, texts, and faults.

use crate::archive::{npy, zip};
use miniz_oxide::deflate::compress_to_vec_zlib;
use unripple_exchange::{Array, Arrays, Values, read_mat, read_npz, write_mat};

fn one(descr: &str, first_fastest: bool, shape: &str, values: &[u8]) -> Array {
    let file = zip(&[("a.npy", npy(descr, first_fastest, shape, values))], true);
    read_npz(&file, "t.npz").unwrap().remove("a").unwrap()
}

fn refused(file: &[u8]) -> String {
    read_npz(file, "t.npz").unwrap_err().to_string()
}

#[test]
fn every_type_of_numpy_is_read() {
    let floats: Vec<u8> = [1.5_f32, -2.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(one("<f4", false, "(2,)", &floats), Array::real(&[2], vec![1.5, -2.0]));
    let turned: Vec<u8> = [1.5_f64, -2.0].iter().flat_map(|x| x.to_be_bytes()).collect();
    assert_eq!(one(">f8", false, "(1, 2)", &turned), Array::real(&[1, 2], vec![1.5, -2.0]));
    assert_eq!(one("<c16", false, "()", &turned).values.len(), 1);
    let complex: Vec<u8> = [1.5_f32, -2.0, 0.0, 1.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(one("<c8", false, "(2,)", &complex).values, Values::Complex(vec![[1.5, -2.0], [0.0, 1.0]]));
    for (descr, bytes, number) in [
        ("|i1", &[0xff][..], -1.0),
        ("|u1", &[0xff][..], 255.0),
        ("|b1", &[1][..], 1.0),
        ("<i2", &[0xfe, 0xff][..], -2.0),
        (">u2", &[1, 0][..], 256.0),
        ("<i4", &[0xff; 4][..], -1.0),
        ("<i8", &[0xfd, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff][..], -3.0),
    ] {
        assert_eq!(one(descr, false, "()", bytes).as_number(), Some(number), "{descr}");
    }
    let letters: Vec<u8> = "a1\0zoë".chars().flat_map(|c| (c as u32).to_le_bytes()).collect();
    assert_eq!(one("<U3", false, "(2,)", &letters).as_texts().unwrap(), ["a1", "zoë"]);
    assert_eq!(one("|S2", false, "()", b"m/").as_text(), Some("m/"));
    let by_columns: Vec<u8> =
        [1.0_f64, 4.0, 2.0, 5.0, 3.0, 6.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(
        one("<f8", true, "(2, 3)", &by_columns),
        Array::real(&[2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])
    );
}

#[test]
fn faults_of_npz_are_named() {
    let array = npy("<f8", false, "(2,)", &[0; 16]);
    let file = zip(&[("a.npy", array.clone()), ("readme.txt", b"none".to_vec())], false);
    assert_eq!(read_npz(&file, "t.npz").unwrap().len(), 1);
    assert!(refused(b"hello").contains("expected an NPZ file, which is a zip archive, found `hello`"));
    assert!(refused(&file[..file.len() - 5]).contains("the end of a zip archive"));
    assert!(refused(&zip(&[("a.npy", array[..array.len() - 8].to_vec())], false)).contains("`a`: byte"));
    let huge = npy("<f8", false, "(10000000,)", &[0; 16]);
    assert!(
        refused(&zip(&[("a.npy", huge)], true))
            .contains("expected the bytes of values of the shape [10000000]")
    );
    let past = npy("<f8", false, "(4294967296, 4294967296)", &[0; 16]);
    assert!(refused(&zip(&[("a.npy", past)], true)).contains("the shape"));
    let object = npy("|O", false, "(2,)", &[0; 16]);
    assert!(refused(&zip(&[("a.npy", object)], true)).contains("numbers or texts"));
    let twice = zip(&[("a.npy", array.clone()), ("a.npy", array.clone())], true);
    assert!(refused(&twice).contains("`a`: expected each array once"));
    // A second entry of the directory for the same bytes, which are most of the file.
    let large = npy("<f8", false, "(1000,)", &[7; 8000]);
    let shared = zip(&[("a.npy", large)], false);
    let end = shared.len() - 22;
    let entry = shared.windows(4).position(|four| four == b"PK\x01\x02").unwrap();
    let mut shared = [&shared[..end], &shared[entry..]].concat();
    let count = shared.len() - 22 + 10;
    shared[count] = 2;
    assert!(refused(&shared).contains("members that share no bytes"));
    let mut damaged = zip(&[("a.npy", array)], false);
    damaged[60] ^= 1;
    assert!(refused(&damaged).contains("the checksum"));
}

/// Arrays of each kind that MATLAB has.
fn some() -> Arrays {
    let names = |names: &[&str]| Array::texts(names.iter().map(|name| (*name).to_owned()).collect());
    Arrays::from([
        ("rate_hz".into(), Array::real(&[1, 1], vec![48e3])),
        ("responses".into(), Array::real(&[2, 3, 2], (0..12).map(f64::from).collect())),
        (
            "spectrum".into(),
            Array { shape: vec![1, 2], values: Values::Complex(vec![[1.0, -1.0], [1.0 / 3.0, 0.0]]) },
        ),
        ("actuators".into(), names(&["a1", "zoë", ""])),
        ("unit".into(), names(&["m/s"])),
    ])
}

#[test]
fn what_is_written_for_matlab_is_read_again() {
    assert_eq!(read_mat(&write_mat(&some()).unwrap(), "t.mat").unwrap(), some());
    let bad = Arrays::from([("no name".into(), Array::real(&[1, 1], vec![0.0]))]);
    assert!(write_mat(&bad).unwrap_err().to_string().contains("found `no name`"));
}

#[test]
fn compressed_variables_are_read() {
    let file = write_mat(&Arrays::from([("a".into(), Array::real(&[1, 3], vec![1.0, 2.0, 3.0]))])).unwrap();
    let packed = compress_to_vec_zlib(&file[128..], 6);
    let mut whole = file[..128].to_vec();
    whole.extend(15_u32.to_le_bytes());
    whole.extend((packed.len() as u32).to_le_bytes());
    whole.extend(&packed);
    let arrays = read_mat(&whole, "t.mat").unwrap();
    assert_eq!(arrays["a"], Array::real(&[1, 3], vec![1.0, 2.0, 3.0]));
    whole[140] ^= 0xff;
    assert!(read_mat(&whole, "t.mat").unwrap_err().to_string().contains("byte 136"));
}

#[test]
fn a_file_of_the_other_order_is_read() {
    // By hand: a variable `x` of the class int8, kept as 16-bit integers, 2 by 2, with short elements.
    let mut file = vec![b' '; 124];
    file.extend([0x01, 0x00, b'M', b'I']);
    let mut matrix = Vec::new();
    for word in [6_u32, 8, 8, 0, 5, 8, 2, 2] {
        matrix.extend(word.to_be_bytes());
    }
    matrix.extend([0, 1, 0, 1, b'x', 0, 0, 0]);
    matrix.extend([0, 0, 0, 3, 0, 0, 0, 8, 0, 1, 0xff, 0xff, 0, 3, 0, 4]);
    file.extend([14_u32.to_be_bytes(), (matrix.len() as u32).to_be_bytes()].concat());
    file.extend(&matrix);
    let arrays = read_mat(&file, "t.mat").unwrap();
    assert_eq!(arrays["x"], Array::real(&[2, 2], vec![1.0, 3.0, -1.0, 4.0]));
}

#[test]
fn faults_of_matlab_files_are_named() {
    let refused = |file: &[u8]| read_mat(file, "t.mat").unwrap_err().to_string();
    let file = write_mat(&some()).unwrap();
    assert!(refused(b"MATLAB 7.3 MAT-file, Platform").contains("one of version 7.3"));
    assert!(refused(b"short").contains("found 5 bytes"));
    assert!(refused(&[b'x'; 200]).contains("version 5"));
    assert!(refused(&file[..file.len() - 8]).contains("bytes of an element, found"));
    // A shape of ten million numbers with few.
    let mut claimed =
        write_mat(&Arrays::from([("a".into(), Array::real(&[1, 3], vec![1.0, 2.0, 3.0]))])).unwrap();
    let at = claimed.windows(8).position(|eight| eight == [1, 0, 0, 0, 3, 0, 0, 0]).unwrap();
    claimed[at..at + 4].copy_from_slice(&10_000_000_i32.to_le_bytes());
    assert!(refused(&claimed).contains("as many numbers as the shape [10000000, 3] of `a` has, found 3"));
}

#[test]
fn numbers_of_one_byte_take_no_more_memory_than_the_file_allows() {
    let zeros = vec![0; 1 << 20];
    let file = zip(&[("a.npy", npy("|u1", false, "(1048576,)", &zeros))], true);
    let error = refused(&file);
    let wanted = format!("t.npz: `a`: expected arrays of at most {} bytes in memory", 1032 * file.len());
    assert!(error.starts_with(&wanted) && error.contains("found 8388608 bytes more"), "{error}");
    // The same as numbers of MATLAB: flags, lengths of the axes, a name of one letter, and bytes.
    let words = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
    let size = zeros.len() as u32;
    let parts = words(&[6, 8, 9, 0, 5, 8, 1, size, 0x1_0001, u32::from(b'a'), 2, size]);
    let element = [words(&[14, parts.len() as u32 + size]), parts, zeros].concat();
    let packed = compress_to_vec_zlib(&element, 6);
    let header = write_mat(&Arrays::new()).unwrap();
    let file = [&header[..128], &words(&[15, packed.len() as u32]), &packed].concat();
    let error = read_mat(&file, "t.mat").unwrap_err().to_string();
    let wanted = format!("expected arrays of at most {} bytes in memory", 1032 * file.len());
    assert!(error.contains(&wanted), "{error}");
}

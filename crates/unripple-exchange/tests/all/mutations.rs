//! Files with bytes changed at random, from a seed: whatever they are, readers answer, and soon.

use crate::archive::{npy, zip};
use crate::uff_text::{binary, dataset, function, head};
use unripple_exchange::{Array, Arrays, Values, read_columns, read_mat, read_npz, read_uff, write_mat};

/// Mutations of each file.
const COUNT: u32 = 2000;

/// Numbers that look random, from a seed (xorshift, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % bound as u64) as usize
    }
}

/// Reads a file with up to four bytes changed, cut out, or the end cut off, many times; counts what is still read.
fn mutated(file: &[u8], seed: u64, read: impl Fn(&[u8]) -> bool) -> u32 {
    let mut random = Random(seed);
    let mut good = 0;
    for _ in 0..COUNT {
        let mut bytes = file.to_vec();
        for _ in 0..=random.below(4) {
            let at = random.below(bytes.len());
            match random.below(8) {
                0 => drop(bytes.remove(at)),
                1 => bytes.insert(at, random.below(256) as u8),
                2 => bytes[at] = b"0123456789-+. \n"[random.below(15)],
                3 => bytes[at] = 0xff,
                _ => bytes[at] ^= 1 << random.below(8),
            }
        }
        if random.below(8) == 0 {
            bytes.truncate(random.below(bytes.len()));
        }
        good += u32::from(read(&bytes));
    }
    good
}

#[test]
fn universal_files() {
    let line = "  1.00000E+00  2.00000E+00 -3.00000E+00  4.00000E+00  5.00000E+00 -6.00000E+00";
    let node = ["         1         0         0         8  1.20000E+01  3.10000E+01  0.00000E+00"];
    let mode = [
        "a plate",
        "NONE",
        "NONE",
        "NONE",
        "NONE",
        "         1         3         2         8         5         3",
        "         2         6         1         1",
        " -1.00000E+01  6.28000E+02  0.00000E+00  1.25600E+03  0.00000E+00  0.00000E+00",
        "         7",
        "  0.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00  5.00000E-01  1.00000E-01",
    ];
    let file = [
        dataset("15", &node).into_bytes(),
        function(&head(5, 3, 1, 0.0, 0.5), &[line]).into_bytes(),
        binary(&head(4, 2, 1, 0.0, 0.5), 1, &[7; 16]),
        function(
            &head(2, 3, 0, 0.0, 0.5),
            &["  0.00000E+00  1.00000E+00  5.00000E-01  2.00000E+00  1.00000E+00  3.00000E+00"],
        )
        .into_bytes(),
        dataset("55", &mode).into_bytes(),
    ]
    .concat();
    let read = |bytes: &[u8]| read_uff(bytes, "t.uff").is_ok();
    assert!(read(&file));
    let good = mutated(&file, 1, read);
    assert!((1..COUNT).contains(&good), "{good}");
}

#[test]
fn tables() {
    let file = b"time_s,a1,a2\n0,1.5,2\n0.5,-3,4e-3\n1,5,6\n";
    let read = |bytes: &[u8]| read_columns(bytes, "t.csv").is_ok();
    assert!(read(file));
    let good = mutated(file, 2, read);
    assert!((1..COUNT).contains(&good), "{good}");
}

#[test]
fn archives_of_numpy() {
    let members = [
        ("a.npy", npy("<f8", true, "(2, 3)", &[3; 48])),
        ("b.npy", npy("<U2", false, "(2,)", &[0; 16])),
        ("c.npy", npy("<c8", false, "(2,)", &[5; 16])),
    ];
    let read = |bytes: &[u8]| read_npz(bytes, "t.npz").is_ok();
    for deflated in [true, false] {
        let file = zip(&members, deflated);
        assert!(read(&file));
        let good = mutated(&file, 3, read);
        assert!((1..COUNT).contains(&good), "{good}");
    }
    // Members whose checksums hold, so that the arrays themselves are reached.
    let array = npy("<f4", true, "(2, 3)", &[3; 24]);
    let good = mutated(&array, 4, |bytes| read(&zip(&[("a.npy", bytes.to_vec())], false)));
    assert!((1..COUNT).contains(&good), "{good}");
}

#[test]
fn files_of_matlab() {
    let arrays = Arrays::from([
        ("a".into(), Array::real(&[2, 3], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])),
        ("b".into(), Array::texts(vec!["a1".into(), "a2".into()])),
        ("c".into(), Array { shape: vec![1, 2], values: Values::Complex(vec![[1.0, 2.0], [3.0, 4.0]]) }),
    ]);
    let file = write_mat(&arrays).unwrap();
    let read = |bytes: &[u8]| read_mat(bytes, "t.mat").is_ok();
    let good = mutated(&file, 5, read);
    assert!((1..COUNT).contains(&good), "{good}");
}

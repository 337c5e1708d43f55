//! Libraries exported as WAV and as SOFA, the latter read by Python's own readers.

use crate::common;
use crate::python;
use crate::skip;

use common::{Scratch, json, number, refused, run};
use python::python;
use skip::skip;
use std::process::Command;

/// Made of the model: 16 points, 8 actuators.
fn library(scratch: &Scratch) -> String {
    let library = scratch.join("film");
    let made = json(&["respond", "hudin-2012", "--grid-mm", "30", "--length-ms", "10", "-o", &library]);
    assert_eq!((number(&made, "/points"), number(&made, "/samples")), (16.0, 481.0));
    library
}

/// The values of a point as they lie in its chunk, before the checksum: little-endian, actuators x samples.
fn stored(library: &str, point: usize) -> Vec<f32> {
    let bytes = std::fs::read(format!("{library}/responses/c.{point}.0.0")).unwrap();
    let (values, _) = bytes[..bytes.len() - 4].as_chunks::<4>();
    values.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect()
}

#[test]
fn wav_files_hold_what_the_library_holds() {
    let scratch = Scratch::new("export-wav");
    let (library, out) = (library(&scratch), scratch.join("out"));
    let told = json(&["export", &library, "-o", &out]);
    assert_eq!(
        (told["format"].as_str(), number(&told, "/points"), number(&told, "/points_left_out")),
        (Some("wav"), 16.0, 0.0)
    );
    let wav = unripple_store::read_wav(format!("{out}/point-05.wav")).unwrap();
    let flat: Vec<f32> = wav.channels.iter().flatten().map(|x| *x as f32).collect();
    assert_eq!(flat, stored(&library, 5));

    let again = run(&["export", &library, "-o", &out, "--format", "wav"]);
    assert!(again.status.success());
    assert!(String::from_utf8_lossy(&again.stderr).contains("replaced the earlier export"));
    assert!(String::from_utf8_lossy(&again.stdout).contains("16 points of 8 actuators, 481 samples"));
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let scratch = Scratch::new("export-refused");
    let library = library(&scratch);
    let to = |name: &str| scratch.join(name);
    assert!(refused(&["export", &library, "-o", &to("out.zip")], 2).contains("`.zip`"));
    assert!(refused(&["export", &library, "-o", &to("out"), "--author", "me"], 2).contains("found WAV"));
    assert!(refused(&["export", "hudin-2012", "-o", &to("out")], 2).contains("hudin-2012"));
    let other = scratch.file("other.sofa", "mine");
    assert!(refused(&["export", &library, "-o", &other], 1).contains("found another file"));
    assert_eq!(std::fs::read(&other).unwrap(), b"mine");
    assert!(refused(&["export", &library, "-o", &library, "--format", "sofa"], 1).contains("not a file"));
    assert!(refused(&["export", &library, "-o", &library], 1).contains("other things in it"));
    let long = "x".repeat(70_000);
    let wordy = refused(&["export", &library, "-o", &to("o.sofa"), "--license", &long], 2);
    assert!(wordy.contains("60000 bytes for `License`"), "{wordy}");

    // What somebody added, changed or cut off is theirs.
    let sofa = to("changed.sofa");
    assert!(run(&["export", &library, "-o", &sofa]).status.success());
    let whole = std::fs::read(&sofa).unwrap();
    let middle = whole.len() / 2;
    let flipped = [&whole[..middle], &[whole[middle] ^ 1], &whole[middle + 1..]].concat();
    for changed in [[&whole[..], b"x"].concat(), whole[..whole.len() - 1].to_vec(), flipped] {
        std::fs::write(&sofa, &changed).unwrap();
        assert!(refused(&["export", &library, "-o", &sofa], 1).contains("changed since"));
        assert!(std::fs::read(&sofa).unwrap() == changed);
    }
    std::fs::write(&sofa, &whole).unwrap();
    assert!(run(&["export", &library, "-o", &sofa]).status.success());
    std::fs::remove_file(&sofa).unwrap();

    // A damaged point is named, and what was there before stays.
    assert!(run(&["export", &library, "-o", &to("o.sofa")]).status.success());
    let before = std::fs::read(to("o.sofa")).unwrap();
    std::fs::write(format!("{library}/responses/c.3.0.0"), "x").unwrap();
    assert!(refused(&["export", &library, "-o", &to("o.sofa")], 2).contains("c.3.0.0"));
    assert!(refused(&["export", &library, "-o", &to("out")], 2).contains("c.3.0.0"));
    assert!(std::fs::read(to("o.sofa")).unwrap() == before);
    assert_eq!(scratch.names(), ["film", "o.sofa", "other.sofa"]);
}

const SCRIPT: &str = r#"
import sys, numpy, sofar, h5py, netCDF4
path, library = sys.argv[1:]
sofa = sofar.read_sofa(path, verify=True, verbose=False)
sofa.verify(mode="read")
points, actuators, samples = 16, 8, 481
ir = numpy.asarray(sofa.Data_IR)
assert ir.shape == (points, 1, samples, actuators) and ir.dtype == numpy.float64, (ir.shape, ir.dtype)
for point in range(points):
    raw = numpy.fromfile(f"{library}/responses/c.{point}.0.0", "<f4", actuators * samples).reshape(actuators, samples)
    assert (ir[point, 0].T == raw).all() and numpy.abs(raw).max() > 0, point
where = numpy.fromfile(f"{library}/position/c.0.0", "<f8", 2 * points).reshape(points, 2)
assert (sofa.ListenerPosition[:, :2] == where).all() and (sofa.ListenerPosition[:, 2] == 0).all()
assert sofa.EmitterPosition.shape == (actuators, 3) and len(numpy.unique(sofa.EmitterPosition, axis=0)) == actuators
assert (sofa.EmitterPosition > -1e-9).all() and (sofa.EmitterPosition < 0.15).all()
assert sofa.Data_SamplingRate == 48000 and (numpy.asarray(sofa.Data_Delay) == 0).all()
assert sofa.ListenerPosition_Type == "cartesian" and sofa.ListenerPosition_Units == "metre"
assert sofa.GLOBAL_SOFAConventions == "GeneralFIR-E" and sofa.GLOBAL_DataType == "FIR-E"
assert sofa.GLOBAL_AuthorContact == "Zoë <z@example.org>", sofa.GLOBAL_AuthorContact
assert "stimulus: impulse" in sofa.GLOBAL_History and sofa.GLOBAL_APIName == "unripple"

# The same by both libraries underneath, and axes as netCDF has them.
with netCDF4.Dataset(path) as file:
    assert [(d.name, d.size) for d in file.dimensions.values()] == list(zip("MRENICS", (16, 1, 8, 481, 1, 3, 2)))
    assert file["Data.IR"].dimensions == ("M", "R", "N", "E")
    assert file["Data.Delay"].dimensions == ("I", "R", "E")
    names = netCDF4.chartostring(file["EmitterDescriptions"][:])
    assert list(names) == [f"a{i}" for i in range(1, 9)], names
    assert (file["Data.IR"][7].data == ir[7]).all()
with h5py.File(path) as file:
    assert [file["Data.IR"].dims[i][0].name for i in range(4)] == ["/M", "/R", "/N", "/E"]
    assert (file["Data.IR"][7] == ir[7]).all() and file["Data.IR"].dtype == "<f8"
# What is changed in its place is no longer as it was written.
with h5py.File(path, "r+") as file:
    file["Data.IR"][0, 0, 0, 0] = 1
print("read")
"#;

#[test]
fn python_reads_and_verifies_the_sofa_file() {
    let scratch = Scratch::new("export-sofa");
    let (library, out) = (library(&scratch), scratch.join("film.sofa"));
    let told = json(&["export", &library, "-o", &out, "--author", "Zoë <z@example.org>"]);
    assert_eq!((told["format"].as_str(), number(&told, "/points")), (Some("sofa"), 16.0));
    let again = run(&["export", &library, "-o", &out, "--author", "Zoë <z@example.org>"]);
    assert!(String::from_utf8_lossy(&again.stderr).contains("replaced the earlier export"));
    let packages = ["sofar>=1.2,<2", "h5py>=3,<4", "netCDF4>=1.6,<2"];
    let python = match python("peers-sofa", "sofar, h5py, netCDF4", &packages) {
        Ok(python) => python,
        Err(why) => return skip(&format!("Python with sofar is not here and cannot be had: {why}")),
    };
    let output = Command::new(python).args(["-W", "error", "-c", SCRIPT, &out, &library]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("read"), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(refused(&["export", &library, "-o", &out], 1).contains("changed since"));
}

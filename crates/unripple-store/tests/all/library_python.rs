//! Python's own readers of Zarr open a library: an independent implementation of the format.

use crate::library_common;
use crate::python;
use crate::skip;

use library_common::{Folder, filled, plan};
use python::python;
use skip::skip;
use std::process::Command;

const SCRIPT: &str = r#"
import sys, warnings, numpy, xarray, zarr
warnings.simplefilter("error", UserWarning)
group = zarr.open_group(sys.argv[1], mode="r")
responses, state = group["responses"], group["state"]
assert responses.shape == (300, 2, 9) and responses.chunks == (1, 2, 9), responses
assert responses.dtype == numpy.float32 and responses.metadata.dimension_names == ("point", "actuator", "sample")
wanted = (numpy.arange(5 * 18, 6 * 18) * numpy.float32(1e-3) - numpy.float32(1)).astype("f4").reshape(2, 9)
assert numpy.abs(responses[5] - wanted).max() < 1e-6
assert numpy.isnan(responses[0]).all()
assert state[:].tolist() == [0] + [1] * 299
assert numpy.allclose(group["position"][:, 0], 1e-4 * numpy.arange(300))
assert group["quality"][7, 1, 3] == 0.07 and numpy.isnan(group["reciprocity_error"][()])
about = group.attrs["unripple_library"]
assert about["sample_rate_hz"] == 48000 and [a["name"] for a in about["actuators"]] == ["a1", "a2"]
assert sorted(name for name, _ in group.arrays()) == ["bands", "position", "quality", "reciprocity_error", "responses", "state"]
bands = group["bands"]
assert bands.shape == (300, 2, 3, 2) and bands.attrs["middle_hz"] == [500, 630, 800] and numpy.isnan(bands[5]).all()
assert group["calibration"].attrs["unripple_calibration"]["log"]["latency"] == 3.5
opened = xarray.open_zarr(sys.argv[1], consolidated=False)
assert opened.responses.dims == ("point", "actuator", "sample") and opened.sizes["point"] == 300
assert opened.bands.dims == ("point", "actuator", "band", "band_figure")
assert float(opened.responses[5, 1, 2]) == responses[5, 1, 2]
print("opened")
"#;

#[test]
fn python_opens_it() {
    let modules = "xarray, zarr; assert zarr.__version__[0] == '3'";
    let python = match python("peers-zarr", modules, &["zarr>=3,<4", "xarray>=2025.1"]) {
        Ok(python) => python,
        Err(why) => {
            return skip(&format!("Python with zarr 3 and xarray is not here and cannot be had: {why}"));
        }
    };
    let folder = Folder::new("python");
    let mut library = filled(&folder.0, &plan(300, 2, 9));
    library.log("latency", 3.5.into()).unwrap();
    library.hold_bands(&[500.0, 630.0, 800.0]).unwrap();
    drop(library);
    let output = Command::new(python).args(["-c", SCRIPT]).arg(&folder.0).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("opened"), "{said}{}", String::from_utf8_lossy(&output.stderr));
}

//! Fills a library with computed responses, batch by batch.

use crate::{Progress, TaskError, go_on};
use unripple::core::{Point, SampledResponses};
use unripple_store::{Library, PointState, Quality, Take};

/// Largest number of points computed and stored at once: they take some megabytes and a fraction of a
/// second.
const BATCH: usize = 64;

/// Largest number of samples computed and stored at once: half a GiB of them, so that fewer points with
/// long responses are computed together. Twice this value would take twice the memory.
const MOST_SAMPLES: usize = 1 << 27;

/// Computes and stores the responses of the library's missing points; those of `dead` actuators are zero. A library that was filled in part
/// is completed.
///
/// # Errors
/// Those of `compute` and of the library; [`TaskError::Cancelled`].
pub(crate) fn fill(
    library: &mut Library,
    dead: &[usize],
    progress: &mut dyn Progress,
    compute: &mut dyn FnMut(&[Point]) -> Result<SampledResponses, TaskError>,
) -> Result<(), TaskError> {
    let missing = library.in_state(PointState::Missing);
    let (samples, ports) = (library.plan().samples, library.plan().ports.len());
    let quality = vec![Quality::UNKNOWN; ports];
    let at_once = (MOST_SAMPLES / (ports * samples).max(1)).clamp(1, BATCH);
    progress.stage("points");
    for (done, batch) in missing.chunks(at_once).enumerate() {
        go_on(progress)?;
        let places: Vec<Point> = batch.iter().map(|point| library.points()[*point]).collect();
        let computed = compute(&places)?;
        go_on(progress)?;
        let values: Vec<Vec<f32>> = (0..batch.len())
            .map(|point| {
                let mut row = Vec::with_capacity(ports * samples);
                for port in 0..ports {
                    match dead.contains(&port) {
                        true => row.resize(row.len() + samples, 0.0),
                        false => row.extend_from_slice(computed.response(port, point)),
                    }
                }
                row
            })
            .collect();
        let takes: Vec<Take<'_>> = (batch.iter().zip(&values))
            .map(|(point, samples)| Take {
                point: *point,
                samples,
                quality: &quality,
                bands: &[],
                state: PointState::Measured,
            })
            .collect();
        library.put_all(&takes)?;
        progress.done(((done + 1) * at_once).min(missing.len()) as f64 / missing.len() as f64);
    }
    Ok(())
}

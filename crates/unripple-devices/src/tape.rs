//! A device without a sound system: it stores its drive, and its inputs return a recording that was
//! specified before.

use crate::DevicesError;
use crate::error::same;
use unripple_core::{Device, DeviceError, Layout, State, Status};

/// A device without a sound system: its drive is stored in memory, and its inputs return a recording that
/// was specified before. So drives can be played and recorded on other equipment, and the recordings brought
/// back.
///
/// ```
/// use unripple_core::{Device, Layout};
/// use unripple_devices::Tape;
///
/// let layout = Layout { device: "tape".into(), rate: 48e3, block: 2, outputs: vec!["a1".into()],
///     inputs: vec!["mic".into()], full_scale: 1.0 };
/// let mut tape = Tape::recorder(layout.clone())?;
/// tape.exchange(&[0.1, 0.2], &mut [0.0; 2])?;
/// let drive = tape.into_drive();
/// assert_eq!(drive, [[0.1, 0.2]]);
///
/// // A recording of it that was made elsewhere:
/// let mut tape = Tape::player(layout, vec![vec![0.0, 0.3, 0.5]])?;
/// let mut heard = [0.0; 2];
/// tape.exchange(&[0.1, 0.2], &mut heard)?;
/// assert_eq!(heard, [0.0, 0.3]);
/// # Ok::<(), unripple_devices::DevicesError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tape {
    layout: Layout,
    drive: Vec<Vec<f32>>,
    recording: Option<Vec<Vec<f32>>>,
    status: Status,
}

impl Tape {
    /// A tape that only stores its drive; its inputs are silent.
    ///
    /// # Errors
    /// [`DevicesError::Size`] for blocks of no samples.
    pub fn recorder(layout: Layout) -> Result<Self, DevicesError> {
        same("samples of a block", layout.block.min(1), 1)?;
        let drive = vec![Vec::new(); layout.outputs.len()];
        Ok(Self { layout, drive, recording: None, status: Status::default() })
    }

    /// A tape whose inputs return a recording, `[input][sample]`, 1 for full scale. After its end the device
    /// reports that it is lost, since later input signals are unknown.
    ///
    /// # Errors
    /// [`DevicesError::Size`] for another number of lines than inputs or lines of different length.
    pub fn player(layout: Layout, recording: Vec<Vec<f32>>) -> Result<Self, DevicesError> {
        same("lines of a recording", recording.len(), layout.inputs.len())?;
        let length = recording.first().map_or(0, Vec::len);
        recording.iter().try_for_each(|line| same("samples of a recording's line", line.len(), length))?;
        Ok(Self { recording: Some(recording), ..Self::recorder(layout)? })
    }

    /// The drive sent so far, `[output][sample]`, 1 for full scale.
    pub fn drive(&self) -> &[Vec<f32>] {
        &self.drive
    }

    /// Consumes the tape and returns the whole drive, `[output][sample]`, 1 for full scale.
    pub fn into_drive(self) -> Vec<Vec<f32>> {
        self.drive
    }

    fn lose(&mut self, why: String) -> DeviceError {
        self.status.state = State::Lost(why.clone());
        DeviceError::Lost { device: self.layout.device.clone(), why }
    }
}

impl Device for Tape {
    fn layout(&self) -> &Layout {
        &self.layout
    }

    fn status(&self) -> Status {
        self.status.clone()
    }

    fn exchange(&mut self, drive: &[f32], heard: &mut [f32]) -> Result<(), DeviceError> {
        self.layout.fits(drive.len(), heard.len())?;
        let block = self.layout.block;
        let start = self.status.blocks as usize * block;
        let length = self.recording.as_ref().and_then(|lines| lines.first()).map(Vec::len);
        if let Some(length) = length.filter(|length| start >= *length) {
            return Err(self.lose(format!("the recording ends after {length} samples")));
        }
        for (line, plane) in self.drive.iter_mut().zip(drive.chunks_exact(block)) {
            line.extend_from_slice(plane);
        }
        heard.fill(0.0);
        for (plane, line) in heard.chunks_exact_mut(block).zip(self.recording.iter().flatten()) {
            let from = line.get(start..).unwrap_or(&[]);
            plane.iter_mut().zip(from).for_each(|(to, x)| *to = *x);
        }
        self.status.blocks += 1;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout() -> Layout {
        let names = |list: &[&str]| list.iter().map(|n| (*n).to_owned()).collect();
        Layout {
            device: "tape".into(),
            rate: 48e3,
            block: 4,
            outputs: names(&["a1", "a2"]),
            inputs: names(&["m"]),
            full_scale: 2.0,
        }
    }

    #[test]
    fn a_recording_is_heard_to_its_end_and_then_the_tape_is_lost() {
        let mut tape = Tape::player(layout(), vec![vec![1.0, 2.0, 3.0, 4.0, 5.0]]).unwrap();
        let mut heard = [9.0; 4];
        tape.exchange(&[0.5; 8], &mut heard).unwrap();
        assert_eq!(heard, [1.0, 2.0, 3.0, 4.0]);
        tape.exchange(&[0.25; 8], &mut heard).unwrap();
        assert_eq!(heard, [5.0, 0.0, 0.0, 0.0]);
        let error = tape.exchange(&[0.0; 8], &mut heard).unwrap_err();
        assert_eq!(error.to_string(), "device `tape` is lost: the recording ends after 5 samples");
        assert!(matches!(tape.status().state, State::Lost(_)));
        assert_eq!(tape.into_drive(), vec![[[0.5; 4], [0.25; 4]].concat(); 2]);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert!(Tape::player(layout(), vec![]).is_err());
        assert!(Tape::recorder(Layout { block: 0, ..layout() }).is_err());
        assert!(Tape::recorder(layout()).unwrap().exchange(&[0.0; 4], &mut [0.0; 4]).is_err());
    }
}

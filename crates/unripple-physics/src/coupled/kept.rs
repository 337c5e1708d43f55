//! Oscillations of a loaded sheet as bytes.

use super::mixed::Mixed;
use super::{Loaded, Oscillations};
use std::sync::Arc;
use unripple_core::{Encoded, Pole, encode_matrix};
use unripple_linalg::Mat;

impl Oscillations {
    /// Appends the bytes of all but the shapes that these combine, which are those of the loaded sheet.
    pub(crate) fn encode(&self, to: &mut Vec<u8>) {
        self.poles.encode(to);
        self.input.encode(to);
        self.modes.encode(to);
        if let Some(mixture) = self.shapes.mixture() {
            encode_matrix(mixture.mixing, to);
            mixture.columns.to_vec().encode(to);
        }
    }
}

impl Loaded {
    /// Takes oscillations of this sheet off the front; `None` if they are not of it.
    pub(crate) fn decode(&self, from: &mut &[u8]) -> Option<Oscillations> {
        let (poles, input) = <(Vec<Pole>, Mat<f64>)>::decode(from)?;
        let modes = Vec::decode(from)?;
        let (mixing, columns) = <(Mat<f64>, Vec<usize>)>::decode(from)?;
        let base = self.shapes.clone();
        let inside = columns.iter().all(|column| *column < mixing.ncols());
        let fits = inside && mixing.nrows() == base.modes() && columns.len() == poles.len();
        let fits = fits && input.ncols() == poles.len() && input.nrows() == self.transducers.len();
        fits.then(|| Oscillations { poles, input, shapes: Arc::new(Mixed { base, mixing, columns }), modes })
    }
}

//! Complex multiply-accumulate over inputs and partitions, in SIMD lanes.

use super::filters::{LANES, OUTPUTS};
use super::input::Input;
use pulp::{Simd, WithSimd};

/// Sums, over all inputs and partitions, products of spectra.
pub(crate) struct Product<'a> {
    /// The last blocks of each input, as spectra.
    pub(crate) histories: &'a [Input],
    /// Output x group of lanes x (real, imaginary) x lane.
    pub(crate) sums: &'a mut [f32],
    /// Groups of outputs, groups of lanes, partitions.
    pub(crate) shape: [usize; 3],
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [outputs, groups, partitions] = self.shape;
        for (of_outputs, group) in (0..outputs).flat_map(|o| (0..groups).map(move |g| (o, g))) {
            let base = (of_outputs * groups + group) * partitions;
            let mut vector = 0;
            while vector * S::F32_LANES < LANES {
                let sums = products(simd, self.histories, group, base, vector);
                for (output, [plus, minus, im]) in sums.into_iter().enumerate() {
                    let at = ((of_outputs * OUTPUTS + output) * groups + group) * 2 * LANES;
                    let (real, imaginary) = self.sums[at..at + 2 * LANES].split_at_mut(LANES);
                    S::as_mut_simd_f32s(real).0[vector] = simd.sub_f32s(plus, minus);
                    S::as_mut_simd_f32s(imaginary).0[vector] = im;
                }
                vector += 1;
            }
        }
    }
}

/// One vector of the sums of a group of outputs: both halves of the real part, and the imaginary part.
///
/// With x = a + ib and h = c + id, re = ac − bd and im = ad + bc; in lane 0 the lowest frequency is real, and so is the
/// highest, which is kept as its imaginary part: b is 0 there, and the a of the second line is the highest's.
#[inline(always)]
fn products<S: Simd>(
    simd: S,
    histories: &[Input],
    group: usize,
    base: usize,
    vector: usize,
) -> [[S::f32s; 3]; OUTPUTS] {
    let mut sums = [[simd.splat_f32s(0.0); 3]; OUTPUTS];
    let stride = LANES / S::F32_LANES;
    for input in histories {
        for (age, spectrum, filters) in input.history.shares(group) {
            let x = S::as_simd_f32s(spectrum).0;
            let (a, b, a_high) = (x[vector], x[stride + vector], x[2 * stride + vector]);
            let at = (base + age) * OUTPUTS * 2 * LANES;
            let h = S::as_simd_f32s(&filters.spectra[at..at + OUTPUTS * 2 * LANES]).0;
            for (output, [plus, minus, im]) in sums.iter_mut().enumerate() {
                let (c, d) = (h[2 * output * stride + vector], h[(2 * output + 1) * stride + vector]);
                *plus = simd.mul_add_e_f32s(a, c, *plus);
                *minus = simd.mul_add_e_f32s(b, d, *minus);
                *im = simd.mul_add_e_f32s(b, c, simd.mul_add_e_f32s(a_high, d, *im));
            }
        }
    }
    sums
}

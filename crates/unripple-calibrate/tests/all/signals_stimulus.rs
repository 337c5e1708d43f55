//! Truth: what sweeps are defined by, and closed forms of what they measure.

use crate::signals_bench;

use signals_bench::{Noise, Plant, RATE, error, fourier, hear, limited, rms};
use unripple_calibrate::signals::{Band, CrossSpectra, Deconvolver, Inversion, Stimulus, Sweep};
use unripple_dsp::DspError;

#[test]
fn a_synchronized_sweep_holds_its_own_harmonics() {
    let sweep = Sweep { seconds: 2.0, fade_in: 0.0, fade_out: 0.0, ..Sweep::default() };
    for order in [2, 3, 5] {
        let lead = sweep.lead(order);
        for t in [0.0, 0.1, 0.37, 0.9] {
            // cos and sin of the phase, without the samples: phase = 2π f L e^{t/L}.
            let phase =
                |t: f64| std::f64::consts::TAU * sweep.from * sweep.growth() * (t / sweep.growth()).exp();
            let [harmonic, later] = [order as f64 * phase(t), phase(t + lead)];
            assert!(
                (harmonic.sin() - later.sin()).abs() < 1e-9 && (harmonic.cos() - later.cos()).abs() < 1e-9
            );
        }
    }
    let samples = sweep.stimulus().unwrap().samples().to_vec();
    assert!(samples[0] == 0.0 && samples.iter().all(|x| x.abs() <= 1.0));
    // Zero crossings count half periods: L (to − from) periods in all.
    let crossings = samples.windows(2).filter(|pair| pair[0] < 0.0 && pair[1] >= 0.0).count() as f64;
    assert!((crossings - sweep.growth() * (sweep.to - sweep.from)).abs() <= 1.0);
}

#[test]
fn a_measured_response_has_the_spectrum_of_the_plant() {
    let plant = Plant::new(1, 306, 0.07);
    let response = plant.response(96_000);
    for synchronized in [true, false] {
        let sweep = Sweep { synchronized, seconds: 0.7, silence: 1.5, ..Sweep::default() };
        let stimulus = sweep.stimulus().unwrap();
        let heard = hear(&response, stimulus.samples(), stimulus.samples().len());
        let lead = 12_000;
        let inversion = Inversion { lead, ..Inversion::default() };
        let plan = Deconvolver::new(&stimulus, heard.len(), &inversion).unwrap();
        let mut found = vec![0.0; plan.size()];
        plan.deconvolve(&heard, &mut found, &mut plan.workspace()).unwrap();
        for hz in [60.0, 160.2, 333.0, 1000.0, 2222.2, 2990.0, 3300.0] {
            let omega = std::f64::consts::TAU * hz / RATE;
            let truth = plant.spectrum(omega).map(|x| x * stimulus.band().weight(hz));
            let measured = fourier(&found, omega, lead as f64);
            let apart = (measured[0] - truth[0]).hypot(measured[1] - truth[1]);
            let scale = truth[0].hypot(truth[1]);
            assert!(apart < 1e-4 * scale, "{hz} Hz: {measured:?} against {truth:?}");
        }
        assert!(error(&found[..lead + 24_000], &limited(&response[..24_000], stimulus.band(), lead)) < 1e-3);
    }
}

#[test]
fn latency_is_taken_out_to_a_fraction() {
    let response = Plant::new(2, 100, 0.03).response(24_000);
    let stimulus = Sweep { silence: 0.5, ..Sweep::default() }.stimulus().unwrap();
    let heard = hear(&response, stimulus.samples(), stimulus.samples().len());
    let late = unripple_calibrate::signals::shift(&heard, 100.37);
    let respond = |heard: &[f64], latency| {
        let inversion = Inversion { lead: 500, latency, ..Inversion::default() };
        let plan = Deconvolver::new(&stimulus, heard.len(), &inversion).unwrap();
        let mut out = vec![0.0; 10_000];
        plan.deconvolve(heard, &mut out, &mut plan.workspace()).unwrap();
        out
    };
    assert!(error(&respond(&late, 100.37), &respond(&heard, 0.0)) < 1e-6);
}

#[test]
fn taps_of_any_strength_measure_through_what_was_recorded_of_them() {
    let response = Plant::new(4, 200, 0.02).response(16_000);
    let band = Band { low: [0.0, 0.0], high: [3000.0, 3600.0] };
    let truth = limited(&response, band, 300);
    let mut noise = Noise(5);
    let mut taps = CrossSpectra::new(20_000, RATE).unwrap();
    let inversion = Inversion { band: Some(band), lead: 300, ..Inversion::default() };
    for strength in [0.3, 1.0, 0.6, 1.4] {
        let width = 6.0 + 2.0 * noise.uniform();
        let force: Vec<f64> =
            (0..40).map(|i| strength * (-0.5 * ((f64::from(i) - 20.0) / width).powi(2)).exp()).collect();
        let tap = Stimulus::new(force.clone(), RATE).unwrap();
        assert!(tap.usable_band(40.0)[1] > 2500.0);
        let mut heard = hear(&response, &force, 20_000);
        let plan = Deconvolver::new(&tap, 20_000, &inversion).unwrap();
        let mut alone = vec![0.0; truth.len()];
        plan.deconvolve(&heard, &mut alone, &mut plan.workspace()).unwrap();
        assert!(error(&alone, &truth) < 1e-3);
        noise.spoil(&mut heard, 60.0);
        taps.add(&force, &heard).unwrap();
    }
    assert_eq!(taps.count(), 4);
    assert!(taps.coherence_in(Band::within(150.0, 3000.0)) > 0.999);
    let mut found = vec![0.0; truth.len()];
    taps.response(&inversion, &mut found).unwrap();
    assert!(error(&found, &truth) < 0.05, "{}", error(&found, &truth));
}

#[test]
fn many_channels_are_what_each_is_alone() {
    let stimulus = Sweep { seconds: 0.2, ..Sweep::default() }.stimulus().unwrap();
    let heard = Noise(6).of(5 * 20_000, 1.0);
    let plan = Deconvolver::new(&stimulus, 20_000, &Inversion::default()).unwrap();
    let mut all = vec![0.0; 5 * 700];
    plan.deconvolve_all(&heard, &mut all, 700).unwrap();
    for (heard, found) in heard.chunks(20_000).zip(all.chunks(700)) {
        let mut alone = vec![0.0; 700];
        plan.deconvolve(heard, &mut alone, &mut plan.workspace()).unwrap();
        assert_eq!(alone, found);
    }
    assert!(rms(&all) > 0.0);
    assert!(plan.deconvolve_all(&heard[1..], &mut all, 700).is_err());
    assert!(plan.deconvolve_all(&heard, &mut all, 0).is_err());
    assert!(plan.deconvolve_all(&[], &mut [], 0).is_err());
}

#[test]
fn what_cannot_be_is_refused() {
    let ok = Sweep::default();
    for sweep in [
        Sweep { from: 0.0, ..ok },
        Sweep { to: 24e3, ..ok },
        Sweep { from: 4000.0, ..ok },
        Sweep { seconds: f64::NAN, ..ok },
        Sweep { seconds: 1e9, ..ok },
        Sweep { rate: 1e7, seconds: 100.0, ..ok },
        Sweep { fade_in: 2.0, ..ok },
        Sweep { fade_out: -1.0, ..ok },
        Sweep { silence: f64::INFINITY, ..ok },
        Sweep { rate: -1.0, ..ok },
        Sweep { amplitude: 0.0, ..ok },
    ] {
        assert!(matches!(sweep.stimulus(), Err(DspError::Range(_))), "{sweep:?}");
    }
    assert!(Stimulus::new(vec![], RATE).is_err() && Stimulus::new(vec![f64::NAN], RATE).is_err());
    let silent = Stimulus::new(vec![0.0; 5], RATE).unwrap();
    assert!(Deconvolver::new(&silent, 5, &Inversion::default()).is_err());
    let tap = Stimulus::new(vec![1.0; 5], RATE).unwrap();
    let crossed = Band { low: [1.0, 0.5], high: [2.0, 3.0] };
    for inversion in [
        Inversion { band: Some(crossed), ..Inversion::default() },
        Inversion { regularisation: -1.0, ..Inversion::default() },
        Inversion { latency: f64::NAN, ..Inversion::default() },
    ] {
        assert!(Deconvolver::new(&tap, 5, &inversion).is_err(), "{inversion:?}");
    }
    assert!(Deconvolver::new(&tap, 4, &Inversion::default()).is_err());
}

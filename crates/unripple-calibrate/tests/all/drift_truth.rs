//! Tension tracked on a true surface whose model is a fit to its actuators alone, in a third of the paper's band.

use crate::drift_bench;

use drift_bench::{Against, Bench, Row, Sent};
use unripple_calibrate::Verdict;
use unripple_focus::Method;

#[test]
fn tension_is_followed_by_a_fitted_model() {
    let (bench, fitted) = Bench::truth(1000.0, 30.0);
    assert_eq!(fitted.verdict, Verdict::Good);
    // Bending's share by the nominal modes combined, what is close to stray masses included, against finite elements.
    let shares = fitted.bending_shares().iter().zip(bench.modes.bending_shares());
    let off = shares.map(|(found, truth)| ((1.0 - found) / (1.0 - truth) - 1.0).abs()).fold(0.0, f64::max);
    println!("tension's share of each mode off by at most {off:.1e}");
    assert!(off < 1e-3);
    for from in [5.0, 40.0] {
        let run = |against, seconds| bench.run(Sent::Focus(Method::TimeReversal), against, from, seconds);
        let [rows, known] = [Against::Dispersion, Against::Knowledge].map(|against| run(against, 2.0));
        let ratio = |f: fn(&Row) -> f64| {
            let pairs = rows.iter().zip(&known).skip(2);
            pairs.map(|(row, known)| f(row) / f(known)).fold(f64::INFINITY, f64::min)
        };
        let off = rows.iter().skip(2).map(|row| (row.known - row.tension).abs()).fold(0.0, f64::max);
        let [peak, contrast] = [ratio(|row| row.peak), ratio(|row| row.contrast)];
        println!(
            "from {from} s: tension off by {off:.1e}, peak {peak:.4}, contrast {contrast:.4} of those known"
        );
        // Few modes: what the fit leaves of each of them does not average out as it does in the whole band.
        assert!(rows.iter().all(|row| row.explained) && off < 5e-4 && peak > 0.97 && contrast > 0.97);
        let nothing = run(Against::Nothing, 0.8);
        assert!(nothing.iter().zip(&known).skip(2).all(|(row, known)| row.peak < 0.8 * known.peak));
    }
}

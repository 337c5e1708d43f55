//! `design` and `modes` on the command line: fixed keys and reference values.

use crate::common;

use common::{json, number, run};

#[test]
fn design_of_the_papers_surface() {
    let design = json(&["design", "hudin-2012"]);
    for (key, expected, tolerance) in [
        ("celerity_min_m_s", 33.8, 0.05),
        ("celerity_max_m_s", 43.65, 0.005),
        ("paper/celerity_at_15mm_m_s", 43.13, 0.005),
        ("paper/window_s", 0.0360, 0.00005),
        ("mode_count_exact", 306.0, 0.0),
        ("lambda_min_m", 0.01455, 0.000005),
    ] {
        let found = number(&design, &format!("/{key}"));
        assert!((found - expected).abs() <= tolerance, "{key}: {found}");
    }
    for key in ["window_recommended_s", "mode_count_weyl", "contrast_predicted"] {
        assert!(number(&design, &format!("/{key}")) > 0.0);
    }
    assert!((number(&design, "/paper/table1/0/power_w") / 514.0 - 1.0).abs() < 0.01);
    assert!((number(&design, "/paper/table1/1/power_w") / 1.44 - 1.0).abs() < 0.01);
}

#[test]
fn every_built_in_surface_has_a_design_and_modes() {
    for name in ["hudin-2012", "glass-plate", "picture-frame"] {
        let design = json(&["design", name]);
        assert!(number(&design, "/contrast_predicted") > 2.0, "{name}");
        let modes = json(&["modes", name]);
        assert_eq!(number(&modes, "/count"), number(&design, "/mode_count_exact"), "{name}");
        let text = String::from_utf8(run(&["design", name]).stdout).unwrap();
        assert!(text.lines().count() > 40);
        // The paper is about its own film alone.
        let of_paper = name == "hudin-2012";
        assert_eq!((text.contains("paper"), !design["paper"].is_null()), (of_paper, of_paper), "{name}");
    }
}

#[test]
fn modes_are_ascending_and_decay() {
    let modes = json(&["modes", "hudin-2012", "--max-hz", "3000"]);
    let list = |key: &str| -> Vec<f64> {
        modes[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let hz = list("frequencies_hz");
    assert!(hz.is_sorted() && hz.len() == 306);
    for (mode, expected) in [(1, 163.7436), (101, 1542.4735), (301, 2992.414)] {
        assert!((hz[mode - 1] / expected - 1.0).abs() < 1e-5, "{mode}");
    }
    assert!(list("decay_times_s").iter().all(|t| (t / 0.070 - 1.0).abs() < 1e-9));
}

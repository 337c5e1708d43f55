//! Design figures against the paper's numbers and against values worked out apart.

use std::f64::consts::{PI, TAU};
use unripple_core::{ActuatorKind, CoilDrive, Decay, Edge, Edges, Finger, Outline, Shape, Surface};
use unripple_physics::design::{Cavity, Nature, Windows, closed, design_by_law, film_strip, papers_surface};
use unripple_physics::{Design, Modes, PhysicsError, design};

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "expected {expected}, found {found}");
}

fn paper() -> Design {
    design(&papers_surface()).unwrap()
}

/// A slack glass plate, large enough for its rim not to matter.
fn plate() -> Surface {
    let mut surface = papers_surface();
    surface.outline = Outline::new(Shape::Rectangle { width: 3.0, height: 2.0 });
    surface.sheet.young = 69e9;
    surface.sheet.density = 2300.0;
    surface.sheet.thickness = 1e-3;
    surface.sheet.poisson = 0.22;
    surface.sheet.tension = 0.0;
    surface
}

#[test]
fn celerities_are_the_papers() {
    let d = paper();
    // Section 4: 34 m/s for long waves, 43 m/s at 15 mm; 43.65 at 3 kHz solves 0.175 ω² = 200 k² + 7.154e-4 k⁴.
    close(d.celerity_min_m_s, 33.806, 1e-4);
    close(d.paper.as_ref().unwrap().celerity_at_15mm_m_s, 43.13, 1e-4);
    close(d.celerity_max_m_s, 43.65, 1e-4);
    close(d.lambda_min_m, 14.55e-3, 1e-3);
    assert_eq!(d.dispersion.len(), 12);
    assert!(d.dispersion.iter().all(|w| w.group_celerity_m_s > w.phase_celerity_m_s));
}

#[test]
fn windows_are_worked_out_by_hand() {
    let d = paper();
    // (2 · 0.0225 · 418.88 + 0.6) / (2 · 8 · 33.806) s.
    close(d.paper.as_ref().unwrap().window_s, 0.03596, 1e-3);
    // Nine tenths of the largest contrast over T, by simulation as by the modes' closed form; three quarters is the window of live play.
    let windows = Windows::of(&papers_surface());
    let (patient, prompt) = (windows.recommended(), windows.shortest(0.75));
    assert_eq!(
        (patient.seconds, patient.why.clone()),
        (d.window_recommended_s, d.window_recommended_why.clone())
    );
    close(patient.seconds, 0.030, 0.03);
    close(patient.contrast / patient.largest, 0.9, 3e-3);
    close(prompt.contrast / prompt.largest, 0.75, 3e-3);
    close(d.contrast_endless / d.contrast_predicted, patient.largest / patient.contrast, 1e-9);
    assert!(patient.why.contains("the shortest with nine tenths of the largest contrast"), "{}", patient.why);
}

#[test]
fn windows_are_never_below_three_crossings() {
    // A plate that swallows waves before they have come across: contrast is highest while most of it is silent.
    let mut dead = papers_surface();
    dead.sheet.decay = Decay::Time(0.5e-3);
    let shortest = Windows::of(&dead).recommended();
    let chord = PI * 0.0225 / 0.6;
    assert!(shortest.at_floor && shortest.why.contains("cross the surface three times"), "{shortest:?}");
    // Between the slowest and the fastest waves of the band, 33.8 and 66 m/s.
    assert!(shortest.seconds > 3.0 * chord / 66.0 && shortest.seconds < 3.0 * chord / 33.8, "{shortest:?}");
}

#[test]
fn losses_that_grow_with_frequency_leave_a_window() {
    for loss_factor in [0.001, 0.01, 0.1] {
        let mut film = papers_surface();
        film.sheet.decay = Decay::LossFactor(loss_factor);
        for chosen in [Windows::of(&film).recommended(), Windows::by_law(&film, "asked for").recommended()] {
            assert!((0.005..0.2).contains(&chosen.seconds), "{loss_factor}: {chosen:?}");
        }
    }
}

#[test]
fn a_window_without_modes_says_so() {
    let chosen = Windows::by_law(&papers_surface(), "asked for").recommended();
    assert!(chosen.why.ends_with("by the statistics of its modes: asked for"), "{}", chosen.why);
    // Ten thousand modes: nobody solves for them here.
    let mut large = papers_surface();
    large.outline = Outline::new(Shape::Rectangle { width: 1.0, height: 0.8 });
    let chosen = Windows::of(&large).recommended();
    assert!(chosen.why.contains("too many") && chosen.seconds > 0.01, "{chosen:?}");
}

#[test]
fn modes_are_counted_and_estimated() {
    let d = paper();
    assert_eq!((d.mode_count_exact, d.mode_count_exact_reason.as_deref()), (Some(306), None));
    // π · 0.0225 · (3000/43.649)² - 0.6 · 3000 / (2 · 43.649) for a membrane, 313.29. At a clamped rim of a film with stiffness the wave
    // is reflected arctan(k cos θ/κ) later: the second term is larger by the average of (4/π) arctan over t = sin θ.
    let (k, tau) = (TAU * 3000.0 / 43.649, 200.0 / (4e9 * 0.125e-3_f64.powi(3) / (12.0 * 0.91)));
    let later = |t: f64| ((1.0 - t * t) / (1.0 + t * t + tau / (k * k))).sqrt().atan();
    let average = (0..10_000).map(|i| later((f64::from(i) + 0.5) * 1e-4)).sum::<f64>() * 1e-4;
    close(
        d.mode_count_weyl,
        0.0225 * k * k / (4.0 * PI) - 0.6 * k / (4.0 * PI) * (1.0 + 4.0 / PI * average),
        1e-3,
    );
    close(d.first_mode_hz, 163.7436, 1e-4);
}

#[test]
fn weyl_counts_fixed_and_free_rims() {
    // Supported and free membranes of no stiffness are counted by their exact wavenumbers π√((m/a)² + (n/b)²).
    let (a, b, k) = (0.15, 0.11, 600.0);
    for (edge, first) in [(Edge::Supported, 1), (Edge::Free, 0)] {
        let below = |m: i32, n: i32| (f64::from(m) / a).hypot(f64::from(n) / b) * PI < k && m + n > 0;
        let exact =
            (first..100).flat_map(|m| (first..100).map(move |n| (m, n))).filter(|(m, n)| below(*m, *n));
        let mut surface = papers_surface();
        surface.outline = Outline::new(Shape::Rectangle { width: a, height: b }).with_edges(Edges::All(edge));
        surface.sheet.young = 1.0;
        surface.emission.band = [0.0, k * 33.806 / TAU];
        surface.emission.rate = 96e3;
        close(design(&surface).unwrap().mode_count_weyl, exact.count() as f64, 0.01);
    }
}

#[test]
fn weyl_counts_plates_by_their_own_edges() {
    // 1 mm of glass, 0.5 m by 0.4 m. What the law leaves out are fluctuations of a mode or two; the membrane's term alone is 5 % off.
    for edge in [Edge::Clamped, Edge::Free, Edge::Elastic { lift: 1e6, tilt: 20.0 }] {
        let mut surface = papers_surface();
        surface.outline =
            Outline::new(Shape::Rectangle { width: 0.5, height: 0.4 }).with_edges(Edges::All(edge));
        let sheet = &mut surface.sheet;
        (sheet.young, sheet.density, sheet.poisson) = (70e9, 2500.0, 0.22);
        (sheet.thickness, sheet.tension) = (1e-3, 0.0);
        surface.emission.band = [10.0, 5000.0];
        let design = design(&surface).unwrap();
        let counted = design.mode_count_exact.unwrap() as f64;
        println!("{edge:?}: {counted} counted, {:.1} by Weyl's law", design.mode_count_weyl);
        assert!(counted > 250.0);
        close(design.mode_count_weyl, counted, 0.015);
    }
}

#[test]
fn table_1_is_the_papers_to_one_per_cent() {
    let d = paper();
    let table1 = &d.paper.as_ref().unwrap().table1;
    let rows: Vec<_> =
        table1.iter().map(|r| (r.celerity_m_s, r.frequency_hz, r.impedance_n_s_per_m, r.power_w)).collect();
    for (found, expected) in rows.iter().zip([(662.0, 44_155.0, 15.2, 514.0), (42.4, 2825.0, 0.0742, 1.44)]) {
        close(found.0, expected.0, 1e-2);
        close(found.1, expected.1, 1e-2);
        close(found.2, expected.2, 1e-2);
        close(found.3, expected.3, 1e-2);
    }
    // The same film under the same tension and finger, as wide as the contact, at wavelengths of its own.
    for (touch, wavelength) in d.touch.iter().zip([d.lambda_min_m, 2.0 * d.lambda_min_m]) {
        close(touch.wavelength_m, wavelength, 1e-12);
        close(touch.power_w, film_strip().power(&Finger::default(), TAU / wavelength, 10e-6), 1e-9);
    }
}

#[test]
fn deformation_is_worked_out_by_hand() {
    let d = paper().deformation;
    // k = 431.84 rad/m: 200 µm bend the crest to 1/(2e-4 k²) and strain it by 2e-4 k² · 62.5 µm and (2e-4 k)²/2.
    let row = d.rows.last().unwrap();
    close(row.bending_radius_m, 26.81e-3, 1e-3);
    close(row.bending_strain, 2.331e-3, 1e-3);
    close(row.stretching_strain, 3.730e-3, 1e-3);
    close(d.tension_strain, 0.7 * 200.0 / (4e9 * 0.125e-3), 1e-12);
    close(d.yield_strain.unwrap(), 0.025, 1e-12);
    // A² = 0.1 R · 2S (1 - ν) / πEh.
    close(d.linear_limit_tension_m.unwrap(), 633e-6, 1e-3);
}

#[test]
fn a_large_even_band_is_the_plain_form() {
    // A slack plate has as many modes in every hertz; Gaussian shapes need an outline that is no rectangle.
    let mut surface = plate();
    surface.outline = Outline::new(Shape::Circle { radius: 1.4 });
    let cavity = Cavity::of(&surface, 3000.0);
    for (n, window) in [(1.0, 0.05), (1.0, 0.2), (8.0, 0.05), (32.0, 0.2)] {
        let plain = closed::contrast(n, 3000.0, 0.07, window, cavity.modes());
        close(cavity.contrast(n, window), plain, 0.03);
    }
    close(cavity.effective_bandwidth(), 3000.0, 0.01);
    assert!(cavity.growth() < 0.05);
}

#[test]
fn repetition_fades_into_single_pulses() {
    let cavity = Cavity::of(&papers_surface(), 3000.0);
    let once = cavity.contrast(8.0, 0.03);
    close(cavity.repeated(8.0, 0.03, 1.0), once, 1e-9);
    let rates = [0.5, 0.1, 0.05, 0.02, 0.01, 0.005];
    let contrasts: Vec<f64> = rates.iter().map(|period| cavity.repeated(8.0, 0.03, *period)).collect();
    assert!(contrasts.windows(2).all(|pair| pair[1] < pair[0] && pair[1] > 0.0), "{contrasts:?}");
}

#[test]
fn repetition_does_not_depend_on_a_band_below_the_first_mode() {
    // A loss factor makes waves of 0 Hz ring for ever, where there is no mode.
    let mut surface = papers_surface();
    surface.sheet.decay = Decay::LossFactor(0.015);
    let from_nothing = design(&surface).unwrap();
    surface.emission.band[0] = 0.999 * from_nothing.first_mode_hz;
    let from_the_first = design(&surface).unwrap();
    for (a, b) in from_nothing.contrast_by_rate.iter().zip(&from_the_first.contrast_by_rate) {
        assert_eq!(a.rate_hz, b.rate_hz);
        close(a.contrast, b.contrast, 0.02);
    }
    // Once a second is as good as once.
    let seldom = &from_nothing.contrast_by_rate[0];
    assert!(seldom.rate_hz <= 1.0);
    close(seldom.contrast, from_nothing.contrast_predicted, 0.1);
    close(from_nothing.decay_time_s, from_the_first.decay_time_s, 0.01);
}

#[test]
fn decay_may_depend_on_frequency() {
    let mut surface = papers_surface();
    surface.sheet.decay = Decay::Table(vec![(0.0, 0.07), (3000.0, 0.07)]);
    assert_eq!(design(&surface).unwrap().contrast_predicted, paper().contrast_predicted);
    surface.sheet.decay = Decay::LossFactor(0.015);
    let lossy = design(&surface).unwrap();
    // σ = η ω Dk²/2(R + Dk²) at the top of the band.
    let sigma = 0.015 * TAU * 3000.0 * 0.4 / 2.0;
    close(lossy.dispersion.last().unwrap().decay_time_s, 1.0 / sigma, 0.01);
    assert!(lossy.contrast_predicted < paper().contrast_predicted);
}

#[test]
fn an_outline_without_modes_says_why() {
    let mut surface = papers_surface();
    surface.outline = Outline::new(Shape::Stadium { straight: 0.06, radius: 0.06 });
    let d = design(&surface).unwrap();
    match Modes::solve(&surface, 3000.0, 1e-4) {
        Ok(modes) => assert_eq!(d.mode_count_exact, Some(modes.poles().len())),
        Err(reason) => {
            assert_eq!((d.mode_count_exact, d.mode_count_exact_reason), (None, Some(reason.to_string())));
        }
    }
    assert!(d.contrast_predicted > 10.0 && d.mode_count_weyl > 100.0);
}

#[test]
fn bad_surfaces_are_refused() {
    let cases: [fn(&mut Surface); 4] = [
        |s| s.actuators.clear(),
        |s| s.emission.band = [3000.0, 100.0],
        |s| s.emission.band = [0.0, f64::NAN],
        |s| s.emission.band = [0.0, 50.0],
    ];
    for spoil in cases {
        let mut surface = papers_surface();
        spoil(&mut surface);
        assert!(matches!(design(&surface), Err(PhysicsError::Range(_))));
    }
}

#[test]
fn every_figure_is_a_number() {
    let free = |mut s: Surface| {
        s.outline.edges = Edges::All(Edge::Free);
        s.sheet.strength = None;
        s
    };
    for surface in [papers_surface(), free(papers_surface()), plate_band(plate())] {
        let d = design(&surface).unwrap();
        let json = serde_json::to_value(&d).unwrap();
        let mut missing = Vec::new();
        nulls("", &json, &mut missing);
        let optional = [
            "coincidence_hz",
            "mode_count_exact_reason",
            "paper",
            "with_actuators",
            "contrast_interval",
            "yield_strain",
            "share_of_yield",
            "yield_amplitude_m",
            "linear_limit_tension_m",
            "mode_spacing_hz",
        ];
        missing.retain(|key| !optional.contains(&key.as_str()));
        assert!(missing.is_empty(), "{missing:?}");
        assert!(!d.to_string().contains("NaN") && !d.to_string().contains("inf"));
    }
}

/// A plate in a band whose modes are quick to count.
fn plate_band(mut surface: Surface) -> Surface {
    surface.outline = Outline::new(Shape::Rectangle { width: 0.3, height: 0.2 });
    surface.emission.band = [100.0, 4000.0];
    surface
}

/// Keys whose value is null: a number that is not finite is written so.
fn nulls(key: &str, value: &serde_json::Value, found: &mut Vec<String>) {
    match value {
        serde_json::Value::Null => found.push(key.to_owned()),
        serde_json::Value::Array(list) => list.iter().for_each(|v| nulls(key, v, found)),
        serde_json::Value::Object(map) => map.iter().for_each(|(k, v)| nulls(k, v, found)),
        _ => {}
    }
}

#[test]
fn the_text_fits_two_screens() {
    let text = paper().to_string();
    assert!(text.lines().count() < 90);
    for part in ["43.13 m/s", "36.0 ms", "306", "513.88", "1.436", "past linear theory"] {
        assert!(text.contains(part), "{part} is missing from\n{text}");
    }
}

#[test]
fn only_the_papers_film_speaks_of_the_paper() {
    let film = paper();
    let remarks = &film.paper.as_ref().unwrap().remarks;
    let misprints = remarks.iter().take_while(|remark| remark.nature == Nature::Misprint).count();
    let topics: Vec<&str> = remarks.iter().map(|remark| remark.topic.as_str()).collect();
    assert_eq!(topics[..misprints], ["tension", "window", "reflected wave"]);
    assert!(remarks[misprints..].iter().all(|remark| remark.nature == Nature::Model) && remarks.len() == 9);
    // (2 · 0.0225 · 418.88 + 0.6) / (2 · 8 · c) with the velocities that are printed.
    assert!(remarks[1].remark.contains("35.8 ms") && remarks[1].remark.contains("28.3 ms"), "{remarks:?}");

    // The same film in another frame, on other edges, with fewer actuators; and a plate.
    let mut others = [papers_surface(), papers_surface(), papers_surface(), plate_band(plate())];
    others[0].outline = Outline::new(Shape::Stadium { straight: 0.11226, radius: 0.05613 });
    others[1].outline.edges = Edges::All(Edge::Supported);
    others[2].actuators.pop();
    for surface in others {
        let d = design_by_law(&surface, "asked for").unwrap();
        assert_eq!(d.paper, None);
        let (text, json) = (d.to_string(), serde_json::to_string(&d.notes).unwrap());
        for word in ["paper", "Hudin", "printed", "15 mm", "T/N"] {
            assert!(!text.contains(word) && !json.contains(word), "{word} in\n{text}");
        }
    }
}

#[test]
fn a_band_with_fewer_modes_than_weyls_law_has_one_has_a_design() {
    let mut surface = papers_surface();
    surface.outline = Outline::new(Shape::Rectangle { width: 0.1, height: 0.1 });
    surface.actuators.retain(|actuator| surface.outline.contains(actuator.at));
    // The first mode is at 239 Hz, the second at 378 Hz.
    surface.emission.band = [0.0, 260.0];
    let d = design(&surface).unwrap();
    assert!(d.mode_count_weyl < 0.5 && d.mode_count_exact == Some(1), "{}", d.mode_count_weyl);
    assert!(d.contrast_predicted > 0.0 && d.contrast_predicted.is_finite());
    surface.emission.band = [0.0, 230.0];
    let error = design(&surface).unwrap_err().to_string();
    assert_eq!(error, "modes of the sheet from 0 to 230 Hz: expected at least 1, found 0");
}

#[test]
fn the_axes_are_the_surfaces_own() {
    let mut surface = plate_band(plate());
    surface.actuators.truncate(3);
    let d = design_by_law(&surface, "asked for").unwrap();
    assert_eq!(d.actuator_counts, [1, 2, 3, 6, 12]);
    let windows: Vec<f64> = d.contrast_by_window.iter().map(|row| row.window_s).collect();
    assert!(windows.is_sorted() && windows.len() == 9, "{windows:?}");
    let own = &d.contrast_by_window[4];
    assert_eq!(own.window_s, d.window_recommended_s);
    close(own.contrast[2], d.contrast_predicted, 1e-12);
    // Two digits are within a twentieth.
    close(windows[0], d.window_recommended_s / 4.0, 0.05);
    close(windows[8], d.window_recommended_s * 4.0, 0.05);
}

/// Coils on a voltage damp the modes that they excite best, which statistics do not know: in short windows these were twice too high.
#[test]
fn contrast_in_any_window_is_that_of_the_modes_with_their_coils() {
    let mut surface = papers_surface();
    for actuator in &mut surface.actuators {
        actuator.kind = ActuatorKind::MovingMagnet {
            force_constant: 1.2,
            resistance: 4.0,
            inductance: 0.0,
            moving_mass: 0.0,
            driven_by: CoilDrive::Voltage,
        };
    }
    let (found, known) = (design(&surface).unwrap(), Windows::of(&surface));
    let own = found.actuator_counts.iter().position(|n| *n == surface.actuators.len()).unwrap();
    for row in &found.contrast_by_window {
        close(row.contrast[own], known.contrast(row.window_s), 1e-9);
        assert!(row.contrast.is_sorted(), "{row:?}");
    }
}

//! One test per kind of fault of an uneven sheet, of scatterers and of piezo patches.

use crate::good::{GOOD, fault, faults};

/// The text of the one fault after a line is added to `[sheet]`.
fn sheet(lines: &str) -> String {
    fault("air = \"none\"", lines).to_string()
}

/// The text of the one fault with such an actuator in place of the force.
fn patch(lines: &str) -> String {
    fault("kind = \"force\"", &format!("kind = \"piezo\"\n{lines}")).to_string()
}

/// The text of the one fault with a scatterer more.
fn scatterer(lines: &str) -> String {
    let list = faults(&format!("{GOOD}[[scatterer]]\n{lines}\n"));
    assert_eq!(list.len(), 1, "{list:#?}");
    list[0].to_string()
}

#[test]
fn grains() {
    let needs = "sheet.young_across_gpa: expected a number from 0.000001 to 2000 GPa, found no such key";
    assert_eq!(sheet("grain_deg = 30"), needs);
    assert_eq!(sheet("shear_gpa = 1"), needs);
    assert!(sheet("young_across_gpa = 0").ends_with("found 0 (nearest: 0.000001)"));
    assert!(
        sheet("young_across_gpa = 5\ngrain_deg = 1000")
            .contains("-720 to 720 degrees, found 1000 (nearest: 720)")
    );
    let stiff = sheet("young_across_gpa = 50");
    assert_eq!(
        stiff,
        "sheet.young_across_gpa: expected a number below young_gpa / poisson_ratio², which is 44.4444 GPa: with more, the \
         stiffness is not positive definite, found 50 (nearest: 44.4)"
    );
    assert_eq!(faults(&GOOD.replace("air = \"none\"", "young_across_gpa = 44.4")), []);
    let limp = sheet("young_across_gpa = 5\nyoung_gpa = 0");
    assert!(
        limp.starts_with("sheet.young_gpa: expected a number from 0.000001 to 2000 GPa: a sheet with grain"),
        "{limp}"
    );
    assert!(limp.ends_with("found 0 GPa (nearest: 0.000001)"), "{limp}");
    // E1 + E2 + 2 ν12 E2 nearly vanishes.
    let odd = sheet("young_gpa = 1999.0\nyoung_across_gpa = 1999\npoisson_ratio = -0.9999");
    assert!(
        odd.starts_with("sheet.shear_gpa: expected a number from 0.000001 to 2000 GPa: the default from"),
        "{odd}"
    );
}

#[test]
fn profiles() {
    for key in ["thickness_profile", "tension_profile", "added_mass_kg_m2"] {
        for (rows, part) in [
            ("[1, 2]", "rows of numbers"),
            ("[]", "rows of numbers"),
            ("[[]]", "rows of numbers"),
            (
                "[[1, 2], [1]]",
                "[1]: expected rows of equal length, so 2 numbers as in row 0, found 1 numbers in row 1",
            ),
            ("[[1, -1]]", "[0][1]: expected a number from 0"),
            ("[[1, nan]]", "[0][1]: expected a number from 0"),
            ("[[1, \"a\"]]", "[0][1]: expected a number from 0"),
        ] {
            let found = sheet(&format!("{key} = {rows}"));
            assert!(found.starts_with(&format!("sheet.{key}")) && found.contains(part), "{found}");
        }
        let many = format!("[{}]", format!("[{}],", "1,".repeat(300)).repeat(300));
        assert!(
            sheet(&format!("{key} = {many}")).contains("expected at most 65536 numbers, found 90000 numbers")
        );
    }
    assert!(sheet("thickness_profile = 1.0").contains("expected rows of numbers"));
    assert!(
        sheet("thickness_profile = [[0.01]]")
            .ends_with("expected a number from 0.05 to 20, found 0.01 (nearest: 0.05)")
    );
    assert!(sheet("tension_profile = [[21]]").ends_with("(nearest: 20)"));
    assert!(sheet("added_mass_kg_m2 = -1").ends_with("a number from 0 to 1000 kg/m², found -1 (nearest: 0)"));
    assert!(sheet("added_mass_kg_m2 = \"much\"").contains("kg/m², or rows of such numbers"));
}

#[test]
fn nothing_pulls_back_in_places() {
    assert_eq!(
        sheet("young_gpa = 0\ntension_profile = [[1, 0]]"),
        "sheet.tension_profile: expected positive factors of tension, or a positive young_gpa: nothing else pulls the sheet back \
         there, found places with neither tension nor stiffness"
    );
    assert_eq!(faults(&GOOD.replace("air = \"none\"", "tension_profile = [[1, 0]]")), []);
}

#[test]
fn a_loss_factor_needs_stiffness() {
    let limp = GOOD.replace("air = \"none\"", "young_gpa = 0");
    assert_eq!(faults(&limp), []);
    let list = faults(&limp.replace("decay_time_ms = 70", "loss_factor = 0.01"));
    assert_eq!((list.len(), list[0].line, list[0].column), (1, 10, 15));
    assert_eq!(
        list[0].to_string(),
        "sheet.loss_factor: expected decay_time_ms, or a positive young_gpa: a loss factor is that of bending, which is all that \
         it damps, found 0.01"
    );
}

#[test]
fn scatterers() {
    let at = "at_mm = [50, 50]";
    assert_eq!(
        scatterer(&format!("{at}\nmass_mg = 5")),
        "scatterer[0].kind: expected \"mass\", \"disc\" or \"resonator\", found no such key"
    );
    assert!(scatterer(&format!("{at}\nkind = \"mas\"\nmass_mg = 5")).ends_with("(nearest: \"mass\")"));
    assert!(
        scatterer(&format!("{at}\nkind = \"mass\""))
            .starts_with("scatterer[0].mass_mg: expected a number from 0")
    );
    assert!(scatterer(&format!("{at}\nkind = \"mass\"\nmass_mg = -5")).ends_with("(nearest: 0)"));
    let wrong = scatterer(&format!("{at}\nkind = \"mass\"\nmass_mg = 5\nradius_mm = 4"));
    assert!(
        wrong.starts_with("scatterer[0].radius_mm: expected this key only where kind = \"disc\""),
        "{wrong}"
    );
    let disc = format!("{at}\nkind = \"disc\"\nradius_mm = 4\nthickness_mm = 1");
    let list = faults(&format!("{GOOD}[[scatterer]]\n{disc}\n"));
    let keys: Vec<&str> = list.iter().map(|f| f.key.rsplit('.').next().unwrap()).collect();
    assert_eq!(keys, ["young_gpa", "density_kg_m3", "poisson_ratio"]);
    assert!(scatterer(&format!("{disc}\nmaterial = \"stele\"")).ends_with("(nearest: \"steel\")"));
    assert!(
        scatterer("kind = \"mass\"\nmass_mg = 5").starts_with("scatterer[0].at_mm: expected [x, y] in mm")
    );
    let outside = scatterer("kind = \"mass\"\nmass_mg = 5\nat_mm = [150.5, 50]");
    assert!(outside.ends_with("and is 0.500 mm away, found [150.5, 50] (nearest: [150, 50])"), "{outside}");
    let many =
        format!("{GOOD}{}", "[[scatterer]]\nkind = \"mass\"\nmass_mg = 5\nat_mm = [50, 50]\n".repeat(1025));
    let list = faults(&many);
    assert_eq!(
        (list.len(), list[0].found.as_str(), list[0].nearest.as_deref()),
        (1, "1025 scatterers", Some("1024"))
    );
    let table = faults(&format!("{GOOD}[scatterer]\nat_mm = [1, 1]\n"));
    assert_eq!(table[0].expected, "a list of tables, each headed [[scatterer]]");
}

/// The text of the one fault with a lattice more.
fn lattice(lines: &str) -> String {
    let list = faults(&format!("{GOOD}[[lattice]]\n{lines}\n"));
    assert_eq!(list.len(), 1, "{list:#?}");
    list[0].to_string()
}

#[test]
fn resonators_and_lattices() {
    let tuned = "frequency_hz = 250\nquality_factor = 30";
    let alone = "at_mm = [50, 50]\nkind = \"resonator\"";
    assert!(
        scatterer(&format!("{alone}\n{tuned}\nmass_g = 0"))
            .starts_with("scatterer[0].mass_g: expected a number from 0.000001 to 100000 g, found 0")
    );
    let wrong = scatterer(&format!("{alone}\n{tuned}\nmass_g = 1\nmass_mg = 1"));
    assert!(
        wrong.starts_with("scatterer[0].mass_mg: expected this key only where kind = \"mass\""),
        "{wrong}"
    );
    let grid = "from_mm = [10, 10]\nto_mm = [50, 40]";
    assert!(lattice(&format!("{grid}\n{tuned}\nmass_g = 1\npitch_mm = 31")).contains("at most 30.0000 mm"));
    let both = lattice(&format!("{grid}\n{tuned}\nmass_g = 1\npitch_mm = 10\nrows = 3"));
    assert!(both.contains("either pitch_mm or columns and rows"), "{both}");
    let masses = lattice(&format!("{grid}\n{tuned}\nmass_g = 1\nmass_ratio = 1\npitch_mm = 10"));
    assert!(masses.starts_with("lattice[0].mass_ratio: expected one of them"), "{masses}");
    let none = lattice(&format!("{grid}\n{tuned}\npitch_mm = 10"));
    assert!(none.contains("lattice[0].mass_g") && none.contains("or mass_ratio instead"), "{none}");
    let turned =
        lattice(&format!("from_mm = [50, 10]\nto_mm = [40, 40]\n{tuned}\nmass_g = 1\npitch_mm = 10"));
    assert!(turned.contains("to the right of from_mm and above it"), "{turned}");
    let off =
        lattice(&format!("from_mm = [900, 900]\nto_mm = [950, 950]\n{tuned}\nmass_g = 1\npitch_mm = 10"));
    assert!(off.contains("places on the sheet"), "{off}");
    let many = lattice(&format!("{grid}\n{tuned}\nmass_g = 1\ncolumns = 33\nrows = 32"));
    assert!(many.contains("at most 1024 resonators in all, found 1056 resonators"), "{many}");
    let limp =
        GOOD.replace("material = \"BoPET\"", "young_gpa = 0\ndensity_kg_m3 = 1400\npoisson_ratio = 0.3");
    let list = faults(&format!("{limp}[[lattice]]\n{grid}\n{tuned}\nmass_g = 1\npitch_mm = 10\n"));
    assert!(list.len() == 1 && list[0].expected.contains("gives way at a point"), "{list:#?}");
}

#[test]
fn contact_discs() {
    let pad = |kind: &str| fault("kind = \"force\"", kind).to_string();
    assert!(pad("contact_radius_mm = -1").ends_with("a number from 0 to 100 mm, found -1 (nearest: 0)"));
    let patch = pad("kind = \"piezo\"\nradius_mm = 5\nmoment_n_per_v = 1\ncontact_radius_mm = 1");
    assert!(patch.contains("this key only where kind = \"force\" or \"moving-magnet\""), "{patch}");
}

#[test]
fn patches() {
    let whole = "radius_mm = 5\nd31_pm_per_v = 190\npatch_young_gpa = 60\npatch_thickness_mm = 0.2";
    assert!(
        patch("moment_n_per_v = 1")
            .starts_with("actuator[0].radius_mm: expected a number from 0.1 to 100 mm")
    );
    assert_eq!(
        patch("radius_mm = 5"),
        "actuator[0].moment_n_per_v: expected a number from -100000 to 100000 N/V, or d31_pm_per_v, patch_young_gpa, \
         patch_thickness_mm instead, found no such key"
    );
    assert_eq!(
        patch(&format!("{whole}\nmoment_n_per_v = 1")),
        "actuator[0].moment_n_per_v: expected either moment_n_per_v, or d31_pm_per_v, patch_young_gpa, \
         patch_thickness_mm, found moment_n_per_v and d31_pm_per_v"
    );
    for (cut, key) in [
        ("\nd31_pm_per_v = 190", "d31"),
        ("\npatch_young_gpa = 60", "patch_y"),
        ("\npatch_thickness_mm = 0.2", "patch_t"),
    ] {
        let found = patch(&whole.replace(cut, ""));
        assert!(
            found.starts_with(&format!("actuator[0].{key}")) && found.ends_with("found no such key"),
            "{found}"
        );
    }
    assert!(
        patch(&format!("{whole}\npatch_mass_mg = 1\npatch_density_kg_m3 = 7800"))
            .contains("at most one of them")
    );
    let alone = patch("radius_mm = 5\nmoment_n_per_v = 1\npatch_density_kg_m3 = 7800");
    assert!(alone.contains("patch_thickness_mm beside it"), "{alone}");
    assert!(patch(&format!("{whole}\nresistance_ohm = 3")).contains("only where kind = \"moving-magnet\""));
    let key = fault("kind = \"force\"", "kind = \"force\"\nd31_pm_per_v = 3").expected;
    assert_eq!(key, "this key only where kind = \"piezo\"");
    // The thickness is at fault: the moment that needs it is not another fault.
    let thin = GOOD.replace("0.125", "-1").replace("kind = \"force\"", &format!("kind = \"piezo\"\n{whole}"));
    assert_eq!(faults(&thin).len(), 1);
}

#[test]
fn patches_across_the_rim() {
    let whole = |radius: &str| format!("radius_mm = {radius}\nmoment_n_per_v = 1");
    let said = "at most 12 mm, the distance from the nearest rim, found 12.5 mm, which reaches beyond the rim (nearest: 12)";
    let across = patch(&whole("12.5"));
    assert!(across.starts_with("actuator[0].radius_mm: ") && across.ends_with(said), "{across}");
    assert!(
        faults(&GOOD.replace("kind = \"force\"", &format!("kind = \"piezo\"\n{}", whole("12")))).is_empty()
    );
}

/// What a patch has from its material and size is within what a file can say itself.
#[test]
fn patches_that_are_too_heavy() {
    let large = GOOD.replace("[150, 100]", "[2000, 2000]").replace("[12, 31]", "[1000, 1000]").replace(
        "kind = \"force\"",
        "kind = \"piezo\"\nrectangle_mm = [1000, 1000]\nmoment_n_per_v = 1\npatch_thickness_mm = 10",
    );
    assert_eq!(faults(&format!("{large}patch_density_kg_m3 = 1000\n")), []);
    let list = faults(&format!("{large}patch_density_kg_m3 = 7800\n"));
    assert_eq!(list.len(), 1, "{list:#?}");
    assert_eq!(
        list[0].to_string(),
        "actuator[0].patch_density_kg_m3: expected a density with which the patch has at most 10000000 mg, found one with which the \
         patch has 78000000 mg"
    );
}

#[test]
fn patches_without_a_moment() {
    let still = "radius_mm = 5\nmoment_n_per_v = 0";
    let found = patch(still);
    assert_eq!(
        found,
        "actuator: expected an actuator that moves the sheet, found patches without a moment alone"
    );
    let beside = format!("{GOOD}[[actuator]]\nat_mm = [50, 50]\nkind = \"piezo\"\n{still}\n");
    assert_eq!(faults(&beside), [], "others move it");
}

//! Laminates: layers of a file reduced to one sheet, and their faults.

use crate::good::{GOOD, faults};
use unripple_store::{parse_surface, to_toml};

/// The good file with a sheet of glass, glue and a film in place of its own.
fn laminate() -> String {
    GOOD.replace("material = \"BoPET\"\nthickness_mm = 0.125\n", "").replace(
        "[drive]",
        "[[sheet.layer]]
material = \"glass\"
thickness_mm = 0.5
[[sheet.layer]]
material = \"glue\"
young_gpa = 0.001
density_kg_m3 = 1000
poisson_ratio = 0.45
strength_mpa = 5
thickness_mm = 0.1
[[sheet.layer]]
material = \"BoPET\"
thickness_mm = 0.2
[drive]",
    )
}

#[test]
fn layers_become_one_sheet() {
    let surface = parse_surface(&laminate(), "pane.toml").unwrap();
    let sheet = &surface.sheet;
    assert_eq!((sheet.material.as_str(), sheet.thickness), ("glass + glue + BoPET", 0.8e-3));
    let mass = 2300.0 * 0.5e-3 + 1000.0 * 0.1e-3 + 1400.0 * 0.2e-3;
    assert!((sheet.density * sheet.thickness / mass - 1.0).abs() < 1e-12);
    // By hand: glass of 69 GPa, 250 µm up, and BoPET of 4 GPa, 700 µm up, about the plane where they balance.
    let q = |young: f64, nu: f64| young / (1.0 - nu * nu);
    let layers = [
        (q(69e9, 0.22), 0.5e-3, 0.25e-3),
        (q(0.001e9, 0.45), 0.1e-3, 0.55e-3),
        (q(4e9, 0.3), 0.2e-3, 0.7e-3),
    ];
    let all: f64 = layers.iter().map(|(q, t, _)| q * t).sum();
    let plane = layers.iter().map(|(q, t, z)| q * t * z).sum::<f64>() / all;
    let bending: f64 = layers.iter().map(|(q, t, z)| q * (t.powi(3) / 12.0 + t * (z - plane).powi(2))).sum();
    let found = q(sheet.young, sheet.poisson) * sheet.thickness.powi(3) / 12.0;
    assert!((found / bending - 1.0).abs() < 1e-12, "{found} {bending}");
    assert_eq!(parse_surface(&to_toml(&surface), "again.toml").unwrap(), surface);
}

#[test]
fn faults_of_layers_are_named_where_they_are() {
    let only = |text: &str| {
        let list = faults(text);
        assert_eq!(list.len(), 1, "{list:#?}");
        list[0].to_string()
    };
    let beside = laminate().replace("tension_n_per_m", "thickness_mm = 1\ntension_n_per_m");
    assert!(only(&beside).starts_with("sheet.thickness_mm: expected no such key beside sheet.layer"));
    let without = laminate().replace("thickness_mm = 0.2\n", "");
    assert!(only(&without).contains("layer[2].thickness_mm: expected"), "{}", only(&without));
    let thick = laminate().replace("thickness_mm = 0.5", "thickness_mm = 99.9");
    assert!(only(&thick).contains("at most 100 mm together, found 100.200 mm in all"), "{}", only(&thick));
    let limp = GOOD.replace(
        "material = \"BoPET\"\nthickness_mm = 0.125\n",
        "layer = [{ young_gpa = 0, density_kg_m3 = 900, poisson_ratio = 0.3, thickness_mm = 1 }]\n",
    );
    assert!(
        only(&limp).contains("sheet.layer: expected a layer with a young_gpa above 0"),
        "{}",
        only(&limp)
    );
    let list = GOOD.replace("material = \"BoPET\"\nthickness_mm = 0.125\n", "layer = 3\n");
    assert!(only(&list).contains("headed [[sheet.layer]]"), "{}", only(&list));
}

/// What is written beside every result, and with every library, can be read again.
#[test]
fn many_layers_have_a_name_that_a_file_can_hold() {
    let layer = "[[sheet.layer]]\nmaterial = \"soda-lime glass\"\nthickness_mm = 0.5\n";
    let stack = |count: usize| {
        let text = GOOD
            .replace("material = \"BoPET\"\nthickness_mm = 0.125\n", "")
            .replace("[drive]", &format!("{}[drive]", layer.repeat(count)));
        let surface = parse_surface(&text, "stack.toml").unwrap();
        assert_eq!(parse_surface(&to_toml(&surface), "again.toml").unwrap(), surface);
        surface.sheet.material
    };
    assert_eq!(stack(2), "soda-lime glass + soda-lime glass");
    assert_eq!(stack(13), "laminate of 13 layers");
}

#[test]
fn layers_that_are_no_sheet_of_a_file_together() {
    let layer = |young: f64, strength: f64, thickness: f64| {
        format!(
            "{{ young_gpa = {young}, density_kg_m3 = 1000, poisson_ratio = 0.3, strength_mpa = {strength}, thickness_mm = {thickness} }}"
        )
    };
    // A brittle skin on something soft: the skin breaks long before the whole feels a stress.
    let odd = format!("layer = [{}, {}]\n", layer(1000.0, 0.01, 0.001), layer(0.001, 5.0, 10.0));
    let list = faults(&GOOD.replace("material = \"BoPET\"\nthickness_mm = 0.125\n", &odd));
    assert_eq!((list.len(), list[0].key.as_str()), (1, "sheet.layer"), "{list:#?}");
    assert_eq!(
        list[0].expected,
        "layers whose strength_mpa as one sheet is a number from 0.01 to 100000 MPa"
    );
}

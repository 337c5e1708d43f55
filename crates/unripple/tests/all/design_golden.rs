//! The paper's surface, written twice on purpose: as a built-in file and in code.

use unripple_physics::design::papers_surface;

#[test]
fn the_built_in_file_is_the_papers_surface() {
    let (file, code) = (unripple_store::load_surface("hudin-2012").unwrap(), papers_surface());
    assert_eq!(file.actuators.len(), code.actuators.len());
    for (a, b) in file.actuators.iter().zip(&code.actuators) {
        assert!(a.name == b.name && a.kind == b.kind && a.at.distance(b.at) < 1e-12, "{a:?} {b:?}");
    }
    let same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * b.abs();
    assert_eq!(file.outline.edges, code.outline.edges);
    assert!(same(file.outline.area(), code.outline.area()));
    let (a, b) = (&file.sheet, &code.sheet);
    assert!(same(a.young, b.young) && same(a.density, b.density) && same(a.poisson, b.poisson));
    assert!(same(a.thickness, b.thickness) && same(a.tension, b.tension) && a.strength == b.strength);
    assert_eq!((&a.air, &a.decay), (&b.air, &b.decay));
    assert_eq!((file.emission, file.finger), (code.emission, code.finger));
}

//! Names of interfaces in the keys of `load`, and pressures that depend on jumps.

use wildmatch::WildMatch;

use crate::scene::{Load, Pressure, Scene, Variable};

/// True if a key of `load` names an interface.
pub(super) fn names(scene: &Scene, key: &str, interface: &str) -> bool {
    scene.names_interfaces(key)
        && (key == interface
            || scene.entry(interface).is_some_and(|(entry, _)| entry == key)
            || WildMatch::new(key).matches(interface))
}

/// True if the pressure in an interface depends on its jumps in some step.
pub(super) fn depends_on_jumps(scene: &Scene, interface: &str) -> bool {
    let own = scene.steps.iter().flat_map(|step| &step.load).filter(|(key, _)| names(scene, key, interface));
    own.into_iter().any(|(_, load)| match load {
        Load::Pressure(Pressure::Flow(_)) => true,
        Load::Pressure(Pressure::Imposed(value)) => {
            Variable::OF_INTERFACES.into_iter().any(|variable| value.uses(variable))
        }
        Load::Traction(_) | Load::Force(_) => false,
    })
}

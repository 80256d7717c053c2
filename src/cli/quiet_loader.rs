//! Keeps a Vulkan layer's chatter off our users' terminals.
//!
//! Mesa's device-select layer asks a Wayland server which GPU it uses; on a machine without a display that prints a line about
//! XDG_RUNTIME_DIR. The layer only reorders devices, and dejag chooses its adapter itself, so the layer is switched off by the
//! variable its manifest names for that. A process cannot safely change its own environment once libraries read it: it starts
//! itself again with the variable set, which costs a millisecond.

const SWITCH: &str = "NODEVICE_SELECT";

#[cfg(target_os = "linux")]
pub(super) fn without_layer_noise() {
    use std::os::unix::process::CommandExt as _;

    if std::env::var_os("XDG_RUNTIME_DIR").is_some() || std::env::var_os(SWITCH).is_some() {
        return;
    }
    let Ok(this) = std::env::current_exe() else {
        return;
    };
    let mut arguments = std::env::args_os();
    let name = arguments.next().unwrap_or_else(|| "dejag".into());
    // Returns only if it fails; then the line is printed after all, which harms nothing.
    let _ = std::process::Command::new(this).arg0(name).args(arguments).env(SWITCH, "1").exec();
}

#[cfg(not(target_os = "linux"))]
pub(super) fn without_layer_noise() {}

//! The reasons why there is no window, and what to do.

/// The reason why there is no studio.
#[derive(Debug, thiserror::Error)]
pub enum StudioError {
    /// The system has no display to open a window on.
    #[error("there is no display to open a window on")]
    NoDisplay,
    /// There should be a display, but it does not answer.
    #[error("the display cannot be reached ({0}); check DISPLAY or WAYLAND_DISPLAY")]
    Unreachable(String),
    /// A library of the system is missing.
    #[error(
        "a library that windows need is missing ({0}); install it (on Debian and Ubuntu: libxkbcommon-x11-0, \
         libxcursor1, libxi6, libx11-xcb1)"
    )]
    Library(String),
    /// Nothing can draw the window.
    #[error(
        "no graphics driver can draw the window; install one that needs no graphics card (on Debian and Ubuntu: \
         mesa-vulkan-drivers, or libegl1 with libgl1-mesa-dri)"
    )]
    NoGraphics,
    /// The window could not be opened.
    #[error("the window cannot be opened: {0}")]
    Window(String),
    /// The device that draws the window was lost, and there is no other.
    #[error(
        "the graphics driver failed, and no window can be kept open ({0}); unsaved work is kept and offered at the next \
         start, which may go better with another driver: {OTHER_DRIVER}"
    )]
    Lost(String),
    /// The thread that traces could not be started.
    #[error("the tracing thread cannot be started: {0}")]
    Thread(std::io::Error),
}

/// How to do without the driver of the card.
#[cfg(target_os = "linux")]
const OTHER_DRIVER: &str = "set WGPU_BACKEND=gl, and LIBGL_ALWAYS_SOFTWARE=1 to do without the card";
#[cfg(not(target_os = "linux"))]
const OTHER_DRIVER: &str = "set WGPU_BACKEND to vulkan, dx12, metal or gl";

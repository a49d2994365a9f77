# The window as a whole.
app-name = Catoptric
pane-close = Close: { $name }
pane-viewport = Picture
pane-outliner = Scene
pane-inspector = Inspector
pane-history = History
pane-problems = Problems
pane-audit = Audit
pane-compare = Compare
pane-measure = Measure
pane-materials = Materials
ok = OK
cancel = Cancel
close = Close
language = Language
    .tip = Switches the language of the studio.

# The status bar.
status-threads = { $count ->
    [one] { $count } thread
   *[other] { $count } threads
}
status-threads-name = Backend
    .tip = What traces the picture, and on how many threads.
status-card-refuses = The processor draws instead of the graphics card: { $reason }
card-lost-notice = The processor draws from now on instead of the graphics card: { $reason }
window-lost = The graphics driver failed, and the window was opened anew. Nothing was lost.
window-lost-card = The graphics driver failed, and the window was opened anew. Nothing was lost. The processor draws the picture from now on; the card can be switched on again in the menu View.
card-is-lost = the card is lost.
card-has-no-memory = the card has too little memory for this.
card-has-too-many-rays = some pixels need too many rays.
card-has-no-doubles = a body is so large or so flat that it needs double precision.
card-has-too-many-media = a ray is inside of too many transparent bodies at once.
status-size-name = Size
    .tip = Width and height of the picture traced last, in pixels; smaller while something moves.
status-time = { $time } ms
status-time-name = Time
    .tip = How long tracing the last picture took, in milliseconds.
status-rays = { $rays } Mray/s
status-rays-name = Speed
    .tip = Millions of rays traced per second, of all kinds.
status-coarse = preview
status-refining = refining { $done }/{ $wanted }
status-done = done
status-progress = Refinement of the picture
status-refining-name = Refinement
    .tip = How many rays each pixel has got so far; edges become smoother with each.
status-error-scene = The scene cannot be traced
status-error-size = No picture of this size is possible
status-error-camera = A value of the camera is not a finite number
status-error-fault = The tracer has failed
status-bodies = { $count ->
    [one] { $count } body
   *[other] { $count } bodies
}
status-lights = { $count ->
    [one] { $count } light
   *[other] { $count } lights
}
status-count-name = Contents
    .tip = How many bodies and lights the scene has, hidden ones included.
status-free = Free view
    .tip = The view looks around by itself; the scene’s camera stays where it is. Press 0 to return to it.
status-flying = Flying
    .tip = W, A, S, D, Q and E fly, the mouse turns. Esc, a click or Shift+F ends the flight.

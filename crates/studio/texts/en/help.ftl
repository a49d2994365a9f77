# What the mouse does in the picture.
gesture-click = Click
gesture-click-does = Selects a body or a light
gesture-click-again = Click again
gesture-click-again-does = Selects the body behind
gesture-shift-click = Shift + click
gesture-shift-click-does = Adds to the selection or takes from it
gesture-drag-body = Left drag on a body
gesture-drag-body-does = Moves the body along the ground
gesture-alt-drag = Alt while dragging
gesture-alt-drag-does = Moves the body up and down
gesture-ctrl-drag = Ctrl while dragging
gesture-ctrl-drag-does = Snaps to round numbers
gesture-drag-beside = Left drag beside bodies
gesture-drag-beside-does = Turns the view about its target
gesture-right-drag = Right drag
gesture-right-drag-does = Turns the view about its target, wherever it begins
gesture-middle-drag = Middle drag, Shift + right drag
gesture-middle-drag-does = Shifts the view
gesture-wheel = Wheel
gesture-wheel-does = Comes closer or goes away
gesture-escape = Esc
gesture-escape-does = Gives a drag up; ends the flight
gesture-fly = W A S D, Q E
gesture-fly-does = In flight: forward, left, back, right; down, up

# The terms of optics.
glossary-color = Color
    .tip = The share of red, green and blue light that the body scatters.
glossary-ambient = Ambient coefficient
    .tip = How strongly the body answers the even ambient light, which comes from everywhere and casts no shadow.
glossary-diffuse = Diffuse coefficient
    .tip = How much light the body scatters evenly to all sides, after Lambert’s law: most where the light falls straight on it.
glossary-specular = Highlight coefficient
    .tip = How bright the highlights are, the blurred mirror images of the lights in Phong’s model.
glossary-shininess = Highlight exponent
    .tip = How sharp the highlights are: a large exponent makes them small, as on polished bodies.
glossary-reflection = Reflection coefficient
    .tip = The share of light that the surface reflects as a mirror: 0 for none, 1 for a perfect mirror.
glossary-transmission = Transmission coefficient
    .tip = The share of light that passes through the body: 0 for an opaque one, close to 1 for clear glass.
glossary-ior = Index of refraction
    .tip = How many times slower light is in the body than in air, and so how much rays bend at its surface: water 1.33, glass 1.5, diamond 2.42.
glossary-tint = Tint
    .tip = The color that light takes on each time it passes the surface of a transparent body.
glossary-checker = Checkerboard
    .tip = A second color in cubic cells of edge s, laid through the whole world.
glossary-intensity = Intensity of a light
    .tip = Multiplies the light’s color; twice the intensity gives twice the light.
glossary-falloff = Law of falloff
    .tip = How light weakens with the distance d: not at all, as 1/(d + K), or as 1/d², the law of nature for a point.
glossary-ambient-light = Ambient light
    .tip = Even light of the surroundings that reaches every point; it stands in for light scattered many times.
glossary-background = Background
    .tip = The light of a ray that meets nothing; mirrors show it too.
glossary-generations = Generations
    .tip = How many times in a row rays are followed: the ray from the eye is the first generation, each reflection or refraction begins the next.
glossary-threshold = Threshold
    .tip = A ray that would carry a smaller share of light than this to the eye is not followed; 0 follows every one.
glossary-total-reflection = Total internal reflection
    .tip = Inside a denser medium, a ray that meets the surface at too shallow an angle cannot leave and is reflected whole.
glossary-shadow = Shadow
    .tip = A point is in shadow when the straight way to the light is blocked; a transparent body only weakens and tints the light.

# About.
about-version = Version { $version }
about-what = A laboratory for reflections from geometric bodies.
about-how = The picture is the traced scene itself: every ray meets every body by the body’s own equation, reflects and refracts by the laws of optics.
about-license = Free software under the MIT license or the Apache License 2.0, at your choice.
about-parts = The window is drawn with egui, its icons are Google’s Material Symbols (Apache License 2.0), its text is set in Ubuntu (Ubuntu Font License) and Hack (MIT).

# The three steps of the first start.
first-title = First steps
first-dismiss = Dismiss the hint
first-move = Drag a ball with the left mouse button: its reflections follow.
first-orbit = Drag with the right button: the view turns about its target.
first-reflection = Select a body and change its reflection coefficient at the right.
first-done = That was all of it.

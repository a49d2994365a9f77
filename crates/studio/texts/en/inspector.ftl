# The panel of values: what a row is called, and under .tip what it means, in a sentence.

# Things
thing-camera = Camera
thing-environment = Surroundings
thing-tracing = Tracing
thing-light = Light
several-bodies = { $count ->
    [one] { $count } body
   *[other] { $count } bodies
}
several-lights = { $count ->
    [one] { $count } light
   *[other] { $count } lights
}
several-note = Shown is “{ $name }”; a change applies to all, places move together. A dash stands where they differ.
several-locked = { $count ->
    [one] { $count } of them is locked and stays as it is.
   *[other] { $count } of them are locked and stay as they are.
}

# Head
name = Name
    .tip = What it is called; no two of a kind share a name.
name-none = no name
name-taken = This name is taken; a number will be added to it.
hidden = Hidden
    .tip = Leaves it out of the picture: it is not seen, not reflected, casts no shadow and gives no light.
is-hidden = Hidden: it takes no part in the picture.
locked = Locked
    .tip = Keeps it as it is: it cannot be moved, changed or deleted.
is-locked = Locked: its values cannot be changed.
unlock = Unlock
    .tip = Lets it be changed again.

# Rows in general
unit-meters = { " " }m
unit-stops = { " " }EV
limits = From { $min } to { $max }
limits-positive = Above 0, at most { $max }
default-is = Initially { $value }
reset-of = Reset: { $name }
reset-to = Back to { $value }
slider-of = { $name }: slider
linked-of = Keep proportions: { $name }
linked = Keep proportions
    .tip = While this is on, a change of one number changes the other two in proportion.
refused-no-number = That is not a number: { $problem } { $allowed } The value stays as it was.
refused-not-whole = Only whole numbers are possible here; the value stays as it was.
fault-unknown = “{ $part }” (character { $at }) means nothing here.
fault-number-missing = a number is missing at character { $at }.
fault-operator-missing = an operator is missing before “{ $part }” (character { $at }).
fault-parenthesis = the parenthesis “{ $part }” (character { $at }) has no counterpart.
fault-argument-missing = “{ $part }” (character { $at }) needs its argument in parentheses.
fault-ambiguous-comma = the comma in “{ $part }” may be a decimal sign or group thousands; write a point, or no comma.
fault-number = “{ $part }” (character { $at }) is not written as a number.
fault-unit = the units in “{ $part }” do not give what this value is measured in.
fault-power-of-unit = it is unclear of what the power at character { $at } is; write it like (2 cm)^2.
fault-not-finite = “{ $part }” has no finite value.
fault-too-long = it is too long.
allowed-plain = Allowed are numbers, + − * / ^ ( ), pi, sqrt, sin, cos, tan.
allowed-length = Allowed are numbers, + − * / ^ ( ), pi, sqrt, sin, cos, tan, and m, cm, mm, km.
allowed-angle = Allowed are numbers, + − * / ^ ( ), pi, sqrt, sin, cos, tan, and °, deg, rad.
refused-limits = It must be from { $min } to { $max }; the value stays as it was.
refused-limits-positive = It must be above 0 and at most { $max }; the value stays as it was.
refused-no-color = A color is written as # and six digits, such as #3a7bd5.
refused-target = The camera cannot stand on its target: it would look nowhere.
refused-up = “Up” must not point along the view, nor be zero.
refused-axis = The two points must be apart, and no farther than 1e9 m.
refused-name = This name is taken.
refused-range = Some value would leave its limits; nothing was changed.

# Shape
section-shape = Shape
shape-sphere = Sphere
    .tip = A ball about its center.
shape-cube = Cube
    .tip = A box about its center; its three edges can differ.
shape-cylinder = Cylinder
    .tip = A cylinder that stands on its position, closed by two caps.
shape-cone = Cone
    .tip = A cone that stands on its position; with a top radius it is cut off.
shape-paraboloid = Paraboloid
    .tip = A bowl on its vertex, closed by a flat cap; what comes along its axis is mirrored to its focus.
shape-plane = Plane
    .tip = An infinite plane; below it everything is inside.
shape-lens = Lens
    .tip = A lens of two spherical or flat faces: by their radii of curvature, or by its focal length.
shape-mirror-dish = Mirror dish
    .tip = A solid disc with a concave face, parabolic or spherical, by its focal length or radius of curvature.
shape-tube = Tube
    .tip = A tube that stands on its position, open at both ends.
shape-ring = Ring
    .tip = A flat ring about its center: a disc with a hole, such as the stop of a bench.
shape-bowl = Bowl
    .tip = The lower part of a spherical shell, on its lowest point.
shape-prism = Prism
    .tip = A prism over a regular polygon, on its base.
shape-wedge = Wedge
    .tip = A ramp about its center: half a box below a diagonal plane.
shape-open-cylinder = Open cylinder
    .tip = The curved surface of a cylinder that stands on its position, without caps and without inside.
shape-open-cone = Open cone
    .tip = The curved surface of a cone that stands on its position, without caps and without inside.
shape-disc = Disc
    .tip = A flat disc about its position, without thickness.
shape-rectangle = Rectangle
    .tip = A flat rectangle about its position, without thickness.
shape-triangle = Triangle
    .tip = A flat triangle between three corners, without thickness.
shape-union = Union
    .tip = All that lies in any of the parts; within it there is no seam.
shape-intersection = Intersection
    .tip = What lies in all parts, as in a lens of two balls.
shape-difference = Difference
    .tip = The first part without what lies in the others.
shape-surface = Surface
    .tip = The surface of the first part, without its caps, as far as it lies in the others. It has no inside.
shape-group = Group
    .tip = Parts that move together, each a body of its own.
parts = Parts
parts-more = and { $count } more
parts-hint = A click on a row of the outliner, or on the selected whole in the picture, selects a part to be changed here.
instance-hint = An instance of “{ $body }”, whose shape and sizes it has. “Make its own” lets them be changed here.
parts-alone = Only one part is left: “Take apart” makes a simple body of it.
part-of = Part of { $name }
    .tip = Goes to what the part is in.
part-alone = It is the only part that is left: deleted, it takes the whole along; “Take apart” makes a simple body of the whole.
part-locked = The whole is locked: its parts cannot be changed.
part-material-hint = The part is made of what the whole around it is made of. Choose a material, or make one of its own.
material-of-whole = As the whole
radius = Radius
    .tip = From the center, or from the axis, to the surface.
base-radius = Base radius
    .tip = The radius of the cone’s lower end.
top-radius = Top radius
    .tip = The radius of the cone’s upper end; 0 makes it pointed.
height = Height
    .tip = From the lower end to the upper one.
focal-length = Focal length
    .tip = From the vertex to the focus; it gives the height of a paraboloid, and stays when the radius changes. Of a lens in air, for its index.
sides = Sides
    .tip = The number of sides of the prism.
inner-radius = Inner radius
    .tip = The radius of the hole.
thickness = Thickness
    .tip = Of a lens or a mirror dish in the middle, of a bowl that of the wall.
profile = Profile
profile-parabolic = Parabolic
    .tip = Light along the axis meets in one point.
profile-spherical = Spherical
    .tip = A part of a ball; light near the rim meets before the focus.
visible-side = Visible side
visible-side-both = Both
    .tip = The surface is met from both sides.
visible-side-outer = Outer
    .tip = Met only from the side to which the normal points; from the other one nothing is there.
visible-side-inner = Inner
    .tip = Met only from the side to which the normal does not point: a pipe seen from within.
shadow = Shadow
shadow-filtered = By material
    .tip = Light on its way to others passes as far as the surfaces and the inside of the body let it through.
shadow-none = None
    .tip = Light on its way to others passes as if the body were not there; it is seen and reflected as before.
shadow-full = Full
    .tip = No light passes to others, even if the body is clear.
fresnel = Fresnel term
fresnel-constant = None
    .tip = k_r and k_t count under every angle.
fresnel-schlick = Schlick
    .tip = k_r counts as much as Schlick’s formula says that is reflected, k_t the rest, as in The Ray Tracer Challenge.
lens-ior = Index of lens
    .tip = The index of refraction that the focal length holds for; that of the material is apart.
curvature-radius = Curvature radius
    .tip = The radius of curvature at the vertex: twice the focal length.
front-radius = Front radius
    .tip = The radius of curvature of the face at −Y; above 0 it bulges, 0 is flat.
back-radius = Back radius
    .tip = The radius of curvature of the face at +Y; below 0 it bulges, 0 is flat.
size = Size
    .tip = The lengths of the edges along X, Y and Z before any rotation.
width = Width
    .tip = The length of the edges along X before any rotation.
length = Length
    .tip = The length of the edges along Z before any rotation.
corner-a = Corner A
    .tip = A corner in the frame of the body.
corner-b = Corner B
    .tip = The next corner, against the clock where the surface faces the eye.
corner-c = Corner C
    .tip = The third corner.

# Place
section-place = Place
position = Position
    .tip = Where the body’s own origin is: the center of spheres and cubes, the middle of the base of cylinders and cones, the vertex of paraboloids.
rotation = Rotation
    .tip = Turns about the fixed X axis, then Y, then Z, by the right-hand rule.
scale = Scale
    .tip = Factors of the size along the body’s own axes, applied before any rotation.
base = Base
    .tip = The center of the lower end, or the vertex of the paraboloid.
top = Top
    .tip = The center of the upper end, or the tip of the cone.
anchor = Placed by
anchor-frame = Position and rotation
    .tip = The place of the base and three turns.
anchor-axis = Two points
    .tip = The two ends of the axis, which also set the height.
anchor-refused = Two points
    .tip = Two points cannot tell how this body is turned about its axis, and its X and Z scales differ.

# Material
section-material = Material
material-own = Own
material-mixed = Different ones
material-choice = Material of the body
    .tip = A material that bodies share, or one of the body’s own.
material-share = Share
    .tip = Makes a named material of this one, which other bodies can use too.
material-make-own = Make unique
    .tip = Gives the body a copy of its own: changes no longer concern the other bodies.
material-used-by = { $count ->
    [0] No body uses this material.
    [one] { $count } body uses this material.
   *[other] { $count } bodies use this material.
}
model = Model
    .tip = By which law the surface reflects.
model-phong = Phong, Whitted
    .tip = Coefficients of one’s own choice, the same under every angle (Phong 1975, Whitted 1980).
model-dielectric = Clear body
    .tip = Glass, water, crystal: Fresnel’s formulas say how much is reflected under each angle; the rest goes through.
model-conductor = Metal
    .tip = Fresnel’s formulas with the measured indices of a metal: its color comes of itself, and grazing light is reflected white.
model-mirror = Mirror
    .tip = Reflects its color under every angle.
model-matte = Matte
    .tip = Scatters its color to all sides, after Lambert’s law.
model-coated = Coated
    .tip = A matte ground under a clear coat: plastic, lacquer, glazed ceramic. What the coat does not reflect is scattered below it.
model-thin-dielectric = Thin glass
    .tip = A thin sheet with air on both sides: a window pane, a bulb. Both faces reflect by Fresnel’s formulas; the rest goes straight on.
substance = Substance
    .tip = A clear substance with its measured index of refraction.
substance-own = own index
substance-ice = Ice
substance-water = Water
substance-fused-silica = Fused silica
substance-acrylic = Acrylic
substance-crown-glass = Crown glass BK7
substance-window-glass = Window glass
substance-polycarbonate = Polycarbonate
substance-flint-glass = Flint glass F2
substance-sapphire = Sapphire
substance-dense-flint-glass = Dense flint SF11
substance-diamond = Diamond
metal = Metal
    .tip = A metal with its measured indices n and k over the visible spectrum.
metal-own = own n and k
metal-aluminum = Aluminum
metal-brass = Brass
metal-chromium = Chromium
metal-copper = Copper
metal-gold = Gold
metal-iron = Iron
metal-nickel = Nickel
metal-silver = Silver
metal-titanium = Titanium
conductor-n = n
    .tip = The refractive index of the metal for red, green and blue light.
conductor-k = k
    .tip = The extinction coefficient for red, green and blue light: how soon light dies out in the metal.
dispersion = Dispersion
    .tip = Bends light of different colors differently: fringes, spectra. It takes more rays.
dispersion-words = splits light
abbe = Abbe number
    .tip = How little the index differs from color to color: 20 to 40 for flint glasses, 50 to 80 for crown glasses.
attenuation-color = Color of depth
    .tip = The color that white light has after the distance below; thicker parts are darker (Beer–Lambert).
attenuation-distance = At a distance
    .tip = The way in the body after which light has this color.
roughness = Roughness
    .tip = How rough the surface is that reflects: 0 is polished, 1 is frosted. Rough reflections need many samples.
reflection-curve = Reflectance by the angle of incidence
brewster-sign = B
critical-sign = C
brewster-outside = Brewster’s angle { $angle }°
brewster-inside = from within { $angle }°
critical-outside = total reflection from { $angle }°
critical-inside = total reflection within from { $angle }°
curve-red = red
curve-green = green
curve-blue = blue
curve-outside = from outside
curve-inside = from within
curve-seen = Under the pointer θ = { $angle }°: reflects { $red } of red, { $green } of green, { $blue } of blue.
curve-seen-alike = Under the pointer θ = { $angle }°: reflects { $share } of red, green and blue alike.
curve-seen-inside = Under the pointer, from within, θ = { $angle }°: reflects { $red } of red, { $green } of green, { $blue } of blue.
curve-seen-inside-alike = Under the pointer, from within, θ = { $angle }°: reflects { $share } of red, green and blue alike.
in-formula-straight = Straight incidence
in-formula-loss = Loss on the way
law-spectrum = Each wavelength is reflected in part: { $least } at { $at-least } nm, { $most } at { $at-most } nm. To the eye, Y = { $luminous } of daylight.
law-gamut = RGB is the color of that in linear sRGB. Its red passes 1 because the color is purer than mixtures of the screen’s red, green and blue (outside of the sRGB gamut), not because more light comes back.
in-formula-coat = Through the coat
kind = Kind of reflection
kind-matte = Matte
    .tip = Diffuse reflection only, as of chalk: equally bright from all sides.
kind-glossy = Glossy
    .tip = Diffuse reflection under a highlight (Phong 1975), as of plastic or lacquer.
kind-mirror = Mirror
    .tip = Nearly all light is mirrored.
kind-glass = Glass
    .tip = Most light goes through and is refracted, a little is mirrored.
kind-custom = Custom
    .tip = The coefficients fit none of the kinds; any change of them can lead here.
material-color = color
    .tip = The color C of the body, as diffuse and ambient light show it; highlights and reflections keep the color of the light.
ambient = ambient
    .tip = How much of the ambient light the surface returns, everywhere alike, even in shadow.
diffuse = diffuse
    .tip = How much of a light’s brightness is scattered to all sides, after Lambert’s law.
specular = highlight
    .tip = How bright the highlight is, the image of a light on a glossy surface.
shininess = shininess
    .tip = The exponent of the highlight: the higher, the smaller and sharper it is.
reflection = reflection
    .tip = How much of what the mirrored ray sees is added.
reflection-same = as the highlight
    .tip = Lets k_r follow k_s, as Whitted’s formula has one coefficient for both.
transmission = transmission
    .tip = How much of what the refracted ray sees is added; 0 is opaque.
ior = refraction
    .tip = The index of refraction relative to air: how much slower light is inside, and so how much it bends.
medium = Medium
    .tip = Sets the index of refraction of a known substance.
medium-other = other
medium-air = Air
medium-ice = Ice
medium-water = Water
medium-acrylic = Acrylic
medium-crown = Crown glass
medium-flint = Flint glass
medium-sapphire = Sapphire
medium-diamond = Diamond
tint = tint
    .tip = Colors the light that goes through, once at each surface.
pattern = Pattern
    .tip = A second color, laid out in space: the surface shows what it cuts.
pattern-none = none
    .tip = One color, or the texture.
pattern-checker = Checker
    .tip = Cubes of two colors in turn.
pattern-stripes = Stripes
    .tip = Layers of two colors in turn, along the X axis of the pattern.
pattern-rings = Rings
    .tip = Rings of two colors in turn, about the Y axis of the pattern.
pattern-gradient = Gradient
    .tip = From the first color to the second along the X axis of the pattern, again and again.
pattern-color = Second color
    .tip = The color of every other cell, or what a gradient ends with.
pattern-size = cell size
    .tip = The width of a cell: the edge of a cube, a stripe, a ring, one run of a gradient.
pattern-space = Along axes of
    .tip = Whether the cells stay where they are in the world, or move and turn with the body.
pattern-world = World
    .tip = Cells are at rest in the world; a body moves through them.
pattern-body = Body
    .tip = Cells lie along the body’s own axes, from its own origin; they move and turn with it and keep their size.
pattern-position = Begins at
    .tip = Where the pattern begins: a corner of a cell, the middle of the rings.
pattern-rotation = Turned by
    .tip = How the pattern is turned about its X, then Y, then Z axis.
pattern-scale = Stretched
    .tip = Factors of the cells’ size along the pattern’s own axes.
pattern-within = { $count ->
    [one] A pattern stands in the place of a color of this one. The scene file says which.
   *[other] { $count } patterns stand in the place of colors of this one. The scene file says which.
}
texture = Texture
    .tip = A picture on the body in the place of its color: around spheres, cylinders, cones and paraboloids, on each face of a cube, on a plane once every meter.
texture-none = none
picture-evening = Evening
picture-studio = Photo studio
picture-planet = Planet
picture-grid = Grid
picture-of-file = From a file…
picture-not-there = The picture is not there yet.
picture-not-opened = The picture “{ $name }” cannot be opened: { $reason }
picture-not-built-in = no picture of this name comes with the program.
picture-built-in-layer = pictures that come with the program have no layers.
picture-not-a-file = it is not a plain file; save the picture in one.
picture-missing = there is no file { $path }.
picture-too-large = it has { $size } pixels, but may have as many as 8192×4096.
choose-picture = Choose a picture
energy-warning = Sends out more light than it receives: { $sum }
    .tip = k_d C + k_r + k_t τ in the strongest channel is above 1. The model allows it, nature does not.
energy-mirror = Reflects more light than it receives: { $sum }
    .tip = k_r C in the strongest channel is above 1. The model allows it, nature does not.
energy-matte = Scatters more light than it receives: { $sum }
    .tip = The color C is above 1 in the strongest channel. The model allows it, nature does not.
energy-coat = Under a coat, a color above 1 counts as 1.
    .tip = The ground scatters at most what comes through the coat: nothing is brighter than white.
energy-highlight = The highlight sends out more light than it receives: { $sum }
    .tip = 2 k_s / (n + 2) is above 1: what the highlight sends into all directions, against a white matte surface. The model allows it, nature does not.

# Formula
section-formula = Formula
in-formula-ambient = Ambient term
in-formula-sum = Sum over the lights
in-formula-diffuse = Diffuse term
in-formula-highlight = Highlight term
in-formula-reflection = Reflection term
in-formula-transmission = Transmission term
in-formula-snell = Law of refraction
in-formula-sent = Light sent
in-formula-visibility = V_j
    .tip = What is left of the light on its way here: 0 in a shadow, 1 in the open, a color behind glass.
in-formula-light = I_j
    .tip = What light j sends: its color times its intensity.
in-formula-lambert = Cosine
    .tip = The cosine between the normal and the direction to the light: 1 when it shines straight down, 0 when it grazes. A light below the surface adds nothing.
in-formula-mirrored = Mirrored cosine
    .tip = The cosine between the view and the mirrored direction of the light, 0 at the least: 1 where the light is seen as in a mirror.
in-formula-reflected = I_{"{"}reflected{"}"}
    .tip = The light that the mirrored ray brings, found by tracing it in the same way.
in-formula-refracted = I_{"{"}refracted{"}"}
    .tip = The light that the refracted ray brings. At total internal reflection it is the mirrored ray instead, with the factor 1.
in-formula-intensity = intensity
in-formula-color = color
critical-angle = α outside, β inside; total reflection inside from β = { $angle }°.
critical-angle-outside = α outside, β inside; total reflection outside from α = { $angle }°.
formula-no-light = No light shines: the sum is empty.
formula-more-lights = { $count ->
    [one] and { $count } more light
   *[other] and { $count } more lights
}

# Light
section-light = Light
light-position = Position
    .tip = Where the point light hangs.
light-color = Color
    .tip = The color of the light, times its intensity.
intensity = Intensity
    .tip = A factor of the color: how bright the light is.
light-radius = Radius
    .tip = The radius of the ball that shines: the larger, the softer the shadows. 0 is a point. Soft shadows need many samples.
falloff = Falloff
    .tip = A(d), how the light weakens with the distance d.
falloff-none = none
    .tip = A = 1: equally bright at any distance, as from a very distant source.
falloff-linear = linear
    .tip = A = 1/(d + K): weakens slowly, and stays finite close by.
falloff-square = inverse square
    .tip = A = 1/d²: the law of nature for a point source.
falloff-constant = constant
    .tip = K in 1/(d + K): the greater, the more evenly the light falls off.

# Camera
section-view = Direction of view
section-projection = Projection
camera-view-note = The picture and every render show what this camera sees. Turning the view moves it; the free view looks around without it.
camera-free-note = The picture shows the free view, not this camera.
camera-position = Position
    .tip = Where the eye of the camera is.
camera-target = Target
    .tip = The point in the center of the picture.
camera-up = Up
    .tip = The direction that points up in the picture.
view-azimuth = Azimuth
    .tip = The direction of view around the vertical: 0° is along −Z, 90° along +X. The camera stays, its target moves.
view-elevation = Elevation
    .tip = The direction of view above the horizon. The camera stays, its target moves.
view-distance = Distance
    .tip = From the camera to its target.
projection-perspective = Perspective
    .tip = Rays spread from the eye: what is far looks small.
projection-parallel = Parallel
    .tip = Rays run side by side: size does not depend on the distance.
fov = Angle of view
    .tip = The vertical angle that the picture covers.
window-height = Window height
    .tip = How high a piece of the world fits into the picture.
lens = Lens
    .tip = The focal length with the same vertical angle on film of 36 × 24 mm.
lens-value = { $value } mm

# Environment and tracing
surroundings = Surroundings
    .tip = What a ray that hits nothing brings: one color, a gradient of a sky, or a picture of everything around.
around-even = One color
around-sky = Gradient sky
sky-zenith = Above
    .tip = The light from straight above.
sky-horizon = Horizon
    .tip = The light from the horizon; towards above and below it changes with the sine of the height.
sky-nadir = Below
    .tip = The light from straight below.
picture-rotation = Rotation
    .tip = How far the picture is turned about the vertical axis.
sky-strength = Strength
    .tip = A factor of the light of the sky or the picture.
background = Background
    .tip = The light of a ray that meets nothing.
ambient-light = ambient light
    .tip = Light from everywhere, without a shadow; bodies return k_a of it.
generations = Generations
    .tip = How many generations of rays are traced: the ray from the eye is the first, each reflection or refraction begins the next.
threshold = Threshold
    .tip = A ray that would count for less than this is not followed; 0 follows every ray.

# Colors
color-code-of = { $name }: code
color-code-tip = The color as the screen shows it, # and six digits.
color-linear-values = Linear light: { $r }, { $g }, { $b }
color-linear = Linear light
color-square-of = { $name }: saturation and brightness
color-hue-of = { $name }: hue
color-hue = Hue
color-red-of = { $name }: red
color-green-of = { $name }: green
color-blue-of = { $name }: blue
color-above-white = Brighter than white: a screen shows it clipped.
copy-address = Copy address
    .tip = Copies the address of this number, as --set and --vary of the command line take it.
no-address =
    .tip = This number follows from others and has no address of its own.

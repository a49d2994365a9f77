# The panel of everything in the scene, and the history.
outliner-filter = Filter by name
    .tip = Shows only what has these letters in its name.
outliner-filter-clear = Clear the filter
outliner-camera = Camera
outliner-environment = Surroundings
outliner-tracing = Tracing
outliner-lights = Lights
    .tip = Point lights; a click folds or unfolds the list.
outliner-bodies = Bodies
    .tip = Geometric bodies; a click folds or unfolds the list.
outliner-materials = Materials
    .tip = Materials that bodies share; a click folds or unfolds the list.
outliner-add-body = Add body
outliner-rename = New name
outliner-unnamed = { $kind } { $number }
outliner-hide = Hide “{ $name }”
outliner-show = Show “{ $name }”
outliner-lock = Lock “{ $name }”
outliner-unlock = Unlock “{ $name }”
outliner-of-material = Material “{ $material }”
outliner-own-material = Material of its own
outliner-drag-material = Drag it onto a body to give the body this material.

# Parts of joined bodies.
outliner-unfold = Show the parts of { $name }
outliner-fold = Hide the parts of { $name }
part-joined = Joined: the whole has all that lies in it.
part-common = In common: the whole has only what lies in this part, too.
part-remains = What remains: the other parts are taken away from it.
part-taken-away = Taken away: the whole has nothing of what lies in it.
part-surface = The surface: what is left of it lies in the other parts.
part-cuts = Cuts the surface: what lies outside of this part is left out.
part-own-material = Of a material of its own
part-material-of-whole = Of the material of the whole

# What new things are called.
name-sphere = Sphere
name-cube = Cube
name-cylinder = Cylinder
name-cone = Cone
name-paraboloid = Paraboloid
name-plane = Plane
name-lens = Lens
name-mirror-dish = Mirror dish
name-tube = Tube
name-ring = Ring
name-bowl = Bowl
name-prism = Prism
name-wedge = Wedge
name-open-cylinder = Open cylinder
name-open-cone = Open cone
name-disc = Disc
name-rectangle = Rectangle
name-triangle = Triangle
name-union = Union
name-intersection = Intersection
name-difference = Difference
name-surface = Surface
name-group = Group
name-light = Light
name-light-source = Light
name-material = Material

history-opened = Opened
history-present = This is the present state.
history-go = A click goes here.

# The menus.
menu-all = Menu
menu-file = File
menu-edit = Edit
menu-add = Add
menu-view = View
menu-lab = Lab
menu-help = Help
menu-recent = Open recent
menu-no-recent = No recent files
menu-examples = Examples
menu-select = Select
menu-material = Material
menu-sides = Standard views
menu-method = Way of drawing
menu-shown = What is shown
menu-panels = Panels
menu-theme = Theme
menu-language = Language
menu-zoom = Zoom
theme-to-dark = Switch to the dark theme
theme-to-light = Switch to the light theme

# The groups of the list of shortcuts.
group-mouse = Mouse in the picture
group-file = Files and pictures
group-edit = Editing
group-select = Selecting
group-add = Adding
group-view = Camera and view
group-tool = Tools
group-lab = Lab
group-window = Window
group-help = Help

# File.
command-new = New scene
    .tip = Begins an empty scene.
command-open = Open…
    .tip = Opens a scene file.
command-examples = Example gallery…
    .tip = Shows the built-in scenes with their pictures.
command-save = Save
    .tip = Writes the scene to its file; comments and order of the file stay.
command-save-as = Save as…
    .tip = Writes the scene to another file.
command-revert = Revert to saved
    .tip = Goes back to what the file says. This can be undone.
command-render = Render picture…
    .tip = Traces a final picture of any size and saves it as PNG or EXR.
command-render-shown = Picture of the view…
    .tip = Makes a picture of what is shown here, as large as here, to be saved as PNG or EXR: of layers and cube maps too.
command-copy-picture = Copy picture
    .tip = Puts the picture of the viewport into the clipboard.
command-quit = Quit
    .tip = Closes the studio; unsaved changes are asked about first.

# Edit.
command-undo = Undo
    .tip = Takes the last step back.
command-redo = Redo
    .tip = Does the step again that was taken back last.
undo-step = Undo: { $step }
redo-step = Redo: { $step }
command-cut = Cut
    .tip = Copies what is selected, then deletes it.
command-copy = Copy
    .tip = Puts what is selected into the clipboard, as the text of a scene file.
command-paste = Paste
    .tip = Adds the bodies, lights and materials of a scene file’s text from the clipboard.
command-duplicate = Duplicate
    .tip = Copies what is selected, a little aside.
command-delete = Delete
    .tip = Deletes what is selected; locked things stay.
command-rename = Rename
    .tip = Types another name for the selected thing.
command-toggle-hidden = Hide or show
    .tip = Takes the selected bodies and lights out of the picture, or back into it.
command-show-all = Show all
    .tip = Shows all hidden bodies and lights.
command-toggle-locked = Lock or unlock
    .tip = Protects the selected bodies and lights against changes, or lifts it.
command-unlock-all = Unlock all
    .tip = Unlocks all bodies and lights.
command-move-up = Move up in the list
    .tip = Moves what is selected one place up.
command-move-down = Move down in the list
    .tip = Moves what is selected one place down.
command-drop-to-ground = Drop to the ground
    .tip = Lets the selected bodies stand on the ground, y = 0.
command-reset-placement = Reset rotation and scale
    .tip = Takes turns and scales of the selected bodies back; their places stay.
command-share-material = Share material
    .tip = Makes a named material of the body’s own; all selected bodies take it.
command-make-material-unique = Make material unique
    .tip = Gives each selected body a copy of its shared material as its own.
command-remove-unused-materials = Remove unused materials
    .tip = Deletes the materials that no body uses.

# Select.
command-select-all = Select all
    .tip = Selects all bodies and lights that are neither hidden nor locked.
command-select-none = Select nothing
    .tip = Selects nothing.
command-invert-selection = Invert selection
    .tip = Selects what was not selected.
command-select-next = Select next
    .tip = Selects the next body or light.
command-select-previous = Select previous
    .tip = Selects the previous body or light.

# Add.
command-add-sphere = Add sphere
    .tip = Adds a sphere on the ground, where the view looks.
command-add-cube = Add cube
    .tip = Adds a cube on the ground, where the view looks.
command-add-cylinder = Add cylinder
    .tip = Adds a cylinder on the ground, where the view looks.
command-add-cone = Add cone
    .tip = Adds a cone on the ground, where the view looks.
command-add-plane = Add plane
    .tip = Adds an infinite plane.
command-add-light = Add light
    .tip = Adds a point light above where the view looks.
command-add-material = Add material
    .tip = Adds a material that bodies can share.

# View.
command-frame-selection = Frame selection
    .tip = Brings what is selected into view.
command-frame-all = Frame all
    .tip = Brings all bodies into view.
command-look-front = View from the front
    .tip = Looks from the front, against Z.
command-look-back = View from the back
    .tip = Looks from the back, along Z.
command-look-right = View from the right
    .tip = Looks from the right, against X.
command-look-left = View from the left
    .tip = Looks from the left, along X.
command-look-top = View from above
    .tip = Looks straight down, against Y.
command-look-bottom = View from below
    .tip = Looks straight up, along Y.
command-toggle-projection = Parallel projection
    .tip = Switches between perspective and parallel rays.
command-toggle-free-view = Free view
    .tip = Looks around without moving the scene’s camera; once more returns to it.
command-camera-from-view = Camera from view
    .tip = Puts the scene’s camera where the free view is.
command-toggle-fly = Fly
    .tip = Flies through the scene with the keys W, A, S, D, Q, E and the mouse.

command-method-whitted = Traced
    .tip = Whitted’s tree of rays: reflections, refractions and shadows are traced. Exact.
command-method-ssr = Screen-space reflections
    .tip = Each reflected ray is marched over the picture itself; what the picture does not show is missing.
command-method-cube-map = Cube maps
    .tip = Reflections are looked up in a picture of the surroundings, made from the middle of each body.
command-method-phong = Phong shading
    .tip = Bodies of flat faces; normals are interpolated across a face and light is computed in each pixel. Nothing reflects.
command-method-gouraud = Gouraud shading
    .tip = Bodies of flat faces; light is computed at their corners and interpolated. Nothing reflects.
command-method-flat = Flat shading
    .tip = Bodies of flat faces, each with one intensity. Nothing reflects.
command-show-picture = The picture
    .tip = The finished drawing.
command-show-depth = Depth
    .tip = How far away what a pixel shows is: white is near, black the background.
command-show-normal = Normals
    .tip = Where surfaces face: red, green and blue are the normal’s x, y and z from −1 to 1.
command-show-body = Bodies
    .tip = A color of its own for each body.
command-show-color = Colors
    .tip = The color C of the bodies, without any light.
command-show-coefficients = Coefficients
    .tip = The diffuse, specular and reflection coefficients as red, green and blue.
command-show-lit = Lit
    .tip = The local light alone: what a reflected ray finds on the screen.
command-show-reflected = Reflections
    .tip = What reflected rays have found, before it is multiplied by the reflection coefficient.
command-show-unfolded = Unfolded cube map
    .tip = The six faces of the selected body’s cube map, or of the first there is: what is seen from its middle.

# Tools.
command-tool-move = Move
    .tip = The handles move the selected bodies and lights.
command-tool-rotate = Rotate
    .tip = The handles turn the selected bodies.
command-tool-scale = Scale
    .tip = The handles scale the selected bodies.
command-toggle-gizmo-space = Local axes
    .tip = The handles follow the body’s own axes instead of the world’s.
command-toggle-grid = Ground grid
    .tip = Shows the grid and the axes on the ground, y = 0.
command-toggle-handles = Handles
    .tip = Shows lights and handles over the picture.

# Lab.
command-compare-swap = Exchange the compared pictures
    .tip = A becomes B, and B becomes A.
command-compare-file-a = Picture file as A…
    .tip = Compares with a picture from a PNG or EXR file.
command-compare-file-b = Picture file as B…
    .tip = Holds a picture from a PNG or EXR file against A.
command-compare-save = Save the comparison…
    .tip = Saves the comparison as one page that needs nothing else: pictures, maps, numbers, times, reasons.
command-measure-start = Start measuring
    .tip = Begins to measure what the panel says; the picture waits meanwhile.
command-measure-stop = Stop measuring
    .tip = Ends the measurement; what was measured stays.
command-measure-save = Save the measurement…
    .tip = Saves report, plots and tables in a folder: CSV, SVG, PNG, Markdown and LaTeX.

# Window.
command-pane-outliner = Scene
    .tip = The panel of everything in the scene.
command-pane-inspector = Inspector
    .tip = The panel of values of what is selected.
command-pane-history = History
    .tip = The panel of the steps of editing.
command-pane-problems = Problems
    .tip = The panel of what is wrong in the file.
command-pane-compare = Compare
    .tip = The panel of two pictures, how they differ, and why.
command-pane-measure = Measure
    .tip = The panel that measures how the time of a picture grows.
command-pane-viewport = Picture
    .tip = The panel of the traced picture.
command-reset-layout = Reset panels
    .tip = Puts all panels where they were at first.
command-theme-dark = Dark theme
    .tip = A dark window leaves the picture the brightest thing.
command-theme-light = Light theme
    .tip = A light window.
command-theme-system = Theme of the system
    .tip = Dark or light, as the system has it.
command-language-english = English
    .tip = Switches the studio to English.
command-language-russian = Русский
    .tip = Switches the studio to Russian.
command-zoom-in = Larger interface
    .tip = Makes everything in the window a tenth larger.
command-zoom-out = Smaller interface
    .tip = Makes everything in the window a tenth smaller.
command-zoom-normal = Normal interface size
    .tip = Makes everything in the window as large as the system has it.

# Help.
command-palette = Find a command…
    .tip = Finds commands, examples, files and things of the scene by some letters of their names.
command-shortcuts = Shortcuts
    .tip = All commands with their keys, and what the mouse does.
command-terms = Terms of optics
    .tip = What the coefficients and signs mean, a sentence each.
command-first-steps = First steps
    .tip = Three things to try.
command-about = About Catoptric
    .tip = Version and licenses.

# The command palette.
palette-hint = A command, an example, a body…
palette-nothing = No matches
palette-example = example
palette-recent = recent file
palette-thing = in the scene

# Why something was not done.
refused-nothing-selected = Nothing is selected that this could be done to.
refused-locked = Everything selected is locked.
refused-no-such-item = It is no longer in the scene.
refused-empty-name = A material needs a name.
refused-bad-text = The clipboard does not hold the text of a scene.
refused-nothing-to-paste = There is nothing in the clipboard that could be pasted.

# The steps of the history. What was edited stands behind: Move “ball”.
step-of = { $act } “{ $subject }”

edit-add-sphere = Add sphere
edit-add-cube = Add cube
edit-add-cylinder = Add cylinder
edit-add-cone = Add cone
edit-add-plane = Add plane
edit-add-light = Add light
edit-add-material = Add material
edit-duplicate = Duplicate
edit-delete = Delete
edit-cut = Cut
edit-paste = Paste
edit-rename = Rename
edit-toggle-hidden = Hide or show
edit-toggle-locked = Lock or unlock
edit-hide = Hide
edit-show = Show
edit-show-all = Show all
edit-lock = Lock
edit-unlock = Unlock
edit-unlock-all = Unlock all
edit-move-up = Move up in the list
edit-move-down = Move down in the list
edit-reorder = Reorder
edit-assign-material = Assign material
edit-share-material = Share material
edit-make-material-unique = Make material unique
edit-remove-unused-materials = Remove unused materials
edit-drop-to-ground = Drop to the ground
edit-reset-placement = Reset rotation and scale
edit-revert = Revert to saved
edit-select-all = Select all
edit-select-none = Select nothing
edit-invert-selection = Invert selection
edit-select-next = Select next
edit-select-previous = Select previous
edit-undo = Undo
edit-redo = Redo

edit-camera-from-view = Camera from view
edit-projection = Projection
edit-frame = Frame

# edits

# In the viewport
edit-orbit = Orbit the camera
edit-pan = Pan the camera
edit-dolly = Dolly the camera
edit-fly = Fly the camera
edit-move = Move
edit-rotate = Rotate
edit-scale = Scale

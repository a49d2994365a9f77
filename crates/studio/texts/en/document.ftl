# Scene files: opening, saving, recovering; their problems; examples.

# The window and the document
window-title = { $name } — Catoptric
window-title-changed = ● { $name } — Catoptric
document-untitled = Untitled scene
document-file-name = scene
fault = This is a fault of the program itself.

# Asking for files
ask-open = Open a scene
ask-save-as = Save the scene as
open = Open
save = Save
save-as = Save as…
replace = Replace
do-not-save = Don’t save

# The studio’s own dialog for files
files-up = Parent folder
files-home = Home folder
files-recent = Recent folders
files-new-folder = New folder
files-new-folder-name = Name of the new folder
files-create = Create
files-new-folder-exists = There is something of this name already. Choose another name.
files-new-folder-denied = You may not create anything in this folder. Choose another place.
files-new-folder-bad-name = This is no name of a folder. It must not be empty or contain a slash.
files-new-folder-full = The disk has no room for a folder. Make room, or choose another place.
files-new-folder-failed = The folder cannot be created here. Try another name or place.
files-name = Name
files-name-hint = A name, or a path
files-all = All files
files-all-tip = Lists files of every kind, not only { $kinds }.
files-reading = Reading the folder…
files-empty = No matching files here.
files-no-folder = There is no such folder. Check the path.
files-denied = You may not look into this folder. Choose another one.
files-failed = This folder cannot be read. Choose another one.
size-bytes = { $count } B
size-kilobytes = { $count } kB
ago-now = just now
ago-minutes = { $number ->
    [one] { $number } minute ago
   *[other] { $number } minutes ago
}
ago-hours = { $number ->
    [one] { $number } hour ago
   *[other] { $number } hours ago
}
ago-days = { $number ->
    [one] { $number } day ago
   *[other] { $number } days ago
}

# Under way
opening = Opening { $name }…
saving = Saving { $name }…
saved = Saved: { $name }
reverted = The scene is again as it was saved. Undo brings your changes back.
reloaded = The scene is as the other program has saved it. Undo brings yours back.
revert-no-file = This scene has no file yet to go back to.

# Changes that would be lost
unsaved-title = Save the changes to “{ $name }”?
unsaved-text = Otherwise the changes since the last save are lost.
replace-title = Replace “{ $name }”?
replace-text = There is already a file { $path }. Its content would be lost.
overwrite-title = Another program has changed “{ $name }”
overwrite-text = The file { $path } is no longer the one that was opened here. Replacing it loses what the other program wrote; under another name, both stay.
outside-changed = Another program has changed “{ $name }”.
outside-changed-both = Another program has changed “{ $name }”; your changes here are not saved.
outside-reload = Reload
    .tip = Shows the file as it is now. Undo brings the present scene back.
outside-keep = Keep mine
    .tip = Leaves the scene as it is. Saving will ask before it replaces the file.
partial-title = Only a part of “{ $name }” is open
partial-text = What could not be read is missing from the scene. Replacing the file loses those parts and all its comments for good; under another name, the original stays and can still be mended.

# What cannot be opened
open-failed = The scene cannot be opened
link-copied = The link is in the clipboard.
link-too-long = The scene is too large for a link. Save it as a file, and pass that on.
link-refused = The clipboard cannot be written, so that the link was not copied.
link-without-pictures = The link does not hold the pictures that the scene names.
link-damaged = The link is damaged: perhaps a part of it was cut off. Ask for it again.
read-missing = There is no file { $path }. Perhaps it was moved or renamed; open it from its new place.
read-denied = You have no right to read { $path }. Change the rights of the file, or open another one.
read-folder = { $path } is a folder. Choose a scene file in it.
read-too-long = { $path } is longer than { $limit } MiB, the longest a scene can be.
read-nothing = There is no scene in { $path } that could be read. Choose a scene file (.toml, .rt, .yml, .nff), or mend this one in a text editor:

    { $found }
read-foreign = { $path } cannot be opened as a scene of { $format }. Mend its errors in a text editor:

    { $found }
read-foreign-approximable = { $path } is a scene of { $format } with what cannot be taken over exactly:

    { $found }

    Opened approximately, it has what comes nearest instead, or lacks it, with a warning for each.
read-more-errors = { $number ->
    [one] and { $number } more error
   *[other] and { $number } more errors
}
open-approximately = Open approximately
dialect-title = Read otherwise
dialect-text = miniRT programs differ. Mark what the one of { $name } does; scenes opened later are read so, too.
dialect-read = Read
dialect-radius = Radius, not diameter
    .tip = Spheres, cylinders and cones are given by their radius.
dialect-base = Cylinders stand on their position
    .tip = The position of a cylinder is the center of its base, not of the cylinder.
dialect-cone-base = Cones stand on their position
    .tip = The position of a cone is the center of its base, and its axis points to the apex.
dialect-cone-angle = Cones by their angle
    .tip = Half the angle at the apex, in degrees, stands in the place of a cone's diameter.
dialect-cone-height-first = Height of cones first
    .tip = The height of a cone stands before its diameter or angle.
dialect-vertical-fov = Vertical angle of view
    .tip = The angle of the camera is the vertical one.
dialect-left-handed = Left-handed axes
    .tip = Looking along +z with y up, x points to the right. Marked wrongly, the picture is mirrored.
dialect-added-reflection = Reflections are added
    .tip = What a mirror reflects is added to its own light, which stays undiminished.
read-other = { $path } cannot be read: { $reason }

# What cannot be saved
save-failed = The scene could not be saved
save-failed-nothing-lost = Nothing is lost: the scene is still open, and the file on the disk is as it was.
write-no-name = { $path } names no file. Give a file name.
write-folder = { $path } is a folder. Give the name of a file in it.
write-no-folder = { $path } cannot be written, since there is no folder { $folder }. Create it, or choose another place.
write-closed = { $path } cannot be written, since nothing can be created in the folder { $folder }. Change its rights, or choose another place.
write-protected = { $path } is write-protected. Choose another name, or make the file writable.
write-circle = { $path } cannot be written: its symbolic links lead in a circle. Choose another name.
write-no-descriptor = { $path } names no open descriptor of this program. Give the name of a file.
write-reader-gone = Not all was written to { $path }: the program that reads from there has ended.
write-full = There is no room for { $path } on the disk. Make room, or choose another place.
write-denied = You have no right to write { $path }. Choose another place.
write-other = { $path } cannot be written: { $reason }

# Dropping files on the window
drop-here = Drop a scene file to open it
dropped-other = Only scene files (.toml, .rt, .yml, .nff) can be opened, and pictures (.png, .exr) put around the scene.
dropped-several = Of the files that were dropped, { $name } is opened.
dropped-later = Answer the dialog first, then drop { $name } again.

# Unsaved work
recovery-title = Unsaved work was found
recovery-text = An earlier studio ended without saving these scenes. A restored scene opens as it was, still to be saved.
recovery-no-file = Not saved in any file yet
restore = Restore
discard = Discard
decide-later = Decide later
discard-title = Discard “{ $name }”?
discard-text = This unsaved scene is then gone for good.
restored = Restored: { $name }
restore-failed-title = The scene cannot be restored
restore-failed = Its file among the unsaved work cannot be read: { $reason }
keep-failed = Unsaved work cannot be kept against a crash: { $reason }
settings-failed = The settings cannot be remembered: { $reason }

# Problems
problems-none = No problems
problems-in = { $number ->
    [one] { $number } problem in { $name }
   *[other] { $number } problems in { $name }
}
problems-omitted = { $number ->
    [one] … and { $number } more
   *[other] … and { $number } more
}
problems-scene = Problems of the scene
problems-text = Text of the file
problem-error = error
problem-warning = warning
problem-note = note
notes-in = { $number ->
    [one] { $number } note on { $name }
   *[other] { $number } notes on { $name }
}
problem-place = line { $line }, column { $column }
banner-problems = { $number ->
    [one] The file has { $number } problem; what could be read is open.
   *[other] The file has { $number } problems; what could be read is open.
}
banner-warnings = { $number ->
    [one] The file is open; there is { $number } warning about it.
   *[other] The file is open; there are { $number } warnings about it.
}
banner-show = Show
banner-dismiss = Dismiss

# Examples
examples-title = Examples
examples-search = Search the examples
examples-none = No matching examples.

# The note below the picture
example-note-title = { $name }: what to notice
example-note-close = Close the note

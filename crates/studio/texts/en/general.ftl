# The window as a whole.
app-name = Catoptric
pane-viewport = Picture
pane-outliner = Scene
pane-inspector = Inspector
pane-history = History
pane-problems = Problems
unsaved-mark = { $title } *
ok = OK
cancel = Cancel
close = Close
language = Language
    .tip = Switches the language of the studio.
theme = Theme
    .tip = Light or dark window.

# Rendering a picture, and what becomes of it.
render-title = Render a picture
render-size = Size
    .tip = How many pixels the picture has, across and down.
render-size-entry = { $name }: { $size }
render-size-hd = HD
render-size-full-hd = Full HD
render-size-qhd = QHD
render-size-4k = 4K UHD
render-size-square = Square
render-size-viewport = As in the window
render-size-own = Own size
render-width = Width
render-height = Height
render-pixels = pixels
render-proportions = Keep proportions
    .tip = When one side is changed, the other follows, so that the proportions stay.
render-samples = Samples
    .tip = Rays sent through each pixel. More of them make edges and fine reflections smoother; the time grows in proportion.
render-generations = Generations
    .tip = How many generations of rays are traced: the ray from the eye is the first, each reflection or refraction begins the next.
render-generations-scene = As in the scene: { $count }
render-generations-own = Own
render-method = Way of drawing
    .tip = How the picture is drawn. The settings are those chosen over the picture.
render-error-method = The picture cannot be drawn this way: { $reason }.
render-kind = File
    .tip = What is written when the picture is saved.
render-kind-png8 = PNG, 8 bit
    .tip = What displays show: 256 steps in each channel.
render-kind-png16 = PNG, 16 bit
    .tip = 65,536 steps in each channel, for further processing.
render-kind-exr = EXR
    .tip = The linear light as it was computed, in floating point numbers.
render-note-snapshot = The scene is rendered as it is now; you can go on editing meanwhile.
render-note-camera = The picture is seen through the scene’s camera, not through the free view.
render-note-exr = EXR keeps the linear light; exposure and tone curve leave it untouched.
render-note-running = A picture is being rendered; it will be given up.
render-memory = Takes about { $bytes } of memory
render-too-much-memory = This takes about { $bytes } of memory, but only { $free } are free. Choose a smaller size, or close other programs.
render-megabytes = { $count } MB
render-gigabytes = { $count } GB
render-time = Takes about { $time }
render-time-unknown = The time is being estimated…
render-time-moment = a moment
render-time-seconds = { $count } s
render-time-minutes = { $count } min
render-time-hours = { $count } h
render-time-days = { $count } days
render-start = Render
render-start-anew = Give up and render
render-progress = Rendering { $size }
render-percent = { $percent }%
render-times = { $elapsed } passed, { $left } left
render-preparing = { $elapsed } passed, preparing
render-cancel = Cancel
    .tip = Gives up the picture that is being rendered; no file is written.
render-cancel-name = Cancel the render
render-cancelled = The render was cancelled
render-failed = The picture could not be rendered
render-error-empty = A picture of { $size } pixels is empty. Choose at least one pixel for each side.
render-error-side = A picture of { $size } pixels is too large: no side may have more than { $side } pixels. Choose a smaller size.
render-error-pixels = A picture of { $size } pixels is too large: it would take { $bytes } of memory, and at most { $megapixels } million pixels are possible. Choose a smaller size.
render-error-memory = There is not enough memory for a picture of { $size } pixels, which takes { $bytes }. Choose a smaller size, or close other programs.
render-error-scene = The scene cannot be rendered: { $reason }. Correct it and render again.
render-error-fault = Something went wrong in the program itself: { $reason }. Try again; your scene is not affected.

picture-title = Picture { $size }
picture-facts = { $name } · { $samples ->
        [one] { $samples } sample
       *[other] { $samples } samples
    } per pixel · { $time } · { $rays ->
        [one] { $rays } million ray
       *[other] { $rays } million rays
    }
picture-preview = Rendered picture
picture-developing = Developing…
picture-save = Save…
    .tip = Writes the picture to a PNG or EXR file; the ending of the name decides.
picture-copy = Copy
    .tip = Puts the picture into the clipboard as it is shown here, in full size.
picture-close = Close the picture
picture-save-title = Save the picture
picture-saved = Saved: { $name }
picture-save-failed = The picture is not saved
picture-writing = Writing…
picture-copying = Copying…
picture-replace-title = Replace “{ $name }”?
picture-replace-text = There is already a file of this name in { $folder }. If it is replaced, its content is lost.
picture-other-name = Other name…
picture-replace = Replace
picture-drop-title = Close without saving?
picture-drop-text = The picture has been neither saved nor copied. If it is closed, it must be rendered again.
picture-drop = Don’t save
picture-in-clipboard = In the clipboard
picture-copied = Copied the picture, { $size } pixels
picture-copy-too-large = The picture is too large for the clipboard. Save it to a file instead.
picture-copy-memory = There is not enough memory to copy the picture. Save it to a file instead.
picture-copy-failed = The clipboard does not take the picture: { $reason }. Save it to a file instead.
picture-copy-waits = The picture is copied as soon as it is refined; the same command again copies it as it is
picture-copy-none = There is no picture to copy yet
picture-leave-title = Leave the studio?
picture-leave-rendering = A picture is still being rendered. If you leave, it is lost.
picture-leave-unsaved = { $count ->
        [one] A rendered picture has been neither saved nor copied. If you leave, it is lost.
       *[other] { $count } rendered pictures have been neither saved nor copied. If you leave, they are lost.
    }
picture-leave-stay = Stay
picture-leave-go = Leave
picture-leave-waits = The window closes as soon as the picture is written

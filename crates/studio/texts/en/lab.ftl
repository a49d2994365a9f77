# Experiments over the picture and beside it
map-generations = Generations reached
    .tip = The last generation that any ray of the pixel has.
map-rays = Rays per pixel
    .tip = All rays of the pixel, shadow rays included.
map-limit-loss = Light lost by the limit of generations
    .tip = The share of the pixel’s light that the limit of generations leaves out, against a reference of 64 generations.
map-threshold-loss = Light lost by the threshold
    .tip = The share of the pixel’s light that the threshold leaves out, against a reference with a far smaller one.
map-clipped = Light beyond white
    .tip = The share of the pixel’s light that lies beyond the display’s white at the viewport’s exposure.
map-mean = mean { $value }
map-refining = refining, { $percent }%
map-percent = { $value }%
map-incomplete = { $count ->
    [one] { $count } pixel has more rays than were followed; its number may be too small.
   *[other] { $count } pixels have more rays than were followed; their numbers may be too small.
}

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

# How many generations are needed
depth-cycle = Before tracing: the strongest cycle of mirrors is { $bodies }, k = { $factor } a generation
    .tip = Of the light of a generation, the next has at most the share k. What the generations behind a limit could bring is a geometric series; less than 1/512 of white is not seen on a display of 8 bits.
depth-endless = Before tracing: the strongest cycle of mirrors is { $bodies }, k = { $factor } a generation; light does not fade there, so that no number of generations is enough for certain
    .tip = The series of reflections has no bound. Tracing shows what this picture needs.
depth-many = Before tracing: the strongest cycle of mirrors is { $bodies }, k = { $factor } a generation; more than 64 generations would be enough for certain
    .tip = The bound counts the brightest light between the strongest mirrors. Tracing shows what this picture needs.
depth-no-mirrors = No body reflects or lets light through: 1 generation is enough
    .tip = Rays that go on start only at mirrors and transparent bodies.
depth-under-way = How much this picture needs is found out when it is done.
depth-measured = As traced: with { $limit } generations at most { $loss } of white is missing in a pixel
    .tip = Pixels spread over this view were traced with 64 generations.
depth-measured-all = As traced: with { $limit } generations nothing is missing
    .tip = Pixels spread over this view were traced with 64 generations.
depth-measured-part = As traced: with { $limit } generations about { $loss } of white is missing in a pixel
    .tip = Pixels spread over this view were traced with 64 generations; some had more rays than were followed, so that more generations may be needed.
depth-enough = { $count ->
    [one] { $count } generation is enough
   *[other] { $count } generations are enough
}
depth-set = Set { $count }
depth-work = Before tracing: about { $rays } rays for each pixel; with the threshold { $threshold }, { $bounded }
    .tip = Estimated by walks down the trees of some pixels. In clear bodies a ray becomes two at each surface, and their number grows with every generation; a threshold leaves out those that carry next to nothing.
depth-set-threshold = Set threshold { $threshold }
depth-body = “{ $name }”

# Exact answers
exact-none = No mirror, glass or highlight has an exact answer for this body.
exact-rough-mirror = { $body } is rough: a rough mirror has no image points.
exact-curved-mirror = { $body } is neither flat nor a ball: the mirror equation does not apply.
exact-of-parts = { $body } is joined of parts: no formula here knows where it sends light.
exact-object-in-focus = { $other } stands in the focus of { $body }: its image is infinitely far away.
exact-rough-lens = { $body } is rough: it has no focal point.
exact-uneven-lens = { $body } is not scaled evenly: the formula of a ball does not apply.
exact-shared-lens = { $body } and { $other } overlap: the formula of a lens in air does not apply.
exact-weak-lens = The index of { $body } is near 1: it hardly bends light, and its focal point is far away.
exact-focus-inside = The index of { $body } is 2 or more: rays meet within it, before they leave it.
exact-image = Image in { $mirror }
exact-sphere-image = Image in { $mirror }, by the mirror equation
exact-reflection-point = Seen here in { $mirror } (Alhazen’s problem)
exact-focus = Focal point, { $length } m from the center
exact-lens-focus = Focal point of the lens, focal length { $length } m
exact-parabolic-focus = Focus of the paraboloid, { $length } m from the vertex
exact-spherical-focus = Focus of the spherical mirror, { $length } m from the vertex
exact-marginal = Crossing of a ray at 0.7 of the radius
exact-highlight = Highlight of { $light }
exact-ring = { $count ->
    [one] { $count } image between mirrors at { $angle }°
   *[other] { $count } images between mirrors at { $angle }°
}
exact-m = { $value } m
exact-mm = { $value } mm
exact-um = { $value } µm
exact-nm = { $value } nm
exact-off = tracer: off by { $difference }
exact-elsewhere = the tracer’s rays go elsewhere

# The audit of a pixel
audit-background = background
audit-air = air
audit-hover = { $x }, { $y } · { $body } · { $light }
audit-kind-primary = primary
audit-kind-reflected = reflected
audit-kind-total = totally reflected
audit-kind-refracted = refracted
audit-ray = { $ray }: { $kind } – { $end }
audit-tag = { $ray }: { $kind }, weight { $weight }
audit-expand = Terms of ray { $ray }
audit-fold = Fold ray { $ray }
audit-column-ray = Ray
audit-column-generation = Gen.
audit-column-weight = Weight
audit-column-brings = Brings with its branches
audit-click = Click a pixel of the picture: all its rays appear here and in space.
audit-choose-tool = With the audit tool, a click in the picture shows all rays behind a pixel and their arithmetic.
audit-begin = Choose the audit tool
audit-under-way = Tracing the rays…
audit-failed = The pixel cannot be looked into: { $error }
audit-pixel = Pixel { $x }, { $y } of { $width } × { $height }
audit-linear = Linear light: red, green, blue, in the shortest digits that name these numbers and no others
audit-proof-exact = exact sum of the rays
    .tip = The light of the rays adds up to the pixel exactly, in whatever order.
audit-proof-same = sum of the rays
    .tip = The light of the rays adds up to the pixel. Its last bit could depend on the order of adding, so the pixel was rendered anew.
audit-proof-last-bit = sum of the rays but for the last bit
    .tip = The last bit depends on the order of adding; the value is that of the rendered pixel.
audit-proof-incomplete = not all rays are listed
    .tip = There are more rays than are written down; the value is that of the rendered pixel.
audit-generations = Generations 1 to { $shown } of { $count }
audit-front = Path
    .tip = How far slow light has come from the eye: the optical path, meters times the index of refraction. It begins just before the first surface and ends just after the last event; where lengths differ greatly, it speeds up on the way. The renderer follows rays from the eye; light itself runs the other way.
audit-duration = Duration
    .tip = How long slow light takes for the whole path. In glass it is slower than in air by the index of refraction.
audit-meters = m
audit-seconds = s
audit-not-drawn = { $count ->
    [one] { $count } way of the least weight is not drawn
   *[other] { $count } ways of the least weight are not drawn
}
audit-copied = The audit was copied as text
audit-file = audit
audit-save-title = Save the tree of rays

# The terms of a ray.
audit-way = Way
audit-way-words = from { $origin } along { $direction }, in { $medium }, n = { $index }
audit-meets = Meets
audit-meets-words = { $body } after { $distance } m at { $point }, normal { $normal }
audit-meets-within = { $body }, from within, after { $distance } m at { $point }, normal { $normal }
audit-angles = Angles
audit-angle = incidence { $incidence }
audit-angles-both = incidence { $incidence }, refraction { $refraction } (from n = { $from } to { $to })
audit-angles-total = incidence { $incidence }, total internal reflection (from n = { $from } to { $to })
audit-cemented = cemented: from { $left } to { $entered }
audit-seamless = cemented: from { $left } to { $entered }, of the same index: there is no surface
audit-ambient = Ambient
audit-through-coat = through the coat
audit-light-below = below the surface, adds nothing
audit-light-words = { $distance } m away, { $between }
audit-nothing-between = nothing between
audit-blocked = { $body } in the way at { $distance } m
audit-filtered = through { $body } at { $distance } m × { $filter }
audit-filtered-into = from { $body } into { $into } at { $distance } m × { $filter }
audit-medium-before-light = the medium before the light × { $filter }
audit-more-surfaces = { $count ->
    [one] and { $count } more surface
   *[other] and { $count } more surfaces
}
audit-diffuse = Diffuse
audit-highlight = Highlight
audit-facets = Facets
audit-arrives = From this light
audit-local = Local light
audit-reflected = Reflected
audit-refracted = Refracted
audit-split = is split by color into { $count } rays, the first { $ray }
audit-wave = light of { $nanometers } nm
audit-density = chosen with a density of { $density } per steradian
audit-goes-on = goes on as ray { $ray }
audit-ends-nothing = nothing, the coefficient is 0
audit-ends-total = nothing, all light is reflected
audit-ends-limit = ends at the limit of { $limit } generations with the weight { $weight }
audit-ends-threshold = ends: its weight { $weight } is below { $threshold }
audit-ends-left-out = left out of this list, its weight is { $weight }
audit-adds = Adds
audit-weight-times-light = weight · local light
audit-brings = Brings
audit-with-branches = with all that grows from it
audit-was = was { $value }
audit-new = new

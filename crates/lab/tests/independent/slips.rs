//! The mistakes that the tracer makes on demand.

/// Lists the mistakes with the key that a verdict should have for each.
macro_rules! slips {
    ($($(#[$doc:meta])* $name:ident => $key:literal),+ $(,)?) => {
        /// A mistake of the tracer or of the writer of its picture.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Slip {
            $($(#[$doc])* $name),+
        }

        impl Slip {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$name),+];

            /// What the detective calls it in JSON.
            pub const fn key(self) -> &'static str {
                match self {
                    $(Self::$name => $key),+
                }
            }
        }
    };
}

slips! {
    // Light.
    NoShadows => "no-shadows",
    OpaqueShadows => "opaque-shadows-of-clear-bodies",
    ClearShadows => "no-shadows-of-clear-bodies",
    /// What lies beyond the lamp throws shadows, too.
    ShadowsBeyondLamp => "shadows-from-beyond-the-lamp",
    /// Shadow rays are followed for one unit of length.
    ShadowsWithinOne => "shadow-rays-too-short",
    /// Bodies behind the point throw shadows.
    ShadowsFromBehind => "shadows-from-behind",
    /// Shadow rays start at a distance.
    LargeBias => "shadow-bias-too-large",
    Acne => "acne",
    /// If one lamp is hidden, none shines.
    OneShadowForAll => "one-shadow-for-all-lamps",
    /// No ambient light where a lamp is hidden.
    BlackShadows => "no-ambient-in-shadow",
    /// No reflection where a lamp is hidden.
    DullShadows => "no-reflection-in-shadow",
    NoAmbient => "no-ambient",
    AmbientPerLamp => "ambient-for-each-lamp",
    UncoloredAmbient => "ambient-without-color-of-body",
    /// Coefficients are taken for 1.
    WholeAmbient => "ambient-coefficient-left-out",
    WholeDiffuse => "diffuse-coefficient-left-out",
    WholeHighlight => "specular-coefficient-left-out",
    WholeReflection => "reflection-coefficient-left-out",
    NoDiffuse => "no-diffuse",
    /// Diffuse light without the cosine.
    EvenDiffuse => "diffuse-without-cosine",
    /// The vector to the lamp keeps its length in both terms.
    LongWay => "light-vector-not-normalized",
    /// Negative cosines count by their magnitude.
    CosineMagnitude => "cosine-magnitude",
    /// Negative cosines are subtracted.
    CosineNegative => "cosine-negative",
    NoSpecular => "no-specular",
    Halfway => "specular-by-halfway-vector",
    ColoredHighlight => "specular-in-color-of-body",
    WhiteHighlight => "specular-without-color-of-light",
    HighlightInShadow => "specular-in-shadow",
    HighlightOnDarkSide => "specular-on-dark-side",
    /// Highlights are computed toward the eye, in reflections, too.
    EyeInReflections => "specular-toward-eye-in-reflections",
    HighlightSquared => "specular-squared",
    ExponentDoubled => "specular-exponent",
    ExponentQuartered => "specular-exponent",
    /// The vector to the eye keeps its length.
    LongView => "specular-of-vectors-not-normalized",
    /// The vector to the lamp keeps its length in the highlight.
    LongLamp => "specular-of-vectors-not-normalized",
    FalloffSquaredDistance => "falloff-of-squared-distance",
    FalloffFromEye => "falloff-from-eye",
    NoFalloff => "falloff",
    FirstLampOnly => "first-light-only",
    LastLampOnly => "last-light-only",
    LampsAveraged => "lamps-averaged",
    WhiteLamps => "light-color-left-out",
    FullLamps => "light-intensity-left-out",
    /// A lamp shines along the vector to its position everywhere.
    LampsAsDirections => "lamp-as-direction",
    /// The direction to a lamp is reversed in light and shadow.
    LampsReversed => "lamp-reversed",
    ClampedRays => "clamped-early",
    // Rays.
    NoReflection => "no-reflection",
    BlendedReflection => "reflection-blended",
    TintedReflection => "reflection-in-color-of-body",
    /// The reflected ray goes the other way.
    ReflectionBackwards => "reflected-ray-direction",
    /// D − (N·D)N.
    ReflectionHalf => "reflected-ray-direction",
    /// D + 2(N·D)N.
    ReflectionAdded => "reflected-ray-direction",
    NoRefraction => "no-refraction",
    ClearBodiesOpaque => "clear-bodies-opaque",
    NoSchlick => "clear-bodies-not-weighed",
    RatioTurned => "refraction-indices-exchanged",
    StraightRefraction => "refraction-without-bending",
    /// On leaving, the ratio of the indices is that of entering.
    RatioOnLeaving => "refraction-on-leaving",
    /// On leaving, the normal is that of entering.
    NormalOnLeaving => "refraction-normal-on-leaving",
    TotalBlack => "total-reflection-black",
    NoInnerReflection => "no-reflection-inside",
    TintLeftOut => "tint-left-out",
    Depth1 => "depth-too-small",
    Depth2 => "depth-too-small",
    DepthMore => "depth-too-large",
    /// A ray that is not followed any more brings the background.
    BackgroundAtLast => "background-at-last-generation",
    /// A reflected or refracted ray that meets nothing brings no light.
    BlackBackground => "background-not-reflected",
    // Hits.
    /// What lies behind the eye is seen.
    HitsBehind => "hits-behind",
    /// Of the bodies that a ray meets the last in the scene counts.
    LastHit => "hits-not-sorted",
    FirstHit => "hits-not-sorted",
    /// The nearest body is met at the distance of the last.
    LastDistance => "hits-at-distance-of-another-body",
    /// Distances are those in the frame of the body.
    OwnDistance => "distance-in-frame-of-body",
    /// The discriminant is b² − ac of b that is twice too large.
    LostFour => "discriminant-factor",
    /// Roots are divided by 2, whatever the length of the direction.
    LostLength => "discriminant-factor",
    FarRoot => "far-root",
    NearRoot => "near-root",
    NoCaps => "caps-missing",
    /// Only the near root of the side is tested, and there are no caps.
    NoCapsSeenThrough => "caps-missing",
    /// Cylinders and cones have no ends.
    NoEnds => "ends-missing",
    /// Cones are those of the other side of the apex.
    OtherNappe => "cone-of-other-nappe",
    PlaneFromAbove => "plane-from-one-side",
    /// Cones have the normals of cylinders.
    LevelConeNormals => "normals-of-cones",
    CapNormals => "normals-of-caps",
    /// Normals turned rightly, but not of length 1.
    LongNormals => "normals-not-normalized",
    /// Normals as gradients in the frame of the body give them.
    RawNormals => "normals-not-normalized",
    MatrixNormals => "normals-of-scaled-bodies",
    /// Normals point out of the body, even where it is seen from inside.
    NormalsOutward => "normals-not-turned-to-eye",
    NormalsInward => "normals-inward",
    OwnNormals => "normals-in-frame-of-body",
    /// Of spheres.
    NormalsFromOrigin => "normals-from-origin",
    // Bodies.
    DoubledRadius => "diameter-taken-as-radius",
    HalvedRadius => "radius-taken-as-diameter",
    CubesDoubled => "kind-of-body-sized",
    CylindersShort => "kind-of-body-sized",
    SpheresShifted => "kind-of-body-shifted",
    CylindersCentered => "middle-and-base-of-cylinders",
    ConesTurned => "apex-and-base-of-cones",
    ConesMissing => "kind-of-body-missing",
    CubesWithoutShadow => "kind-of-body-without-shadow",
    TurnsXyz => "rotation-order",
    TurnsYxz => "rotation-order",
    TurnsZxy => "rotation-order",
    TurnsYzx => "rotation-order",
    TurnsXzy => "rotation-order",
    TurnsBack => "rotation-sense",
    TurnsLeftOut => "rotation-left-out",
    ScaleLeftOut => "scale-left-out",
    ScaleAfterTurn => "transform-order",
    TurnAfterMove => "transform-order",
    // Patterns.
    NoPattern => "no-pattern",
    CheckerTruncated => "checker-truncated",
    CheckerShifted => "checker-shifted",
    CheckerHalved => "checker-size",
    CheckerInverted => "checker-colors-exchanged",
    CheckerOfBody => "checker-space",
    CheckerFlat => "checker-of-two-axes",
    IntegerColors => "colors-divided-as-integers",
    // The view.
    Corners => "half-pixel",
    OnePixel => "one-pixel",
    LeftHanded => "flipped-left-to-right",
    AngleForWidth => "field-of-view-taken-as-horizontal",
    AngleForHeight => "field-of-view-taken-as-vertical",
    AngleWhole => "field-of-view-not-halved",
    AngleQuartered => "field-of-view-halved-twice",
    NoAspect => "aspect-ratio-left-out",
    UpNotOrthogonal => "camera-axes-not-orthogonal",
    RightNotUnit => "camera-axes-not-normalized",
    TargetAsDirection => "target-taken-as-direction",
    CameraMoved => "camera-moved",
    /// Angles, not tangents, are spread evenly over the picture.
    EvenAngles => "angles-spread-evenly",
    Stretched => "view-stretched",
    Cropped => "view-cropped",
    FlippedDown => "flipped-top-to-bottom",
    UpsideDown => "turned-upside-down",
    // Codes.
    EncodedTwice => "encoded-twice",
    Gamma => "gamma-instead-of-linear",
    Decoded => "tone-curve",
    Darker => "exposure",
    BlueFirst => "red-and-blue-exchanged",
    Overflow => "codes-overflow",
}

//! What a ray tracer may do wrong with rays: where they go, what they meet, and with which normal.

use super::scene_mistake::BodyKind;
use super::trial_tracer::TrialFacts;
use super::verdict::Words;

/// How long the normals of a shape are in its own frame, before its inverse transpose turns them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum NormalLength {
    /// 1
    #[default]
    Unit,
    /// That of the gradient: the way from the center of a sphere, or from the axis.
    Gradient,
    /// That of a shape of size 1, whose sizes are a part of the matrix.
    UnitShape,
    /// That of a shape of radius 1 and of edges 2, whose sizes are a part of the matrix.
    UnitRadius,
}

impl NormalLength {
    pub(super) const ALL: [Self; 4] = [Self::Unit, Self::Gradient, Self::UnitShape, Self::UnitRadius];
}

/// Where shadow rays begin and end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ShadowBias {
    /// Hits nearer than so many thousandths of a meter are left out.
    Least(u16),
    /// The ray starts so many thousandths of a meter above the surface.
    Above(u16),
}

/// The rules by which a program might turn a refracted ray on leaving a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LeavingRule {
    /// The ratio of the indices is that of entering.
    Ratio,
    /// The normal is that of entering.
    Normal,
    /// Both are.
    Both,
    /// The ray is not bent at all, neither on entering; it belongs to the next generation all the same.
    Straight,
}

/// Lists the faults without numbers, the likelier first: topic, key in JSON, words in English and in Russian.
macro_rules! ray_faults {
    ($($(#[$doc:meta])* $name:ident, $topic:literal, $key:literal, $english:literal, $russian:literal;)+) => {
        /// A fault of rays.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum RayFault {
            $($(#[$doc])* $name,)+
            /// Normals are turned rightly, but not brought to length 1: of spheres, cubes, cylinders and cones.
            LongNormals([NormalLength; 4]),
            /// Shadow rays start away from the surface.
            Bias(ShadowBias),
            /// A ray that leaves a body is bent wrongly.
            Leaving(LeavingRule),
            /// What the hits of a kind of body's own would be, are missing.
            WithoutCaps(BodyKind),
        }

        impl RayFault {
            pub(super) const PLAIN: &[Self] = &[$(Self::$name),+];

            /// Faults of one topic exclude each other.
            pub(super) fn topic(self) -> u8 {
                match self {
                    $(Self::$name => $topic,)+
                    Self::LongNormals(_) => 10,
                    Self::Bias(_) => 20,
                    Self::Leaving(_) => 31,
                    Self::WithoutCaps(_) => 3,
                }
            }

            /// The name in JSON.
            pub fn key(self) -> &'static str {
                match self {
                    $(Self::$name => $key,)+
                    Self::LongNormals(_) => "normals-not-normalized",
                    Self::Bias(_) => "shadow-bias-too-large",
                    Self::Leaving(LeavingRule::Normal) => "refraction-normal-on-leaving",
                    Self::Leaving(LeavingRule::Straight) => "refraction-without-bending",
                    Self::Leaving(_) => "refraction-on-leaving",
                    Self::WithoutCaps(_) => "caps-missing",
                }
            }

            /// The fault in English and in Russian.
            pub(super) fn words(self) -> Words {
                match self {
                    $(Self::$name => [$english, $russian],)+
                    Self::LongNormals(_) => [
                        "normals are not brought to length 1",
                        "нормали не приведены к длине 1",
                    ],
                    Self::Bias(_) => [
                        "shadow rays start too far from the surface (bias): shadows are detached",
                        "теневые лучи начинаются слишком далеко от поверхности (смещение): тени оторваны",
                    ],
                    Self::Leaving(LeavingRule::Ratio) => [
                        "a ray that leaves a clear body is bent with the indices of entering",
                        "луч, покидающий прозрачное тело, преломлён с показателями входа",
                    ],
                    Self::Leaving(LeavingRule::Normal) => [
                        "the normal is not turned where a ray leaves a clear body",
                        "нормаль не повёрнута там, где луч покидает прозрачное тело",
                    ],
                    Self::Leaving(LeavingRule::Both) => [
                        "a ray that leaves a clear body is bent as if it entered it",
                        "луч, покидающий прозрачное тело, преломлён, словно входит в него",
                    ],
                    Self::Leaving(LeavingRule::Straight) => [
                        "no refraction: rays go straight through clear bodies",
                        "нет преломления: лучи идут сквозь прозрачные тела прямо",
                    ],
                    Self::WithoutCaps(BodyKind::Cones) => {
                        ["caps of cones are missing", "у конусов нет оснований"]
                    }
                    Self::WithoutCaps(_) => {
                        ["caps of cylinders are missing", "у цилиндров нет оснований"]
                    }
                }
            }
        }
    };
}

ray_faults! {
    /// Bodies beyond the lamp throw shadows.
    ShadowsFromBeyond, 20, "shadows-from-beyond-the-lamp",
        "bodies beyond the lamp throw shadows: the shadow ray does not end at the lamp",
        "тени бросают и тела за лампой: теневой луч не кончается у лампы";
    /// Shadow rays end at distance 1.
    ShadowsWithinOne, 20, "shadow-rays-too-short",
        "shadow rays end at distance 1 instead of at the lamp",
        "теневые лучи кончаются на расстоянии 1, а не у лампы";
    /// Cylinders and cones have no caps.
    NoCaps, 3, "caps-missing",
        "caps of cylinders and cones are missing", "у цилиндров и конусов нет оснований";
    /// Cylinders and cones have no caps, and are not met from inside.
    NoCapsSeenThrough, 3, "caps-missing",
        "caps of cylinders and cones are missing, and what lies behind is seen: the far root is not tried",
        "у цилиндров и конусов нет оснований, и видно то, что позади: дальний корень не испробован";
    /// Cylinders and cones have no lower cap.
    NoBaseCap, 3, "caps-missing",
        "the lower caps of cylinders and cones are missing", "у цилиндров и конусов нет нижних оснований";
    /// Cylinders and cones have no upper cap.
    NoTopCap, 3, "caps-missing",
        "the upper caps of cylinders and frustums are missing",
        "у цилиндров и усечённых конусов нет верхних оснований";
    /// Cylinders and cones have no ends.
    NoEnds, 3, "ends-missing",
        "cylinders and cones have no ends: their heights are left out",
        "у цилиндров и конусов нет концов: высоты не учтены";
    /// Cylinders and double cones have no ends.
    NoEndsOfDoubleCones, 3, "ends-missing",
        "cylinders and double cones have no ends: their heights are left out",
        "у цилиндров и двойных конусов нет концов: высоты не учтены";
    /// Cones are those on the other side of the apex.
    OtherNappe, 4, "cone-of-other-nappe",
        "cones lie on the other side of their apex (the other nappe)",
        "конусы лежат по другую сторону вершины (другая полость)";
    /// Cones go on beyond the apex.
    BothNappes, 4, "cone-of-other-nappe",
        "cones are double: the other nappe is seen, too", "конусы двойные: видна и другая полость";
    /// Planes are seen from above alone.
    PlanesFromAbove, 5, "plane-from-one-side",
        "planes are met from one side only", "плоскости видны лишь с одной стороны";
    /// Planes are seen from below alone.
    PlanesFromBelow, 5, "plane-from-one-side",
        "planes are met from the side against their normals only",
        "плоскости видны лишь со стороны, обратной нормали";
    /// Only the far hit of a curved surface counts.
    FarRoot, 2, "far-root",
        "the far root is taken: curved bodies are seen from inside",
        "взят дальний корень: кривые тела видны изнутри";
    /// Only the near hit of a curved surface counts.
    NearRoot, 2, "near-root",
        "the near root alone is tried: curved bodies are not met from inside",
        "испробован лишь ближний корень: изнутри кривые тела не встречены";
    /// b² − ac with b twice too large.
    LostFour, 2, "discriminant-factor",
        "a factor is lost in the discriminant: b² − ac instead of b² − 4ac",
        "в дискриминанте потерян множитель: b² − ac вместо b² − 4ac";
    /// b² − 4ac with b half as large.
    ExtraFour, 2, "discriminant-factor",
        "a factor too many in the discriminant: b² − 4ac of half the b",
        "в дискриминанте лишний множитель: b² − 4ac при половинном b";
    /// a is left out in both places.
    LostSquare, 2, "discriminant-factor",
        "the squared length of the direction is left out of the discriminant",
        "в дискриминанте не учтён квадрат длины направления";
    /// The roots are divided by 2 alone.
    LostLength, 2, "discriminant-factor",
        "roots are not divided by the squared length of the direction",
        "корни не поделены на квадрат длины направления";
    /// The roots are not divided by 2.
    LostTwo, 2, "discriminant-factor",
        "roots are twice too far: the division by 2 is lost", "корни вдвое дальше: потеряно деление на 2";
    /// The radius stands for its square.
    LostRadius, 2, "discriminant-factor",
        "the radius stands for its square in the equation of spheres",
        "в уравнении шара вместо квадрата радиуса сам радиус";
    /// Of what a ray meets, the last in the scene counts.
    LastHit, 0, "hits-not-sorted",
        "the last body in the scene that a ray meets counts, not the nearest",
        "считается последнее в сцене тело на пути луча, а не ближайшее";
    /// Of what a ray meets, the first in the scene counts.
    FirstHit, 0, "hits-not-sorted",
        "the first body in the scene that a ray meets counts, not the nearest",
        "считается первое в сцене тело на пути луча, а не ближайшее";
    /// The nearest body is met at the distance of the last in the scene.
    LastDistance, 0, "hits-at-distance-of-another-body",
        "the nearest body is met at another body's distance",
        "ближайшее тело встречено на расстоянии другого тела";
    /// What lies behind the eye is seen.
    HitsBehindEye, 0, "hits-behind",
        "hits of negative distance count: what lies behind the eye is seen",
        "считаются отрицательные расстояния: видно то, что позади глаза";
    /// What lies behind a ray is met.
    HitsBehind, 0, "hits-behind",
        "hits of negative distance count: rays meet what lies behind them",
        "считаются отрицательные расстояния: лучи встречают то, что позади";
    /// What lies behind a shadow ray hides the lamp.
    ShadowsFromBehind, 20, "shadows-from-behind",
        "bodies behind the point throw shadows: hits of negative distance count in shadow rays",
        "тени бросают тела позади точки: в теневых лучах считаются отрицательные расстояния";
    /// Distances are those in the frame of the body.
    OwnDistance, 1, "distance-in-frame-of-body",
        "distances are those in the frame of a scaled body, whose direction is brought to length 1",
        "расстояния взяты в системе масштабированного тела, где направление приведено к длине 1";
    /// Distances in the frame of the body decide what is nearest.
    OwnOrder, 1, "distance-in-frame-of-body",
        "the nearest body is found by distances in the frames of scaled bodies",
        "ближайшее тело найдено по расстояниям в системах масштабированных тел";
    /// Normals of scaled bodies are turned by the matrix of the body.
    MatrixNormals, 10, "normals-of-scaled-bodies",
        "normals of scaled bodies are wrong: they need the inverse transpose",
        "нормали масштабированных тел неверны: нужна обратная транспонированная матрица";
    /// Normals of scaled bodies are those of the unscaled body.
    TurnedNormals, 10, "normals-of-scaled-bodies",
        "normals of scaled bodies are wrong: they need the inverse transpose",
        "нормали масштабированных тел неверны: нужна обратная транспонированная матрица";
    /// Normals of turned bodies are not turned.
    OwnNormals, 10, "normals-in-frame-of-body",
        "normals are not turned with their bodies", "нормали не повёрнуты вместе с телами";
    /// Normals of spheres are the way from the origin of the world.
    NormalsFromOrigin, 10, "normals-from-origin",
        "normals of spheres are the way from the origin of the world, not from the center",
        "нормали шаров взяты от начала координат, а не от центра";
    /// Normals are those that point out of the body even where it is seen from inside.
    NormalsOutward, 11, "normals-not-turned-to-eye",
        "normals are not turned to the eye: surfaces seen from behind stay dark",
        "нормали не повёрнуты к глазу: поверхности, видимые с изнанки, тёмные";
    /// Normals point inwards.
    NormalsInward, 11, "normals-inward",
        "normals point into the bodies", "нормали направлены внутрь тел";
    /// Cones have the normals of cylinders.
    LevelConeNormals, 12, "normals-of-cones",
        "normals of cones are those of cylinders: the slope is left out",
        "нормали конусов как у цилиндров: наклон не учтён";
    /// Caps have the normals of the side.
    CapNormals, 13, "normals-of-caps",
        "caps of cylinders and cones have the normals of the side",
        "у оснований цилиндров и конусов нормали боковой поверхности";
    /// Lamps below the horizon shine as if they stood above.
    CosineMagnitude, 21, "cosine-magnitude",
        "negative cosines count by their magnitude: dark sides are lit",
        "отрицательные косинусы взяты по модулю: тёмные стороны освещены";
    /// Lamps below the horizon take light away.
    CosineNegative, 21, "cosine-negative",
        "negative cosines are not cut to 0: lamps take light away from dark sides",
        "отрицательные косинусы не обрезаны до 0: лампы отнимают свет у тёмных сторон";
    /// Lamps below the horizon make highlights.
    HighlightOnDarkSide, 21, "specular-on-dark-side",
        "specular highlights are seen on dark sides, too", "блики видны и на тёмных сторонах";
    /// Lamps shine along the vector to their position.
    LampsAsDirections, 22, "lamp-as-direction",
        "the position of a lamp is taken as its direction", "положение лампы взято как направление на неё";
    /// Lamps shine from the other side.
    LampsReversed, 22, "lamp-reversed",
        "the direction to the lamp is reversed", "направление на лампу обращено";
    /// The reflected ray goes the other way.
    ReflectionBackwards, 30, "reflected-ray-direction",
        "the reflected ray goes the other way: its sign is wrong",
        "отражённый луч идёт в обратную сторону: неверен знак";
    /// D − (N·D)N.
    ReflectionHalf, 30, "reflected-ray-direction",
        "the reflected ray lacks the factor 2", "у отражённого луча потерян множитель 2";
    /// D + 2(N·D)N.
    ReflectionAdded, 30, "reflected-ray-direction",
        "the reflected ray has the wrong sign: D + 2(N·D)N",
        "у отражённого луча неверный знак: D + 2(N·D)N";
    /// Scaled after being turned.
    ScaledLast, 40, "transform-order",
        "bodies are turned first and scaled afterwards", "тела сначала повёрнуты, потом масштабированы";
    /// Turned after being moved.
    TurnedLast, 40, "transform-order",
        "bodies are moved first and turned about the origin of the world afterwards",
        "тела сначала перенесены, потом повёрнуты вокруг начала координат";
    /// Scaled after being moved.
    ScaledAfterMove, 40, "transform-order",
        "bodies are moved first and scaled from the origin of the world afterwards",
        "тела сначала перенесены, потом масштабированы от начала координат";
    /// Moved, scaled, turned.
    MovedFirst, 40, "transform-order",
        "bodies are moved first, then scaled and turned", "тела сначала перенесены, потом масштабированы и повёрнуты";
    /// Cells of checkers are cut toward 0.
    CheckerTruncated, 50, "checker-truncated",
        "checkers by truncation instead of floor: cells are doubled at 0",
        "клетки по отбрасыванию дробной части, а не по округлению вниз: у нуля они двойные";
    /// Only x and z count in checkers.
    CheckerFlat, 50, "checker-of-two-axes",
        "checkers have x and z only: they do not change with the height",
        "у клеток учтены лишь x и z: с высотой они не меняются";
    /// The vector up is that of the scene.
    UpNotOrthogonal, 60, "camera-axes-not-orthogonal",
        "the camera's up is taken as it is, not perpendicular to the view",
        "вектор камеры «вверх» взят как есть, не перпендикулярно взгляду";
    /// The vector to the right is not brought to length 1.
    RightNotUnit, 60, "camera-axes-not-normalized",
        "the camera's axes are not brought to length 1", "оси камеры не приведены к длине 1";
    /// That to the right alone.
    RightAloneNotUnit, 60, "camera-axes-not-normalized",
        "the camera's axis to the right is not brought to length 1",
        "ось камеры «вправо» не приведена к длине 1";
    /// Angles are spread evenly over the picture.
    EvenAngles, 60, "angles-spread-evenly",
        "angles instead of tangents are spread evenly over the picture",
        "по изображению равномерно распределены углы, а не тангенсы";
    /// The tilt of the camera is left out.
    NoTilt, 60, "camera-tilt-left-out",
        "the camera looks level: its tilt is left out", "камера смотрит горизонтально: наклон не учтён";
}

impl RayFault {
    /// All that a scene can show, the likelier first.
    pub(super) fn possible(facts: &TrialFacts) -> Vec<Self> {
        let plain = Self::PLAIN.iter().copied().filter(|fault| fault.is_possible(facts));
        let mut all: Vec<Self> = plain.collect();
        for length in
            [NormalLength::Unit, NormalLength::Gradient, NormalLength::UnitShape, NormalLength::UnitRadius]
        {
            if length != NormalLength::Unit || facts.is_scaled {
                all.push(Self::LongNormals([length; 4]));
            }
        }
        if facts.is_lit {
            for size in [10, 30, 100, 300] {
                all.extend([ShadowBias::Least(size), ShadowBias::Above(size)].map(Self::Bias));
            }
        }
        if facts.transmits {
            let rules = [LeavingRule::Ratio, LeavingRule::Normal, LeavingRule::Both, LeavingRule::Straight];
            all.extend(rules.map(Self::Leaving));
        }
        if facts.has_cylinders && facts.has_cones {
            all.extend([BodyKind::Cylinders, BodyKind::Cones].map(Self::WithoutCaps));
        }
        all
    }

    fn is_possible(self, facts: &TrialFacts) -> bool {
        match self {
            Self::NoCaps
            | Self::NoCapsSeenThrough
            | Self::NoBaseCap
            | Self::NoTopCap
            | Self::NoEnds
            | Self::CapNormals => facts.has_cylinders || facts.has_cones,
            Self::NoEndsOfDoubleCones | Self::OtherNappe | Self::BothNappes | Self::LevelConeNormals => {
                facts.has_cones
            }
            Self::PlanesFromAbove | Self::PlanesFromBelow => facts.has_planes,
            Self::FarRoot | Self::NearRoot | Self::LostFour | Self::ExtraFour | Self::LostTwo => {
                facts.is_round
            }
            Self::LostSquare | Self::LostLength | Self::OwnDistance | Self::OwnOrder => {
                facts.is_round && facts.is_stretched
            }
            Self::LostRadius => facts.has_spheres,
            Self::MatrixNormals | Self::TurnedNormals | Self::ScaledLast => facts.is_scaled,
            Self::OwnNormals => facts.is_turned || facts.is_scaled,
            Self::TurnedLast => facts.is_turned,
            Self::ScaledAfterMove | Self::MovedFirst => facts.is_stretched,
            Self::NormalsFromOrigin => facts.has_spheres,
            Self::ReflectionBackwards | Self::ReflectionHalf | Self::ReflectionAdded => facts.reflects,
            Self::CheckerTruncated | Self::CheckerFlat => facts.has_checkers,
            Self::ShadowsFromBeyond
            | Self::ShadowsWithinOne
            | Self::ShadowsFromBehind
            | Self::CosineMagnitude
            | Self::CosineNegative
            | Self::LampsAsDirections
            | Self::LampsReversed => facts.is_lit,
            Self::HighlightOnDarkSide => facts.has_highlights,
            Self::UpNotOrthogonal | Self::RightNotUnit | Self::RightAloneNotUnit | Self::EvenAngles => {
                facts.is_perspective
            }
            _ => true,
        }
    }

    /// The fault with other numbers, of which one may explain the picture better.
    pub(super) fn variants(self) -> Vec<Self> {
        match self {
            Self::LongNormals(own) => (0..4_usize)
                .flat_map(|kind| {
                    NormalLength::ALL.map(move |length| {
                        let mut lengths = own;
                        if let Some(one) = lengths.get_mut(kind) {
                            *one = length;
                        }
                        Self::LongNormals(lengths)
                    })
                })
                .filter(|other| *other != self)
                .collect(),
            Self::Bias(bias) => {
                let around = |size: u16| [size / 2, size / 4 * 3, size / 4 * 5, size / 2 * 3];
                match bias {
                    ShadowBias::Least(size) => {
                        around(size).map(|size| Self::Bias(ShadowBias::Least(size))).into()
                    }
                    ShadowBias::Above(size) => {
                        around(size).map(|size| Self::Bias(ShadowBias::Above(size))).into()
                    }
                }
            }
            _ => Vec::new(),
        }
    }
}

/// Faults of rays of different topics, in their order.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct RayFaults(Vec<RayFault>);

impl RayFaults {
    pub(super) fn iter(&self) -> impl Iterator<Item = RayFault> {
        self.0.iter().copied()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn has(&self, fault: RayFault) -> bool {
        self.0.contains(&fault)
    }

    /// The set with one more; `None` if it has one of that topic.
    pub(super) fn with(&self, fault: RayFault) -> Option<Self> {
        if self.0.iter().any(|own| own.topic() == fault.topic()) {
            return None;
        }
        let mut all = self.0.clone();
        all.push(fault);
        all.sort_unstable();
        Some(Self(all))
    }

    pub(super) fn without(&self, fault: RayFault) -> Self {
        Self(self.0.iter().copied().filter(|own| *own != fault).collect())
    }
}

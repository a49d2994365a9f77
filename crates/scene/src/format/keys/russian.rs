//! The tables and keys of the format in Russian.

use super::{BODY, CAMERA, ENVIRONMENT, LIGHT, MATERIAL, NESTED_PATTERN, PART, PATTERN, ROOT, SKY, TRACING};
use crate::format::spec::{KeySpec, TableSpec};

/// A table in Russian.
struct RussianTable {
    table: &'static TableSpec,
    /// What it is called, in the genitive.
    genitive: &'static str,
    /// What its keys mean, as [`KeySpec::doc`]; of a part, those that mean something else than for a body.
    docs: &'static [(&'static str, &'static str)],
}

/// What a table is called, in the genitive: `тела`.
pub(crate) fn genitive(table: &TableSpec) -> &'static str {
    TABLES.iter().find(|known| known.table == table).map_or(table.name, |known| known.genitive)
}

/// What a key means; in English if it is no key of the format.
pub(crate) fn doc(key: &KeySpec) -> &'static str {
    let table = TABLES.iter().find(|known| known.table.keys.iter().any(|own| own == key));
    // A part shares keys with bodies.
    let body =
        TABLES.iter().filter(|known| *known.table == BODY && table.is_some_and(|own| *own.table == PART));
    let docs = table.into_iter().chain(body).flat_map(|known| known.docs);
    docs.into_iter().find(|(name, _)| *name == key.name).map_or(key.doc, |(_, doc)| *doc)
}

const CHECKER: &str = "второй цвет: шахматная раскраска";
const STRIPES: &str = "второй цвет: через слой вдоль оси X";
const RINGS: &str = "второй цвет: через кольцо вокруг оси Y";
const GRADIENT: &str = "второй цвет, в который первый снова и снова переходит вдоль оси X";

static TABLES: [RussianTable; 11] = [
    RussianTable {
        table: &ROOT,
        genitive: "сцены",
        docs: &[
            ("format", "версия формата файла"),
            ("camera", "откуда снято изображение"),
            ("environment", "что окружает тела"),
            ("tracing", "как далеко прослеживаются лучи"),
            ("materials", "материалы с именами, общие для нескольких тел"),
            ("lights", "источники света"),
            ("bodies", "тела"),
        ],
    },
    RussianTable {
        table: &CAMERA,
        genitive: "камеры",
        docs: &[
            ("position", "точка наблюдения, метры"),
            ("target", "точка в центре изображения, метры"),
            ("up", "направление вверх на изображении"),
            ("projection", "проекция"),
            ("fov", "вертикальный угол обзора, градусы"),
            ("height", "высота окна, метры"),
        ],
    },
    RussianTable {
        table: &ENVIRONMENT,
        genitive: "окружения",
        docs: &[
            ("background", "свет, который приносит луч, ничего не встретивший"),
            ("ambient", "фоновое освещение"),
            ("sky", "небо вместо фона"),
            ("picture", "картинка всего вокруг вместо фона"),
            ("layer", LAYER),
            ("rotation", "поворот картинки вокруг оси y, градусы"),
            ("strength", "множитель света неба или картинки"),
            ("contact", "что между соприкасающимися телами: плёнка воздуха (`air`) или ничего (`cemented`)"),
        ],
    },
    RussianTable {
        table: &SKY,
        genitive: "неба",
        docs: &[
            ("zenith", "свет прямо сверху"),
            ("horizon", "свет от горизонта"),
            ("nadir", "свет прямо снизу"),
        ],
    },
    RussianTable {
        table: &TRACING,
        genitive: "трассировки",
        docs: &[
            ("generations", "число поколений лучей, считая с первичного луча"),
            (
                "threshold",
                "вес, ниже которого луч не прослеживается; при 0 прослеживается всё, что несёт свет",
            ),
        ],
    },
    RussianTable {
        table: &MATERIAL,
        genitive: "материала",
        docs: &[
            ("model", "что поверхность делает со светом"),
            ("color", "цвет тела"),
            ("ambient", "коэффициент фонового освещения"),
            ("diffuse", "коэффициент диффузного отражения"),
            ("specular", "коэффициент блика"),
            ("shininess", "показатель степени блика"),
            (
                "reflection",
                "коэффициент зеркального отражения; если его нет, он равен `specular`, а у зеркала 1",
            ),
            ("transmission", "коэффициент пропускания; при 0 тело непрозрачно"),
            ("ior", "показатель преломления относительно воздуха"),
            ("tint", "окраска проходящего света"),
            (
                "fresnel",
                "как отражение и пропускание прозрачного тела зависят от угла: никак (`constant`) или по формуле Шлика \
                 (`schlick`)",
            ),
            ("substance", "вещество прозрачного тела"),
            ("dispersion", "по-разному ли преломляются цвета"),
            ("abbe", "число Аббе: чем оно больше, тем слабее дисперсия"),
            (
                "attenuation_color",
                "цвет, который белый свет приобретает на пути `attenuation_distance` в теле",
            ),
            ("attenuation_distance", "путь, после которого у света цвет `attenuation_color`, метры"),
            ("metal", "измеренный металл"),
            ("n", "показатель преломления для красного, зелёного и синего света"),
            ("k", "показатель экстинкции для красного, зелёного и синего света"),
            ("roughness", "шероховатость отражающей поверхности; 0 — гладкая"),
            ("texture", "картинка на теле вместо его цвета"),
            ("layer", LAYER),
            ("checker", CHECKER),
            ("stripes", STRIPES),
            ("rings", RINGS),
            ("gradient", GRADIENT),
        ],
    },
    RussianTable {
        table: &PATTERN,
        genitive: "узора",
        docs: &[
            ("color", "второй цвет, нечётных клеток"),
            ("size", "ширина клетки, метры"),
            (
                "space",
                "относительно чего клетки неподвижны; клетки тела движутся и поворачиваются вместе с ним",
            ),
            ("position", "начало узора, метры"),
            ("rotation", "повороты вокруг неподвижных осей X, затем Y, затем Z, градусы"),
            ("scale", "множитель размера или три множителя"),
            ("first", "узор вместо первого цвета"),
            ("second", "узор вместо второго цвета"),
        ],
    },
    RussianTable {
        table: &NESTED_PATTERN,
        genitive: "узора в узоре",
        docs: &[("checker", CHECKER), ("stripes", STRIPES), ("rings", RINGS), ("gradient", GRADIENT)],
    },
    RussianTable {
        table: &LIGHT,
        genitive: "источника света",
        docs: &[
            ("name", "имя, своё у каждого источника"),
            ("position", "место источника, метры"),
            ("color", "цвет источника"),
            ("intensity", "множитель цвета"),
            ("falloff", "ослабление света с расстоянием d: 1, 1/(d + K) или 1/d²"),
            ("falloff_constant", "K линейного ослабления 1/(d + K), метры"),
            ("radius", "радиус светящегося шара, метры; 0 — точка"),
            ("hidden", "выключен ли источник"),
            ("locked", "закреплён ли источник в студии; на изображения это не влияет"),
        ],
    },
    RussianTable {
        table: &BODY,
        genitive: "тела",
        docs: &[
            ("name", "имя, своё у каждого тела"),
            (
                "instance_of",
                "имя тела, форма, размеры и части которого у него те же, как и материал, если нет своего",
            ),
            ("shape", "форма тела"),
            ("sides", "число граней призмы"),
            (
                "radius",
                "радиус (у конуса — основания, у параболоида, линзы и вогнутого зеркала — края), метры",
            ),
            ("inner_radius", "радиус отверстия, меньше чем `radius`, метры"),
            ("top_radius", "радиус верхнего основания, метры; при 0 конус острый"),
            ("size", "длина ребра или длины трёх рёбер, метры"),
            ("width", "длина прямоугольника вдоль X, метры"),
            ("length", "длина прямоугольника вдоль Z, метры"),
            ("a", "вершина треугольника, метры"),
            ("b", "вершина треугольника после `a`, метры"),
            ("c", "вершина треугольника после `b`, метры"),
            ("thickness", "толщина (у линзы и вогнутого зеркала — посередине, у чаши — стенки), метры"),
            ("height", "высота (у чаши — края: по умолчанию её радиус), метры"),
            ("profile", "кривая поверхности вогнутого зеркала"),
            (
                "focal_length",
                "расстояние до фокуса (от вершины, вместо высоты параболоида; у линзы в воздухе — вместо радиусов \
                 кривизны, меньше нуля, если она рассеивает свет), метры",
            ),
            ("ior", "показатель преломления, для которого верно фокусное расстояние линзы"),
            (
                "curvature_radius",
                "радиус кривизны вогнутого зеркала у вершины вместо фокусного расстояния, метры",
            ),
            ("front_radius", "радиус кривизны линзы со стороны -Y, метры; 0 — плоско, больше нуля — выпукло"),
            ("back_radius", "радиус кривизны линзы со стороны +Y, метры; 0 — плоско, меньше нуля — выпукло"),
            (
                "visible_side",
                "видимая сторона поверхности: `outer` — внешняя, куда направлена нормаль, `inner` — внутренняя или `both` — \
                 обе; с другой стороны там ничего нет",
            ),
            ("base", "центр нижнего основания или вершина параболоида, метры"),
            ("top", "центр верхнего основания или вершина конуса, метры"),
            ("position", "место начала собственных координат тела, метры"),
            ("rotation", "повороты вокруг неподвижных осей X, затем Y, затем Z, градусы"),
            ("scale", "множитель размера или три множителя"),
            ("material", "имя материала или собственный материал"),
            ("hidden", "скрыто ли тело: его не видно, оно не отражается и не отбрасывает тени"),
            (
                "shadow",
                "сколько света проходит к другим телам: сколько пропускают поверхности (`filtered`), весь (`none`: тени нет) \
                 или нисколько (`full`)",
            ),
            (
                "contact",
                "что между телом и теми, которых оно касается: плёнка воздуха (`air`), ничего (`cemented`) или как сказано \
                 у другого тела либо у сцены (`scene`)",
            ),
            ("locked", "закреплено ли тело в студии; на изображения это не влияет"),
            ("parts", "из чего составлено тело"),
        ],
    },
    RussianTable {
        table: &PART,
        genitive: "части тела",
        docs: &[
            ("name", "имя, своё у каждой части одного целого"),
            ("position", "место начала собственных координат части в координатах целого, метры"),
            ("material", "имя материала или собственный материал; если его нет, он тот же, что у целого"),
        ],
    },
];

const LAYER: &str = "слой картинки, если в её файле их несколько";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_and_key_has_russian_words() {
        for spec in super::super::TABLES {
            let known = TABLES.iter().find(|known| known.table == spec).unwrap();
            let names =
                |docs: &[(&'static str, &str)]| docs.iter().map(|(name, _)| *name).collect::<Vec<_>>();
            // Keys of a part that mean what they mean for a body are told there.
            let is_own = |key: &&KeySpec| {
                *spec != PART || BODY.key(key.name).is_none_or(|of_body| of_body.doc != key.doc)
            };
            let keys: Vec<&str> = spec.keys.iter().filter(is_own).map(|key| key.name).collect();
            assert_eq!(names(known.docs), keys, "{}", spec.name);
            for key in spec.keys {
                assert_ne!(doc(key), key.doc, "{} of {}", key.name, spec.name);
            }
        }
        assert_eq!(
            (genitive(&BODY), doc(BODY.key("radius").unwrap())),
            ("тела", "радиус (у конуса — основания, у параболоида, линзы и вогнутого зеркала — края), метры")
        );
        assert_eq!(doc(LIGHT.key("radius").unwrap()), "радиус светящегося шара, метры; 0 — точка");
    }
}

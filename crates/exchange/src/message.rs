//! What is said about scenes of other programs, in English and in Russian.

use catoptric_scene::{Number, Sentence};

use crate::phrase::{Argument, ConeNumbers, Kind, Title};

catoptric_scene::messages! {
    // All formats.
    TooLong { most: String }:
        "the file is too long: scenes of other programs have at most {most} MiB",
        "файл слишком длинный: сцены других программ занимают не больше {most} МиБ";
    LineTooLong { most: String }:
        "the line has more than {most} words",
        "в строке больше {most} слов";
    Approximate { instead: Sentence }:
        "with `--approximate` {instead}",
        "с ключом `--approximate` {instead}";
    LeftOut:
        "it is left out",
        "это пропускается";
    TakenAsItIs:
        "it is taken as it is",
        "это берётся как есть";
    NearestTaken:
        "the nearest that is allowed is taken",
        "берётся ближайшее допустимое";
    WhiteTaken:
        "white is taken",
        "берётся белый";
    AllInView:
        "the camera is put where it sees all bodies",
        "камера ставится так, чтобы видеть все тела";
    NotANumber { word: String }:
        "`{word}` is not a number",
        "`{word}` — не число";
    DecimalComma { word: String }:
        "`{word}` has a decimal comma",
        "в `{word}` десятичная запятая";
    DecimalPoint { example: String }:
        "a decimal number is written with a point: `{example}`",
        "дробная часть отделяется точкой: `{example}`";
    DidYouMean { word: String }:
        "did you mean `{word}`?",
        "возможно, `{word}`?";
    Write { usage: String }:
        "write `{usage}`",
        "напишите `{usage}`";
    FirstTime:
        "the first time",
        "первый раз";

    // miniRT.
    NoElement { word: String }:
        "there is no element `{word}`",
        "элемента `{word}` нет";
    ElementsAre { elements: String }:
        "the elements are {elements}",
        "элементы: `{elements}`";
    ElementTwice { element: String }:
        "`{element}` is given twice",
        "`{element}` встречается дважды";
    ElementMissing { element: &'static str }:
        "the scene has no `{element}`",
        "в сцене нет `{element}`";
    NoAmbientLight:
        "there is no ambient light",
        "фонового света нет";
    Lacks { element: String, argument: Argument }:
        "`{element}` lacks {argument}",
        "у `{element}` не хватает: {argument}";
    TooMany { element: String }:
        "`{element}` has more values than this",
        "у `{element}` больше значений, чем нужно";
    OutOfRange { argument: Argument, value: Number, low: Number, high: Number }:
        "{argument} is {value}, but must be from {low} to {high}",
        "{argument}: {value}, а должно быть от {low} до {high}";
    NotPositive { argument: Argument, value: Number }:
        "{argument} is {value}, but must be greater than 0",
        "{argument}: {value}, а должно быть больше 0";
    NotADirection { argument: Argument, element: String }:
        "{argument} of `{element}` has a number beyond -1 to 1",
        "{argument} у `{element}`: есть число вне отрезка от -1 до 1";
    ZeroDirection { argument: Argument }:
        "{argument} is zero",
        "{argument}: нулевой вектор";
    DirectionIs:
        "a direction is three numbers from -1 to 1, not all 0: `0,0,1`; turns by angles are not read",
        "направление — три числа от -1 до 1, не все равны 0: `0,0,1`; повороты на углы не читаются";
    NotThreeNumbers { word: String }:
        "`{word}` is not three numbers",
        "`{word}` — не три числа";
    ThreeNumbersAre:
        "three numbers stand with commas between them, without spaces: `1.5,0,-2`",
        "три числа пишутся через запятую без пробелов: `1.5,0,-2`";
    NotAColor { value: Number }:
        "a color has the value {value}",
        "в цвете есть значение {value}";
    ColorIs:
        "a color is three numbers from 0 to 255: `255,128,0`",
        "цвет — три числа от 0 до 255: `255,128,0`";
    CheckerIs:
        "a checker is `checker=R,G,B` or `checker=R,G,B:size`",
        "шахматный узор — `checker=R,G,B` или `checker=R,G,B:size`";
    UnknownProperty { name: String }:
        "the property `{name}` is not known",
        "свойство `{name}` неизвестно";
    NoBodyBefore:
        "these properties belong to no body",
        "перед этими свойствами нет тела";
    OtherCamera:
        "another camera is left out; the first one is taken",
        "другая камера пропущена; взята первая";
    CodesAreLight:
        "colors are light in proportion to their codes, as nearly all miniRT programs take them",
        "цвета — свет пропорционально кодам, как принято почти во всех программах miniRT";
    ToneCurveHelp:
        "to see the codes of such a program, write pictures with `--tone-curve linear-codes`, the default for these files",
        "чтобы увидеть коды такой программы, сохраняйте картинки с `--tone-curve linear-codes`: для этих файлов так и есть";
    OtherDialect { word: String }:
        "`--dialect {word}` reads it the other way",
        "`--dialect {word}` читает наоборот";
    HorizontalFov { width: String, height: String }:
        "the field of view is taken as the horizontal one of a picture of {width}x{height}",
        "угол зрения взят горизонтальным для картинки {width}x{height}";
    VerticalFov:
        "the field of view is taken as the vertical one",
        "угол зрения взят вертикальным";
    RightHanded:
        "with y up, looking along -z, x points to the right",
        "при оси y вверх и взгляде вдоль -z ось x направлена вправо";
    CylinderAtCenter:
        "the position of a cylinder is taken as its center, and its ends as closed",
        "положение цилиндра взято как его центр, торцы — закрытыми";
    CylinderAtBase:
        "the position of a cylinder is taken as the center of its base, and its ends as closed",
        "положение цилиндра взято как центр основания, торцы — закрытыми";
    ConeAtApex:
        "the position of a cone is taken as its apex, from which the axis points to the base, which is closed",
        "положение конуса взято как его вершина, ось ведёт от неё к закрытому основанию";
    ConeAtBase:
        "the position of a cone is taken as the center of its base, which is closed",
        "положение конуса взято как центр основания, оно закрыто";
    ConeNumbers { numbers: ConeNumbers }:
        "the numbers of a cone are taken as {numbers}",
        "числа у конуса взяты так: {numbers}";
    ConeDialects:
        "`--dialect cone-angle`, `cone-height-first` or both say otherwise",
        "иное говорит `--dialect cone-angle`, `cone-height-first` или оба слова";
    ConeOfAngle { far: Number }:
        "a cone with one number is endless on both sides of its apex, and drawn as far as {far}; the number is taken as half the angle there, in degrees",
        "конус с одним числом бесконечен по обе стороны от вершины и рисуется до расстояния {far}; число взято как половина угла при вершине в градусах";
    SquareIsTurned:
        "a square has no thickness, and is turned along the shortest arc from +Y to its normal",
        "у квадрата нет толщины; он повёрнут кратчайшим путём от +Y к нормали";
    ReflectionBlends:
        "a reflection of r leaves 1 - r of the body's own light",
        "отражение r оставляет от собственного света тела долю 1 - r";
    ReflectionAdds:
        "a reflection is added to the body's own light",
        "отражение прибавляется к собственному свету тела";
    HighlightIsLight:
        "highlights have the color of the light; an exponent alone means a coefficient of 0.5",
        "блики имеют цвет источника света; показатель без коэффициента означает коэффициент 0,5";
    CheckerOfBody:
        "checkers are cubes along the body's own axes; other programs unroll them on spheres and cylinders",
        "шахматный узор — кубы вдоль осей тела; другие программы разворачивают его на шарах и цилиндрах";
    NumbersAreFinish { element: String }:
        "the further numbers of `{element}` are taken as shininess, reflection and whether it is checkered",
        "остальные числа у `{element}` взяты как показатель блика, отражение и наличие шахматного узора";
    NumbersAreHighlight { element: String }:
        "the further numbers of `{element}` are taken as coefficient and exponent of the highlight, and reflection",
        "остальные числа у `{element}` взяты как коэффициент и показатель блика и отражение";

    // The Ray Tracer Challenge.
    Yaml { fault: String }:
        "the YAML cannot be read: {fault}",
        "YAML не читается: {fault}";
    TooDeep { most: String }:
        "this is nested more than {most} deep",
        "вложенность больше {most}";
    TooMuch { most: String }:
        "the scene becomes too large: definitions that use each other may give at most {most} parts",
        "сцена слишком велика: определения, которые используют друг друга, дают не больше {most} частей";
    SecondDocument:
        "a file holds one scene; the second document is not read",
        "в файле одна сцена; второй документ не читается";
    NotAScene:
        "a scene is a list: each line begins with `- add:` or `- define:`",
        "сцена — это список: каждая строка начинается с `- add:` или `- define:`";
    WrongKind { key: String, found: Kind, expected: Kind }:
        "`{key}` is {found}, but must be {expected}",
        "`{key}` — {found}, а ожидается {expected}";
    NotAddOrDefine:
        "this is neither `add` nor `define`",
        "это не `add` и не `define`";
    KeyTwice { key: String }:
        "`{key}` is given twice",
        "`{key}` встречается дважды";
    UnknownKey { owner: String, key: String }:
        "`{owner}` has no key `{key}`",
        "у `{owner}` нет ключа `{key}`";
    KeyMissing { owner: String, key: String }:
        "`{owner}` lacks `{key}`",
        "у `{owner}` не хватает `{key}`";
    Undefined { name: String }:
        "`{name}` is not defined",
        "`{name}` не определено";
    DefinedBelow:
        "a definition stands before its use",
        "определение стоит до использования";
    DefinedTwice { name: String }:
        "`{name}` is defined twice",
        "`{name}` определено дважды";
    UnknownShape { name: String }:
        "there is no shape, and no definition, called `{name}`",
        "нет ни формы, ни определения с именем `{name}`";
    ShapesAre:
        "to add there are camera, light, sphere, plane, cube, cylinder, cone, triangle, group and csg",
        "добавить можно `camera`, `light`, `sphere`, `plane`, `cube`, `cylinder`, `cone`, `triangle`, `group` и `csg`";
    UnknownTransform { name: String }:
        "there is no transform `{name}`",
        "преобразования `{name}` нет";
    TransformsAre:
        "transforms are translate, scale, rotate-x, rotate-y, rotate-z and shear, with numbers: `[translate, 0, 1, 0]`",
        "преобразования: `translate`, `scale`, `rotate-x`, `rotate-y`, `rotate-z` и `shear` с числами: `[translate, 0, 1, 0]`";
    TransformNumbers { name: String, count: String }:
        "`{name}` has the wrong number of values; it needs {count}",
        "у `{name}` не то количество чисел; нужно {count}";
    KeyOutOfRange { key: String, value: Number, low: Number, high: Number }:
        "`{key}` is {value}, but must be from {low} to {high}",
        "`{key}` равно {value}, а должно быть от {low} до {high}";
    NoCamera:
        "the scene has no camera",
        "в сцене нет камеры";
    CameraTwice:
        "the scene has two cameras",
        "в сцене две камеры";
    NotDrawn { name: String }:
        "`{name}` is not drawn",
        "`{name}` не рисуется";
    PlaneOfCsg:
        "a plane has no inside in the book, and cannot be an operand of a `csg`",
        "в книге у плоскости нет внутренности, и операндом `csg` она быть не может";
    HalfSpace:
        "all that lies below it is taken",
        "берётся всё, что под ней";
    UnknownOperation { name: String }:
        "there is no operation `{name}`",
        "нет операции `{name}`";
    OperationsAre:
        "operations are `union`, `intersection` and `difference`",
        "операции — `union`, `intersection` и `difference`";
    Flat:
        "the transform leaves nothing of the shape, or takes it to infinity",
        "преобразование ничего не оставляет от формы или уводит её в бесконечность";
    Sheared { name: String }:
        "a sheared `{name}` is not drawn",
        "`{name}` со сдвигом не рисуется";
    OpenEnds { name: String }:
        "a `{name}` with open ends has no inside, so it is no operand",
        "у `{name}` с открытыми торцами нет внутренности, поэтому это не операнд";
    FlatOperand:
        "a triangle has no inside, so it is no operand",
        "у треугольника нет внутренности, поэтому это не операнд";
    IsClosed:
        "it is closed",
        "торцы закрываются";
    Endless { name: String, far: Number }:
        "an endless `{name}` is drawn as far as {far} from its origin",
        "бесконечный `{name}` рисуется до расстояния {far} от его начала";
    NoHeight { name: String }:
        "`min` of the `{name}` is not below `max`",
        "`min` у `{name}` не меньше `max`";
    NoPattern { kind: String }:
        "the pattern `{kind}` is not drawn",
        "узор `{kind}` не рисуется";
    PatternColors { kind: String, count: String }:
        "the pattern `{kind}` has 2 colors, not {count}",
        "у узора `{kind}` 2 цвета, а не {count}";
    MeanColor:
        "the mean of its colors is taken",
        "берётся среднее его цветов";
    PatternSheared:
        "a pattern whose axes are not at right angles to each other is not drawn",
        "узор, оси которого не под прямыми углами друг к другу, не рисуется";
    PatternsTooDeep { most: String }:
        "patterns within patterns are drawn {most} levels deep",
        "узоры в узорах рисуются до {most} уровней";
    OperandShadow:
        "an operand of a `csg` has its shadow; the whole may have none",
        "у операнда `csg` тень есть; её может не быть у целого";
    ThrowsShadow:
        "it throws its shadow",
        "тень есть";
    AreaLight:
        "an area light is a light in the middle of each of its cells, without jitter",
        "протяжённый источник света — это источники в серединах его ячеек, без случайных сдвигов";
    Mirrored:
        "the book's axes are left-handed; z is turned around",
        "оси в книге левые; ось z обращена";
    LightsAreCodes:
        "light is taken to be written as it is, without the sRGB curve",
        "считается, что свет записывается как есть, без кривой sRGB";

    // NFF.
    NoRecord { word: String }:
        "there is no record `{word}`",
        "записи `{word}` нет";
    RecordsAre:
        "the records are v, b, l, f, s, c, p and pp",
        "записи: `v`, `b`, `l`, `f`, `s`, `c`, `p` и `pp`";
    RecordCount { record: &'static str, count: String }:
        "`{record}` has the wrong number of values; it needs {count}",
        "у записи `{record}` не то количество чисел; нужно {count}";
    RecordLine { expected: &'static str }:
        "a line `{expected}` belongs here",
        "здесь место строке `{expected}`";
    RecordRange { what: &'static str, value: Number, low: Number, high: Number }:
        "`{what}` is {value}, but must be from {low} to {high}",
        "`{what}` равно {value}, а должно быть от {low} до {high}";
    NoView:
        "the scene has no view `v`",
        "в сцене нет вида `v`";
    ViewTwice:
        "the scene has two views `v`",
        "в сцене два вида `v`";
    NoPolygon { most: String }:
        "only flat polygons without notches, of up to {most} corners, are drawn",
        "рисуются только плоские многоугольники без выемок, не больше чем с {most} вершинами";
    NoNormals:
        "the normals of a patch are not drawn: it is flat",
        "нормали многоугольника не рисуются: он плоский";
    IsFlat:
        "it is drawn flat",
        "он рисуется плоским";
    MixedRadii:
        "one radius of the cone is negative, the other is not",
        "один радиус конуса отрицательный, а другой нет";
    NegativeRadius:
        "a negative radius means the inside; the sphere is taken as it is",
        "отрицательный радиус означает внутреннюю сторону; шар взят обычным";
    PolygonCount { most: String }:
        "a polygon has from 3 to {most} corners",
        "у многоугольника от 3 до {most} вершин";
    NoFill:
        "no `f` before this gives its material",
        "перед этим нет `f` с материалом";
    EqualLights { value: Number }:
        "lights without a color have the intensity {value}, one over the root of their number",
        "источники без цвета имеют яркость {value}: единица, делённая на корень из их числа";

    // What a format cannot say.
    LosesSurroundings:
        "the format has no sky and no picture around",
        "в формате нет неба и картинки вокруг";
    LosesContact:
        "in the format there always is air between bodies that touch",
        "в формате между соприкасающимися телами всегда воздух";
    LosesTracing:
        "the format does not say how far rays are followed",
        "формат не говорит, как далеко прослеживать лучи";
    LosesBackground:
        "the format has a black background",
        "фон в формате чёрный";
    LosesParallel:
        "the format has no parallel projection",
        "в формате нет параллельной проекции";
    LosesRoll:
        "the format has no camera that is rolled",
        "в формате нет крена камеры";
    LosesAmbient { title: Title }:
        "{title}: the format has one ambient light for all; its `ambient` differs from the others' as a share of `diffuse`",
        "{title}: фоновый свет в формате один для всех; его `ambient` составляет иную долю от `diffuse`, чем у других";
    LosesAmbientLight:
        "the format has no ambient light beyond 1",
        "в формате нет фонового света больше 1";
    LosesAmbientColor:
        "ambient light of the format is the sum of all lights, and has its color",
        "фоновый свет в формате — сумма всех источников и имеет её цвет";
    LosesBodyAmbient { title: Title }:
        "{title}: the format has no ambient light",
        "{title}: в формате нет фонового света";
    LosesReflection { title: Title }:
        "{title}: in the format `reflection` equals `specular`",
        "{title}: в формате `reflection` равно `specular`";
    LosesBrightness { title: Title }:
        "{title}: the format has no brightness beyond 1",
        "{title}: в формате нет яркости больше 1";
    LosesFalloff { title: Title }:
        "{title}: the format has no falloff and no soft light",
        "{title}: в формате нет убывания света и мягкого света";
    LosesMaterial { title: Title }:
        "{title}: the format has only the coefficients of `phong`",
        "{title}: в формате есть только коэффициенты `phong`";
    LosesTexture { title: Title }:
        "{title}: the format has no textures",
        "{title}: в формате нет текстур";
    LosesParts { title: Title }:
        "{title}: the format has no bodies of parts",
        "{title}: тел из частей в формате нет";
    LosesShape { title: Title }:
        "{title}: the format does not have its shape",
        "{title}: такой формы в формате нет";
    LosesSide { title: Title }:
        "{title}: in the format surfaces are seen from both sides",
        "{title}: в формате поверхности видны с обеих сторон";
    LosesShadow { title: Title }:
        "{title}: the format has no such shadow",
        "{title}: такой тени в формате нет";
    LosesFresnel { title: Title }:
        "{title}: in the format reflection and transmission do not depend on the angle",
        "{title}: отражение и пропускание в формате не зависят от угла";
    LosesConstant { title: Title }:
        "{title}: the format weighs reflection and transmission of clear bodies by Schlick's formula",
        "{title}: отражение и пропускание прозрачных тел в формате взвешены по формуле Шлика";
    LosesTransmission { title: Title }:
        "{title}: the format has no refraction",
        "{title}: в формате нет преломления";
    LosesTint { title: Title }:
        "{title}: the format has no tint of refracted light",
        "{title}: в формате нет оттенка преломлённого света";
    LosesColor { title: Title }:
        "{title}: the format has no color as bright as its own light with this reflection",
        "{title}: в формате нет столь яркого цвета при таком отражении";
    LosesHighlight { title: Title }:
        "{title}: the format has no such highlight",
        "{title}: такого блика в формате нет";
    LosesPattern { title: Title }:
        "{title}: the format has no such pattern",
        "{title}: такого узора в формате нет";
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The names between braces.
    fn arguments(sentence: &str) -> std::collections::BTreeSet<&str> {
        sentence.split('{').skip(1).filter_map(|part| part.split('}').next()).collect()
    }

    #[test]
    fn both_sentences_of_a_message_have_the_same_arguments() {
        for [name, english, russian] in Message::SENTENCES {
            assert_eq!(arguments(english), arguments(russian), "{name}");
            assert_eq!(english.ends_with('?'), russian.ends_with('?'), "{name}");
            assert_eq!(russian.matches('`').count() % 2, 0, "{name}");
        }
    }

    #[test]
    fn russian_sentences_are_russian() {
        for [name, _, russian] in Message::SENTENCES {
            assert!(russian.contains(|letter| matches!(letter, 'а'..='я' | 'ё')), "{name}: {russian}");
        }
    }
}

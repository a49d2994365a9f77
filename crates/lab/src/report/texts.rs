//! The texts of reports, in both languages. Placeholders stand in braces.

use std::borrow::Cow;

use catoptric_scene::SceneValue;
use catoptric_tracer::raster::{PassName, Reason};

use super::language::Language;
use crate::measure::{GrowthLaw, Parameter, PictureQuestion, Value, Variable};

/// Fills in what stands in braces.
pub(crate) fn fill(text: &str, values: &[(&str, &str)]) -> String {
    values.iter().fold(text.to_owned(), |text, (name, value)| text.replace(&format!("{{{name}}}"), value))
}

macro_rules! texts {
    ($($name:ident: $english:expr, $russian:expr;)+) => {
        impl Language {
            $(pub(crate) const fn $name(self) -> &'static str { self.choose($english, $russian) })+
        }
    };
}

texts! {
    // The machine and the settings.
    processor: "Processor", "Процессор";
    cores: "Cores / threads", "Ядра / потоки";
    memory: "Memory", "Память";
    gibibytes: "GiB", "ГиБ";
    system: "Operating system", "Операционная система";
    program: "Program", "Программа";
    unknown: "unknown", "неизвестно";
    scene: "Scene", "Сцена";
    size: "Picture size", "Размер изображения";
    pixels: "pixels", "пикселей";
    samples_per_pixel: "Samples per pixel", "Отсчётов на пиксель";
    threads_used: "Threads used", "Потоков в работе";
    bodies_and_lights: "Bodies / lights", "Тела / источники света";
    generations_limit: "Limit of generations", "Ограничение числа поколений";
    milliseconds: "ms", "мс";

    // The page of pictures that were checked.
    checked_title: "Checked against {scene}", "Проверено по сцене {scene}";
    checked_lead: "Each picture is held against the exact one of the scene. What is systematically different was found by \
        trying it; the share that agrees counts pixels with that undone. Circles are the worst pixels of the places where \
        it differs still.",
        "Каждое изображение сравнивается с точным изображением сцены. Что в нём систематически отличается, найдено \
        пробами; доля совпадений — с этой поправкой. Кружки — худшие пиксели тех мест, где отличие осталось.";
    checked_right: "right", "верно";
    checked_different: "different", "отличается";
    checked_exact: "exact", "точное";
    checked_places_caption: "Where the picture differs still", "Где изображение ещё отличается";
    checked_place: "Place", "Место";
    checked_share: "Share", "Доля";
    checked_pixel: "Worst pixel", "Худший пиксель";
    checked_found: "Codes found", "Коды";
    checked_expected: "Codes expected", "Ожидаемые коды";
    checked_audit: "The exact answer at place {number}", "Точный ответ в месте {number}";

    // The page of a class.
    marking_title: "Marks of the class", "Оценки группы";
    marking_lead: "Each picture is held against the exact one of its scene; its mistakes were found by trying them, and cost \
        what the rubric says. The circle is the pixel that differs most from the exact picture; its neighborhood stands beside.",
        "Каждое изображение сравнивается с точным изображением своей сцены; ошибки найдены пробами и стоят столько, \
        сколько сказано в правилах оценки. Кружок — пиксель, который сильнее всего отличается от точного изображения; \
        рядом его окрестность.";
    marking_student: "Student", "Студент";
    marking_total: "Total", "Всего";
    marking_of: "of {of}", "из {of}";
    marking_totals_caption: "Points by student and scene; a head sorts the table", "Баллы по студентам и сценам; \
        заголовок сортирует таблицу";
    marking_frequencies_caption: "What was wrong, and how often", "Что было неверно и как часто";
    marking_mistake: "Mistake", "Ошибка";
    marking_pictures: "Pictures", "Изображений";
    marking_students: "Students", "Студентов";
    marking_mean: "Mean", "Среднее";
    marking_missing: "There is no picture.", "Изображения нет.";
    marking_unreadable: "The file cannot be read:", "Файл не читается:";
    marking_unmarked: "The scene cannot be used, so the picture does not count:", "Сцену нельзя использовать, изображение не \
        учитывается:";
    marking_unexplained: "pixels that differ for no known reason", "пиксели, отличие которых не объяснено";
    marking_again: "again", "повторно";
    marking_left_over: "Pictures of no scene, or beside another of the same one", "Изображения без сцены или лишние";

    // The page of a comparison.
    compare_title: "Ways of drawing, held against {truth}", "Способы построения в сравнении с {truth}";
    compare_lead: "Every picture is drawn with the same camera and held, pixel by pixel, against the first one, “{truth}”, \
        which counts as the truth here. A pixel counts as wrong when a channel differs by more than {bound} in linear \
        light.",
        "Все изображения построены с одной и той же камеры и попиксельно сравниваются с первым — «{truth}», которое здесь \
        считается истинным. Пиксель считается неверным, если хотя бы один его канал в линейном свете отличается больше чем \
        на {bound}.";
    conditions: "Conditions", "Условия";
    conditions_caption: "What was drawn, and on what machine", "Что построено и на какой машине";
    item: "Item", "Параметр";
    value: "Value", "Значение";
    pictures: "Pictures", "Изображения";
    read_from_file: "read from a file", "прочитано из файла";
    results: "Differences and times", "Отличия и время";
    results_caption: "Each picture against “{truth}”; smaller is better but for PSNR and SSIM",
        "Отличие каждого изображения от «{truth}»; чем меньше, тем лучше, кроме PSNR и SSIM";
    picture: "Picture", "Изображение";
    largest: "Largest", "Наибольшее";
    mean: "Mean", "Среднее";
    decibels: "PSNR, dB", "PSNR, дБ";
    wrong_pixels: "Wrong pixels, %", "Неверных пикселей, %";
    time: "Time, ms", "Время, мс";
    times_note: "Times are medians of {count} runs on {threads} threads, after one that is not counted; preparing the \
        scene is not included. For times with intervals and laws use catoptric measure.",
        "Время — медиана {count} запусков (потоков: {threads}) после одного незасчитанного; подготовка сцены не \
        учитывается. Время с доверительными интервалами и законами роста даёт catoptric measure.";
    passes: "Where the time goes", "На что уходит время";
    passes_caption: "Time of each pass, ms", "Время каждого прохода, мс";
    pair_title: "{name} against {truth}", "{name} и {truth}";
    split_caption: "Left of the line “{truth}”, right of it “{name}”. On a screen the line can be moved.",
        "Слева от линии «{truth}», справа — «{name}». На экране линию можно передвигать.";
    split_label: "Place of the dividing line, percent", "Положение разделительной линии, проценты";
    difference_caption: "The largest difference of a channel in linear light, clamped to 0 … 1 as a display does; beyond \
        the scale the color stays.",
        "Наибольшее отличие канала в линейном свете, ограниченном отрезком 0 … 1, как на экране; за концом шкалы цвет не \
        меняется.";
    flip_caption: "ꟻLIP: how different it looks when the pictures are flipped. Mean {mean}.",
        "ꟻLIP: насколько заметно отличие, если попеременно показывать изображения. Среднее {mean}.";
    reasons_caption: "Why each wrong pixel is wrong. Gray pixels agree with “{truth}”.",
        "Почему неверен каждый неверный пиксель. Серые пиксели совпадают с «{truth}».";
    shares_caption: "Wrong pixels by their reason; light beyond white counts too",
        "Неверные пиксели по причинам; учитывается и свет ярче белого";
    reason: "Reason", "Причина";
    pixels_head: "Pixels", "Пикселей";
    share_of_wrong: "Of the wrong ones, %", "Из неверных, %";
    share_of_all: "Of all, %", "Из всех, %";
    without_reason: "not explained", "не объяснено";
    equal: "No pixel differs.", "Ни один пиксель не отличается.";
    reading: "How the numbers are made", "Как получены числа";
    reading_rmse: "Largest, mean and RMSE: over the channels of linear light clamped to 0 … 1. RMSE is the root of the mean \
        squared difference; PSNR = −20 log₁₀ RMSE.",
        "Наибольшее, среднее и RMSE вычислены по каналам линейного света, ограниченного отрезком 0 … 1. RMSE — корень из \
        среднего квадрата отличия; PSNR = −20 lg RMSE.";
    reading_ssim: "SSIM: the mean structural similarity of the displayed luma in Gaussian windows of 11×11 pixels, σ = 1.5; \
        1 is alike (Wang, Bovik, Sheikh, Simoncelli, IEEE Trans. Image Processing 13 (4), 2004).",
        "SSIM — среднее структурное сходство яркости на экране в гауссовых окнах 11×11 пикселей, σ = 1,5; 1 — полное \
        сходство (Wang, Bovik, Sheikh, Simoncelli, IEEE Trans. Image Processing 13 (4), 2004).";
    reading_flip: "ꟻLIP: the mean difference that an observer sees at 67 pixels per degree, 0 to 1 (Andersson et al., Proc. \
        ACM Comput. Graph. Interact. Tech. 3 (2), 2020).",
        "ꟻLIP — среднее отличие, которое видит наблюдатель при 67 пикселях на градус, от 0 до 1 (Andersson и др., Proc. ACM \
        Comput. Graph. Interact. Tech. 3 (2), 2020).";

    // The report of measurements.
    study_title: "Time of drawing {scene}", "Время построения сцены {scene}";
    setup: "How it was measured", "Как измерено";
    setup_text: "Each of the {points} points was drawn once for warming up, which is not counted, and then measured in \
        {rounds} rounds. In a round all points are measured once, in an order shuffled anew, so that drift of the \
        processor's clock hits all alike. A point quicker than 20 ms is drawn several times for one measurement. The time \
        is that of drawing alone; preparing the scene is given apart.",
        "Каждая из точек (всего {points}) сначала построена один раз для прогрева, который не засчитывается, а затем измерена в \
        нескольких кругах (всего {rounds}). В каждом круге все точки измеряются по одному разу в заново перемешанном \
        порядке, так что дрейф частоты процессора действует на все одинаково. Точка быстрее 20 мс строится за одно измерение \
        несколько раз. Время относится только к построению; подготовка сцены указана отдельно.";
    incomplete: "The measurement was interrupted: not all rounds were made.",
        "Измерение прервано: выполнены не все круги.";
    grown_text: "The scene with N bodies is its own bodies, as far as they go, and then those of a cloud that fills the box \
        around them, made by rule: spheres, cubes, cylinders and cones whose share of the box does not depend on N.",
        "Сцена из N тел — это её собственные тела, сколько их хватает, а затем облако по правилу построенных тел, \
        заполняющее охватывающий их параллелепипед: шары, кубы, цилиндры и конусы, занимающие при любом N одну и ту же его \
        долю.";
    interval_text: "The interval of the median needs no assumption on the distribution: it runs between two order \
        statistics that enclose the true median with a chance of at least 95 % (Le Boudec 2010, theorem 2.1); with fewer \
        than six rounds it is all they span, and the chance is less. Outliers lie more than one and a half interquartile \
        ranges beyond the quartiles (Tukey 1977); they are kept and shown as rings. Laws are fitted to the medians by least \
        squares of the relative residuals, with 95 % intervals from Student's t.",
        "Доверительный интервал медианы не опирается на вид распределения: он заключён между двумя порядковыми \
        статистиками, которые охватывают истинную медиану с вероятностью не менее 95 % (Le Boudec 2010, теорема 2.1); если \
        кругов меньше шести, это весь размах, а вероятность ниже. Выбросы лежат дальше полутора межквартильных размахов от \
        квартилей (Tukey 1977); они не отброшены и показаны кольцами. Законы подобраны по медианам методом наименьших \
        квадратов относительных невязок, 95-процентные интервалы — по распределению Стьюдента.";
    machine_caption: "The machine", "Машина";
    times_caption: "Time of drawing {scene} depending on {parameter}", "Время построения сцены {scene} в зависимости от {parameter}";
    plot_caption: "Time of drawing {scene} depending on {parameter}: medians with 95 % intervals, all measurements as \
        dots, outliers as rings, and the law fitted.",
        "Время построения сцены {scene} в зависимости от {parameter}: медианы с 95-процентными интервалами, точки — все \
        измерения, кольца — выбросы, линия — подобранный закон.";
    plot_caption_without_law: "Time of drawing {scene} depending on {parameter}: medians with 95 % intervals, all \
        measurements as dots, outliers as rings.",
        "Время построения сцены {scene} в зависимости от {parameter}: медианы с 95-процентными интервалами, точки — все \
        измерения, кольца — выбросы.";
    rays_caption: "Rays traced for one picture depending on the limit of generations, with the law fitted.",
        "Число лучей на одно изображение в зависимости от ограничения числа поколений и подобранный закон.";
    median: "Median", "Медиана";
    interval_head: "95 % interval", "95 % интервал";
    prepare: "Preparing", "Подготовка";
    rays: "Rays", "Лучей";
    outliers: "Outliers", "Выбросов";
    runs: "Runs", "Измерений";
    results_head: "Results", "Результаты";
    law_head: "The law", "Закон";
    laws_caption: "Laws fitted to the medians", "Законы, подобранные по медианам";
    curve: "Curve", "Кривая";
    formula: "Law", "Закон";
    coefficients: "Coefficients (95 % interval)", "Коэффициенты (95 % интервал)";
    r_squared: "R²", "R²";
    residual: "Residual, %", "Невязка, %";
    no_law: "A law needs at least three different numbers.", "Для закона нужны хотя бы три разных числа.";
    no_law_of_value: "No law is expected of a value of the scene.", "Для значения сцены закон не предполагается.";
    value_text: "Of the scene, {value} is varied: {meaning}.", "В сцене меняется {value}: {meaning}.";
    time_axis: "Time t, ms", "Время t, мс";
    rays_axis: "Rays for one picture", "Лучей на изображение";
    figure: "Figure {n}", "Рис. {n}";
    worst_case: "Worst case of the growth: each ray gives two, so that the work is O(N·C·2ᴷ).",
        "Худший случай роста: каждый луч порождает два, и работа составляет O(N·C·2ᴷ).";
}

impl Language {
    /// Why a pixel is wrong.
    pub const fn why(self, reason: Reason) -> &'static str {
        match reason {
            Reason::LeftScreen => self.choose("what is reflected is off the screen", "отражаемое вне экрана"),
            Reason::Hidden => {
                self.choose("what is reflected is hidden from the eye", "отражаемое заслонено от глаза")
            }
            Reason::Thickness => {
                self.choose("surface taken too thick", "поверхность принята слишком толстой")
            }
            Reason::Step => self.choose("the march stepped over it", "перешагнуто при проходе вдоль луча"),
            Reason::OutOfRange => self.choose("beyond the range", "дальше наибольшего расстояния"),
            Reason::Parallax => {
                self.choose("seen from the body's center (parallax)", "вид из центра тела (параллакс)")
            }
            Reason::SelfMissing => {
                self.choose("the body is missing from its own map", "тела нет на его собственной карте")
            }
            Reason::Sampling => self.choose("pixels too coarse", "слишком крупные пиксели"),
            Reason::ReflectionMissing => self.choose("reflection missing", "нет отражения"),
            Reason::SecondReflectionMissing => {
                self.choose("second reflection missing", "нет повторного отражения")
            }
            Reason::RefractionMissing => self.choose("refraction missing", "нет преломления"),
            Reason::Facet => self.choose("flat faces instead of the body", "плоские грани вместо тела"),
            Reason::Shading => self.choose("interpolated intensity", "интерполированная интенсивность"),
            Reason::ShadowMissing => self.choose("shadow missing", "нет тени"),
            Reason::Highlight => {
                self.choose("highlight missing or out of place", "блик пропал или сместился")
            }
        }
    }

    /// What a pass does.
    pub const fn pass_name(self, pass: PassName) -> &'static str {
        match pass {
            PassName::Trace => self.choose("tracing", "трассировка"),
            PassName::Tessellate => self.choose("tessellation", "разбиение на грани"),
            PassName::Light => self.choose("lighting", "освещение"),
            PassName::Rasterize => self.choose("rasterization", "растеризация"),
            PassName::FirstHits => self.choose("first hits", "первые пересечения"),
            PassName::CubeMaps => self.choose("cube maps", "кубические карты"),
            PassName::Reflect => self.choose("reflections", "отражения"),
        }
    }

    /// The parameter's title on an axis or over a column.
    pub const fn parameter(self, parameter: Parameter) -> &'static str {
        match parameter {
            Parameter::Bodies => self.choose("Bodies N", "Число тел N"),
            Parameter::Generations => self.choose("Generations K", "Число поколений K"),
            Parameter::Size => self.choose("Pixels C", "Число пикселей C"),
            Parameter::Samples => self.choose("Samples per pixel S", "Отсчётов на пиксель S"),
            Parameter::Threads => self.choose("Threads p", "Число потоков p"),
            Parameter::Method => self.choose("Method", "Способ построения"),
            Parameter::Fineness => self.choose("Fineness m", "Дробность разбиения m"),
            Parameter::CubeMapSize => {
                self.choose("Edge of the cube map, pixels n", "Сторона кубической карты n, пикселей")
            }
            Parameter::Search => self.choose("Search for bodies", "Поиск тел"),
        }
    }

    /// The title of what is varied, on an axis or over a column.
    pub fn variable(self, variable: &Variable) -> Cow<'static, str> {
        match variable {
            Variable::Parameter(parameter) => self.parameter(*parameter).into(),
            Variable::Setting(path) => path.to_string().into(),
        }
    }

    /// What is varied, after "depending on".
    pub(crate) fn depending_on(self, variable: &Variable) -> Cow<'static, str> {
        let parameter = match variable {
            Variable::Parameter(parameter) => *parameter,
            Variable::Setting(path) => {
                return format!("{} {path}", self.choose("the value", "значения")).into();
            }
        };
        let text = match parameter {
            Parameter::Bodies => self.choose("the number of bodies N", "числа тел N"),
            Parameter::Generations => {
                self.choose("the limit of generations K", "ограничения числа поколений K")
            }
            Parameter::Size => self.choose("the number of pixels C", "числа пикселей C"),
            Parameter::Samples => self.choose("the samples per pixel S", "числа отсчётов на пиксель S"),
            Parameter::Threads => self.choose("the number of threads p", "числа потоков p"),
            Parameter::Method => self.choose("the method", "способа построения"),
            Parameter::Fineness => self.choose("the fineness m of the faces", "дробности разбиения m"),
            Parameter::CubeMapSize => self.choose("the edge n of the cube map", "стороны кубической карты n"),
            Parameter::Search => self.choose("the search for bodies", "способа поиска тел"),
        };
        text.into()
    }

    /// What a picture answers, depending on what is varied; the name of the scene is still to be filled in.
    pub(crate) fn answer_caption(self, question: PictureQuestion) -> String {
        let what = match question {
            PictureQuestion::Mean => {
                self.choose("Mean light of the picture", "Средний свет изображения").to_owned()
            }
            PictureQuestion::Pixel([x, y]) => {
                format!("{} {x}, {y}", self.choose("Light of the pixel", "Свет пикселя"))
            }
            PictureQuestion::Flip => self
                .choose("ꟻLIP difference from the first picture", "Отличие ꟻLIP от первого изображения")
                .to_owned(),
            PictureQuestion::Rays => {
                self.choose("Rays traced for one picture", "Число лучей на одно изображение").to_owned()
            }
        };
        let depending =
            self.choose("of {scene}, depending on {parameter}", "сцены {scene} в зависимости от {parameter}");
        format!("{what} {depending}")
    }

    /// What the figure of the times is called.
    pub(crate) const fn time_name(self) -> &'static str {
        self.choose("Time", "Время")
    }

    /// What a question to the pictures is called.
    pub fn question_name(self, question: PictureQuestion) -> String {
        match question {
            PictureQuestion::Mean => self.choose("Mean light", "Средний свет").to_owned(),
            PictureQuestion::Pixel([x, y]) => format!("{} {x}, {y}", self.choose("Pixel", "Пиксель")),
            PictureQuestion::Flip => "FLIP".to_owned(),
            PictureQuestion::Rays => self.choose("Rays", "Лучи").to_owned(),
        }
    }

    /// The heads of the numbers that a picture answers.
    pub(crate) fn answer_columns(self, question: PictureQuestion) -> Vec<String> {
        let heads: &[&str] = match question {
            PictureQuestion::Mean | PictureQuestion::Pixel(_) => &[
                self.choose("Red", "Красный"),
                self.choose("Green", "Зелёный"),
                self.choose("Blue", "Синий"),
                self.choose("Luminance, linear light", "Яркость, линейный свет"),
            ],
            // The font of the plots has no reversed F.
            PictureQuestion::Flip => &["FLIP"],
            PictureQuestion::Rays => &[
                self.choose("Primary", "Первичные"),
                self.choose("Shadow", "Теневые"),
                self.choose("Reflected", "Отражённые"),
                self.choose("Refracted", "Преломлённые"),
                self.choose("All rays", "Все лучи"),
            ],
        };
        heads.iter().copied().map(str::to_owned).collect()
    }

    /// The letter of what is varied in formulas.
    pub(crate) const fn letter(self, variable: &Variable) -> &'static str {
        let Variable::Parameter(parameter) = variable else { return "x" };
        match parameter {
            Parameter::Bodies => "N",
            Parameter::Generations => "K",
            Parameter::Size => "C",
            Parameter::Samples => "S",
            Parameter::Threads => "p",
            Parameter::Fineness => "m",
            Parameter::CubeMapSize => "n",
            Parameter::Method | Parameter::Search => "x",
        }
    }

    /// A value in words.
    pub fn value_name(self, value: &Value) -> String {
        use catoptric_tracer::AcceleratorChoice;
        match value {
            Value::Size([width, height]) => format!("{width}×{height}"),
            Value::Count(count) => self.count(u64::from(*count)),
            Value::Search(AcceleratorChoice::Quickest) => {
                self.choose("hierarchy of boxes", "иерархия объёмов").to_owned()
            }
            Value::Search(AcceleratorChoice::OneByOne) => {
                self.choose("one by one", "полный перебор").to_owned()
            }
            Value::Method(variant) => variant.name.clone(),
            Value::Setting(SceneValue::Number(number)) => self.decimal(*number),
            Value::Setting(_) => value.to_string(),
        }
    }

    /// What a law is called.
    pub const fn law_name(self, law: GrowthLaw) -> &'static str {
        match law {
            GrowthLaw::Constant => self.choose("no growth", "не растёт"),
            GrowthLaw::Linear => self.choose("linear", "линейный"),
            GrowthLaw::Square => self.choose("quadratic", "квадратичный"),
            GrowthLaw::Power => self.choose("power law", "степенной"),
            GrowthLaw::Bounded => self.choose("bounded", "ограниченный"),
            GrowthLaw::Geometric => self.choose("geometric", "геометрическая прогрессия"),
            GrowthLaw::Amdahl => self.choose("Amdahl's law", "закон Амдала"),
        }
    }
}

impl Language {
    /// Points of so many.
    pub(crate) fn marking_points(self, points: f64, worth: f64) -> String {
        let [points, worth] = [points, worth].map(|points| self.decimal(points));
        match self {
            Self::English => format!("{points} of {worth} points"),
            Self::Russian => format!("{points} из {worth} баллов"),
        }
    }

    /// Points that are lost.
    pub(crate) fn marking_cost(self, points: f64) -> String {
        self.decimal(-points)
    }

    /// The pixel that differs most.
    pub(crate) fn marking_worst(self, [x, y]: [u32; 2], found: [u8; 3], exact: [u8; 3]) -> String {
        let [found, exact] = [found, exact].map(|codes| codes.map(|code| code.to_string()).join(", "));
        match self {
            Self::English => format!("Worst pixel {x}, {y}: {found}; exact {exact}"),
            Self::Russian => format!("Худший пиксель {x}, {y}: {found}; точный {exact}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_languages_say_something_of_their_own() {
        for reason in Reason::ALL {
            let [english, russian] = Language::ALL.map(|language| language.why(reason));
            assert!(english.is_ascii() && !russian.is_ascii(), "{reason:?}");
        }
        for parameter in Parameter::ALL {
            let russian = Language::Russian.parameter(parameter);
            assert!(russian.chars().any(|letter| ('а'..='я').contains(&letter)), "{parameter}");
        }
        assert_eq!(fill("{a} of {b}", &[("a", "1"), ("b", "{a}")]), "1 of {a}");
    }
}

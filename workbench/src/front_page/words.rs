//! What the front page says.

use catoptric_scene::Language;

/// The page in one language, but for its scenes.
#[derive(Debug)]
pub(super) struct PageWords {
    /// The page's file.
    pub file: &'static str,
    /// The language's code, for `lang`.
    pub code: &'static str,
    /// The language's name in itself.
    pub own_name: &'static str,
    pub heading: &'static str,
    pub lead: &'static str,
    pub open: &'static str,
    pub look: &'static str,
    pub note: &'static str,
    /// The link to the page that checks a picture.
    pub check: &'static str,
    /// Head and sentence of what the laboratory is good for.
    pub points: [[&'static str; 2]; 3],
    pub scenes: &'static str,
    pub scenes_below: &'static str,
    /// What stands before and after the title of a scene, to describe its picture.
    pub picture: [&'static str; 2],
    pub manual: &'static str,
    pub license: &'static str,
}

impl PageWords {
    /// The words of a language.
    pub(super) const fn of(language: Language) -> &'static Self {
        match language {
            Language::English => &ENGLISH,
            Language::Russian => &RUSSIAN,
        }
    }
}

const ENGLISH: PageWords = PageWords {
    file: "index.html",
    code: "en",
    own_name: "English",
    heading: "A laboratory for reflections",
    lead: "Put balls, cubes, cones and mirrors into a room, make them of glass, gold or lacquer, and see what they \
           reflect. Every ray follows the laws of optics, and the picture follows your hand.",
    open: "Open the laboratory",
    look: "Look at the scenes",
    note: "It runs in this browser: nothing is installed, and nothing leaves your machine.",
    check: "Check a picture by your own ray tracer",
    points: [
        [
            "Exact",
            "Rays meet bodies by their equations, without triangles: outlines and reflections stay smooth at any size.",
        ],
        ["Live", "Drag a body, a light or the camera, and the reflections follow. Every step can be undone."],
        ["Explained", "Click a pixel to see all rays behind it, with every number. Their sum is the pixel."],
    ],
    scenes: "Scenes to begin with",
    scenes_below: "Each shows one thing. Open it, move what is in it, and see what changes.",
    picture: ["The scene “", "”"],
    manual: "The manual is in the laboratory: Help → Manual. Once opened, all of it works without a network too.",
    license: "Free software under the MIT license or Apache 2.0, at your choice.",
};

const RUSSIAN: PageWords = PageWords {
    file: "ru.html",
    code: "ru",
    own_name: "Русский",
    heading: "Лаборатория отражений",
    lead: "Поставьте в комнату шары, кубы, конусы и зеркала, сделайте их стеклянными, золотыми или лаковыми и \
           посмотрите, что в них отразится. Каждый луч идёт по законам оптики, а изображение следует за рукой.",
    open: "Открыть лабораторию",
    look: "Посмотреть сцены",
    note: "Она работает в этом браузере: ничего не нужно устанавливать, и ничего не покидает ваш компьютер.",
    check: "Проверить изображение своего трассировщика",
    points: [
        [
            "Точно",
            "Лучи встречают тела по их уравнениям, без треугольников: контуры и отражения гладки при любом увеличении.",
        ],
        [
            "Вживую",
            "Потяните тело, источник света или камеру — отражения последуют. Любой шаг можно отменить.",
        ],
        [
            "Понятно",
            "Щёлкните по пикселю — и увидите все его лучи со всеми числами. Их сумма и есть пиксель.",
        ],
    ],
    scenes: "С чего начать",
    scenes_below: "Каждая сцена показывает что-то одно. Откройте её, подвиньте тела и посмотрите, что изменится.",
    picture: ["Сцена «", "»"],
    manual: "Руководство — в самой лаборатории: «Справка → Руководство». Открытая однажды, она работает и без сети.",
    license: "Свободная программа под лицензией MIT или Apache 2.0, на ваш выбор.",
};

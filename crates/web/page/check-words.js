// What the page that checks a picture says; sentences about pictures come from the program.

const WORDS = {
  en: {
    title: "Check a picture",
    lead: "Hold a picture by your ray tracer against the exact one of its scene. The page looks for what is systematically different. Nothing leaves this machine.",
    scene: "Scene",
    sceneHelp: "A file to drop here or to choose: .toml, .rt, .yml or .nff, with the pictures that it uses",
    choose: "Choose a file",
    example: "or a built-in scene",
    picture: "Picture",
    pictureHelp: "A file to drop here or to choose: PNG, PPM, JPEG, BMP, TIFF, WebP, EXR or HDR",
    curve: "Codes of the picture",
    curves: { "": "as usual for the scene", "linear-codes": "in proportion to light", none: "by the sRGB curve" },
    start: "Check",
    loading: "Loading the program…",
    checking: "Checking…",
    right: "Right",
    wrong: "Different",
    yours: "your picture",
    exact: "exact",
    worst: ([x, y], found) => `worst pixel ${x}, ${y}: ${found}`,
    worstExact: (exact) => `exact: ${exact}`,
    places: "Where the picture differs still, with the named mistakes undone",
    heads: ["Place", "Share", "Worst pixel", "Codes", "Expected codes"],
    failed: "The check ended because of a fault:",
    noProgram: "There is no program for this browser here.",
  },
  ru: {
    title: "Проверка изображения",
    lead: "Сравните изображение вашего трассировщика с точным изображением сцены. Страница ищет, что в нём систематически не так. Ничего не покидает этот компьютер.",
    scene: "Сцена",
    sceneHelp: "Перетащите сюда или выберите файл .toml, .rt, .yml или .nff вместе с картинками, которые он использует",
    choose: "Выбрать файл",
    example: "или встроенная сцена",
    picture: "Изображение",
    pictureHelp: "Перетащите сюда или выберите файл PNG, PPM, JPEG, BMP, TIFF, WebP, EXR или HDR",
    curve: "Коды изображения",
    curves: { "": "как принято для сцены", "linear-codes": "пропорциональны свету", none: "по кривой sRGB" },
    start: "Проверить",
    loading: "Загружается программа…",
    checking: "Идёт проверка…",
    right: "Верно",
    wrong: "Отличается",
    yours: "ваше изображение",
    exact: "точное",
    worst: ([x, y], found) => `худший пиксель ${x}, ${y}: ${found}`,
    worstExact: (exact) => `точный: ${exact}`,
    places: "Где изображение ещё отличается после поправки на названные ошибки",
    heads: ["Место", "Доля", "Худший пиксель", "Коды", "Ожидаемые коды"],
    failed: "Проверка прервалась из-за ошибки:",
    noProgram: "Для этого браузера здесь нет программы.",
  },
};

// Of the link, such as `?lang=ru`, or of the browser.
const wanted = new URLSearchParams(location.search).get("lang") ?? navigator.language ?? "en";
export const language = wanted.toLowerCase().startsWith("ru") ? "ru" : "en";
export const words = WORDS[language];

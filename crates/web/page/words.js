// What the page itself says; the studio has its own catalogs.

const WORDS = {
  en: {
    loading: "Loading the laboratory",
    starting: "Starting",
    stopped: "The studio stopped because of a fault and is started again. What was kept of unsaved work is offered.",
    failed: "The studio cannot be started here.",
    noWebGl: "The window is drawn by WebGL 2, which this browser does not have: turn on hardware acceleration in its settings, or open the page in another browser.",
    failedAgain: "The studio stops again and again. Unsaved work is kept in this browser.",
    noStore: "This browser keeps nothing for this page: save your work to files.",
    again: "Try again",
    open: "Open the laboratory",
    silent: "The studio does not answer. It may be busy with a large picture, or lost.",
    restart: "Start it again",
    newer: "A newer laboratory is here.",
    load: "Load it",
  },
  ru: {
    loading: "Загружается лаборатория",
    starting: "Запускается",
    stopped: "Студия остановилась из-за ошибки и запускается снова. Сохранённая несохранённая работа будет предложена.",
    failed: "Студию здесь запустить нельзя.",
    noWebGl: "Окно рисуется через WebGL 2, а в этом браузере его нет: включите аппаратное ускорение в настройках или откройте страницу в другом браузере.",
    failedAgain: "Студия останавливается снова и снова. Несохранённая работа остаётся в этом браузере.",
    noStore: "Браузер ничего не хранит для этой страницы: сохраняйте работу в файлы.",
    again: "Попробовать снова",
    open: "Открыть лабораторию",
    silent: "Студия не отвечает. Возможно, она занята большим изображением, или остановилась.",
    restart: "Запустить снова",
    newer: "Появилась новая версия лаборатории.",
    load: "Загрузить",
  },
};

// Of the link, such as `?lang=ru`, or of the browser.
export const language = new URLSearchParams(location.search).get("lang") ?? navigator.language ?? "en";
const chosen = language.toLowerCase().startsWith("ru") ? WORDS.ru : WORDS.en;

export function say(key) {
  return chosen[key];
}

# Окно в целом.
app-name = Catoptric
pane-close = Закрыть: { $name }
pane-viewport = Изображение
pane-outliner = Сцена
pane-inspector = Свойства
pane-history = История
pane-problems = Замечания
pane-audit = Разбор
pane-compare = Сравнение
pane-measure = Измерение
pane-materials = Материалы
ok = ОК
cancel = Отмена
close = Закрыть
language = Язык
    .tip = Переключает язык студии.

# Строка состояния.
status-threads = { $count ->
    [one] { $count } поток
    [few] { $count } потока
   *[many] { $count } потоков
}
status-threads-name = Вычислитель
    .tip = Что строит изображение и во сколько потоков.
status-card-refuses = Вместо видеокарты считает процессор: { $reason }
card-lost-notice = Теперь вместо видеокарты считает процессор: { $reason }
window-lost = Драйвер видеокарты дал сбой, и окно открыто заново. Ничего не потеряно.
window-lost-card = Драйвер видеокарты дал сбой, и окно открыто заново. Ничего не потеряно. Изображение теперь строит процессор; включить видеокарту снова можно в меню «Вид».
card-is-lost = связь с видеокартой потеряна.
card-has-no-memory = видеокарте не хватает памяти.
card-has-too-many-rays = в некоторых пикселях слишком много лучей.
card-has-no-doubles = тело так велико или так плоско, что нужна двойная точность.
card-has-too-many-media = луч оказывается внутри слишком многих прозрачных тел сразу.
status-size-name = Размер
    .tip = Ширина и высота последнего изображения в пикселях; пока что-то движется, оно меньше.
status-time = { $time } мс
status-time-name = Время
    .tip = Сколько миллисекунд заняло построение последнего изображения.
status-rays = { $rays } млн лучей/с
status-rays-name = Скорость
    .tip = Сколько миллионов лучей всех видов прослежено за секунду.
status-coarse = набросок
status-refining = уточнение { $done }/{ $wanted }
status-done = готово
status-progress = Уточнение изображения
status-refining-name = Уточнение
    .tip = Сколько отсчётов уже получил каждый пиксель; с каждым из них края становятся глаже.
status-error-scene = Сцену нельзя построить
status-error-size = Изображение такого размера невозможно
status-error-camera = Недопустимое число в параметрах камеры
status-error-fault = Сбой трассировщика
status-bodies = { $count ->
    [one] { $count } тело
    [few] { $count } тела
   *[many] { $count } тел
}
status-lights = { $count ->
    [one] { $count } источник света
    [few] { $count } источника света
   *[many] { $count } источников света
}
status-count-name = Состав
    .tip = Сколько в сцене тел и источников света, считая скрытые.
status-free = Свободный вид
    .tip = Вид движется сам по себе, камера сцены стоит на месте. Клавиша 0 возвращает к ней.
status-flying = Полёт
    .tip = W, A, S, D, Q, E — движение, мышь — поворот. Esc, щелчок или Shift+F завершает полёт.

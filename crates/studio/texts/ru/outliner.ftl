# Панель всего, что есть в сцене, и история.
outliner-filter = Отбор по имени
    .tip = Показывает только то, в имени чего есть эти буквы.
outliner-filter-clear = Снять отбор
outliner-camera = Камера
outliner-environment = Окружение
outliner-tracing = Трассировка
outliner-lights = Источники света
    .tip = Точечные источники; щелчок сворачивает и разворачивает список.
outliner-bodies = Тела
    .tip = Геометрические тела; щелчок сворачивает и разворачивает список.
outliner-materials = Материалы
    .tip = Материалы, общие для нескольких тел; щелчок сворачивает и разворачивает список.
outliner-add-body = Добавить тело
outliner-rename = Новое имя
outliner-unnamed = { $kind } { $number }
outliner-hide = Скрыть «{ $name }»
outliner-show = Показать «{ $name }»
outliner-lock = Закрепить «{ $name }»
outliner-unlock = Открепить «{ $name }»
outliner-of-material = Материал «{ $material }»
outliner-own-material = Собственный материал
outliner-drag-material = Перетащите на тело, чтобы назначить ему этот материал.

# Части составных тел.
outliner-unfold = Показать части: { $name }
outliner-fold = Скрыть части: { $name }
part-joined = Объединение: в целое входит всё, что в ней лежит.
part-common = Пересечение: в целое входит только то, что лежит и в этой части.
part-remains = Остаётся: из неё вычитаются остальные части.
part-taken-away = Вычитается: в целом нет ничего из того, что в ней лежит.
part-surface = Поверхность: от неё остаётся то, что лежит в других частях.
part-cuts = Обрезает поверхность: что лежит вне этой части, отбрасывается.
part-own-material = Из собственного материала
part-material-of-whole = Из материала целого

# Имена новых предметов.
name-sphere = Шар
name-cube = Куб
name-cylinder = Цилиндр
name-cone = Конус
name-paraboloid = Параболоид
name-plane = Плоскость
name-lens = Линза
name-mirror-dish = Вогнутое зеркало
name-tube = Труба
name-ring = Кольцо
name-bowl = Чаша
name-prism = Призма
name-wedge = Клин
name-open-cylinder = Открытый цилиндр
name-open-cone = Открытый конус
name-disc = Диск
name-rectangle = Прямоугольник
name-triangle = Треугольник
name-union = Объединение
name-intersection = Пересечение
name-difference = Разность
name-surface = Поверхность
name-group = Группа
name-light = Свет
name-light-source = Источник света
name-material = Материал

history-opened = Открыто
history-present = Это нынешнее состояние.
history-go = Щелчок вернёт к этому шагу.

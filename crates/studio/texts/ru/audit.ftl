# Разбор пикселя
audit-background = фон
audit-air = воздух
audit-hover = { $x }, { $y } · { $body } · { $light }
audit-kind-primary = первичный
audit-kind-reflected = отражённый
audit-kind-total = полное отражение
audit-kind-refracted = преломлённый
audit-ray = { $ray }: { $kind } – { $end }
audit-tag = { $ray }: { $kind }, вес { $weight }
audit-expand = Слагаемые луча { $ray }
audit-fold = Свернуть луч { $ray }
audit-column-ray = Луч
audit-column-generation = Пок.
audit-column-weight = Вес
audit-column-brings = Приносит вместе с ветвями
audit-click = Щёлкните пиксель изображения: все его лучи появятся здесь и в пространстве.
audit-choose-tool = С инструментом «Разбор пикселя» щелчок по изображению показывает все лучи пикселя и всю их арифметику.
audit-begin = Выбрать инструмент
audit-under-way = Лучи прослеживаются…
audit-failed = Пиксель не удалось разобрать: { $error }
audit-pixel = Пиксель { $x }, { $y } из { $width } × { $height }
audit-linear = Линейный свет: красный, зелёный, синий — кратчайшей записью, которая однозначно задаёт эти числа
audit-proof-exact = точная сумма лучей
    .tip = Свет лучей складывается в пиксель точно, в каком бы порядке его ни складывать.
audit-proof-same = сумма лучей
    .tip = Свет лучей складывается в пиксель. Последний бит мог бы зависеть от порядка сложения, поэтому пиксель рассчитан заново.
audit-proof-last-bit = сумма лучей с точностью до последнего бита
    .tip = Последний бит зависит от порядка сложения; показано значение рассчитанного пикселя.
audit-proof-incomplete = записаны не все лучи
    .tip = Лучей больше, чем записывается; показано значение рассчитанного пикселя.
audit-generations = Поколения с 1 по { $shown } из { $count }
audit-front = Путь
    .tip = Как далеко от глаза ушёл медленный свет: оптический путь, метры, умноженные на показатель преломления. Он начинается перед самой первой поверхностью и кончается сразу за последним событием; если длины очень разные, в пути он ускоряется. Трассировщик прослеживает лучи от глаза; сам свет бежит навстречу.
audit-duration = Длительность
    .tip = Сколько времени занимает весь путь медленного света. В стекле он медленнее, чем в воздухе, во столько раз, каков показатель преломления.
audit-meters = м
audit-seconds = с
audit-not-drawn = { $count ->
    [one] не нарисован { $count } путь с наименьшим весом
    [few] не нарисованы { $count } пути с наименьшим весом
   *[other] не нарисованы { $count } путей с наименьшим весом
}
audit-copied = Разбор скопирован как текст
audit-file = разбор
audit-save-title = Сохранить дерево лучей

# Слагаемые луча.
audit-way = Путь
audit-way-words = из { $origin } вдоль { $direction }, в среде «{ $medium }», n = { $index }
audit-meets = Встречает
audit-meets-words = { $body } через { $distance } м в точке { $point }, нормаль { $normal }
audit-meets-within = { $body } изнутри через { $distance } м в точке { $point }, нормаль { $normal }
audit-angles = Углы
audit-angle = падения { $incidence }
audit-angles-both = падения { $incidence }, преломления { $refraction } (из n = { $from } в n = { $to })
audit-angles-total = падения { $incidence }, полное внутреннее отражение (из n = { $from } в n = { $to })
audit-cemented = склейка: { $left } → { $entered }
audit-seamless = склейка: { $left } → { $entered }, показатель один: границы нет
audit-ambient = Фоновый свет
audit-through-coat = сквозь покрытие
audit-light-below = за поверхностью, ничего не добавляет
audit-light-words = расстояние { $distance } м, { $between }
audit-nothing-between = путь свободен
audit-blocked = заслоняет { $body } на { $distance } м
audit-filtered = сквозь { $body } на { $distance } м × { $filter }
audit-filtered-into = { $body } → { $into } на { $distance } м × { $filter }
audit-medium-before-light = среда перед источником × { $filter }
audit-more-surfaces = { $count ->
    [one] и ещё { $count } поверхность
    [few] и ещё { $count } поверхности
   *[other] и ещё { $count } поверхностей
}
audit-diffuse = Рассеянный
audit-highlight = Блик
audit-facets = Микрограни
audit-arrives = От источника
audit-local = Локальный свет
audit-reflected = Отражённый
audit-refracted = Преломлённый
audit-split = разлагается по цветам, лучей: { $count }, первый из них — { $ray }
audit-wave = свет { $nanometers } нм
audit-density = выбран с плотностью вероятности { $density } на стерадиан
audit-goes-on = продолжается лучом { $ray }
audit-ends-nothing = луча нет: коэффициент равен 0
audit-ends-total = луча нет: весь свет отражается
audit-ends-limit = обрывается на пределе поколений ({ $limit }), вес { $weight }
audit-ends-threshold = обрывается: вес { $weight } меньше порога { $threshold }
audit-ends-left-out = не вошёл в список, вес { $weight }
audit-adds = Добавляет
audit-weight-times-light = вес · локальный свет
audit-brings = Приносит
audit-with-branches = вместе со всем, что из него растёт
audit-was = было { $value }
audit-new = новый

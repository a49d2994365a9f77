# Рендер изображения и что с ним делать дальше.
render-title = Рендер изображения
render-size = Размер
    .tip = Сколько пикселей в изображении по горизонтали и по вертикали.
render-size-entry = { $name }: { $size }
render-size-hd = HD
render-size-full-hd = Full HD
render-size-qhd = QHD
render-size-4k = 4K UHD
render-size-square = Квадрат
render-size-viewport = Как в окне
render-size-own = Свой размер
render-width = Ширина
render-height = Высота
render-pixels = пикселей
render-proportions = Сохранять пропорции
    .tip = При изменении одной стороны меняется и другая, так что пропорции остаются прежними.
render-samples = Отсчётов на пиксель
    .tip = Сколько первичных лучей проходит через каждый пиксель. Чем их больше, тем глаже края и мелкие отражения; время растёт пропорционально.
render-generations = Поколения
    .tip = Сколько поколений лучей прослеживается: луч из глаза — первое, каждое отражение или преломление начинает следующее.
render-generations-scene = Как в сцене: { $count }
render-generations-own = Своё число
render-kind = Файл
    .tip = Что будет записано при сохранении изображения.
render-kind-png8 = PNG, 8 бит
    .tip = То, что показывают экраны: 256 ступеней в каждом канале.
render-kind-png16 = PNG, 16 бит
    .tip = 65 536 ступеней в каждом канале — для дальнейшей обработки.
render-kind-exr = EXR
    .tip = Линейный свет, как он вычислен, в числах с плавающей запятой.
render-note-snapshot = Сцена берётся такой, какая она сейчас; её можно редактировать и во время рендера.
render-note-camera = Изображение строится из камеры сцены, а не из свободного вида.
render-note-exr = EXR хранит линейный свет: экспозиция и тональная кривая на него не влияют.
render-note-running = Сейчас идёт рендер другого изображения; он будет прерван.
render-memory = Потребуется около { $bytes } памяти
render-too-much-memory = Потребуется около { $bytes } памяти, а свободно только { $free }. Выберите меньший размер или закройте другие программы.
render-megabytes = { $count } МБ
render-gigabytes = { $count } ГБ
render-time = Займёт примерно { $time }
render-time-unknown = Время оценивается…
render-time-moment = мгновение
render-time-seconds = { $count } с
render-time-minutes = { $count } мин
render-time-hours = { $count } ч
render-time-days = { $count } сут
render-start = Начать рендер
render-start-anew = Прервать и начать новый
render-progress = Рендер { $size }
render-percent = { $percent } %
render-times = прошло { $elapsed }, осталось { $left }
render-preparing = прошло { $elapsed }, подготовка
render-cancel = Отменить
    .tip = Прерывает рендер; файл не записывается.
render-cancel-name = Отменить рендер
render-cancelled = Рендер отменён
render-failed = Изображение получить не удалось
render-error-empty = В изображении { $size } нет ни одного пикселя. Каждая сторона должна быть не меньше одного пикселя.
render-error-side = Изображение { $size } слишком велико: сторона не может быть больше { $side } пикселей. Выберите меньший размер.
render-error-pixels = Изображение { $size } слишком велико: оно заняло бы { $bytes } памяти, а возможно не более { $megapixels } млн пикселей. Выберите меньший размер.
render-error-memory = Для изображения { $size } не хватает памяти: нужно { $bytes }. Выберите меньший размер или закройте другие программы.
render-error-scene = Рендер этой сцены невозможен: { $reason }. Исправьте сцену и попробуйте снова.
render-error-fault = Произошла ошибка в самой программе: { $reason }. Попробуйте ещё раз; сцена не пострадала.

picture-title = Изображение { $size }
picture-facts = { $name } · { $samples ->
        [one] { $samples } отсчёт
        [few] { $samples } отсчёта
       *[many] { $samples } отсчётов
    } на пиксель · { $time } · { $rays } млн лучей
picture-preview = Готовое изображение
picture-developing = Проявляется…
picture-save = Сохранить…
    .tip = Записывает изображение в файл PNG или EXR; вид файла определяется расширением имени.
picture-copy = Копировать
    .tip = Помещает изображение в буфер обмена таким, каким оно показано здесь, в полном размере.
picture-close = Закрыть изображение
picture-save-title = Сохранение изображения
picture-saved = Сохранено: { $name }
picture-save-failed = Изображение не сохранено
picture-writing = Записывается…
picture-copying = Копируется…
picture-replace-title = Заменить «{ $name }»?
picture-replace-text = В папке { $folder } уже есть файл с таким именем. При замене его содержимое будет потеряно.
picture-other-name = Другое имя…
picture-replace = Заменить
picture-drop-title = Закрыть без сохранения?
picture-drop-text = Изображение не сохранено и не скопировано. Если его закрыть, рендер придётся повторить.
picture-drop = Не сохранять
picture-in-clipboard = В буфере обмена
picture-copied = Изображение скопировано, { $size } пикселей
picture-copy-too-large = Изображение слишком велико для буфера обмена. Сохраните его в файл.
picture-copy-memory = Для копирования изображения не хватает памяти. Сохраните его в файл.
picture-copy-failed = Буфер обмена не принимает изображение: { $reason }. Сохраните его в файл.
picture-copy-waits = Изображение будет скопировано, как только уточнится; та же команда ещё раз скопирует его как есть
picture-copy-none = Пока нет изображения, которое можно скопировать
picture-leave-title = Выйти из студии?
picture-leave-rendering = Рендер ещё идёт. Если выйти сейчас, изображение будет потеряно.
picture-leave-unsaved = { $count ->
        [one] { $count } готовое изображение не сохранено и не скопировано. Если выйти, оно будет потеряно.
        [few] { $count } готовых изображения не сохранены и не скопированы. Если выйти, они будут потеряны.
       *[many] { $count } готовых изображений не сохранены и не скопированы. Если выйти, они будут потеряны.
    }
picture-leave-stay = Остаться
picture-leave-go = Выйти
picture-leave-waits = Окно закроется, как только изображение будет записано

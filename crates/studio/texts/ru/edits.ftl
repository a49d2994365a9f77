# Шаги истории. За действием стоит то, с чем оно сделано: Перемещение: «шар».
step-of = { $act }: «{ $subject }»

edit-add-sphere = Новая сфера
edit-add-cube = Новый куб
edit-add-cylinder = Новый цилиндр
edit-add-cone = Новый конус
edit-add-plane = Новая плоскость
edit-add-light = Новый источник света
edit-add-material = Новый материал
edit-duplicate = Дублирование
edit-delete = Удаление
edit-cut = Вырезание
edit-paste = Вставка
edit-rename = Переименование
edit-toggle-hidden = Скрытие или показ
edit-toggle-locked = Закрепление или открепление
edit-hide = Скрытие
edit-show = Показ
edit-show-all = Показ всего
edit-lock = Закрепление
edit-unlock = Открепление
edit-unlock-all = Открепление всего
edit-move-up = Выше в списке
edit-move-down = Ниже в списке
edit-reorder = Перестановка
edit-assign-material = Назначение материала
edit-share-material = Общий материал
edit-make-material-unique = Собственный материал
edit-remove-unused-materials = Удаление неиспользуемых материалов
edit-drop-to-ground = Постановка на землю
edit-reset-placement = Сброс поворота и масштаба
edit-revert = Возврат к сохранённому
edit-select-all = Выделение всего
edit-select-none = Снятие выделения
edit-invert-selection = Обращение выделения
edit-select-next = Выделение следующего
edit-select-previous = Выделение предыдущего
edit-undo = Отмена
edit-redo = Повтор

edit-camera-from-view = Камера в точке вида
edit-projection = Проекция
edit-frame = Показ целиком

# edits

# В окне просмотра
edit-orbit = Облёт камерой
edit-pan = Сдвиг камеры
edit-dolly = Приближение камеры
edit-fly = Полёт камеры
edit-move = Перемещение
edit-rotate = Поворот
edit-scale = Масштаб

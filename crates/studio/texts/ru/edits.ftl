# edits

# В окне просмотра
edit-orbit = Облёт камерой
edit-pan = Сдвиг камеры
edit-dolly = Приближение камеры
edit-fly = Полёт камеры
edit-frame = Наведение камеры
edit-projection = Смена проекции
edit-camera-from-view = Камера на место вида
edit-move = Перемещение
edit-rotate = Поворот
edit-scale = Масштаб

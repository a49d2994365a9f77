# Окно в целом.
app-name = Catoptric
pane-viewport = Изображение
pane-outliner = Сцена
pane-inspector = Свойства
pane-history = История
pane-problems = Замечания
unsaved-mark = { $title } *
ok = ОК
cancel = Отмена
close = Закрыть
language = Язык
    .tip = Переключает язык студии.
theme = Тема
    .tip = Светлое или тёмное окно.

//! The catalog: every message with its arguments, in English and in Russian.

use crate::format::message::phrase::{
    Collection, Enumeration, FoundValue, KeyMeaning, Requirement, Sentence, Subject,
};
use crate::format::message::syntax::SyntaxFault;
use crate::format::spec::{Kind, TableSpec};
use crate::image::ImageError;

crate::messages! {
    // The file as a whole.
    TextTooLong:
        "the text is too long",
        "текст слишком длинный";
    LongestText { bytes: String }:
        "the longest text that can be read has {bytes} bytes",
        "прочесть можно не больше {bytes} байт";
    NotUtf8:
        "the file is not UTF-8 text",
        "файл — не текст в кодировке UTF-8";
    ByteOutOfPlace { byte: String }:
        "the byte {byte} does not belong here",
        "байту {byte} здесь не место";
    SaveAsUtf8:
        "save the file as UTF-8",
        "сохраните файл в кодировке UTF-8";
    FormatMissing:
        "the key `format` is missing",
        "нет ключа `format`";
    BeginWithFormat { known: String }:
        "begin the file with the line `format = {known}`",
        "начните файл строкой `format = {known}`";
    UnknownVersion { version: String }:
        "`format` is {version}, which this program does not know",
        "`format` — {version}, но такой версии эта программа не знает";
    KnownVersions { known: String }:
        "known is {known}",
        "известна версия {known}";

    // Tables, lists and keys.
    NotAList { name: String }:
        "{name} is not a list",
        "{name} — не список";
    NotATable { name: String }:
        "{name} is not a table",
        "{name} — не таблица";
    Write { text: String }:
        "write `{text}`",
        "напишите `{text}`";
    WriteInSingleBrackets:
        "write its name in single brackets",
        "напишите имя в одинарных скобках";
    IsAList { name: &'static str }:
        "`{name}` is a list",
        "`{name}` — список";
    NoElementYet { name: &'static str }:
        "`{name}` is a list, and has no element yet",
        "`{name}` — список, и в нём ещё нет элементов";
    BeginElement { name: String }:
        "begin an element with `[[{name}]]` before this",
        "начните перед этим элемент: `[[{name}]]`";
    WriteBeforeElement { name: String }:
        "write `[[{name}]]` before the keys of each element",
        "пишите `[[{name}]]` перед ключами каждого элемента";
    WrongElement { list: &'static str, found: FoundValue }:
        "an element of `{list}` is {found}, but must be a table",
        "элемент списка `{list}` — {found}, а ожидается таблица";
    GivenTwice { key: String }:
        "{key} is given twice",
        "{key} встречается дважды";
    SecondTime:
        "the second time",
        "второй раз";
    FirstTime:
        "the first time",
        "первый раз";
    LeaveOne:
        "leave one of them",
        "оставьте что-то одно";
    ListInOneWay:
        "write the list either as a value or with headers",
        "задайте список либо значением, либо заголовками";
    EmptyName:
        "a name must not be empty",
        "имя не может быть пустым";
    NoSuchKey { table: &'static TableSpec, key: String }:
        "{table} has no key {key}",
        "у {table} нет ключа {key}";
    KeysAre { table: &'static TableSpec, keys: Enumeration }:
        "the keys of {table} are {keys}",
        "ключи {table}: {keys}";
    KeyOf { table: &'static TableSpec }:
        "a key of {table}",
        "ключ {table}";
    UnknownKey:
        "unknown key",
        "неизвестный ключ";
    BelongsToFile { key: String }:
        "{key} belongs to the whole file: write it before the first header",
        "{key} относится ко всему файлу: напишите его до первого заголовка";
    DidYouMean { word: String }:
        "did you mean {word}?",
        "возможно, {word}?";
    ValueTooLong:
        "this value is too long",
        "это значение слишком длинное";
    WriteWithHeaders:
        "write bodies and lights as `[[bodies]]` and `[[lights]]`",
        "записывайте тела и источники света как `[[bodies]]` и `[[lights]]`";

    // Values.
    WrongValue { subject: Subject, found: FoundValue, expected: Kind }:
        "{subject} is {found}, but must be {expected}",
        "{subject} — {found}, а ожидается {expected}";
    OutOfRange { subject: Subject, value: FoundValue, requirement: Requirement }:
        "{subject} is {value}, but must be {requirement}",
        "{subject} равно {value}, а должно быть {requirement}";
    KeyMeans { meaning: KeyMeaning }:
        "{meaning}",
        "{meaning}";
    DecimalCommas { key: &'static str, expected: Kind }:
        "`{key}` has decimal commas, but must be {expected}",
        "в `{key}` десятичные запятые, а ожидается {expected}";
    DecimalPoint { example: String }:
        "a decimal number is written with a point: {example}",
        "дробная часть отделяется точкой: {example}";
    DecimalComma:
        "a decimal comma",
        "десятичная запятая";
    NotAColor:
        "not a color",
        "не цвет";
    ColorIs:
        "a color is `[r, g, b]` in linear light, or \"#rrggbb\" with six hexadecimal digits in sRGB",
        "цвет — это `[r, g, b]` в линейном свете или \"#rrggbb\", шесть шестнадцатеричных цифр в sRGB";
    UnknownWord { key: &'static str }:
        "unknown {key}",
        "неизвестное значение `{key}`";
    OnlyFor { key: &'static str, choice: &'static str, values: Enumeration }:
        "`{key}` is only for `{choice}` {values}",
        "`{key}` бывает только при `{choice}` {values}";
    ChosenHere { choice: &'static str, chosen: &'static str }:
        "here `{choice}` is \"{chosen}\"",
        "здесь `{choice}` — \"{chosen}\"";
    ChosenByDefault { choice: &'static str, chosen: &'static str }:
        "here `{choice}` is \"{chosen}\", the default",
        "здесь `{choice}` — \"{chosen}\", по умолчанию";
    RemoveOrChange { key: &'static str, choice: &'static str }:
        "remove `{key}`, or change `{choice}`",
        "уберите `{key}` или измените `{choice}`";
    RemoveOrChangeChosen {
        key: &'static str,
        choice: &'static str,
        chosen: &'static str,
        own: Enumeration
    }:
        "remove `{key}`, or change `{choice}`; with \"{chosen}\" stand {own}",
        "уберите `{key}` или измените `{choice}`; при \"{chosen}\" можно задать {own}";
    Needs { key: &'static str, other: &'static str }:
        "`{key}` needs `{other}`",
        "ключу `{key}` нужен `{other}`";
    Missing { key: &'static str }:
        "`{key}` is missing",
        "не хватает `{key}`";
    CannotStandBeside { key: &'static str, other: &'static str }:
        "`{key}` cannot stand beside `{other}`",
        "`{key}` не может стоять рядом с `{other}`";
    SetAlready { key: &'static str }:
        "`{key}` sets this already",
        "это уже задаёт `{key}`";
    StandsHere { key: &'static str }:
        "`{key}` stands here",
        "`{key}` стоит здесь";
    EitherOr:
        "write either the one or the other",
        "напишите что-то одно";
    AxisOrFrame:
        "`base` and `top` set position, rotation and height; write either them or those",
        "`base` и `top` задают положение, поворот и высоту; оставьте либо эти два ключа, либо остальные";

    // Rules between several values.
    TargetIsPosition:
        "`target` and `position` of the camera are the same point",
        "`target` и `position` камеры — одна и та же точка";
    TargetIsNear:
        "`target` and `position` of the camera are less than 1e-9 meters apart",
        "между `target` и `position` камеры меньше 1e-9 метра";
    CameraLooks:
        "the camera looks from `position` towards `target`; move one of them",
        "камера смотрит из `position` в сторону `target`; сдвиньте одну из этих точек";
    UpIsZero:
        "`up` is zero, but must be a direction",
        "`up` — нулевой вектор, а должно быть направление";
    UpPoints:
        "`up` is the direction that points up in the picture, mostly `[0.0, 1.0, 0.0]`",
        "`up` — направление вверх на изображении, обычно `[0.0, 1.0, 0.0]`";
    UpIsParallel:
        "`up` is parallel to the direction of view",
        "вектор `up` параллелен направлению взгляда";
    ChooseUp:
        "choose another `up`, for example `[0.0, 0.0, -1.0]` for a camera that looks straight down",
        "выберите другой `up`, например `[0.0, 0.0, -1.0]` для камеры, которая смотрит прямо вниз";
    BaseIsTop:
        "`base` and `top` are the same point",
        "`base` и `top` — одна и та же точка";
    BaseIsNearTop:
        "`base` and `top` are less than 1e-9 meters apart",
        "между `base` и `top` меньше 1e-9 метра";
    BaseIsFarFromTop:
        "`base` and `top` are more than 1e9 meters apart",
        "между `base` и `top` больше 1e9 метров";
    AxisEnds:
        "`base` and `top` are the ends of the axis; move one of them",
        "`base` и `top` — концы оси; сдвиньте один из них";

    FocalLengthBesideRadius:
        "`focal_length` gives a height that is less than 1e-9 or more than 1e9 meters",
        "`focal_length` даёт высоту меньше 1e-9 или больше 1e9 метров";
    HeightOfParaboloid:
        "the height of a paraboloid is the square of `radius` over four times `focal_length`; change one of them",
        "высота параболоида равна квадрату `radius`, делённому на учетверённый `focal_length`; измените один из ключей";
    Sizes { fault: Sentence }:
        "{fault}",
        "{fault}";
    ChangeSizes { help: Sentence }:
        "{help}",
        "{help}";

    // Bodies of parts.
    NoParts { shape: &'static str }:
        "a {shape} needs at least one part",
        "телу формы \"{shape}\" нужна хотя бы одна часть";
    BeginPart:
        "begin a part with `[[bodies.parts]]`, within a part with `[[bodies.parts.parts]]`",
        "начните часть с `[[bodies.parts]]`, внутри части — с `[[bodies.parts.parts]]`";
    TooManyParts { shape: &'static str, count: String, most: String }:
        "this {shape} has {count} simple parts, but can have at most {most}",
        "у тела формы \"{shape}\" простых частей {count}, а может быть не больше {most}";
    GroupHasMore:
        "a group that is no part of another shape can have any number of them",
        "в группе, которая не входит в тело другой формы, их может быть сколько угодно";
    PartsTooDeep: "parts are nested too deep", "части вложены слишком глубоко";
    DeepestParts { most: String }:
        "parts within parts can be nested {most} levels deep",
        "частей одна в другой может быть не больше {most} уровней";
    SurfaceOfJoined:
        "the first part of a surface is made of parts itself",
        "первая часть поверхности сама состоит из частей";
    SurfaceOfSimple:
        "the first part is the sphere, cylinder, cone, plane … whose surface is left; the others cut it",
        "первая часть — шар, цилиндр, конус, плоскость…, от которых остаётся поверхность; другие её обрезают";
    SurfaceWithin { shape: &'static str }:
        "a surface has no inside, so it cannot be a part of a {shape}",
        "у поверхности нет внутренности, поэтому она не может быть частью тела формы \"{shape}\"";
    SurfaceStandsAlone:
        "make it a body of its own, or a member of a group",
        "сделайте её отдельным телом или членом группы";
    PartsOfSimple { shape: &'static str }: "a {shape} has no parts", "у тела формы \"{shape}\" частей не бывает";
    UndefinedBody { name: String }: "the body {name} is not defined", "тело {name} не определено";
    PatternsTooDeep: "patterns are nested too deep", "узоры вложены слишком глубоко";
    DeepestPatterns { most: String }:
        "patterns within patterns can be nested {most} levels deep",
        "узоров один в другом может быть не больше {most} уровней";
    InstanceOfBody:
        "`instance_of` is the name of another body of the scene, which may be hidden",
        "`instance_of` — имя другого тела сцены, возможно скрытого";
    InstanceOfItself { name: String }:
        "with this instance of {name} the body would be made of itself",
        "с этим экземпляром тела {name} тело состояло бы из самого себя";
    InstanceOfOther:
        "a body can be an instance only of what is no instance of it and has none among its parts",
        "тело может быть экземпляром только того, что не является его экземпляром и не содержит таких частей";
    TooManyInstances { count: String, most: String }:
        "with its instances the scene has {count} simple bodies, but can have at most {most}",
        "вместе с экземплярами в сцене простых тел {count}, а может быть не больше {most}";
    FewerInstances: "use fewer instances", "используйте меньше экземпляров";
    PartNameTwice { name: String }:
        "two parts have the name {name}",
        "имя {name} носят две части";
    EmptyBody { shape: &'static str }:
        "this {shape} is empty: its parts do not meet",
        "тело формы \"{shape}\" пусто: его части не пересекаются";
    MoveParts:
        "move its parts until they overlap, or remove it",
        "сдвиньте части так, чтобы они пересекались, или уберите его";

    // Names.
    MaterialIsTable:
        "a material is a table: `[materials.NAME]`",
        "материал — это таблица: `[materials.ИМЯ]`";
    Undefined { name: String }:
        "the material {name} is not defined",
        "материал {name} не определён";
    NotDefined:
        "not defined",
        "не определён";
    Define { key: String }:
        "define it with `[materials.{key}]`, or write a material of its own: `{{ color = [0.8, 0.8, 0.8] }}`",
        "определите его: `[materials.{key}]`, или напишите собственный материал: `{{ color = [0.8, 0.8, 0.8] }}`";
    OwnMaterial:
        "write a material of its own: `{{ color = [0.8, 0.8, 0.8] }}`",
        "напишите собственный материал: `{{ color = [0.8, 0.8, 0.8] }}`";
    OnlyDefined { name: String }:
        "the only defined material is {name}",
        "определён только материал {name}";
    Defined { names: Enumeration }:
        "defined are {names}",
        "определены материалы {names}";
    NameTwice { things: Collection, name: String }:
        "two {things} have the name {name}",
        "имя {name} носят два {things}";
    NumbersOfName { things: Collection, name: String, first: String, second: String }:
        "two {things} have the name {name}: numbers {first} and {second}",
        "имя {name} носят два {things}: номера {first} и {second}";
    SecondOne:
        "the second one",
        "второе такое имя";
    FirstOne:
        "the first one",
        "первое такое имя";
    Rename:
        "give one of them another name, or none",
        "дайте одному из них другое имя или оставьте его без имени";
    NoLight:
        "the scene has no lights and no ambient light",
        "в сцене нет ни источников света, ни фонового освещения";
    AddLight:
        "add a light with `[[lights]]`, or the bodies will be black",
        "добавьте источник света: `[[lights]]`, иначе тела будут чёрными";
    Unused { name: String }:
        "the material {name} is not used",
        "материал {name} не используется";
    UseOrRemove:
        "give it to a body with `material`, or remove it",
        "назначьте его телу ключом `material` или удалите";

    // Scenes in memory.
    UnnamedMaterial:
        "the name is empty",
        "имя пустое";
    EmptyPath { key: &'static str }:
        "`{key}` is empty, but must be the path of a picture",
        "`{key}` — пустой текст, а ожидается путь к картинке";
    NoAxis { shape: &'static str }:
        "a {shape} cannot be placed by `base` and `top`",
        "тело формы \"{shape}\" нельзя разместить ключами `base` и `top`";
    NoImage { error: ImageError }:
        "{error}",
        "{error}";

    // Files of other programs.
    Said { sentence: Sentence }:
        "{sentence}",
        "{sentence}";

    // Addresses of values.
    NotAPath { text: String }:
        "{text} is not the address of a value",
        "{text} — не адрес значения";
    PathIs:
        "an address is keys and names with points between them, such as `bodies.ball.position.y`; names with other \
         characters than letters, digits, `_` and `-` stand in quotes",
        "адрес — это ключи и имена через точку, например `bodies.ball.position.y`; имена не только из букв, цифр, `_` \
         и `-` берут в кавычки";
    SceneValueIs:
        "a value is a number, three numbers as in `[0, 1, 0]`, `true`, `false` or a text",
        "значение — это число, три числа, например `[0, 1, 0]`, `true`, `false` или текст";
    NotOfScene { key: &'static str }:
        "`{key}` is not a value of the scene",
        "`{key}` — не значение сцены";
    IsATable { name: String }:
        "{name} is not one value, but several",
        "{name} — не одно значение, а несколько";
    NoElement { list: &'static str, name: String }:
        "`{list}` has no element {name}",
        "в `{list}` нет элемента {name}";
    ElementIs { list: &'static str, last: String }:
        "an element of `{list}` has a name, or a number from 0 to {last}",
        "у элемента `{list}` есть имя или номер от 0 до {last}";
    ListIsEmpty { list: &'static str }:
        "`{list}` is empty",
        "список `{list}` пуст";
    MaterialIsShared { name: String }:
        "the body shares the material {name}",
        "у тела общий материал {name}";
    SharedUnder { key: String }:
        "its values are under `materials.{key}`",
        "его значения находятся в `materials.{key}`";
    MaterialIsOwn:
        "the body has a material of its own, which has no name",
        "у тела собственный материал, без имени";
    AbsentKey { key: &'static str }:
        "`{key}` has no value here",
        "у `{key}` здесь нет значения";
    NoSuchPart { key: &'static str, part: String }:
        "`{key}` has no part {part}",
        "у `{key}` нет части {part}";
    PartsAre { key: &'static str, parts: Enumeration }:
        "the parts of `{key}` are {parts}",
        "части `{key}`: {parts}";
    PartIsNumber { key: &'static str }:
        "a part of `{key}` must be a number, and `{key}` must have numbers already",
        "часть `{key}` должна быть числом, и у `{key}` уже должны быть числа";

    // Syntax.
    ListNotClosed:
        "this list is not closed",
        "этот список не закрыт";
    TableNotClosed:
        "this table is not closed",
        "эта таблица не закрыта";
    HeaderNotClosed:
        "this header is not closed",
        "этот заголовок не закрыт";
    TextNotClosed:
        "this text is not closed",
        "этот текст не закрыт";
    KeyNotClosed:
        "this key is not closed",
        "этот ключ не закрыт";
    OpenedHere:
        "opened here",
        "начало здесь";
    CloseAfterLast { bracket: &'static str }:
        "write `{bracket}` after its last value",
        "напишите `{bracket}` после последнего значения";
    CloseQuote:
        "write the closing quote",
        "напишите закрывающую кавычку";
    HeaderIs:
        "a header is `[name]`",
        "заголовок таблицы — `[имя]`";
    ListHeaderIs:
        "a header of a list is `[[name]]`",
        "заголовок элемента списка — `[[имя]]`";
    NoValue:
        "this key has no value",
        "у этого ключа нет значения";
    EqualsNotColon:
        "between a key and its value stands `=`, not `:`",
        "между ключом и значением стоит `=`, а не `:`";
    EqualsBetween:
        "between a key and its value stands `=`",
        "между ключом и значением стоит `=`";
    EqualsAndValueMissing:
        "`=` and a value are missing",
        "не хватает `=` и значения";
    ValueMissing:
        "a value is missing",
        "не хватает значения";
    ValueMissingBeforeComma:
        "a value is missing before this comma",
        "перед этой запятой не хватает значения";
    KeyMissing:
        "a key is missing",
        "не хватает ключа";
    CommaMissing:
        "a comma is missing",
        "не хватает запятой";
    QuoteMissing:
        "a quote is missing",
        "не хватает кавычки";
    DigitMissing:
        "a digit is missing",
        "не хватает цифры";
    IsCommaMissing:
        "is a comma missing?",
        "не пропущена ли запятая?";
    Here:
        "here",
        "здесь";
    BeforeThis:
        "before this",
        "перед этим";
    ValueIs:
        "a value is a number, a \"text\", a [list] or a {{ table }}",
        "значение — это число, \"текст\", [список] или {{ таблица }}";
    LineBegins:
        "a line cannot begin like this",
        "так строка начинаться не может";
    LineIs:
        "a line is `key = value`, `[table]`, `[[list]]` or `# a comment`",
        "строка — это `ключ = значение`, `[таблица]`, `[[список]]` или `# комментарий`";
    LineEnds:
        "the line should end here",
        "здесь строка должна закончиться";
    TooMuch:
        "too much",
        "лишнее";
    OneKeyPerLine:
        "write each key on a line of its own, and comments after `#`",
        "пишите каждый ключ на отдельной строке, а комментарии — после `#`";
    NotOpened { closing: &'static str, opening: &'static str }:
        "`{closing}` without `{opening}`",
        "`{closing}` без `{opening}`";
    TooDeep:
        "brackets are nested too deep",
        "скобки вложены слишком глубоко";
    OneLevelTooDeep:
        "one level too deep",
        "этот уровень уже лишний";
    Syntax { fault: SyntaxFault }:
        "{fault}",
        "{fault}";
    QuoteColor:
        "# begins a comment; write a color in quotes: \"#ff0000\"",
        "с # начинается комментарий; цвет пишется в кавычках: \"#ff0000\"";
    NotAValue { raw: String }:
        "{raw} is not a value",
        "{raw} — не значение";
    NotANumber { raw: String }:
        "{raw} is not a number",
        "{raw} — не число";
    BadNumber { raw: String, fault: SyntaxFault }:
        "{raw} is not a number: {fault}",
        "{raw} — не число: {fault}";
    NoNumber:
        "not a number",
        "не число";
    NumberIs:
        "a number has digits before and after the point: 0.5, 27.0",
        "у дробного числа есть цифры и до точки, и после неё: 0.5, 27.0";
    VectorIs:
        "a vector stands in square brackets: [0.0, 1.0, 0.0]",
        "вектор пишется в квадратных скобках: [0.0, 1.0, 0.0]";
    TextIs:
        "a text stands in quotes: \"text\"",
        "текст пишется в кавычках: \"текст\"";
    UnknownEscape:
        "unknown escape sequence in a text",
        "неизвестная управляющая последовательность в тексте";
    EscapesAre:
        "a backslash is written `\\\\`, a quote `\\\"`, a new line `\\n`",
        "обратная косая черта пишется `\\\\`, кавычка — `\\\"`, новая строка — `\\n`";
    NotUnicode:
        "not a Unicode character",
        "такого символа в Юникоде нет";
    UnicodeIs:
        "`\\u` is followed by four hexadecimal digits, `\\U` by eight",
        "после `\\u` стоят четыре шестнадцатеричные цифры, после `\\U` — восемь";
    BadCharacter:
        "a character that a text cannot hold",
        "символ, которого в тексте быть не может";
    EscapeCharacter:
        "write it as an escape sequence, for example `\\t` or `\\u0007`",
        "запишите его управляющей последовательностью, например `\\t` или `\\u0007`";
    NotAKey { raw: String }:
        "{raw} is not a key",
        "{raw} — не ключ";
    BadKey { raw: String, fault: SyntaxFault }:
        "{raw} is not a key: {fault}",
        "{raw} — не ключ: {fault}";
    KeyIs:
        "a key is made of the letters A to Z and a to z, digits, `_` and `-`; others need quotes",
        "ключ состоит из латинских букв, цифр, `_` и `-`; с другими символами его берут в кавычки";
}

//! Messages of the TOML library about syntax.

use std::borrow::Cow;

use super::phrase::Phrase;
use crate::language::Language;

/// An error of the TOML library, in its own words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SyntaxFault(String);

impl From<&toml_parser::ParseError> for SyntaxFault {
    fn from(error: &toml_parser::ParseError) -> Self {
        Self(error.description().to_owned())
    }
}

impl Phrase for SyntaxFault {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        let english = self.0.as_str();
        if language == Language::English {
            return english.into();
        }
        match RUSSIAN.iter().find(|(known, _)| *known == english) {
            Some((_, russian)) => (*russian).into(),
            None => format!("синтаксис TOML: {english}").into(),
        }
    }
}

/// The errors of `toml_parser` 1.1 that can reach a reader, and their Russian words.
pub(super) const RUSSIAN: &[(&str, &str)] = &[
    ("`_` may only go between digits", "`_` может стоять только между цифрами"),
    ("carriage return must be followed by newline", "за возвратом каретки должен следовать перевод строки"),
    ("extra `=`", "лишний знак `=`"),
    ("extra assignment between key-value pairs", "лишний знак `=`"),
    ("integers with a radix cannot be signed", "у числа с приставкой `0x`, `0o` или `0b` не бывает знака"),
    ("invalid basic string", "недопустимый символ в тексте"),
    ("invalid binary number", "неверное двоичное число"),
    ("invalid boolean", "неверное логическое значение"),
    ("invalid comment character", "недопустимый символ в комментарии"),
    ("invalid date-time", "неверная дата"),
    ("invalid exponent", "неверный порядок"),
    ("invalid float", "неверное дробное число"),
    ("invalid fraction", "неверная дробная часть"),
    ("invalid hexadecimal number", "неверное шестнадцатеричное число"),
    ("invalid inline table element", "это не может стоять в таблице"),
    ("invalid integer number", "неверное целое число"),
    ("invalid literal string", "недопустимый символ в тексте"),
    ("invalid mantissa", "неверная мантисса"),
    ("invalid multi-line basic string", "недопустимый символ в тексте"),
    ("invalid multi-line literal string", "недопустимый символ в тексте"),
    ("invalid octal number", "неверное восьмеричное число"),
    ("invalid string", "неверный текст"),
    ("invalid unquoted key", "недопустимый символ в ключе без кавычек"),
    ("invalid value", "такого символа в Юникоде нет"),
    ("keys cannot be multi-line basic strings", "ключ не может быть текстом из нескольких строк"),
    ("keys cannot be multi-line literal strings", "ключ не может быть текстом из нескольких строк"),
    ("missing comment start", "не хватает `#`"),
    ("missing escaped value", "неизвестная управляющая последовательность"),
    ("missing key for inline table element", "не хватает ключа"),
    ("missing opening quote", "не хватает открывающей кавычки"),
    ("radix must be lowercase", "приставки `0x`, `0o` и `0b` пишутся строчными буквами"),
    ("redundant integer number prefix", "лишняя приставка"),
    ("redundant numeric sign", "лишний знак числа"),
    ("string values must be quoted", "текст пишется в кавычках"),
    ("too few unicode value digits", "не хватает шестнадцатеричных цифр"),
    ("unexpected `=` in array", "в списке не может стоять `=`"),
    ("unexpected content", "здесь ничего не должно стоять"),
    ("unexpected content between comment and newline", "после комментария ничего не должно стоять"),
    ("unexpected leading zero", "лишний ноль в начале"),
    ("unexpected sign", "лишний знак числа"),
    ("unquoted keys cannot be empty", "ключ не может быть пустым"),
];

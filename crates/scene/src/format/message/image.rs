//! Pictures that cannot be opened.

use std::borrow::Cow;

use super::phrase::Phrase;
use crate::image::{Image, ImageError, ImageFault, UnreadableKind};
use crate::language::Language;

impl ImageFault {
    /// What is wrong and what to do; in English as `Display` writes it. What only a decoder or the system knows is in
    /// English in any language.
    pub fn text(&self, language: Language) -> String {
        match language {
            Language::English => self.to_string(),
            Language::Russian => self.russian(),
        }
    }

    fn russian(&self) -> String {
        match self {
            Self::NotBuiltIn => {
                let names = Image::BUILT_IN_NAMES.map(|name| format!("`{name}`"));
                format!("в программе нет картинки с таким именем; есть {}", names.join(", "))
            }
            Self::BuiltInLayer => "у картинки из программы нет слоёв; уберите `layer`".to_owned(),
            Self::Missing(path) => {
                format!("нет файла `{path}`; проверьте путь, он начинается в папке сцены")
            }
            Self::NotAFile => "это не обычный файл; сохраните картинку в файл".to_owned(),
            Self::TooLarge { width, height } => {
                format!("в ней {width}×{height} пикселей, а можно не больше 8192×4096; уменьшите её")
            }
            Self::Unreadable { reason, kind } => kind.russian().unwrap_or_else(|| reason.clone()),
        }
    }
}

impl UnreadableKind {
    /// What is wrong and what to do, where it is known.
    fn russian(&self) -> Option<String> {
        let quoted = |layers: &[String]| layers.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>();
        Some(match self {
            Self::Empty => "файл пуст; запишите его заново".to_owned(),
            Self::UnknownFormat => {
                "такой формат не читается; сохраните картинку в другом, например PNG".to_owned()
            }
            Self::Damaged => "файл повреждён или обрывается; запишите его заново".to_owned(),
            Self::ManyLayers { layers } => format!(
                "в файле несколько слоёв; назовите один из них ключом `layer`: {}",
                quoted(layers).join(", ")
            ),
            Self::NoSuchLayer { layers } if layers.is_empty() => {
                "в файле нет слоёв с именами; уберите `layer`".to_owned()
            }
            Self::NoSuchLayer { layers } => {
                format!("такого слоя в файле нет; есть {}", quoted(layers).join(", "))
            }
            Self::Other => return None,
        })
    }
}

impl Phrase for ImageError {
    fn phrase(&self, language: Language) -> Cow<'_, str> {
        match language {
            Language::English => self.to_string().into(),
            Language::Russian => {
                let reason = self.fault.text(language);
                format!("картинка `{}` не открывается: {reason}", self.image.path()).into()
            }
        }
    }
}

//! The macro that makes a catalog of messages.

/// Makes a catalog of messages: an enum `Message` of names with arguments, each with its English and its Russian
/// sentence. Both sentences name all arguments, which are [`Phrase`](crate::Phrase)s.
///
/// ```
/// # use catoptric_scene::{Diagnostic, Language, Sentence, Severity};
/// catoptric_scene::messages! {
///     Unknown { name: String }:
///         "there is no {name}",
///         "нет такого имени: {name}";
/// }
/// let finding = Diagnostic::said(Severity::Error, 0..1, Message::Unknown { name: "a".to_owned() });
/// assert_eq!(finding.message(Language::English), "there is no a");
/// ```
#[macro_export]
macro_rules! messages {
    ($($name:ident $({ $($field:ident: $kind:ty),+ $(,)? })?: $english:literal, $russian:literal;)+) => {
        /// A message, independent of the language.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub(crate) enum Message {
            $($name $({ $($field: $kind),+ })?,)+
        }

        impl Message {
            /// The name, the English and the Russian sentence of every message, for tests.
            #[cfg(test)]
            pub(crate) const SENTENCES: &'static [[&'static str; 3]] =
                &[$([stringify!($name), $english, $russian]),+];

            /// The message in words. Whatever of the file it repeats, it is one line that does nothing but be seen.
            pub(crate) fn text(&self, language: $crate::Language) -> String {
                #[allow(unused_imports, reason = "a catalog may have no arguments")]
                use $crate::Phrase as _;
                let sentence = match self {
                    $(Self::$name $({ $($field),+ })? => {
                        $($(let $field = $field.phrase(language);)+)?
                        match language {
                            $crate::Language::English => format_args!($english).to_string(),
                            $crate::Language::Russian => format_args!($russian).to_string(),
                        }
                    })+
                };
                match $crate::visible(&sentence) {
                    ::std::borrow::Cow::Borrowed(_) => sentence,
                    ::std::borrow::Cow::Owned(visible) => visible,
                }
            }
        }

        impl From<Message> for $crate::Sentence {
            fn from(message: Message) -> Self {
                Self::new(|language| message.text(language))
            }
        }
    };
}

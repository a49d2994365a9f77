//! Choices that scene files say by words.

/// Gives an enumeration its words in scene files: `keyed!(Shadow { Filtered = "filtered", None = "none" })`, in the order in
/// which to offer them.
macro_rules! keyed {
    ($name:ident { $($variant:ident = $key:literal),+ $(,)? }) => {
        impl $name {
            /// All of them, in the order in which to offer them.
            pub const ALL: [Self; [$($key),+].len()] = [$(Self::$variant),+];

            /// Their words in scene files.
            pub(crate) const KEYS: &'static [&'static str] = &[$($key),+];

            /// The word for it in scene files.
            pub const fn key(self) -> &'static str {
                match self {
                    $(Self::$variant => $key),+
                }
            }

            /// The one of this word.
            pub fn of_key(key: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|own| own.key() == key)
            }
        }
    };
}

pub(crate) use keyed;

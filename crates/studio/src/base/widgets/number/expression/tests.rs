use super::*;

fn read(text: &str, unit: Unit) -> Result<f64, ExpressionErrorKind> {
    evaluate(text, unit, DecimalSign::Point).map_err(|fault| fault.kind)
}

fn plain(text: &str) -> Result<f64, ExpressionErrorKind> {
    read(text, Unit::None)
}

#[test]
fn arithmetic_follows_the_rules_of_mathematics() {
    for (text, value) in [
        ("0.1*3", 0.3),
        ("1/3", 1.0 / 3.0),
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("7 − 2 − 1", 4.0),
        ("8 / 4 / 2", 1.0),
        ("2^10", 1024.0),
        ("2**3", 8.0),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^-1", 0.5),
        ("2/-4", -0.5),
        ("--3", 3.0),
        ("6 × 2 ÷ 3 · 2", 8.0),
        ("sqrt(2)", std::f64::consts::SQRT_2),
        ("√(9)", 3.0),
        ("2*pi", std::f64::consts::TAU),
        ("π", std::f64::consts::PI),
        ("sin(pi/6)", 0.5),
        ("sin(30°)", 0.5),
        ("COS(0)", 1.0),
        ("tan(45 deg)", 1.0),
        ("abs(-4) + ln(exp(2))", 6.0),
        ("((((1))))", 1.0),
        ("1/0.000001", 1e6),
    ] {
        assert_eq!(plain(text), Ok(value), "{text}");
    }
    assert_eq!(read("atan(1)", Unit::Degrees), Ok(45.0));
}

#[test]
fn numbers_are_read_as_people_write_them() {
    for (text, value) in [
        ("0,5", 0.5),
        (" 0.5 ", 0.5),
        (".5", 0.5),
        ("5.", 5.0),
        ("−2.5", -2.5),
        ("+3", 3.0),
        ("1e9", 1e9),
        ("2.5e−3", 0.0025),
        ("2,5E+3", 2500.0),
        ("1 000", 1000.0),
        ("12 345 678,5", 12_345_678.5),
        ("0,500", 0.5),
        ("1,25 + 0.75", 2.0),
        ("0,1*3", 0.3),
    ] {
        assert_eq!(plain(text), Ok(value), "{text}");
    }
}

#[test]
fn a_comma_is_a_decimal_sign_where_it_cannot_be_another() {
    assert_eq!(plain("1,500"), Err(ExpressionErrorKind::AmbiguousComma));
    assert_eq!(evaluate("1,500", Unit::None, DecimalSign::Comma), Ok(1.5));
    assert_eq!(evaluate("1.500", Unit::None, DecimalSign::Comma), Ok(1.5));
    for text in ["1,000,000", "1.5.2", "1,5.2", "1..2", "1,,2"] {
        for sign in [DecimalSign::Point, DecimalSign::Comma] {
            assert!(evaluate(text, Unit::None, sign).is_err(), "{text}");
        }
    }
}

#[test]
fn units_are_those_of_the_quantity() {
    for (text, value) in [
        ("2", 2.0),
        ("2 m", 2.0),
        ("2м", 2.0),
        ("50 cm", 0.5),
        ("50см", 0.5),
        ("1500 mm", 1.5),
        ("0,5 km", 500.0),
        ("1 m + 20 cm", 1.2),
        ("1 + 20 cm", 1.2),
        ("2*(10 cm + 5 mm)", 0.21),
        ("1/2 m", 0.5),
        ("3/4 cm", 0.0075),
        ("(6 m / 2 cm) m", 300.0),
        ("6 m / 3", 2.0),
        ("6 m / 2 cm", 300.0),
        ("-2 cm", -0.02),
        ("sqrt((3 m)^2 + (4 m)^2)", 5.0),
        ("2 m * sin(30°)", 1.0),
        ("sqrt(2) m", std::f64::consts::SQRT_2),
    ] {
        assert_eq!(read(text, Unit::Meters), Ok(value), "{text}");
    }
    for (text, value) in
        [("45°", 45.0), ("45 deg", 45.0), ("90/2", 45.0), ("45 град", 45.0), ("acos(0)/2", 45.0)]
    {
        assert_eq!(read(text, Unit::Degrees), Ok(value), "{text}");
    }
    assert!((read("pi/4 rad", Unit::Degrees).unwrap() - 45.0).abs() < 1e-12);
    for (text, unit) in [
        ("2 m", Unit::None),
        ("45°", Unit::Meters),
        ("2 m", Unit::Degrees),
        ("2 m * 3 m", Unit::Meters),
        ("1 m + 1°", Unit::Meters),
        ("2 m m", Unit::Meters),
        ("sqrt(2 m)", Unit::Meters),
        ("2^(1 m)", Unit::Meters),
        ("sin(1 m)", Unit::Meters),
        ("atan(1)", Unit::Meters),
        ("1/(2 m)", Unit::Meters),
    ] {
        assert_eq!(read(text, unit), Err(ExpressionErrorKind::Unit), "{text}");
    }
    assert_eq!(read("2 cm^2", Unit::Meters), Err(ExpressionErrorKind::PowerOfUnit));
}

#[test]
fn what_is_no_number_is_refused_whole_and_told_where() {
    for (text, kind, place) in [
        ("0.5abc", ExpressionErrorKind::Unknown, 3..6),
        ("abc", ExpressionErrorKind::Unknown, 0..3),
        ("1 + foo", ExpressionErrorKind::Unknown, 4..7),
        ("5 €", ExpressionErrorKind::Unknown, 2..3),
        ("nan", ExpressionErrorKind::Unknown, 0..3),
        ("inf", ExpressionErrorKind::Unknown, 0..3),
        ("1_000", ExpressionErrorKind::Unknown, 1..2),
        ("0x10", ExpressionErrorKind::Unknown, 1..2),
        ("", ExpressionErrorKind::NumberMissing, 0..0),
        ("1 +", ExpressionErrorKind::NumberMissing, 3..3),
        ("1 + * 2", ExpressionErrorKind::NumberMissing, 4..5),
        ("m", ExpressionErrorKind::NumberMissing, 0..1),
        ("1 2", ExpressionErrorKind::OperatorMissing, 2..3),
        ("2(3)", ExpressionErrorKind::OperatorMissing, 1..2),
        ("2 pi", ExpressionErrorKind::OperatorMissing, 2..4),
        ("(1 2)", ExpressionErrorKind::OperatorMissing, 3..4),
        ("(1 + 2", ExpressionErrorKind::Parenthesis, 0..1),
        ("1 + 2)", ExpressionErrorKind::Parenthesis, 5..6),
        ("()", ExpressionErrorKind::Parenthesis, 1..2),
        ("sqrt 2", ExpressionErrorKind::ArgumentMissing, 0..4),
        ("1..2", ExpressionErrorKind::Number, 0..3),
        ("1/0", ExpressionErrorKind::NotFinite, 0..3),
        ("1e999", ExpressionErrorKind::NotFinite, 0..5),
        ("10^999", ExpressionErrorKind::NotFinite, 0..6),
        ("1 + sqrt(-1)", ExpressionErrorKind::NotFinite, 4..12),
        ("2*ln(0)", ExpressionErrorKind::NotFinite, 2..7),
    ] {
        assert_eq!(
            evaluate(text, Unit::None, DecimalSign::Point),
            Err(ExpressionError { kind, place }),
            "{text}"
        );
    }
}

#[test]
fn long_and_deep_texts_are_refused_without_harm() {
    for text in ["(".repeat(150), "1+".repeat(5000), "2^".repeat(90), format!("{}1", "-".repeat(190))] {
        let _ = plain(&text).is_err();
    }
    assert_eq!(plain(&"(".repeat(150)), Err(ExpressionErrorKind::TooLong));
    assert_eq!(plain(&"9".repeat(201)), Err(ExpressionErrorKind::TooLong));
    assert_eq!(plain(&"9".repeat(200)), Ok("9".repeat(200).parse().unwrap()));
}

/// What the program shows is read back as the same number, in either language.
#[test]
fn shown_numbers_are_read_again() {
    for value in [0.0, 1.0, -1.75, 1e-9, 2.5e12, -0.3, 1234.5, 1.0 / 3.0, f64::MAX, f64::MIN_POSITIVE] {
        for language in crate::base::texts::Language::ALL {
            let text = super::super::exact(&crate::base::texts::Texts::new(language), value);
            let read = evaluate(&text, Unit::None, language.decimal_sign()).unwrap();
            assert!((read - value).abs() <= 1e-11 * value.abs(), "{text}: {read}");
        }
    }
}

/// Nothing that is typed panics, and what is read does not depend on spaces around it.
#[test]
fn any_text_is_read_or_refused() {
    let parts = [
        "1", "2,5", "0.1", "+", "-", "*", "/", "^", "(", ")", "pi", "sqrt", "sin(", "cm", "°", " ", "e", "я",
        ".", ",",
    ];
    let mut state = 1_u64;
    for _ in 0..20_000 {
        let mut text = String::new();
        for _ in 0..(state >> 33) % 9 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            text.push_str(parts[(state >> 33) as usize % parts.len()]);
        }
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let read = evaluate(&text, Unit::Meters, DecimalSign::Point);
        let spaced = evaluate(&format!("  {text} "), Unit::Meters, DecimalSign::Point);
        assert_eq!(read.as_ref().ok(), spaced.as_ref().ok(), "{text}");
        if let Err(fault) = read {
            assert!(
                fault.place.start <= fault.place.end && fault.place.end <= text.chars().count(),
                "{text}"
            );
        }
    }
}

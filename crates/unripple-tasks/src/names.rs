//! Focusing methods and interpolations by name, for the fields of requests.

/// Reads and writes a focusing method by its name, for `#[serde(with)]`.
pub mod method {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};
    use unripple::focus::Method;

    /// Writes the name of a focusing method.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(method: &Method, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(method.name())
    }

    /// Reads a focusing method by its name.
    ///
    /// # Errors
    /// If no method has that name.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Method, D::Error> {
        named(&String::deserialize(from)?)
    }

    /// The method that has a name, or an error if there is none.
    pub(super) fn named<E: Error>(name: &str) -> Result<Method, E> {
        let found = Method::ALL.into_iter().find(|method| method.name() == name);
        found.ok_or_else(|| {
            let names = Method::ALL.map(Method::name).join(", ");
            E::custom(format!("expected one of {names}, found `{name}`"))
        })
    }
}

/// Reads and writes a list of focusing methods by their names, for `#[serde(with)]`.
pub mod methods {
    use super::method::named;
    use serde::{Deserialize, Deserializer, Serializer};
    use unripple::focus::Method;

    /// Writes the names of focusing methods, as a list.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(methods: &[Method], to: S) -> Result<S::Ok, S::Error> {
        to.collect_seq(methods.iter().map(|method| method.name()))
    }

    /// Reads a list of focusing methods by their names.
    ///
    /// # Errors
    /// If no method has one of those names.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Method>, D::Error> {
        Vec::<String>::deserialize(from)?.iter().map(|name| named(name)).collect()
    }
}

/// Reads and writes an interpolation between the points of a library by its name, for `#[serde(with)]`.
pub mod interpolation {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};
    use unripple_calibrate::Interpolation;

    const ALL: [Interpolation; 3] = [Interpolation::Nearest, Interpolation::Linear, Interpolation::Kernel];

    /// Writes the name of an interpolation.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(way: &Interpolation, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(way.name())
    }

    /// Reads an interpolation by its name.
    ///
    /// # Errors
    /// If no interpolation has that name.
    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Interpolation, D::Error> {
        let name = String::deserialize(from)?;
        let found = ALL.into_iter().find(|way| way.name() == name);
        found.ok_or_else(|| {
            let names = ALL.map(Interpolation::name).join(", ");
            D::Error::custom(format!("expected one of {names}, found `{name}`"))
        })
    }
}

//! The list of the laws, written once (`mod.rs`), becomes the type of a scene's `law` and its place among all laws.

/// The laws of a scene: each is a type of its own that is a `PointLaw`; its `type` in a scene is its name in lower case.
macro_rules! laws {
    ($($(#[doc = $about:literal])+ $(#[cfg($when:meta)])? $name:ident,)+) => {
        /// The law of an interface, as written in the scene under `law`.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "type", rename_all = "lowercase")]
        pub enum Law {
            $($(#[doc = $about])+ $(#[cfg($when)])? $name($name),)+
        }

        impl Deref for Law {
            type Target = dyn PointLaw;

            fn deref(&self) -> &(dyn PointLaw + 'static) {
                match self {
                    $($(#[cfg($when)])? Law::$name(law) => law,)+
                }
            }
        }

        impl Law {
            /// The answer at a jump, reached in a straight line from the old state. Allocates nothing.
            #[inline]
            pub fn respond(
                &self,
                jump: Local,
                old: &State,
                integration: Integration,
            ) -> Result<Response, Unresolved> {
                if !jump.iter().all(|component| component.is_finite()) {
                    return Err(Unresolved::NotFinite { jump });
                }
                match self {
                    $($(#[cfg($when)])? Law::$name(law) => law.respond(jump, old, integration),)+
                }
            }
        }

        /// Variables of every law, law by law.
        fn lists() -> impl Iterator<Item = &'static [LawVariable]> {
            [$($(#[cfg($when)])? <$name as PointLaw>::all_variables(),)+].into_iter()
        }
    };
}

pub(super) use laws;

//! A cache of values made once each: programs, plans and derivatives, by their function or recording.
use crate::error::Error;
use crate::kernels::row::derivation::{Mode, Order};
use std::any::{Any, TypeId};
use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

/// The key of a value that a recording keeps: a program, a plan, or a derivative as a function of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Key {
    /// The program of a mode.
    Program(Mode),
    /// The plan of the CPU; `true` for all pairs, with shapes prepared once.
    Cpu(Mode, bool),
    /// The kernels of a GPU; `true` for all pairs, with shapes prepared once.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "used with the feature gpu")
    )]
    Gpu(Mode, bool),
    /// The replays of a search.
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "used with the feature gpu")
    )]
    Replays(Mode),
    /// A derivative as a function.
    Derived(Mode),
    /// Minus the function.
    Negated,
    /// The bounds of its arguments along the axes.
    AxisBounds,
    /// A derivative along directions as a function.
    Along(Order),
}

type CachedValue = Arc<dyn Any + Send + Sync>;

/// A cache of values of any type, each made once, by their keys.
pub(crate) struct Once<K>(RwLock<HashMap<K, CachedValue>>);

impl<K> Default for Once<K> {
    fn default() -> Self {
        Once(RwLock::default())
    }
}

impl<K: Eq + Hash> Once<K> {
    /// Returns the value of a key, made at first use. Each key has one type.
    pub(crate) fn made<X: Send + Sync + 'static>(
        &self,
        key: K,
        make: &dyn Fn() -> Result<X, Error>,
    ) -> Result<Arc<X>, Error> {
        let known = self.0.read().unwrap_or_else(PoisonError::into_inner);
        let found = known.get(&key).cloned();
        drop(known);
        let found = match found {
            Some(found) => found,
            None => {
                let made: CachedValue = Arc::new(make()?);
                let mut known = self.0.write().unwrap_or_else(PoisonError::into_inner);
                // If two threads made one, both use the first.
                Arc::clone(known.entry(key).or_insert(made))
            }
        };
        Ok(found
            .downcast()
            .unwrap_or_else(|_| unreachable!("a key stands for one type")))
    }
}

/// The cache of a recording: programs of modes, plans of machines, derivatives.
pub(crate) type RecordingCache = Once<Key>;

/// The recordings and programs of all functions, by the type of the function and that of the value.
static KNOWN: LazyLock<Once<(TypeId, TypeId)>> = LazyLock::new(Once::default);

/// Returns the recording of a function, which is made once per type and format.
pub(crate) fn known<F: 'static, X: Send + Sync + 'static>(
    make: impl Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    known_by(TypeId::of::<F>(), &make)
}

/// Returns the recording of the function with a type id, which is made once.
pub(crate) fn known_by<X: Send + Sync + 'static>(
    function: TypeId,
    make: &dyn Fn() -> Result<X, Error>,
) -> Result<Arc<X>, Error> {
    KNOWN.made((function, TypeId::of::<X>()), make)
}

//! Sites, weights and a domain.
use crate::error::{Argument, Error, Field, Flaw};
use crate::polygon::Rings;
use crate::{Scalar, Vec2};

/// Sites with weights in a polygon. See the [module](super).
#[derive(Clone, Copy, Debug)]
pub struct PowerDiagram<'a, S> {
    pub(super) sites: &'a [Vec2<S>],
    pub(super) weights: &'a [S],
    pub(super) domain: Rings<'a, S>,
}

impl<'a, S: Scalar<Mask = bool>> PowerDiagram<'a, S> {
    /// Creates the diagram of sites and their weights, in squared units of length, in a domain. A list without weights
    /// stands for equal ones.
    ///
    /// # Errors
    ///
    /// [`Error::Length`] for another number of weights than of sites; [`Error::Invalid`] for a site or a weight that is
    /// not finite, and for a ring of the domain with fewer than three distinct vertices or one that is not finite.
    pub fn new(
        sites: &'a [Vec2<S>],
        weights: &'a [S],
        domain: impl Into<Rings<'a, S>>,
    ) -> Result<Self, Error> {
        let domain = domain.into();
        if !weights.is_empty() && weights.len() != sites.len() {
            return Err(Error::Length {
                argument: Argument::Named("weights"),
                expected: sites.len(),
                found: weights.len(),
            });
        }
        let invalid = |argument, item, flaw| {
            Err(Error::Invalid {
                argument: Argument::Named(argument),
                item,
                flaw,
            })
        };
        for (item, site) in sites.iter().enumerate() {
            for (name, x) in [("x", site.x), ("y", site.y)] {
                if !x.finite() {
                    return invalid("sites", item, Flaw::NotFinite(Field::new(name)));
                }
            }
        }
        if let Some(item) = weights.iter().position(|weight| !weight.finite()) {
            return invalid("weights", item, Flaw::NotFinite(Field::VALUE));
        }
        match domain.validate() {
            Ok(()) => Ok(PowerDiagram {
                sites,
                weights,
                domain,
            }),
            Err(flaw) => invalid("domain", 0, flaw),
        }
    }
}

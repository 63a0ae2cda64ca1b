//! Encodings of turned boxes in the plane.
use super::{Clockwise, Counterclockwise, Degrees, Period, Radians};
use crate::{Obb2, Scalar, Shape, Vec2};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// A turned box in an image, where y points down: the heading turns from x towards y, which is clockwise to
/// the viewer.
///
/// ```
/// use geograd::{Obb2, Vec2, convention::{Clockwise, ImageBox}};
/// let seen = ImageBox {
///     center: Vec2::new(100.0, 20.0),
///     size: Vec2::new(40.0, 10.0),
///     heading: Clockwise { radians: 0.25_f64 },
/// };
/// // In a frame at the lower left corner of an image 480 pixels high, y up:
/// assert_eq!(seen.upright(480.0), Obb2::new(100.0, 460.0, 40.0, 10.0, -0.25));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct ImageBox<S> {
    /// The centre, in pixels from the upper left corner.
    pub center: Vec2<S>,
    /// Width and height, along the box's own x and y axes.
    #[shape(non_negative, length)]
    pub size: Vec2<S>,
    /// The angle of the box's own x axis.
    pub heading: Clockwise<S>,
}

impl<S: Scalar> ImageBox<S> {
    /// Returns the box where y points up, in an image of a height.
    #[must_use]
    #[inline]
    pub fn upright(self, image_height: S) -> Obb2<S> {
        Obb2 {
            center: Vec2::new(self.center.x, image_height - self.center.y),
            size: self.size,
            heading: Counterclockwise::from(self.heading).radians,
        }
    }
    /// Returns the inverse of [`upright`](Self::upright).
    #[must_use]
    #[inline]
    pub fn from_upright(shape: Obb2<S>, image_height: S) -> Self {
        ImageBox {
            center: Vec2::new(shape.center.x, image_height - shape.center.y),
            size: shape.size,
            heading: Counterclockwise {
                radians: shape.heading,
            }
            .into(),
        }
    }
    /// Returns the mirrored box: its numbers read in a frame with y upwards. Measures that mirrors do not change, such
    /// as areas and overlaps of two boxes that are both mirrored, can be computed from it.
    #[must_use]
    #[inline(always)]
    pub fn mirrored(self) -> Obb2<S> {
        Obb2 {
            center: self.center,
            size: self.size,
            heading: self.heading.radians,
        }
    }
    /// Returns the inverse of [`mirrored`](Self::mirrored).
    #[must_use]
    #[inline(always)]
    pub fn from_mirrored(shape: Obb2<S>) -> Self {
        ImageBox {
            center: shape.center,
            size: shape.size,
            heading: Clockwise {
                radians: shape.heading,
            },
        }
    }
    /// Returns center, width, height and heading of the box with its longer side as width.
    #[inline(always)]
    fn long_edge(self) -> (Vec2<S>, S) {
        let swap = self.size.x.below(self.size.y);
        let size = Vec2::new(
            self.size.x.most(self.size.y),
            self.size.x.least(self.size.y),
        );
        let turned = self.heading.radians + S::lit(FRAC_PI_2);
        (size, S::select(swap, turned, self.heading.radians))
    }
}

/// One of the encodings that are an image's box with a chosen range of the angle.
macro_rules! ranged {
    ($(#[$doc:meta])* $name:ident { $heading:literal } |$shape:ident| $made:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Shape)]
        #[shape(except(Arbitrary))]
        #[repr(C)]
        pub struct $name<S> {
            /// The centre, in pixels from the upper left corner.
            pub center: Vec2<S>,
            /// Width and height, along the box's own x and y axes.
            #[shape(non_negative, length)]
            pub size: Vec2<S>,
            #[doc = $heading]
            pub heading: Clockwise<S>,
        }
        impl<S: Scalar> From<$name<S>> for ImageBox<S> {
            #[inline(always)]
            fn from(shape: $name<S>) -> Self {
                ImageBox { center: shape.center, size: shape.size, heading: shape.heading }
            }
        }
        impl<S: Scalar> From<ImageBox<S>> for $name<S> {
            #[inline]
            fn from($shape: ImageBox<S>) -> Self {
                let (size, radians): (Vec2<S>, S) = $made;
                $name { center: $shape.center, size, heading: Clockwise { radians } }
            }
        }
    };
}

ranged! {
    /// mmrotate's `le90`: the width is the longer side. Kinks: squares, and the ends of the range.
    Le90 { "In `[−π/2, π/2)`." }
    |shape| {
        let (size, angle) = shape.long_edge();
        (size, from(Period::Half.wrap(angle), -FRAC_PI_2))
    }
}
ranged! {
    /// mmrotate's `le135`: the width is the longer side. Kinks: squares, and the ends of the range.
    Le135 { "In `[−π/4, 3π/4)`." }
    |shape| {
        let (size, angle) = shape.long_edge();
        (size, from(Period::Half.wrap(angle), -FRAC_PI_4))
    }
}
ranged! {
    /// The box of OpenCV's `minAreaRect` since 4.5.1, in radians instead of degrees: either side may be the longer one.
    /// Kinks: the ends of the range.
    OpenCvBox { "In `(0, π/2]`." }
    |shape| {
        let angle = Period::Half.wrap(shape.heading.radians);
        let (zero, right) = (S::zero(), S::lit(FRAC_PI_2));
        let back = angle.at_most(-right);
        let swap = angle.at_most(zero) & !back;
        let size = shape.size;
        let turned = S::select(swap, angle + right, S::select(back, angle + S::lit(PI), angle));
        let width = S::select(swap, size.y, size.x);
        (Vec2::new(width, S::select(swap, size.x, size.y)), turned)
    }
}

/// Returns an angle of `[−π/2, π/2]` in `[low, low + π)`, for a negative low.
#[inline(always)]
fn from<S: Scalar>(angle: S, low: f64) -> S {
    let half = S::lit(PI);
    let raised = S::select(angle.below(S::lit(low)), angle + half, angle);
    S::select(raised.at_least(S::lit(low) + half), raised - half, raised)
}

/// detectron2's `RotatedBoxes`: in an image, y down, but with an angle in degrees that grows
/// counter-clockwise to the viewer.
///
/// ```
/// use geograd::{Vec2, convention::{Degrees, Detectron2Box, ImageBox}};
/// let made = Detectron2Box {
///     center: Vec2::new(50.0, 50.0),
///     size: Vec2::new(20.0, 10.0),
///     heading: Degrees { value: 90.0_f64 },
/// };
/// assert_eq!(ImageBox::from(made).heading.radians, -std::f64::consts::FRAC_PI_2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Detectron2Box<S> {
    /// The centre, in pixels from the upper left corner.
    pub center: Vec2<S>,
    /// Width and height, along the box's own x and y axes.
    #[shape(non_negative, length)]
    pub size: Vec2<S>,
    /// Counter-clockwise to the viewer.
    pub heading: Degrees<S>,
}

impl<S: Scalar> From<Detectron2Box<S>> for ImageBox<S> {
    #[inline]
    fn from(shape: Detectron2Box<S>) -> Self {
        let radians = Radians::from(shape.heading).value;
        ImageBox {
            center: shape.center,
            size: shape.size,
            heading: Counterclockwise { radians }.into(),
        }
    }
}
impl<S: Scalar> From<ImageBox<S>> for Detectron2Box<S> {
    #[inline]
    fn from(shape: ImageBox<S>) -> Self {
        let value = Counterclockwise::from(shape.heading).radians;
        Detectron2Box {
            center: shape.center,
            size: shape.size,
            heading: Radians { value }.into(),
        }
    }
}

/// The bounds of a box before it was turned about its centre, and the angle in radians,
/// counter-clockwise.
///
/// ```
/// use geograd::{Obb2, convention::Xyxyr};
/// let shape = Obb2::new(2.0, 1.0, 4.0, 2.0, 0.5);
/// let bounds = Xyxyr::from(shape);
/// assert_eq!((bounds.min.x, bounds.max.y), (0.0, 2.0));
/// assert_eq!(Obb2::from(bounds), shape);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Shape)]
#[shape(except(Arbitrary))]
#[repr(C)]
pub struct Xyxyr<S> {
    /// The lower bounds before turning.
    #[shape(at_most = "max")]
    pub min: Vec2<S>,
    /// The upper bounds before turning.
    pub max: Vec2<S>,
    /// The angle in radians, counter-clockwise.
    #[shape(angle)]
    pub heading: S,
}

impl<S: Scalar> From<Xyxyr<S>> for Obb2<S> {
    #[inline]
    fn from(shape: Xyxyr<S>) -> Self {
        let half = S::lit(0.5);
        Obb2 {
            center: shape.min * half + shape.max * half,
            size: shape.max - shape.min,
            heading: shape.heading,
        }
    }
}
impl<S: Scalar> From<Obb2<S>> for Xyxyr<S> {
    #[inline]
    fn from(shape: Obb2<S>) -> Self {
        let half = shape.size * S::lit(0.5);
        Xyxyr {
            min: shape.center - half,
            max: shape.center + half,
            heading: shape.heading,
        }
    }
}

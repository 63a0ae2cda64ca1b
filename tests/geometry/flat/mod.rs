//! Shapes of the plane, their distances and intersections.
mod any;
mod contacts;
mod distance;
mod extremes;
mod intersection;
mod meeting;
mod oracle;
mod ring;
mod shapes;
mod touched;

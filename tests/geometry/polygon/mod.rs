//! Polygons: what they share, their clips, hulls, measures and scores.
mod cases;
mod exact;
mod iou;
mod overlap;
mod shapes;

//! Polygons: what they share, their clips, hulls, measures and scores.
mod adjoints;
#[cfg(feature = "boolean")]
mod boolean;
mod cases;
mod cell_oracle;
mod cells;
mod curve_places;
mod curve_rows;
mod curves;
#[cfg(feature = "boolean")]
mod cut;
pub mod exact;
mod iou;
mod leashes;
#[cfg(feature = "boolean")]
mod minkowski;
mod nearest_edges;
#[cfg(feature = "boolean")]
mod offset_peers;
#[cfg(feature = "boolean")]
mod offsets;
mod overlap;
mod published;
mod rings;
#[cfg(feature = "boolean")]
mod round_offsets;
pub mod scanline;
mod shapes;
#[cfg(feature = "boolean")]
mod simple;
mod triangulations;
#[cfg(feature = "boolean")]
mod valid;
#[cfg(feature = "boolean")]
mod walked_unions;

//! Shapes of space: measures, distances, rays.
mod certificates;
mod distances;
mod draw;
mod oracle;
mod rays;
mod shapes;
mod slopes;

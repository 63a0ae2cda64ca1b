//! Shapes of space: measures, distances, rays.
mod certificates;
mod contacts;
mod depths;
mod distances;
mod draw;
mod inertia;
mod oracle;
mod points;
mod rays;
mod shapes;
mod slopes;

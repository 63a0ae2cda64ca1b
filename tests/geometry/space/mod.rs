//! Shapes of space: measures, distances, rays.
mod borders;
mod certificates;
mod contacts;
mod depths;
mod distances;
mod draw;
mod far_bounds;
mod inertia;
mod oracle;
mod parallels;
mod points;
mod rays;
mod revolved_slopes;
mod shapes;
mod slopes;
mod walls;

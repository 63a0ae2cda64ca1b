//! Shapes of space: measures, distances, rays.
mod borders;
mod certificates;
mod distances;
mod draw;
mod exact;
mod inertia;
mod oracle;
mod ray_rows;
mod rays;
mod shapes;
mod slopes;
mod thin;

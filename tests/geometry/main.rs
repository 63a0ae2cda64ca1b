//! What geometry promises, number by number.
mod oracle;
mod overlap;
mod polygon;
mod projection;
mod ring;
mod scalar;
mod source;

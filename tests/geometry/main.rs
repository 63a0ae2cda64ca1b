//! What geometry promises, number by number.
mod fingerprint;
mod oracle;
mod overlap;
mod projection;
mod ring;
mod scalar;
mod shape;
mod source;

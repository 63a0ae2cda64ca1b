//! What geometry promises, number by number.
mod convention;
mod fingerprint;
mod gaussian;
mod iou3;
mod oracle;
mod oracle_solid;
mod overlap;
mod pairs;
mod projection;
mod recorded;
mod ring;
mod rotation;
mod scalar;
mod shape;
mod solids;
mod source;

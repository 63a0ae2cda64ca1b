//! The harness that proves derivatives, and what it proves of ours.
mod adjoint;
mod behaviour;
mod checker;
mod corpus;
mod difficult;
mod everyday;
mod forward;
mod hashes;
mod planted;
mod program;
mod program_random;
mod program_slopes;
mod shrinking;
mod strategy;
mod ties;
mod unrecorded;
mod witness;

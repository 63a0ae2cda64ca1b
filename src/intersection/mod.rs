//! Where shapes meet.

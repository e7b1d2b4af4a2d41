//! What targets look like.

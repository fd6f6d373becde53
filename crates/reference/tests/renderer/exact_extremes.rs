//! The exact renderer where geometry and material are extreme.

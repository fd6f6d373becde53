//! Pre-integrated classification: whole segments of a ray, looked up by the values at their two ends.

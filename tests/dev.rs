#![allow(missing_docs, clippy::unwrap_used, dead_code)]
mod common;
mod law_help;
mod flow;
mod pressurised;
mod dam;
mod law_cohesive;
mod water;

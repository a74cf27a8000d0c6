//! The views of judged results, over a beam with a family of settings and a small patch test.

mod files;
mod fixture;
mod margins;
mod page;
mod results;
mod terminal;

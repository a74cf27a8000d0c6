//! The words of what makes a user's first hour easier: new, schema, completions.

use clap::{Args, ValueEnum};
use clap_complete::Shell;
use std::path::PathBuf;

/// `seam new`
#[derive(Debug, Args)]
pub struct New {
    /// Id of the scene: lower case, digits, hyphens
    pub id: String,
    /// Folder for ID.toml
    #[arg(long, value_name = "DIR", default_value = ".")]
    pub folder: PathBuf,
}

/// `seam schema`
#[derive(Debug, Args)]
pub struct Schema {
    /// Of what
    #[arg(value_enum)]
    pub of: Text,
}

/// What a schema describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Text {
    /// Scene files
    Scene,
    /// results.json
    Results,
}

/// `seam completions`
#[derive(Debug, Args)]
pub struct Completions {
    /// Of which shell
    #[arg(value_enum)]
    pub shell: Shell,
}

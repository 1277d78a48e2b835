//! Directories and JSON files.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;

/// Creates a directory where it is missing.
///
/// # Errors
///
/// When it cannot be created.
pub fn make_directory(out: &Path) -> Result<()> {
    fs::create_dir_all(out)
        .with_context(|| format!("cannot make the directory '{}'; choose another with --out", out.display()))
}

/// Writes a report as JSON.
///
/// # Errors
///
/// When the file cannot be written.
pub fn write_json(report: &impl Serialize, path: &Path) -> Result<()> {
    let mut text = serde_json::to_string_pretty(report).context("the report cannot be put in words")?;
    text.push('\n');
    fs::write(path, text).with_context(|| format!("cannot write '{}'", path.display()))
}

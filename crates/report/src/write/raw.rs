//! Raw figures as CSV, and all of them as JSON.

use anyhow::{Context, Result, ensure};
use csv::Writer;
use serde_json::Value;

use super::Report;
use crate::chapter::Raw;
use crate::size::Size;

/// The records as CSV: the first line has the names of the fields. Numbers have all their digits.
pub(super) fn csv(raw: &Raw) -> Result<Vec<u8>> {
    let mut writer = Writer::from_writer(Vec::new());
    if let Some(first) = raw.records.first() {
        writer.write_record(first.keys())?;
        for (index, record) in raw.records.iter().enumerate() {
            ensure!(record.keys().eq(first.keys()), "record {index} has other fields than the first");
            writer.write_record(record.values().map(cell))?;
        }
    }
    writer.into_inner().map_err(|error| error.into_error()).context("it cannot be written as CSV")
}

/// The whole report for programs: the machine, the command, and all lists by their names, a record a line.
pub(super) fn json(report: &Report) -> Result<String> {
    let list = |raw: &Raw| -> Result<String> {
        let records = raw.records.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>()?;
        Ok(format!("\"{}\": [\n{}\n]", raw.name, records.join(",\n")))
    };
    let lists = report.raw().map(list).collect::<Result<Vec<_>>>()?;
    Ok(format!(
        "{{\n\"machine\": {},\n\"command\": {},\n\"smoke\": {},\n\"raw\": {{\n{}\n}}\n}}\n",
        serde_json::to_string(&report.machine)?,
        serde_json::to_string(&report.command)?,
        report.size == Size::Smoke,
        lists.join(",\n")
    ))
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(words) => words.clone(),
        other => other.to_string(),
    }
}

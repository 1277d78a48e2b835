//! What the report ran on. Nothing that names a person or a place.

use std::fmt;

use serde::Serialize;
use sysinfo::{CpuRefreshKind, MemoryRefreshKind, RefreshKind, System};

/// A machine, and what was built for it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The processor's name.
    pub processor: String,
    /// How many cores it has, where the system says so.
    pub cores: Option<usize>,
    /// How many threads it runs at once, or as many of them as this system was given.
    pub threads: usize,
    /// Its memory, in mebibytes.
    pub memory_mib: u64,
    /// The graphics card, where one was asked.
    pub card: Option<String>,
    /// The operating system.
    pub system: String,
    /// The compiler.
    pub compiler: String,
    /// Whether debug assertions were compiled in, which a release leaves out.
    pub debug_assertions: bool,
    /// The version of the crate that was measured.
    pub shadowfit: String,
}

impl Machine {
    /// The one this runs on, with the name of its graphics card, where one was asked.
    #[must_use]
    pub fn this(card: Option<String>) -> Self {
        let asked = RefreshKind::nothing()
            .with_cpu(CpuRefreshKind::nothing())
            .with_memory(MemoryRefreshKind::nothing().with_ram());
        let system = System::new_with_specifics(asked);
        let processor = system.cpus().first().map(|cpu| cpu.brand().trim()).filter(|brand| !brand.is_empty());
        Self {
            processor: processor.map_or_else(System::cpu_arch, str::to_owned),
            cores: System::physical_core_count(),
            threads: system.cpus().len(),
            memory_mib: system.total_memory() >> 20,
            card,
            system: System::long_os_version().unwrap_or_else(|| std::env::consts::OS.to_owned()),
            compiler: format!("rustc {}", rustc_version_runtime::version()),
            debug_assertions: cfg!(debug_assertions),
            shadowfit: version().to_owned(),
        }
    }
}

/// The version of the crate, from its manifest: it has no constant for it.
fn version() -> &'static str {
    let line = include_str!("../../../Cargo.toml").lines().find_map(|line| line.strip_prefix("version = "));
    line.unwrap_or_default().trim_matches('"')
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let memory = self.memory_mib as f64 / 1024.0;
        write!(f, "{}, ", self.processor)?;
        if let Some(cores) = self.cores {
            write!(f, "{cores} cores, ")?;
        }
        write!(f, "{} threads, {memory:.0} GiB", self.threads)?;
        if let Some(card) = &self.card {
            write!(f, "; {card}")?;
        }
        let build = if self.debug_assertions { "with debug assertions" } else { "without debug assertions" };
        write!(f, "; {}; {}, {build}; shadowfit {}", self.system, self.compiler, self.shadowfit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_is_described() {
        let machine = Machine::this(Some("a card".into()));
        assert!(machine.threads > 0 && machine.memory_mib > 0 && !machine.processor.is_empty());
        let line = machine.to_string();
        for part in [&machine.processor, "a card", &machine.system, &machine.compiler] {
            assert!(line.contains(part), "{line}");
        }
        assert!(!line.contains('\n'), "{line}");
    }

    #[test]
    fn the_version_is_that_of_the_crate() {
        let parts: Vec<&str> = version().split('.').collect();
        assert!(parts.len() == 3 && parts.iter().all(|part| part.parse::<u32>().is_ok()), "{parts:?}");
    }
}

//! The machine on which something was measured.

use std::collections::BTreeSet;

use sysinfo::{CpuRefreshKind, MemoryRefreshKind, RefreshKind, System};

/// The machine that measured, as a report describes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Machine {
    /// The processor's name, as it gives it; empty when unknown.
    pub processor: String,
    /// Cores, where they are known.
    pub cores: Option<usize>,
    /// Threads that run at the same time.
    pub threads: usize,
    /// Memory in bytes; 0 when unknown.
    pub memory_bytes: u64,
    /// The operating system with its version; empty when unknown.
    pub system: String,
    /// The program with its version, and how it was compiled if not for speed.
    pub program: String,
}

impl Machine {
    /// The machine that runs the program.
    pub fn here() -> Self {
        let wanted = RefreshKind::nothing()
            .with_cpu(CpuRefreshKind::nothing())
            .with_memory(MemoryRefreshKind::nothing().with_ram());
        let system = System::new_with_specifics(wanted);
        // What is not known on a system is left out.
        let cpus = system.as_ref().map(System::cpus).unwrap_or_default();
        let names: BTreeSet<&str> = cpus.iter().map(|cpu| cpu.brand().trim()).collect();
        let parallelism = catoptric_platform::threads::processors();
        Self {
            processor: names.into_iter().filter(|name| !name.is_empty()).collect::<Vec<_>>().join(", "),
            cores: System::physical_core_count().ok(),
            threads: parallelism,
            memory_bytes: system.as_ref().map_or(0, System::total_memory),
            system: [System::long_os_version().ok(), Some(std::env::consts::ARCH.to_owned())]
                .into_iter()
                .flatten()
                .collect::<Vec<_>>()
                .join(", "),
            program: format!(
                "catoptric {}{}",
                env!("CARGO_PKG_VERSION"),
                if cfg!(debug_assertions) { " (dev)" } else { "" }
            ),
        }
    }
}

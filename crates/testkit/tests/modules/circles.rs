//! Modules that use each other in a circle.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use petgraph::algo::tarjan_scc;
use petgraph::graph::DiGraph;

use crate::names::defined_in;
use crate::source::{Crate, Id};

/// Every circle of modules beside each other, with the files and the uses that close it.
pub(crate) fn circles(krate: &Crate) -> Vec<String> {
    // For each pair of modules beside each other, the uses of one by the other.
    let mut edges: BTreeMap<(Id, Id), Vec<String>> = BTreeMap::new();
    for (id, module) in krate.modules.iter().enumerate() {
        for used in &module.uses {
            let Some(of) = defined_in(krate, id, &used.path) else { continue };
            if let Some(edge) = beside(krate, id, of) {
                let line = format!("{}:{}: {}", module.file.display(), used.line, used.path.join("::"));
                edges.entry(edge).or_default().push(line);
            }
        }
    }
    let mut graph = DiGraph::<Id, ()>::new();
    let nodes: Vec<_> = (0..krate.modules.len()).map(|id| graph.add_node(id)).collect();
    for &(from, to) in edges.keys() {
        graph.add_edge(nodes[from], nodes[to], ());
    }
    let groups = tarjan_scc(&graph).into_iter().filter(|group| group.len() > 1);
    groups.map(|group| message(krate, &group.iter().map(|&node| graph[node]).collect::<Vec<_>>(), &edges)).collect()
}

/// Of two modules the two beside each other that they are or are in; none where one is in the other.
fn beside(krate: &Crate, from: Id, to: Id) -> Option<(Id, Id)> {
    let (from, to) = (line_of(krate, from), line_of(krate, to));
    from.into_iter().zip(to).find(|(from, to)| from != to)
}

/// A module's ancestors from the root on, and itself.
fn line_of(krate: &Crate, module: Id) -> Vec<Id> {
    let mut line: Vec<Id> = std::iter::successors(Some(module), |&id| krate.modules[id].parent).collect();
    line.reverse();
    line
}

fn message(krate: &Crate, group: &[Id], edges: &BTreeMap<(Id, Id), Vec<String>>) -> String {
    let mut group = group.to_vec();
    group.sort_unstable();
    let name = |id: Id| {
        line_of(krate, id).into_iter().map(|id| krate.modules[id].name.as_str()).collect::<Vec<_>>().join("::")
    };
    let mut text = format!("{} modules use each other in a circle:\n", group.len());
    for &id in &group {
        let _ = writeln!(text, "  {} ({})", name(id), krate.modules[id].file.display());
    }
    for (&(from, to), uses) in edges.iter().filter(|((from, to), _)| group.contains(from) && group.contains(to)) {
        let _ = writeln!(text, "  {} uses {}:", name(from), name(to));
        for used in uses.iter().take(3) {
            let _ = writeln!(text, "    {used}");
        }
        if uses.len() > 3 {
            let _ = writeln!(text, "    and {} more", uses.len() - 3);
        }
    }
    text
}

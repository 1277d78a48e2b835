//! Which module defines what a path names.

use crate::source::{Crate, Id};

/// The module that defines what a path in a module names: itself where it names a module. None for what is of another crate.
pub(crate) fn defined_in(krate: &Crate, module: Id, path: &[String]) -> Option<Id> {
    resolve(krate, module, path, &mut Vec::new())
}

/// `asked` are the imports on the way to this one, as imports may go around in a circle.
fn resolve<'a>(krate: &'a Crate, module: Id, path: &'a [String], asked: &mut Vec<(Id, &'a str)>) -> Option<Id> {
    let (first, rest) = path.split_first()?;
    match first.as_str() {
        "crate" => within(krate, 0, rest, asked),
        "self" => within(krate, module, rest, asked),
        "super" => {
            let parent = krate.modules[module].parent?;
            // Of `super::super::x` the rest begins with another.
            if rest.first().is_some_and(|next| next == "super") {
                resolve(krate, parent, rest, asked)
            } else {
                within(krate, parent, rest, asked)
            }
        }
        _ => within(krate, module, path, asked),
    }
}

/// The same of what follows the name of a module.
fn within<'a>(krate: &'a Crate, module: Id, path: &'a [String], asked: &mut Vec<(Id, &'a str)>) -> Option<Id> {
    let Some((first, rest)) = path.split_first() else { return Some(module) };
    let of = &krate.modules[module];
    if let Some(&child) = of.children.get(first) {
        // `module::CONSTANT`, or a name made by a macro, which is taken for the module's own.
        return within(krate, child, rest, asked).or(Some(child));
    }
    if of.items.contains(first) {
        return Some(module);
    }
    if asked.contains(&(module, first)) {
        return None;
    }
    asked.push((module, first));
    let imported = of.imports.iter().filter(|(name, _)| name == first).find_map(|(_, path)| {
        let found = resolve(krate, module, path, asked)?;
        let is_module = path.last() == Some(&krate.modules[found].name);
        if is_module && !rest.is_empty() { within(krate, found, rest, asked).or(Some(found)) } else { Some(found) }
    });
    let found = imported.or_else(|| {
        of.globs.iter().find_map(|glob| {
            let from = resolve(krate, module, glob, asked)?;
            within(krate, from, path, asked)
        })
    });
    asked.pop();
    found
}
